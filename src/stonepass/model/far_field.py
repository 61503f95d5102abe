"""The tube far from the stone: urine pressure against inner radius (paper, Eqs 9–12, 20, 22)."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache

import numpy as np

from stonepass.array_types import Float
from stonepass.errors import BadInput
from stonepass.fe.core.roots import bracketed_root
from stonepass.materials.composition import fibres_of
from stonepass.materials.derivatives import hoop_energy_slope
from stonepass.materials.protocol import ClosedForm, Law
from stonepass.model.load import Load
from stonepass.model.problem import Problem
from stonepass.strain import Place
from stonepass.units import Values

__all__ = [
    "confining_traction",
    "far_field_law",
    "inflation",
    "inflation_by_quadrature",
    "lumen_ratio",
    "stuck_lumen",
    "urine_pressure",
]

QUADRATURE_POINTS = 48
SMALLEST_LUMEN = 0.02


def urine_pressure(inner_ratio: Values, wall_ratio: Values, law: Law, load: Load) -> Values:
    """P_u in Pa that holds a uniform tube at r_a/R_a = `inner_ratio` (Eq. 12)."""
    transmural = inflation(inner_ratio, wall_ratio, law, load.prestretch)
    return transmural + confining_traction(inner_ratio, wall_ratio, load)


def confining_traction(inner_ratio: Values, wall_ratio: Values, load: Load) -> Values:
    """p_out in Pa on the deformed outer wall.

    Dead load keeps the radial resultant: P_out R_b / (λ_z r_b) (Eq. 10); hydrostatic: P_out.
    """
    ratio = np.asarray(inner_ratio, dtype=float)
    if load.hydrostatic:
        return np.full_like(ratio, load.confining_pressure)
    outer = np.sqrt(ratio**2 + (wall_ratio**2 - 1.0) / load.prestretch)
    return load.confining_pressure * wall_ratio / (load.prestretch * outer)


def inflation(inner_ratio: Values, wall_ratio: Values, law: Law, axial: float = 1.0) -> Values:
    """Transmural pressure in Pa: in closed form where the law has one, else by quadrature."""
    ratio = np.asarray(inner_ratio, dtype=float)
    if axial == 1.0 and isinstance(law, ClosedForm):
        return law.inflation_pressure(ratio, wall_ratio)
    return inflation_by_quadrature(ratio, wall_ratio, law, axial)


def inflation_by_quadrature(
    inner_ratio: Values, wall_ratio: Values, law: Law, axial: float = 1.0
) -> Values:
    """Transmural pressure in Pa for any law: ∫ w′(λ)/(λ_z λ R) dR over the wall.

    λ = r/R with r² = r_a² + (R² − R_a²)/λ_z. The integrand is regular for every law; in ln R it
    is so smooth that `QUADRATURE_POINTS` Gauss points reach rounding error.
    """
    ratio, thickness = np.asarray(inner_ratio, dtype=float), np.log(wall_ratio)
    points, weights = _gauss()
    R = np.exp(points * thickness[..., None])
    stretch = np.sqrt(ratio[..., None] ** 2 + (R**2 - 1.0) / axial) / R
    slope = hoop_energy_slope(law, stretch, axial, Place(R))
    integral: Values = (slope / (axial * stretch)) @ weights * thickness
    return integral


def lumen_ratio(wall_ratio: float, law: Law, load: Load) -> float | None:
    """r_a/R_a of the tube without stone and urine pressure; None where the load closes it.

    1 without confining pressure and pre-stretch.
    """
    if load.confining_pressure == 0.0 and load.prestretch == 1.0:
        return 1.0

    def pressure(ratio: float) -> float:
        return float(urine_pressure(np.array(ratio), wall_ratio, law, load))

    unloaded = 1.0 / float(np.sqrt(load.prestretch))
    wide = 1.05 * unloaded
    while pressure(wide) <= 0.0 and wide < 2.0:
        wide *= 1.1
    narrow = _nearest_with_value(pressure, SMALLEST_LUMEN, unloaded)
    wide = _nearest_with_value(pressure, wide, unloaded)
    if not pressure(narrow) < 0.0 < pressure(wide):
        return None
    return bracketed_root(pressure, narrow, wide, xtol=1e-14)


def _nearest_with_value(pressure: Callable[[float], float], ratio: float, inside: float) -> float:
    """Return `ratio`, or the place nearest to it, on the way to `inside`, where there is a value.

    A law with a locking stretch has none beyond it, and its pressure is unbounded on the way there.
    """
    with np.errstate(all="ignore"):
        if np.isfinite(pressure(ratio)):
            return ratio
        without, there = ratio, inside
        while abs(there - without) > 4.0 * np.spacing(inside):
            middle = (there + without) / 2.0
            if np.isfinite(pressure(middle)):
                there = middle
            else:
                without = middle
        return there


def stuck_lumen(case: Problem) -> float:
    """The lumen r_a/R_a that load leaves open, refused where the stone is not larger."""
    lumen = lumen_ratio(case.wall_ratio, case.ureter.material.law, case.load)
    if lumen is None or case.size_ratio <= lumen:
        raise BadInput(
            "size ratio",
            round(case.size_ratio, 6),
            "larger than the lumen" + ("" if lumen is None else f", {lumen:.6g}"),
            "a smaller stone is loose",
        )
    return lumen


def far_field_law(case: Problem, *, ground: bool) -> Law:
    """The law of the far field: the paper's leaves the ground matrix out unless `ground` is set."""
    law = case.ureter.material.law
    return law if ground else fibres_of(law)


@lru_cache(maxsize=1)
def _gauss() -> tuple[Float[np.ndarray, " n"], Float[np.ndarray, " n"]]:
    """Gauss–Legendre points and weights on [0, 1]."""
    points, weights = np.polynomial.legendre.leggauss(QUADRATURE_POINTS)
    return (points + 1.0) / 2.0, weights / 2.0
