"""Cautions about cases outside the range in which the material or the model was validated."""

from __future__ import annotations

from stonepass.caution import Caution, caution
from stonepass.materials.derivatives import hoop_modulus, rest_moduli
from stonepass.materials.protocol import Material
from stonepass.materials.stability import SOFTEST_WALL
from stonepass.model.far_field import lumen_ratio
from stonepass.model.problem import Problem

__all__ = ["ring_buckling", "soft_law", "strain_range"]


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


def soft_law(material: Material) -> list[Caution]:
    """Return a caution if the wall is so soft that its constants probably have another unit."""
    shear = rest_moduli(material.law)[1]
    if shear >= SOFTEST_WALL:
        return []
    return [caution("soft_law", material=material.name, modulus_Pa=shear)]


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
