"""Search for the first of possibly several roots: scan of the interval, then refinement."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from stonepass.fe.core.roots import bracketed_root
from stonepass.units import Values

__all__ = ["first_root"]

SCAN_POINTS = 721


def first_root(excess: Callable[[Values], Values], first: float, last: float) -> float | None:
    """Find the root of a function that is nearest to one end of an interval.

    Parameters
    ----------
    excess : callable
        Vectorised function whose root is sought. The search stops at its first value ≤ 0.
    first, last : float
        Ends of the interval. The search starts at `first`; `last` may be less than `first`.

    Returns
    -------
    float or None
        The root; `first` if the function is zero or negative there; None if the function is
        positive at all `SCAN_POINTS` points of the scan.

    Raises
    ------
    FloatingPointError
        A value of the function is not finite.
    """
    grid = np.linspace(first, last, SCAN_POINTS)
    values = np.asarray(excess(grid))
    if not np.all(np.isfinite(values)):
        raise FloatingPointError("the force balance is not finite")
    if values[0] <= 1e-12 * np.abs(values).max():
        return first
    below = np.flatnonzero(values <= 0.0)
    if below.size == 0:
        return None
    k = int(below[0])
    return bracketed_root(excess, float(grid[k - 1]), float(grid[k]), xtol=1e-14)
