"""The first root of a balance that may have several: scan, then refine."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from stonepass.fe.core.roots import bracketed_root
from stonepass.units import Values

__all__ = ["first_root"]

SCAN_POINTS = 721


def first_root(excess: Callable[[Values], Values], first: float, last: float) -> float | None:
    """Root of `excess` in [first, last] nearest to `first`; `first` where it starts at or below 0.

    None where it stays above 0. `last` may lie below `first`.

    Raises
    ------
    FloatingPointError
        Where `excess` is not finite.
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
