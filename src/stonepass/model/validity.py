"""Cautions about cases outside the range in which the material or the model was validated."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from stonepass.caution import Caution, caution
from stonepass.materials.derivatives import hoop_modulus, rest_moduli
from stonepass.materials.protocol import Law, Material
from stonepass.materials.stability import SOFTEST_WALL
from stonepass.model.far_field import lumen_ratio
from stonepass.model.problem import Problem
from stonepass.strain import CauchyGreen, Place

__all__ = ["law_cautions", "ring_buckling", "strain_range"]

PLACES = (0.0, 0.7, 3.1, 9.0)  # places along the tube, Z/R_a, at which the energy is compared
VARIATION = 1e-9  # relative difference of energies that is not a rounding error


def strain_range(case: Problem) -> list[Caution]:
    """Return cautions if stone or load deform the wall beyond the material's strain range."""
    material = case.ureter.material
    low, high = material.strain_range
    known = {"material": material.name, "low": low, "high": high}
    found = []
    if case.size_ratio > high:
        found.append(caution("wall_beyond_range", stretch=case.size_ratio, **known))
    lumen = lumen_ratio(case.wall_ratio, material.law, case.load)
    if lumen is not None and lumen < low:
        found.append(caution("lumen_below_range", lumen=lumen, **known))
    return found


def law_cautions(material: Material) -> list[Caution]:
    """Return cautions about the law of a material.

    One is that the wall is so soft that its constants probably have another unit. The other one is
    that the wall varies along the tube, for which neither the far field nor the check of stability
    holds.
    """
    found = []
    shear = rest_moduli(material.law)[1]
    if shear < SOFTEST_WALL:
        found.append(caution("soft_law", material=material.name, modulus_Pa=shear))
    if _varies_along(material.law):
        found.append(caution("varies_along", material=material.name))
    return found


@lru_cache(maxsize=32)
def _varies_along(law: Law) -> bool:
    """Return whether the energy of a strained wall depends on the place along the tube."""
    Z = np.array(PLACES)
    one = np.ones_like(Z)
    C = CauchyGreen(one / 1.21, 1.21 * one, one, 0.0 * one)
    with np.errstate(all="ignore"):  # the strain may be outside the range of a law
        energies = np.asarray(law.energy(C, Place(1.1 * one, Z), np)) * one
    return bool(np.ptp(energies) > VARIATION * np.abs(energies).max())


def ring_buckling(case: Problem) -> list[Caution]:
    """Return a caution if the confining pressure alone would make the tube collapse.

    A ring in plane strain with thickness h and mean radius R_m buckles into two lobes under an
    outside pressure of w″(1) h³/(4 R_m³) (Lévy 1884). This mode is not axisymmetric, so the models
    of this package cannot detect it. See "Stability" in docs/theory.md.
    """
    eta, pressure = case.wall_ratio, case.load.confining_pressure
    slenderness = (eta - 1.0) / ((eta + 1.0) / 2.0)
    buckling = hoop_modulus(case.ureter.material.law) * slenderness**3 / 4.0
    if pressure <= buckling:
        return []
    return [caution("ring_buckling", pressure_kPa=pressure / 1e3, buckling_kPa=buckling / 1e3)]
