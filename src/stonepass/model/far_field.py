"""The tube far from the stone: urine pressure as a function of inner radius.

The source is the paper, Eqs 9–12, 20 and 22; see "Far field" in docs/theory.md. Radii are divided
by the undeformed inner radius R_a.
"""

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
    """Return the urine pressure P_u that holds a uniform tube at a given inner radius (Eq. 12).

    Parameters
    ----------
    inner_ratio : float or array
        r_a/R_a, positive.
    wall_ratio : float or array
        η = R_b/R_a, above 1.
    law : Law
    load : Load
        Confining pressure and pre-stretch.

    Returns
    -------
    float or array
        P_u in Pa.
    """
    transmural = inflation(inner_ratio, wall_ratio, law, load.prestretch)
    return transmural + confining_traction(inner_ratio, wall_ratio, load)


def confining_traction(inner_ratio: Values, wall_ratio: Values, load: Load) -> Values:
    """Return the pressure p_out in Pa on the deformed outer wall.

    A hydrostatic pressure is P_out itself. A dead load keeps its radial resultant, so
    p_out = P_out R_b/(λ_z r_b) (Eq. 10).

    Parameters
    ----------
    inner_ratio, wall_ratio, load
        See `urine_pressure`.
    """
    ratio = np.asarray(inner_ratio, dtype=float)
    if load.hydrostatic:
        return np.full_like(ratio, load.confining_pressure)
    outer = np.sqrt(ratio**2 + (wall_ratio**2 - 1.0) / load.prestretch)
    return load.confining_pressure * wall_ratio / (load.prestretch * outer)


def inflation(inner_ratio: Values, wall_ratio: Values, law: Law, axial: float = 1.0) -> Values:
    """Return the transmural pressure in Pa, in closed form if the law has one, else by quadrature.

    Parameters
    ----------
    inner_ratio, wall_ratio, law
        See `urine_pressure`.
    axial : float
        Axial stretch λ_z, positive.
    """
    ratio = np.asarray(inner_ratio, dtype=float)
    if axial == 1.0 and isinstance(law, ClosedForm):
        return law.inflation_pressure(ratio, wall_ratio)
    return inflation_by_quadrature(ratio, wall_ratio, law, axial)


def inflation_by_quadrature(
    inner_ratio: Values, wall_ratio: Values, law: Law, axial: float = 1.0
) -> Values:
    """Return the transmural pressure in Pa of any law by quadrature (paper, Eq. 12).

    It is the integral of w′(λ)/(λ_z λ R) over R from R_a to R_b, with λ = r/R and
    r² = r_a² + (R² − R_a²)/λ_z. The integrand is regular for every law, and so smooth as a function
    of ln R that the quadrature error of `QUADRATURE_POINTS` Gauss points is below rounding.

    Parameters
    ----------
    inner_ratio, wall_ratio, law, axial
        See `inflation`.
    """
    ratio, thickness = np.asarray(inner_ratio, dtype=float), np.log(wall_ratio)
    points, weights = _gauss()
    R = np.exp(points * thickness[..., None])
    stretch = np.sqrt(ratio[..., None] ** 2 + (R**2 - 1.0) / axial) / R
    slope = hoop_energy_slope(law, stretch, axial, Place(R))
    integral: Values = (slope / (axial * stretch)) @ weights * thickness
    return integral


def lumen_ratio(wall_ratio: float, law: Law, load: Load) -> float | None:
    """Return r_a/R_a of the tube without stone and without urine pressure.

    Parameters
    ----------
    wall_ratio : float
        η = R_b/R_a, above 1.
    law : Law
    load : Load
        Confining pressure and pre-stretch; without both of them the result is 1.

    Returns
    -------
    float or None
        None if the load closes the lumen, or if no uniform tube is in equilibrium under the load.
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
    """Return the point nearest to `ratio`, between it and `inside`, with a finite pressure.

    The pressure of a law with a locking stretch is not finite beyond that stretch, and it grows
    without bound as the stretch is approached.
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
    """Return the lumen r_a/R_a under the load, and check that the stone is larger.

    Raises
    ------
    BadInput
        The stone is not larger than the lumen, or the load closes the lumen.
    """
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
    """Return the law with which the far field is evaluated.

    Parameters
    ----------
    case : Problem
    ground : bool
        True to include the ground matrix. The paper leaves it out (Eq. 22).
    """
    law = case.ureter.material.law
    return law if ground else fibres_of(law)


@lru_cache(maxsize=1)
def _gauss() -> tuple[Float[np.ndarray, " n"], Float[np.ndarray, " n"]]:
    """Return Gauss–Legendre points and weights on [0, 1]."""
    points, weights = np.polynomial.legendre.leggauss(QUADRATURE_POINTS)
    return (points + 1.0) / 2.0, weights / 2.0
