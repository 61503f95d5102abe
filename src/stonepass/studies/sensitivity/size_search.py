"""Critical sizes of many cases by a search over critical pressures that cost little."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from stonepass.array_types import Bool, Float, Int
from stonepass.errors import Outcome
from stonepass.model.stone import SIZE_RATIO
from stonepass.studies.sensitivity.evaluator import OUTCOMES, OUTSIDE, Evaluations

__all__ = ["search_sizes"]

GRID = 146  # number of size ratios of the first pass; P_ucr grows with the size
BEGUN = len(OUTCOMES)  # stands for no outcome
HALVINGS = 24  # number of halvings of the interval in which P_ucr crosses the limit

Pressures = Callable[[Float[np.ndarray, " m"], Int[np.ndarray, " m"]], Evaluations]


def search_sizes(
    pressures: Pressures, count: int, limit: float, bounds: tuple[float, float] = SIZE_RATIO
) -> Evaluations:
    """Find the size ratio at which the critical pressure reaches a limit, for many cases.

    Parameters
    ----------
    pressures : callable
        Function of m size ratios and of the m indices of their cases, which may occur repeatedly;
        it returns the critical pressures.
    count : int
        Number n of cases.
    limit : float
        Pressure limit in Pa.
    bounds : (float, float)
        Smallest and largest size ratio of the search.

    Returns
    -------
    Evaluations
        Critical size ratios. If the pressures end before they reach the limit, the outcome is that
        of the end, or BEYOND_RANGE at the end of the range of the source; the lower bound is the
        largest size whose critical pressure is below the limit. If no critical pressure is below
        the limit, the outcome is BELOW_RANGE.
    """
    grid, cases = np.linspace(*bounds, GRID), np.arange(count)
    found = pressures(np.tile(grid, count), np.repeat(cases, GRID))
    below = _below(found, limit).reshape(count, GRID)
    too_large = np.logical_or.accumulate(below, axis=1) & ~below
    begun, crossed = np.asarray(below.any(axis=1)), np.asarray(too_large.any(axis=1))
    first = np.where(crossed, np.argmax(too_large, axis=1), GRID - 1)
    low, high = grid[np.maximum(first - 1, 0)], grid[first]
    for _ in range(HALVINGS):
        middle = (low + high) / 2.0
        less = _below(pressures(middle, cases), limit)
        low, high = np.where(less, middle, low), np.where(less, high, middle)
    known = ~np.ma.getmaskarray(found.value).reshape(count, GRID).all(axis=1)
    none = np.where(known, OUTCOMES.index(Outcome.BELOW_RANGE), found.outcome[GRID // 2 :: GRID])
    return _found(low, pressures(high, cases), np.where(begun, BEGUN, none), crossed)


def _below(found: Evaluations, limit: float) -> Bool[np.ndarray, " n"]:
    """Return where the critical pressure is known and at most the limit."""
    known = ~np.ma.getmaskarray(found.value)
    return known & (found.value.filled(np.inf) <= limit)


def _found(
    sizes: Float[np.ndarray, " n"],
    above: Evaluations,
    none: Int[np.ndarray, " n"],
    crossed: Bool[np.ndarray, " n"],
) -> Evaluations:
    """Return the sizes where the pressure just above them is known; bounds elsewhere.

    `none` is the outcome where no size is below the limit, and `BEGUN` for all other cases.
    """
    solved = crossed & ~np.ma.getmaskarray(above.value)
    beyond, done = (OUTCOMES.index(each) for each in (Outcome.BEYOND_RANGE, Outcome.SOLVED))
    ended = np.where((above.outcome == OUTSIDE) | ~crossed, beyond, above.outcome)
    return Evaluations(
        np.where(solved, done, np.where(none == BEGUN, ended, none)),
        np.ma.MaskedArray(sizes, ~solved),
        np.ma.MaskedArray(sizes, solved | (none != BEGUN)),
    )
