"""Conversion of ureter, load and stone to the scales of the finite elements.

Lengths are divided by the inner radius R_a, and pressures by the hoop modulus w″(1).
"""

from __future__ import annotations

from typing import Any

from stonepass.fe.axisymmetric.problem import Tube
from stonepass.fe.axisymmetric.profile import Profile
from stonepass.materials.derivatives import hoop_modulus, rest_gradient
from stonepass.materials.protocol import Law
from stonepass.model.load import Load
from stonepass.model.problem import Problem
from stonepass.strain import CauchyGreen, Place

__all__ = ["profile_of", "tube_of"]


# The factor κ of the volumetric energy is VOLUME_WEIGHT times the pressure in the wall at rest, or
# times that of a neo-Hookean wall, RUBBER × w″(1), if the latter is larger.
VOLUME_WEIGHT, RUBBER = 1.2, 0.25


def tube_of(law: Law, wall_ratio: float, load: Load, half_length: float) -> Tube:
    """Describe a tube in units of its inner radius and of the modulus w″(1).

    An incompressible law defines the energy for J = 1 only. For J ≠ 1 the volumetric energy
    κ (J² − 1)²/8, which is ½ κ (J − 1)² near J = 1, is added. The reason is that finite elements
    preserve the volume only on average, weighted with the polynomials of the pressure. A motion v
    that preserves the volume on average but not at every point changes the energy by −p (div v)²,
    where p is the pressure in the wall. On coarse meshes that would make a stable wall unstable; κ
    is large enough to prevent it. See "Stabilisation of the volume between the pressure nodes" in
    docs/theory.md.

    Parameters
    ----------
    law : Law
    wall_ratio : float
        η = R_b/R_a, above 1.
    load : Load
        Confining pressure and pre-stretch.
    half_length : float
        Half the length of the tube, L/R_a, in inner radii.
    """
    modulus = hoop_modulus(law)
    rest_pressure = 2.0 * float(rest_gradient(law)[0]) / modulus
    weight = VOLUME_WEIGHT * max(rest_pressure, RUBBER)

    def energy(C: CauchyGreen, place: Place, xp: Any) -> Any:
        change = C.tt * (C.rr * C.zz - C.rz * C.rz) - 1.0
        return law.energy(C, place, xp) / modulus + weight / 8.0 * change * change

    return Tube(
        energy=energy,
        wall_ratio=wall_ratio,
        half_length=half_length,
        axial_stretch=load.prestretch,
        outside_pressure=load.confining_pressure / modulus,
        hydrostatic=load.hydrostatic,
    )


def profile_of(case: Problem) -> Profile:
    """Return the meridian of the stone in inner radii, in its final position on the axis."""
    shape = case.stone.shape
    return Profile(case.size_ratio, shape.aspect, outline=shape.outline)
