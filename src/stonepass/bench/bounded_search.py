"""Iterations of a least-squares search within bounds, by the logarithms of positive parameters.

If data determine little more than a product of constants, such as C a for a Fung law, the minimum
lies in a curved valley, which is straight in the logarithms of the constants.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.optimize import least_squares

from stonepass.array_types import Float

__all__ = ["improved"]

PRECISION = 1e-8
INSIDE = 1e-9  # smallest relative distance of a starting point from the bounds of the search


def improved(
    residuals: Callable[[Any], Float[np.ndarray, " n"]],
    start: Any,
    iterations: int,
    precision: float = PRECISION,
) -> Any:
    """Return lmfit parameters after a number of iterations from a starting point.

    Parameters
    ----------
    residuals : callable
        The residuals for lmfit parameters, all finite.
    start : lmfit.Parameters
        Starting values, and the bounds of the search.
    iterations : int
        Largest number of iterations; each takes one evaluation, and one more for every parameter
        that is not held.
    precision : float
        The search ends if an iteration lowers the sum of squares by less than this fraction.
    """
    free = [each for each in start.values() if each.vary]
    if not free:
        return start
    low, high = np.array([(each.min, each.max) for each in free], dtype=float).T
    positive = low > 0.0

    def scaled(values: Float[np.ndarray, " free"]) -> Float[np.ndarray, " free"]:
        return np.where(positive, np.log(np.where(positive, values, 1.0)), values)

    moved = start.copy()

    def moved_to(x: Float[np.ndarray, " free"]) -> Any:
        values = np.where(positive, np.exp(np.where(positive, x, 0.0)), x)
        for each, value in zip(free, values.tolist(), strict=True):
            moved[each.name].set(value=value)
        return moved

    lowest, highest = scaled(low), scaled(high)
    margin = INSIDE * (highest - lowest)
    at = scaled(np.array([float(each.value) for each in free]))
    at = np.clip(at, lowest + margin, highest - margin)
    with np.errstate(all="ignore"):  # trial constants may have no finite prediction
        found = least_squares(
            lambda x: residuals(moved_to(x)), at, bounds=(lowest, highest), x_scale="jac",
            max_nfev=iterations, ftol=precision,
        )  # fmt: skip
    return moved_to(found.x)
