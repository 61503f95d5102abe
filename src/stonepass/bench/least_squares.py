"""Least squares with intervals: lmfit's fit and profile likelihood, for constants and friction."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any
from warnings import catch_warnings, simplefilter

import numpy as np
from scipy.optimize import brentq
from scipy.stats import f as f_distribution
from scipy.stats import t as t_distribution

from stonepass.caution import Caution, caution
from stonepass.io.optional_imports import library

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

# Both ends of an interval; None where the data set no bound on that side.
Interval = tuple[float | None, float | None]


def lmfit() -> Any:
    """Load lmfit, or say what to install."""
    return library("lmfit", "fit constants", "laboratory")


def intervals(
    minimizer: Any, result: Any, free: Sequence[str]
) -> tuple[dict[str, Interval], list[Caution]]:
    """95 % intervals of the free parameters by profile likelihood, and what there is to say.

    The scatter is that of the residuals. Where a profile cannot be followed the curvature at the
    best fit stands in.
    """
    if len(free) == 1:
        bounds = {free[0]: _profile_of_one(minimizer, result, free[0])}
        return bounds, open_ended(bounds)
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
    bounds = {name: (_end(rows[0][1]), _end(rows[-1][1])) for name, rows in profiles.items()}
    return bounds, open_ended(bounds)


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
