"""Search for the size ratio at which the critical pressure equals a given limit.

The functions in this module search for a root of a general function that may have no value at some
points. In the application x is the size ratio, and the function is the critical pressure, which
needs a finite-element solve for each value. The methods are therefore chosen to need few values.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from stonepass.fe.core.roots import bracketed_root

__all__ = ["NoValue", "Root", "TooSmall", "local_slope", "root_in_range", "secant_root"]

SLOPE_BASE = 1e-4  # smallest distance of two points from which a slope is computed
CLOSE = 1e-3  # a secant step shorter than this is probably the last one
SECANTS = 5  # largest number of secant steps
FARTHEST = 0.03  # largest length of a secant step
# Fractions of the range that are tried as its upper end if the function has no value at the end.
SMALLER = (0.75, 0.5, 0.35, 0.25)
LARGER = 3  # number of bisections between a point below the target and a point without a value

# A function that returns the difference of another function and its target, or None if the other
# function has no value.
Excess = Callable[[float], float | None]


@dataclass(frozen=True)
class Root:
    """A root of a function.

    Attributes
    ----------
    x : float
    slope : float or None
        Derivative of the function at x; None if it could not be estimated.
    """

    x: float
    slope: float | None


@dataclass(frozen=True)
class NoValue:
    """Result of a search that ended at the point `x`, at which the function has no value."""

    x: float


@dataclass(frozen=True)
class TooSmall:
    """Result of a search in which the function is below its target up to the upper end `x`."""

    x: float


class _Lost(Exception):
    """Raised to leave a root finder at a point at which the function has no value."""

    def __init__(self, x: float) -> None:
        super().__init__(x)
        self.x = x


def root_in_range(
    excess: Excess,
    low: float,
    high: float,
    low_excess: float,
    near_low: float,
    tolerance: float,
    *,
    may_lie_below: bool = False,
) -> float | NoValue | TooSmall | None:
    """Find the root of an increasing function whose value at the lower end of the range is known.

    Parameters
    ----------
    excess : callable
        ``excess(x)`` returns the function minus its target, or None if it has no value.
    low, high : float
        Ends of the range.
    low_excess : float
        The excess at `low`, negative.
    near_low : float
        Smallest point at which the function is evaluated. Between `low` and `near_low` it is
        interpolated linearly.
    tolerance : float
        Absolute tolerance of the root. An excess counts as zero if it is smaller than
        `tolerance` × |`low_excess`|.
    may_lie_below : bool
        True if the root may lie below `near_low`. The function is then evaluated at `near_low`
        first, and the result is None if its excess is positive there.

    Returns
    -------
    float
        The root.
    NoValue
        The search met a point at which the function has no value.
    TooSmall
        The function is below its target up to the upper end of the range.
    None
        The root lies below `near_low`.
    """
    found = _upper_end(excess, low, high)
    if isinstance(found, NoValue):
        return found
    top, top_excess = found
    if top_excess < 0.0:
        return TooSmall(top)
    if may_lie_below:
        least = excess(near_low)
        if least is None:
            return NoValue(near_low)
        if least > 0.0:
            return None
    known = {low: low_excess, top: top_excess}

    def value(x: float) -> float:
        missed = excess(x)
        if missed is None:
            raise _Lost(x)
        return missed

    def continued(x: float) -> float:
        if x in known:
            return known[x]
        if x < near_low:
            fraction = (x - low) / (near_low - low)
            return fraction * (value(near_low) - low_excess) + low_excess
        missed = value(x)
        return 0.0 if abs(missed) < tolerance * -low_excess else missed

    try:
        return bracketed_root(continued, low, top, xtol=tolerance)
    except _Lost as stop:
        return NoValue(stop.x)


def secant_root(
    value: Callable[[float, bool], float | None],
    target: float,
    start: Root,
    low: float,
    high: float,
    tolerance: float,
) -> Root | None:
    """Find the point at which a function has a target value, by secants from a first guess.

    Parameters
    ----------
    value : callable
        ``value(x, last)`` returns the function, or None if it has no value; `last` is true if x is
        probably the result.
    target : float
        The wanted value of the function.
    start : Root
        First guess and slope, from a coarser approximation of the function.
    low, high : float
        Ends of the range; the lower end is excluded.
    tolerance : float
        The search ends if the value differs from the target by less than `tolerance` × the larger
        of target and slope.

    Returns
    -------
    Root or None
        None if the secants leave the range, meet a point without a value, or do not converge.
    """
    if start.slope is None:
        return None
    last, slope, before = start.x, start.slope, value(start.x, False)
    for _ in range(SECANTS):
        if before is None or not abs(before - target) < slope * FARTHEST:
            return None
        x = last - (before - target) / slope
        if not low < x <= high:
            return None
        step = abs(x - last)
        found = value(x, step < CLOSE)
        if found is None:
            return None
        if step > SLOPE_BASE:
            slope = (found - before) / (x - last)
        if abs(found - target) < tolerance * max(target, slope):
            return Root(x, slope)
        last, before = x, found
    return None


def local_slope(known: Mapping[float, float], x: float) -> float | None:
    """Return the slope at a known point, by the nearest other point at a sufficient distance.

    Parameters
    ----------
    known : mapping of float to float
        Known values of the function.
    x : float
        The point.

    Returns
    -------
    float or None
        None if the value at `x` is not known, or no other point is at a sufficient distance.
    """
    for other in sorted(known, key=lambda each: abs(each - x)):
        if abs(other - x) > SLOPE_BASE and x in known:
            return (known[other] - known[x]) / (other - x)
    return None


def _upper_end(excess: Excess, low: float, high: float) -> tuple[float, float] | NoValue:
    """Return an upper end of the search, and the excess there.

    This is `high` if the function has a value there. Otherwise smaller points are tried until one
    has a value. If that value is below the target, points between it and the smallest point without
    a value are tried. A point whose value reaches the target is the upper end; if there is none,
    the result is `NoValue`.
    """
    first = excess(high)
    if first is not None:
        return high, first
    answered, lost, fractions = 0.0, 1.0, [*SMALLER]
    for _ in range(len(SMALLER) + LARGER):
        fraction = fractions.pop(0) if fractions else (answered + lost) / 2.0
        x = low + fraction * (high - low)
        top = excess(x)
        if top is None:
            lost = fraction
        elif top >= 0.0:
            return x, top
        else:
            answered, fractions = fraction, []
    return NoValue(high)
