"""Least squares with intervals: lmfit's fit and profile likelihood, for constants and friction."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from importlib import import_module
from typing import Any
from warnings import catch_warnings, simplefilter

import numpy as np
from scipy.optimize import brentq
from scipy.stats import f as f_distribution
from scipy.stats import t as t_distribution

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

LEVEL = 0.95
FARTHER = 1.5  # each step outwards over the last one
STEPS = 60
SMALLEST = 1e-9  # step, relative
PARABOLIC = 0.02  # of the growth of χ², by which a parabola may miss it
TINY = np.finfo(float).tiny

# Both ends of an interval; None where the data set no bound on that side.
Interval = tuple[float | None, float | None]


def lmfit() -> Any:
    """Load lmfit when a fit needs it, because loading it takes a third of a second."""
    return import_module("lmfit")


def intervals(
    minimizer: Any,
    result: Any,
    free: Sequence[str],
    declared: Mapping[str, Any] | None = None,
) -> tuple[dict[str, Interval], list[Caution]]:
    """95 % intervals of the free parameters, and what there is to say.

    The scatter is that of the residuals. Where χ² is a parabola as far as the intervals go, they
    are Student's, which are exact for a model that is linear in its parameters and Gaussian errors;
    else the likelihood is profiled. Where a profile cannot be followed the curvature at the best
    fit stands in, and that is said. Every interval stays within the bounds of its parameter.

    Parameters
    ----------
    minimizer, result : lmfit.Minimizer, lmfit.minimizer.MinimizerResult
    free : sequence of str
        Parameters to bound; others that vary have none, as those that lie on a bound.
    declared : mapping, optional
        Objects with `low` and `high`, the bounds that are physical, by name of the parameter.

    Returns
    -------
    bounds : dict
        Ends by name; None where an end is not bounded before the end of the search.
    told : list of Caution
    """
    told: list[Caution] = []
    bounds = _by_parabola(minimizer, result, free)
    if bounds is None and len(free) == 1 and result.nvarys == 1:
        bounds = {free[0]: _profile_of_one(minimizer, result, free[0])}
    if bounds is None:
        bounds, told = _profiled(minimizer, result, free)
    within = {name: _within(each, result.params[name]) for name, each in bounds.items()}
    return within, [*told, *open_ended(within)]


def _within(interval: Interval, parameter: Any) -> Interval:
    """The interval, open where it goes to the end of the search or of what is physical."""
    low, high = interval
    return (
        None if low is None or low <= parameter.min else low,
        None if high is None or high >= parameter.max else high,
    )


def _profiled(
    minimizer: Any, result: Any, free: Sequence[str]
) -> tuple[dict[str, Interval], list[Caution]]:
    fitting = lmfit()
    try:
        with np.errstate(all="ignore"), catch_warnings():
            simplefilter("error", UserWarning)  # a profile that was not followed to its end
            profiles = fitting.conf_interval(
                minimizer, result, p_names=list(free), sigmas=[LEVEL], maxiter=40,
                min_rel_change=1e-3,
            )  # fmt: skip
    except (fitting.minimizer.MinimizerException, ValueError, RuntimeError, UserWarning):
        found, told = _by_curvature(result, free)
        return found, [*told, caution("interval_by_curvature")]
    return {name: (_end(rows[0][1]), _end(rows[-1][1])) for name, rows in profiles.items()}, []


def _by_parabola(minimizer: Any, result: Any, free: Sequence[str]) -> dict[str, Interval] | None:
    """Student's intervals, or None where χ² at their ends is not what a parabola says.

    At the ends of the interval of one parameter, the others moved along with it by their
    covariance, a parabola has the χ² of `profile_level`. The bounds of the others do not count
    here, so that an interval may be wider than it has to be, but not narrower.
    """
    if result.covar is None or not np.all(np.isfinite(result.covar)):
        return None
    names, covariance = list(result.var_names), np.array(result.covar)
    factor = float(t_distribution.ppf(0.5 + LEVEL / 2.0, result.nfree))
    least = float(np.sum(np.square(minimizer.userfcn(result.params))))
    level = profile_level(result.nfree)
    found: dict[str, Interval] = {}
    for name in free:
        k = names.index(name)
        error, centre = float(np.sqrt(covariance[k, k])), float(result.params[name].value)
        if error == 0.0:  # the data are met exactly
            found[name] = (centre, centre)
            continue
        for sign in (-1.0, 1.0):
            moved = result.params.copy()
            shift = sign * factor * covariance[k] / error
            for other, by in zip(names, shift, strict=True):
                value = float(result.params[other].value) + by
                moved[other].set(value=value, min=-np.inf, max=np.inf)
            with np.errstate(all="ignore"):  # no number there is no parabola
                reached = float(np.sum(np.square(minimizer.userfcn(moved)))) / max(least, TINY)
            if not abs(reached - level) < PARABOLIC * (level - 1.0):
                return None
        found[name] = (centre - factor * error, centre + factor * error)
    return found


def correlations(result: Any, free: Sequence[str]) -> dict[tuple[str, str], float]:
    """Correlation of every pair of estimates."""
    found = {}
    for k, one in enumerate(free):
        for other in free[k + 1 :]:
            known = result.params[one].correl or {}
            if other in known:
                found[one, other] = float(known[other])
    return found


def _end(value: float) -> float | None:
    return float(value) if np.isfinite(value) else None


def open_ended(
    bounds: dict[str, Interval], both: str = "not_bounded", one: str = "bounded_on_one_side"
) -> list[Caution]:
    """Return a caution for each interval that is open: code `both`, or `one` for one open end."""
    told = []
    for name, (low, high) in bounds.items():
        if low is None and high is None:
            told.append(caution(both, name=name))
        elif low is None or high is None:
            told.append(caution(one, name=name))
    return told


def _profile_of_one(minimizer: Any, result: Any, name: str) -> Interval:
    """Where χ² has grown by the F distribution's share, on both sides of the best fit."""
    best, parameter = float(result.params[name].value), result.params[name]
    least = float(np.sum(np.square(minimizer.userfcn(result.params))))
    moved = result.params.copy()
    level = least * profile_level(result.nfree)

    def excess(value: float) -> float:
        moved[name].set(value=value)
        return float(np.sum(np.square(minimizer.userfcn(moved)))) - level

    spread = parameter.stderr if parameter.stderr else abs(best)
    return ends_of_profile(excess, best, 0.5 * spread, (parameter.min, parameter.max))


def profile_level(free: int) -> float:
    """χ² over its least value at the ends of the interval of one parameter."""
    return 1.0 + float(f_distribution.ppf(LEVEL, 1, free)) / free


def ends_of_profile(
    excess: Callable[[float], float], best: float, first: float, bounds: tuple[float, float]
) -> Interval:
    """Where a profile crosses 0 on both sides of the best value; None where it does not.

    Steps grow outwards from the `first` one to the bounds.
    """
    ends: list[float | None] = []
    for sign, bound in zip((-1.0, 1.0), bounds, strict=True):
        step, inner, end = max(first, SMALLEST * abs(best)), best, None
        for _ in range(STEPS):
            outer = best + sign * step
            beyond = sign * (outer - bound) >= 0.0
            outer = bound if beyond else outer
            if excess(outer) >= 0.0:
                end = best if inner == outer else float(brentq(excess, inner, outer, rtol=1e-10))
                break
            if beyond:
                break
            inner, step = outer, step * FARTHER
        ends.append(end)
    return ends[0], ends[1]


def _by_curvature(result: Any, free: Sequence[str]) -> tuple[dict[str, Interval], list[Caution]]:
    """95 % of the t distribution about the best fit."""
    if any(result.params[name].stderr is None for name in free):
        return {}, [caution("no_interval")]
    factor = float(t_distribution.ppf(0.5 + LEVEL / 2.0, result.nfree))
    found: dict[str, Interval] = {}
    for name in free:
        centre, half = result.params[name].value, factor * result.params[name].stderr
        found[name] = (float(centre - half), float(centre + half))
    return found, []
