"""Confidence intervals and correlations of least-squares estimates, with lmfit."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from importlib import import_module
from typing import Any

import numpy as np
from scipy.optimize import brentq
from scipy.stats import f as f_distribution
from scipy.stats import t as t_distribution

from stonepass.bench.bounded_search import improved
from stonepass.caution import Caution, caution

__all__ = [
    "LEVEL",
    "Interval",
    "correlations",
    "ends_of_profile",
    "intervals",
    "lmfit",
    "open_ended",
    "profile_level",
]

LEVEL = 0.95  # confidence level of all intervals
FARTHER = 2.0  # ratio of successive steps outwards along a profile
STEPS = 40  # largest number of these steps
# A point of a profile is tried again from other minima if its distance from the nearest point
# inside the interval exceeds this fraction of its distance from the best value.
APART = 0.1
ITERATIONS = 20  # largest number of iterations for a point of a profile
# Precision of the ends of an interval as a fraction of their distance from the best value, for a
# profile in closed form and for one that takes a search at each point.
CLOSED, SEARCHED = 1e-10, 1e-4
SMALLEST = 1e-9  # smallest first step, relative to the best value
# Largest error of the parabola at an end of an interval, as a fraction of the increase of χ².
PARABOLIC = 0.02
TINY = np.finfo(float).tiny

# Lower and upper end of an interval; None if the data do not bound it on that side.
Interval = tuple[float | None, float | None]


def lmfit() -> Any:
    """Load lmfit when a fit needs it, because loading it takes a third of a second."""
    return import_module("lmfit")


def intervals(
    minimizer: Any,
    result: Any,
    free: Sequence[str],
    also: Sequence[Any] = (),
) -> tuple[dict[str, Interval], list[Caution]]:
    """Compute 95 % confidence intervals of fitted parameters.

    The residuals provide the variance of the errors. If χ² is a parabola out to the ends of the
    intervals, Student's t intervals are returned; they are exact for Gaussian errors and a model
    that is linear in its parameters. Otherwise the profile likelihood is used.

    Parameters
    ----------
    minimizer : lmfit.Minimizer
        The minimizer after its fit.
    result : lmfit.minimizer.MinimizerResult
        Result of the fit.
    free : sequence of str
        Names of the parameters for which intervals are wanted. Fitted parameters that lie at a
        bound are left out.
    also : sequence of lmfit.Parameters
        Other minima of χ². A profile that begins at the best fit may have to pass through them.

    Returns
    -------
    bounds : dict of str to (float or None, float or None)
        Lower and upper end by name, in the unit of the parameter. An end that reaches the search
        bound of its parameter is None.
    told : list of Caution
        Cautions about open intervals.

    References
    ----------
    docs/bench.md, "The fit".
    """
    bounds = _by_parabola(minimizer, result, free)
    if bounds is None:
        bounds = _by_profiles(minimizer, result, free, also)
    within = {name: _within(each, result.params[name]) for name, each in bounds.items()}
    return within, open_ended(within)


def _within(interval: Interval, parameter: Any) -> Interval:
    """Return the interval with None in place of an end that reaches a bound of the search."""
    low, high = interval
    return (
        None if low is None or low <= parameter.min else low,
        None if high is None or high >= parameter.max else high,
    )


def _by_parabola(minimizer: Any, result: Any, free: Sequence[str]) -> dict[str, Interval] | None:
    """Return Student's t intervals, or None if χ² is not a parabola out to their ends.

    For each end of the interval of a parameter, the other parameters are set to the values that
    minimise χ² according to the covariance matrix. If χ² is a parabola, it has the value
    `profile_level` there. The search bounds of the other parameters are ignored, so that an
    interval may be too wide but not too narrow.
    """
    if result.covar is None or not np.all(np.isfinite(result.covar)):
        return None
    names, covariance = list(result.var_names), np.array(result.covar)
    factor = float(t_distribution.ppf(0.5 + LEVEL / 2.0, result.nfree))
    least, level = _chi_square(minimizer, result.params), profile_level(result.nfree)
    found: dict[str, Interval] = {}
    for name in free:
        k = names.index(name)
        error, centre = float(np.sqrt(covariance[k, k])), float(result.params[name].value)
        if error == 0.0:  # the law fits the data exactly
            found[name] = (centre, centre)
            continue
        for sign in (-1.0, 1.0):
            moved = result.params.copy()
            shift = sign * factor * covariance[k] / error
            for other, by in zip(names, shift, strict=True):
                value = float(result.params[other].value) + by
                moved[other].set(value=value, min=-np.inf, max=np.inf)
            with np.errstate(all="ignore"):  # a χ² of NaN is not that of a parabola either
                reached = _chi_square(minimizer, moved) / max(least, TINY)
            if not abs(reached - level) < PARABOLIC * (level - 1.0):
                return None
        found[name] = (centre - factor * error, centre + factor * error)
    return found


def correlations(result: Any, free: Sequence[str]) -> dict[tuple[str, str], float]:
    """Return the correlation of every pair of estimates.

    Parameters
    ----------
    result : lmfit.minimizer.MinimizerResult
        Result of the fit.
    free : sequence of str
        Names of the parameters.

    Returns
    -------
    dict of (str, str) to float
        Correlation, −1 to 1; pairs for which lmfit has none are left out.
    """
    found = {}
    for k, one in enumerate(free):
        for other in free[k + 1 :]:
            known = result.params[one].correl or {}
            if other in known:
                found[one, other] = float(known[other])
    return found


def open_ended(
    bounds: dict[str, Interval], both: str = "not_bounded", one: str = "bounded_on_one_side"
) -> list[Caution]:
    """Return a caution for each interval without a lower or an upper end.

    Parameters
    ----------
    bounds : dict of str to (float or None, float or None)
        Ends of the intervals by name of the parameter.
    both, one : str
        Codes of the cautions for intervals with two open ends and with one.
    """
    told = []
    for name, (low, high) in bounds.items():
        if low is None and high is None:
            told.append(caution(both, name=name))
        elif low is None or high is None:
            told.append(caution(one, name=name))
    return told


def _by_profiles(
    minimizer: Any, result: Any, free: Sequence[str], also: Sequence[Any]
) -> dict[str, Interval]:
    """Return the intervals of several parameters from their profiles.

    The profile of one parameter may pass through a minimum that the search for another one has not
    met. An interval is therefore searched again if a profile of another parameter has a point
    inside the confidence region and outside this interval.
    """
    found = {name: _by_profile(minimizer, result, name, also) for name in free}
    inside = [each for _, points in found.values() for each in points]
    bounds = {}
    for name, ((low, high), _) in found.items():
        values = [float(each[name].value) for each in inside]
        first, last = int(np.argmin(values)), int(np.argmax(values))
        beyond = [inside[first]] if low is not None and values[first] < low else []
        beyond += [inside[last]] if high is not None and values[last] > high else []
        bounds[name] = low, high
        if beyond:
            bounds[name], _ = _by_profile(minimizer, result, name, [*also, *beyond])
    return bounds


def _by_profile(
    minimizer: Any, result: Any, name: str, also: Sequence[Any]
) -> tuple[Interval, list[Any]]:
    """Return the values on both sides of the best fit at which χ² reaches `profile_level`.

    At each value of the parameter χ² is minimised over the other parameters, beginning at the
    nearest point inside the interval, and if this ends outside it, at the points `also`. The points
    inside the interval are returned, too.
    """
    best, parameter = float(result.params[name].value), result.params[name]
    others = [each for each in result.var_names if each != name]

    def at(start: Any, value: float) -> tuple[float, Any]:
        """Return the smallest χ² at a value, and its parameters."""
        moved = start.copy()
        for each in result.var_names:
            moved[each].set(vary=each != name)
        moved[name].set(value=value)
        moved = improved(minimizer.userfcn, moved, ITERATIONS)
        return _chi_square(minimizer, moved), moved

    known = {best: (_chi_square(minimizer, result.params), result.params)}
    level = known[best][0] * profile_level(result.nfree)

    def excess(value: float) -> float:
        if value not in known:
            inside = [each for each, (reached, _) in known.items() if reached <= level]
            nearest = min(inside, key=lambda each: abs(each - value))
            known[value] = at(known[nearest][1], value)
            apart = abs(value - nearest) > APART * abs(value - best)
            if known[value][0] > level and others and apart:
                tried = [known[value], *(at(each, value) for each in also)]
                known[value] = min(tried, key=lambda each: each[0])
        return known[value][0] - level

    error = parameter.stderr or 0.0
    spread = error if 0.0 < error < np.inf else abs(best)
    precision = SEARCHED if others else CLOSED
    bounds = (parameter.min, parameter.max)
    ends = ends_of_profile(excess, best, 0.5 * spread, bounds, precision)
    return ends, [each for reached, each in known.values() if reached <= level]


def _chi_square(minimizer: Any, parameters: Any) -> float:
    return float(np.sum(np.square(minimizer.userfcn(parameters))))


def profile_level(free: int) -> float:
    """Return χ² at the ends of the interval of one parameter, divided by its least value.

    `free` is the number of degrees of freedom of the residuals, at least 1. The quotient is
    1 + F/free with the 95 % quantile F of the F distribution with 1 and `free` degrees of freedom.
    """
    return 1.0 + float(f_distribution.ppf(LEVEL, 1, free)) / free


def ends_of_profile(
    excess: Callable[[float], float],
    best: float,
    first: float,
    bounds: tuple[float, float],
    precision: float = CLOSED,
) -> Interval:
    """Find the zeros of a profile on both sides of the best value.

    Parameters
    ----------
    excess : callable
        The profile minus its level at the ends of the interval; negative at the best value.
    best : float
        Best value of the parameter, within the bounds.
    first : float
        First step outwards; every further step is twice as large.
    bounds : (float, float)
        Smallest and largest value of the parameter.
    precision : float
        Largest error of the zeros as a fraction of their distance from the best value.

    Returns
    -------
    (float or None, float or None)
        Lower and upper zero; None if the profile has no zero between the best value and the bound.
    """
    ends: list[float | None] = []
    for sign, bound in zip((-1.0, 1.0), bounds, strict=True):
        step, inner, end = max(first, SMALLEST * abs(best)), best, None
        for _ in range(STEPS):
            outer = best + sign * step
            beyond = sign * (outer - bound) >= 0.0
            outer = bound if beyond else outer
            if excess(outer) >= 0.0:
                error = precision * abs(outer - best)
                end = best if error == 0.0 else float(brentq(excess, inner, outer, xtol=error))
                break
            if beyond:
                break
            inner, step = outer, step * FARTHER
        ends.append(end)
    return ends[0], ends[1]
