"""Grid lines whose intervals grow geometrically."""

from __future__ import annotations

import numpy as np

from stonepass.array_types import Float
from stonepass.fe.core.roots import bracketed_root

__all__ = ["graded", "growing", "intervals"]


def graded(count: int, first: float, total: float) -> Float[np.ndarray, " points"]:
    """Points from 0 to `total` whose intervals grow geometrically.

    Parameters
    ----------
    count : int
        Number of intervals, at least 2.
    first : float
        Length of the first interval, positive. Where `count` intervals of this length would not
        fit into `total`, all intervals are equal instead.
    total : float
        Length of all intervals together, positive.

    Returns
    -------
    array (count + 1,)
        ``graded(2, 1.0, 3.0)`` is 0, 1, 3: the intervals 1 and 2 have the ratio 2.
    """
    if first * count >= total:
        return np.linspace(0.0, total, count + 1)

    def excess(log_ratio: float) -> float:
        return float(first * np.exp(log_ratio * np.arange(count)).sum() - total)

    # The last interval is at most `total`, which bounds the ratio.
    log_ratio = bracketed_root(excess, 0.0, np.log(total / first) / (count - 1), xtol=1e-14)
    points = np.concatenate([[0.0], np.cumsum(first * np.exp(log_ratio * np.arange(count)))])
    return points * (total / points[-1])


def intervals(first: float, total: float, growth: float, least: int = 2) -> int:
    """Smallest number of geometric intervals whose ratio does not exceed `growth`.

    Parameters
    ----------
    first, total : float
        Length of the first interval and of all together, positive.
    growth : float
        Largest ratio of neighbouring intervals, greater than 1.
    least : int
        The number returned is at least this.
    """
    if first >= total:
        return least
    return max(least, int(np.ceil(np.log1p(total / first * (growth - 1.0)) / np.log(growth))))


def growing(
    first: float, total: float, growth: float, least: int = 2
) -> Float[np.ndarray, " points"]:
    """Points of `graded` with the smallest number of intervals that `intervals` allows."""
    return graded(intervals(first, total, growth, least), first, total)
