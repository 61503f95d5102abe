"""Computation of the largest confining pressures of a box, from the buckling of its tubes."""

from __future__ import annotations

import numpy as np

from stonepass.errors import require
from stonepass.model.case import Case
from stonepass.model.load import CONFINING
from stonepass.model.states.stability import axisymmetric_buckling
from stonepass.studies.conditions import Conditions, case_at, lumen_ratios
from stonepass.studies.surrogates.stable_loads import StableLoads
from stonepass.units import format_pressure

__all__ = ["MARGIN", "stable_loads"]

# Largest load of a surrogate, as a fraction of the load at which the tube buckles.
MARGIN = 0.6
WALLS = 49  # number of wall ratios at which the largest load is computed
STEPS = 12  # number of bisections for each of them


def stable_loads(
    case: Case, wall_ratio: tuple[float, float], margin: float = MARGIN
) -> StableLoads:
    """Compute the largest loads that a surrogate covers.

    Parameters
    ----------
    case : Case
        Its material, load and length of the tube are used.
    wall_ratio : (float, float)
        Smallest and largest wall ratio η.
    margin : float
        Largest load as a fraction of the load at which the tube buckles, above 0, at most 1.

    Raises
    ------
    BadInput
        The load closes the lumen of the thinnest wall.
    """
    low, high = (edge - 1.0 for edge in wall_ratio)
    walls = 1.0 + np.geomspace(low, high, WALLS)
    walls[0], walls[-1] = wall_ratio
    if case.load.confining_pressure == 0.0:
        return StableLoads(walls, np.ones(WALLS), 1.0)
    whole = lumen_ratios(case, walls, np.ones(WALLS))
    require(bool(np.isfinite(whole).all()), "confining pressure",
            format_pressure(case.load.confining_pressure),
            "so small that the thinnest wall of the box keeps a lumen")  # fmt: skip
    factors = np.array([_largest_factor(case, eta, margin) for eta in walls.tolist()])
    return StableLoads(walls, factors, float(lumen_ratios(case, walls, factors).min()))


def _largest_factor(case: Case, wall_ratio: float, margin: float) -> float:
    """Return the largest load factor with the margin to buckling, found by bisection."""
    low, high = 0.0, min(1.0 / margin, CONFINING[1] / case.load.confining_pressure)
    if _stable(case, wall_ratio, high):
        return 1.0
    for _ in range(STEPS):
        middle = (low + high) / 2.0
        if _stable(case, wall_ratio, middle):
            low = middle
        else:
            high = middle
    return margin * low


def _stable(case: Case, wall_ratio: float, factor: float) -> bool:
    """Return whether a tube keeps a lumen and does not buckle axisymmetrically."""
    wall, load = np.array([wall_ratio]), np.array([factor])
    if not np.isfinite(lumen_ratios(case, wall, load)).all():
        return False
    at = Conditions(np.ones(1), wall, np.zeros(1), load)
    return not axisymmetric_buckling(case_at(case, at, 0), case.numerics.half_length)
