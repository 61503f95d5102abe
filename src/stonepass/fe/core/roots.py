"""Brent's method for a root in an interval.

The method is implemented here because the import of `scipy.optimize`, which contains it as
`brentq`, takes as long as the solution of a frictionless case.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

__all__ = ["bracketed_root"]

RELATIVE = 4.0 * float(np.finfo(float).eps)  # smallest relative tolerance: four rounding errors
MOST_STEPS = 100


def bracketed_root(
    function: Callable[[float], Any], first: float, last: float, xtol: float = 2e-12
) -> float:
    """Find a root between two points at which the function has opposite signs.

    The function implements Brent's method (Algorithms for Minimization without Derivatives, 1973,
    chapter 4) with the same sequence of steps as `scipy.optimize.brentq`, so that both return the
    same number.

    Parameters
    ----------
    function : callable
        Continuous real function of one real number.
    first, last : float
        Ends of the interval, in either order.
    xtol : float
        Absolute tolerance of the root, positive. A relative tolerance of four rounding errors is
        added to it.

    Returns
    -------
    float
        The root. If the function is zero at an end of the interval, that end is returned.

    Raises
    ------
    ValueError
        The function has the same sign at both ends.
    FloatingPointError
        A value of the function is NaN, or no root is found in 100 steps.
    """
    before, here = float(first), float(last)
    f_before, f_here = float(function(before)), float(function(here))
    for end, value in ((before, f_before), (here, f_here)):
        if math.isnan(value):
            raise FloatingPointError("the function has no value at an end of the interval")
        if value == 0.0:
            return end
    if (f_before < 0.0) == (f_here < 0.0):
        raise ValueError("the function must have opposite signs at the ends of the interval")
    other = f_other = step = earlier = 0.0
    for _ in range(MOST_STEPS):
        # `here` and `other` enclose the root, and the function is smaller at `here`.
        if f_before != 0.0 and f_here != 0.0 and (f_before < 0.0) != (f_here < 0.0):
            other, f_other = before, f_before
            step = earlier = here - before
        if abs(f_other) < abs(f_here):
            before, here, other = here, other, here
            f_before, f_here, f_other = f_here, f_other, f_here
        tolerance = (xtol + RELATIVE * abs(here)) / 2.0
        half = (other - here) / 2.0
        if f_here == 0.0 or abs(half) < tolerance:
            return here
        tried = math.inf
        if abs(earlier) > tolerance and abs(f_here) < abs(f_before):
            tried = _interpolated(before, here, other, f_before, f_here, f_other)
        if 2.0 * abs(tried) < min(abs(earlier), 3.0 * abs(half) - tolerance):
            earlier, step = step, tried
        else:
            earlier = step = half
        before, f_before = here, f_here
        if abs(step) > tolerance:
            here += step
        else:
            here += tolerance if half > 0.0 else -tolerance
        f_here = float(function(here))
        if math.isnan(f_here):
            raise FloatingPointError("the function has no value within the interval")
    raise FloatingPointError(f"no root was found in {MOST_STEPS} steps")


def _interpolated(
    before: float, here: float, other: float, f_before: float, f_here: float, f_other: float
) -> float:
    """Return the step to the root of a line (two points) or of an inverse parabola (three)."""
    if before == other:
        return -f_here * (here - before) / (f_here - f_before)
    near = (f_before - f_here) / (before - here)
    far = (f_other - f_here) / (other - here)
    below = far * near * (f_other - f_before)
    return -f_here * (f_other * far - f_before * near) / below if below else math.inf
