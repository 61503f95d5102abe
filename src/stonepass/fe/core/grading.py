"""Grid lines whose intervals form a geometric sequence."""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from stonepass.array_types import Float
from stonepass.fe.core.roots import bracketed_root

__all__ = ["graded", "growing", "intervals"]


def graded(count: int, first: float, total: float) -> Float[np.ndarray, " points"]:
    """Return points from 0 to `total` whose intervals form a geometric sequence.

    Parameters
    ----------
    count : int
        Number of intervals, at least 2.
    first : float
        Length of the first interval, positive. If `count` intervals of this length do not fit into
        `total`, all intervals are equal instead.
    total : float
        Sum of all intervals, positive, in the same unit as `first`.

    Returns
    -------
    array (count + 1,)
        The points, increasing. ``graded(2, 1.0, 3.0)`` returns 0, 1, 3: the ratio of the intervals
        1 and 2 is 2.
    """
    if first * count >= total:
        return np.linspace(0.0, total, count + 1)
    log_ratio = _log_ratio(count, first, total)
    points = np.concatenate([[0.0], np.cumsum(first * np.exp(log_ratio * np.arange(count)))])
    return points * (total / points[-1])


@lru_cache(maxsize=64)  # a mesh that follows the contact has the same intervals, scaled
def _log_ratio(count: int, first: float, total: float) -> float:
    """Return the logarithm of the ratio of the intervals."""

    def excess(log_ratio: float) -> float:
        return float(first * np.exp(log_ratio * np.arange(count)).sum() - total)

    # The last interval is at most `total`, which bounds the ratio.
    return bracketed_root(excess, 0.0, np.log(total / first) / (count - 1), xtol=1e-14)


def intervals(first: float, total: float, growth: float, least: int = 2) -> int:
    """Return the smallest number of geometric intervals whose ratio does not exceed `growth`.

    Parameters
    ----------
    first, total : float
        Length of the first interval, and sum of all intervals; both positive, in the same unit.
    growth : float
        Largest allowed ratio of an interval to its predecessor, greater than 1.
    least : int
        Lower bound of the result.

    Returns
    -------
    int
        The smallest n, not below `least`, for which first (growthⁿ − 1)/(growth − 1) is at least
        `total`.
    """
    if first >= total:
        return least
    return max(least, int(np.ceil(np.log1p(total / first * (growth - 1.0)) / np.log(growth))))


def growing(
    first: float, total: float, growth: float, least: int = 2
) -> Float[np.ndarray, " points"]:
    """Return the points of `graded`, with the number of intervals that `intervals` returns.

    Parameters
    ----------
    first, total, growth, least
        See `intervals`.

    Returns
    -------
    array (points,)
        Points from 0 to `total`, increasing.
    """
    return graded(intervals(first, total, growth, least), first, total)
