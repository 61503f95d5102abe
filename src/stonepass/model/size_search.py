"""Search for the size whose critical pressure is a limit, on one mesh or from a coarser one.

The functions here take the critical pressure as a function of the size, which may have no value at
some sizes, and know nothing of stones. Each evaluation is a finite-element solve, so they are made
for few of them.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from stonepass.fe.core.roots import bracketed_root

__all__ = ["NoValue", "Root", "TooSmall", "local_slope", "root_in_range", "secant_root"]

SLOPE_BASE = 1e-4  # points nearer than this say too little of the slope
CLOSE = 1e-3  # a step of this length is probably the last one
SECANTS = 5  # steps from the root of a coarser function
FARTHEST = 0.03  # largest step of those
SMALLER = (0.75, 0.5, 0.35, 0.25)  # of the range, tried where its upper end has no value
LARGER = 3  # points tried between one below the target and one without a value

# The function minus its target; None where it has no value.
Excess = Callable[[float], float | None]


@dataclass(frozen=True)
class Root:
    """A root, and the slope of the function there where two points tell it."""

    x: float
    slope: float | None


@dataclass(frozen=True)
class NoValue:
    """The search ended at a point at which the function has no value."""

    x: float


@dataclass(frozen=True)
class TooSmall:
    """The function stays below its target up to the upper end of the range, at `x`."""

    x: float


class _Lost(Exception):
    """Ends a root finder at a point without a value."""

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
    """Find the root of a rising function between the end `low`, where it is known, and `high`.

    Parameters
    ----------
    excess : callable
        The function minus its target.
    low, high : float
        Ends of the range.
    low_excess : float
        The excess at `low`, below zero.
    near_low : float
        Below it the function is not evaluated: it is taken as linear from `low` to there.
    tolerance : float
        Absolute tolerance of the root, and relative to `low_excess` of the excess: an excess that
        is smaller counts as zero.
    may_lie_below : bool
        Whether the root may lie below `near_low`, so that this is looked at first.

    Returns
    -------
    float, NoValue, TooSmall or None
        The root; or where the search met a point without a value; or the point up to which the
        function stays below its target; or None where the root lies below `near_low`.
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
    """Find a root by secants from that of a coarser function.

    Parameters
    ----------
    value : callable
        The function; its second argument says whether the point is probably the root.
    target : float
        The value at the root.
    start : Root
        The root of the coarser function, and its slope.
    low, high : float
        Ends of the range, the lower one excluded.
    tolerance : float
        Absolute tolerance of the root, and relative to `target` of the value.

    Returns
    -------
    Root or None
        None where secants do not lead to a root within the range.
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
    """Slope at a known point, by the nearest other one that is not too near."""
    for other in sorted(known, key=lambda each: abs(each - x)):
        if abs(other - x) > SLOPE_BASE and x in known:
            return (known[other] - known[x]) / (other - x)
    return None


def _upper_end(excess: Excess, low: float, high: float) -> tuple[float, float] | NoValue:
    """The largest point that has a value, and its excess.

    Where the upper end of the range has none, smaller points are tried, then larger ones up to what
    has none; they serve as the upper end if their value is above the target.
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
