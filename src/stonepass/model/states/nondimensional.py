"""Ureter, load and stone in the units of the finite elements: inner radius and hoop modulus."""

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


# The energy of a volume change, as a multiple of the pressure that a law has at rest, and at least
# that of rubber's.
VOLUME_WEIGHT, RUBBER = 1.2, 0.25


def tube_of(law: Law, wall_ratio: float, load: Load, half_length: float) -> Tube:
    """Divide lengths by the inner radius and pressures by w″(1).

    A law speaks of J = 1 only; beside it the energy is ours to choose, and gets ½ κ (J − 1)², here
    as κ (J² − 1)²/8. Finite elements keep volume on average over the pressure's polynomials. A
    motion that keeps it so, but not in between, gains −p (div v)², p the pressure in the wall, and
    would make a stable wall unstable on coarse meshes: κ outweighs that.
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
    """The stone in inner radii, its axis that of the tube."""
    shape = case.stone.shape
    return Profile(case.size_ratio, shape.aspect, outline=shape.outline)
