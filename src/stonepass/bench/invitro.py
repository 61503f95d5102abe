"""Fit of the friction coefficient to a measured series of critical pressures.

A stiffer wall and a larger friction coefficient both raise P_ucr. The two effects can be separated
only because they vary differently with the size of the stone, the wall and the load. A second fit,
of friction and stiffness together, shows how well the series determines both.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.optimize import minimize_scalar
from scipy.stats import f as f_distribution

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Float
from stonepass.bench.agreement import OBJECTIONS, disagreement
from stonepass.bench.comparison import SeriesComparison, SeriesSetting, compare
from stonepass.bench.least_squares import (
    LEVEL,
    Interval,
    correlations,
    ends_of_profile,
    intervals,
    lmfit,
    open_ended,
    profile_level,
)
from stonepass.bench.series_model import SeriesModel, series_curves
from stonepass.caution import Caution, caution
from stonepass.errors import BadInput, Outcome, require
from stonepass.inputs.measured_pressures import Point
from stonepass.model.models.registry import MODELS
from stonepass.model.stone import FRICTION
from stonepass.result import Result
from stonepass.studies.case_solver import CaseSolver, JobSolver
from stonepass.units import Values

__all__ = [
    "LARGEST",
    "SMALLEST",
    "STIFFNESS",
    "FittedParameter",
    "InVitro",
    "JointFit",
    "fit_friction",
]

SMALLEST, LARGEST = 0.01, FRICTION[1]  # search bounds of the friction coefficient
STIFFNESS = (1.0 / 3.0, 3.0)  # search bounds of the factor on the stiffness of the material
BOUNDS = {"friction": (SMALLEST, LARGEST), "stiffness": STIFFNESS}
PROFILE_GRID = 60  # number of values of the second parameter at each point of a profile
START = (0.3, 1.0)  # friction and stiffness at which the fit starts
# Largest number of times that the series is solved again at the friction fitted so far.
REFINED, JOINTLY_REFINED = 3, 2
SETTLED = 1e-3  # relative change of the friction below which the fit has converged
FEWEST = 4  # smallest number of points for a fit of both parameters


@dataclass(frozen=True)
class FittedParameter:
    """A fitted parameter and its 95 % confidence interval.

    Attributes
    ----------
    value : float
        Best value; dimensionless for friction and stiffness.
    low, high : float or None
        Lower and upper end of the interval; None if the data do not bound it on that side.
    """

    value: float
    low: float | None
    high: float | None


@array_dataclass
@dataclass(frozen=True)
class JointFit:
    """Friction and stiffness fitted together.

    Attributes
    ----------
    friction : FittedParameter
        Friction coefficient μ_f.
    stiffness : FittedParameter
        Factor on the stiffness of the material.
    correlation : float or None
        Correlation of the two estimates, −1 to 1.
    misfit : callable
        χ²(friction, stiffness) divided by its least value. The arguments are arrays that broadcast.
    level : float
        Value of `misfit` on the boundary of the joint 95 % confidence region.

    References
    ----------
    docs/bench.md, "A series in vitro".
    """

    friction: FittedParameter
    stiffness: FittedParameter
    correlation: float | None
    misfit: Callable[[Values, Values], Values]
    level: float


@array_dataclass
@dataclass(frozen=True, repr=False)
class InVitro(Result):
    """Result of the comparison of a measured series with the model.

    Attributes
    ----------
    comparison : SeriesComparison
        Comparison at the fitted friction, or at the friction that the caller gave.
    fitted : SeriesComparison
        Comparison at the fitted friction.
    friction : FittedParameter
        Friction coefficient fitted with the stiffness of the material.
    joint : JointFit or None
        Friction and stiffness fitted together; None for fewer than four points.
    setting : SeriesSetting
        Material, confinement, model and numerics.
    weighted : bool
        True if every residual is weighted by the standard deviation of its point.
    warnings : tuple of Caution
        Warnings; those after which the fitted numbers must not be used come first.
    """

    comparison: SeriesComparison
    fitted: SeriesComparison
    friction: FittedParameter
    joint: JointFit | None
    setting: SeriesSetting
    weighted: bool
    warnings: tuple[Caution, ...] = ()

    def summary(self) -> str:
        """Return the fitted friction with its interval, and how it was found, in one line."""
        low, high = (
            "unbounded" if end is None else f"{end:.3g}"
            for end in (self.friction.low, self.friction.high)
        )
        holds = "" if not self.objections else "; series and model do not agree"
        return (
            f"friction {self.friction.value:.3g}, 95 % interval {low} to {high}, from "
            f"{len(self.comparison.points)} points{holds}"
        )

    @property
    def objections(self) -> tuple[Caution, ...]:
        """Warnings of a disagreement of series and model that invalidates the fitted numbers."""
        return tuple(each for each in self.warnings if each.code in OBJECTIONS)


def fit_friction(
    points: Sequence[Point],
    setting: SeriesSetting,
    friction: float | None = None,
    solver: CaseSolver | None = None,
) -> InVitro:
    """Fit the friction coefficient to a series of measured critical pressures.

    The model is solved at a few friction coefficients, and P_ucr is interpolated between them. The
    model is then solved again at the fitted coefficient, until the coefficient changes by less than
    0.1 %, so that the result does not depend on the interpolation. With four points or more,
    friction and stiffness are also fitted together.

    Parameters
    ----------
    points : sequence of Point
        At least two measured critical pressures. The residuals are weighted if every point has a
        standard deviation.
    setting : SeriesSetting
        Material, confinement, model and numerics.
    friction : float, optional
        Friction coefficient at which the series is compared with the model, 0 to 2; by default the
        fitted one.
    solver : CaseSolver, optional
        Solves the cases; by default in this process, without a cache.

    Returns
    -------
    InVitro

    Raises
    ------
    BadInput
        The model has an answer for fewer than two points, a standard deviation is 0, all pressures
        are 0, `friction` is out of bounds, or the model has no finite elements.

    References
    ----------
    docs/bench.md, "A series in vitro".
    """
    library, solver = lmfit(), solver or JobSolver(progress=True)
    if not setting.model.NEEDS_ELEMENTS:
        names = [f"'{name}'" for name, model in MODELS.items() if model.NEEDS_ELEMENTS]
        raise BadInput("model", setting.model.NAME, " or ".join(names),
                       "a model with finite elements is compared")  # fmt: skip
    weights, weighted = _weights(points)
    curves, warnings = series_curves(points, setting, solver)
    kept = [k for k, curve in enumerate(curves) if curve is not None]
    require(len(kept) > 1, "number of points for which the model predicts a critical pressure",
            len(kept), "at least 2", "; ".join(map(str, warnings)))  # fmt: skip
    known = tuple(curve for curve in curves if curve is not None)
    whole = SeriesModel(known, [points[k] for k in kept], weights[kept], setting)
    parameters = library.Parameters()
    parameters.add("friction", START[0], min=SMALLEST, max=LARGEST)
    parameters.add("stiffness", START[1], min=STIFFNESS[0], max=STIFFNESS[1], vary=False)
    fitted, chosen = None, [True] * len(kept)
    for _ in range(REFINED):
        minimizer, found = _minimized(library, whole.where(chosen), parameters)
        value = float(found.params["friction"].value)
        if fitted is not None and abs(value - fitted.friction) < SETTLED * value:
            break
        fitted = compare(points, value, setting, solver)
        whole = whole.through(value, [{1.0: fitted.answers[k]} for k in kept])
        held = [fitted.answers[k].outcome is Outcome.MOVES for k in kept]
        if sum(held) < 2:
            break
        chosen = held
    assert fitted is not None
    minimizer, found = _minimized(library, whole.where(chosen), parameters)
    value = float(found.params["friction"].value)
    answered = sum(fitted.answers[k].outcome is Outcome.MOVES for k in kept)
    if answered < 2 or any(abs(value - end) < 1e-3 * end for end in BOUNDS["friction"]):
        estimate = FittedParameter(value, None, None)
        warnings.append(caution("no_friction_fits"))
    else:
        bounds, more = intervals(minimizer, found, ["friction"])
        estimate = FittedParameter(value, *_ends(bounds, "friction"))
        warnings += more
        if False in chosen:
            warnings.append(caution("unanswered_at_fit", count=chosen.count(False)))
    joint, about_both = _joint(library, whole, parameters, solver)
    asked = fitted if friction is None else compare(points, friction, setting, solver)
    against = disagreement(asked, 1 if friction is None else 0)
    told = dict.fromkeys([*against, *_excluded(joint, estimate), *warnings, *about_both])
    ordered = sorted(told, key=lambda each: each.code not in OBJECTIONS)
    return InVitro(asked, fitted, estimate, joint, setting, weighted, tuple(ordered))


def _excluded(joint: JointFit | None, alone: FittedParameter) -> list[Caution]:
    """Return cautions if the joint fit excludes the stiffness of the material or ends at a bound.

    `joint` and `alone` are the fits with and without an unknown stiffness.
    """
    if joint is None:
        return []
    found = []
    stiffness = joint.stiffness
    above = stiffness.low is not None and stiffness.low > 1.0
    if above or (stiffness.high is not None and stiffness.high < 1.0):
        found.append(
            caution("stiffness_excluded", stiffness=stiffness.value, friction=alone.value,
                    jointly=joint.friction.value)
        )  # fmt: skip
    for name, estimate in (("friction", joint.friction), ("stiffness", stiffness)):
        if any(abs(estimate.value - end) < 1e-3 * end for end in BOUNDS[name]):
            found.append(caution("jointly_at_end", name=name, value=estimate.value))
    return found


def _minimized(library: Any, series: SeriesModel, parameters: Any) -> tuple[Any, Any]:
    minimizer = library.Minimizer(series.residuals, parameters)
    return minimizer, minimizer.minimize(method="least_squares")


def _weights(points: Sequence[Point]) -> tuple[Float[np.ndarray, " n"], bool]:
    given = [point.sd for point in points if point.sd is not None]
    if len(given) < len(points):
        scale = max((abs(point.pressure) for point in points), default=0.0)
        require(scale > 0.0, "pressure_kPa", "0 in every row", "above 0 in some rows")
        return np.full(len(points), 1.0 / scale), False
    if min(given) <= 0.0:
        raise BadInput("sd_kPa", min(given) / 1e3, "above 0",
                       "leave the column out if the standard deviations are unknown")  # fmt: skip
    return 1.0 / np.array(given), True


def _joint(
    library: Any, series: SeriesModel, parameters: Any, solver: CaseSolver
) -> tuple[JointFit | None, list[Caution]]:
    """Fit friction and stiffness together, with intervals and the joint confidence region."""
    count = len(series.curves)
    if count < FEWEST:
        return None, [caution("too_few_for_stiffness", points=count)]
    both = parameters.copy()
    both["stiffness"].set(vary=True)
    for _ in range(JOINTLY_REFINED):
        _, found = _minimized(library, series, both)
        series = series.solved_at(float(found.params["friction"].value), solver)
    _, found = _minimized(library, series, both)
    ended = series.ended(float(found.params["friction"].value))
    if any(ended) and count - sum(ended) >= FEWEST:
        series, count = series.where([not each for each in ended]), count - sum(ended)
        _, found = _minimized(library, series, both)
    least = max(float(np.sum(np.square(found.residual))), np.finfo(float).tiny)

    def misfit(mu: Values, stiffness: Values) -> Values:
        return series.misfit(mu, stiffness) / least

    best = {name: float(found.params[name].value) for name in BOUNDS}
    estimates = {
        name: FittedParameter(best[name], *_profiled(misfit, best, name, count)) for name in best
    }
    bounds = {name: (each.low, each.high) for name, each in estimates.items()}
    warnings = open_ended(bounds, "jointly_not_bounded", "jointly_bounded_on_one_side")
    excess_level = 2.0 * float(f_distribution.ppf(LEVEL, 2, count - 2)) / (count - 2)
    correlation = correlations(found, list(both)).get(("friction", "stiffness"))
    joint = JointFit(
        estimates["friction"], estimates["stiffness"], correlation, misfit, 1.0 + excess_level
    )
    return joint, warnings


def _profiled(
    misfit: Callable[[Values, Values], Values], best: Mapping[str, float], name: str, count: int
) -> Interval:
    """Return the interval of one parameter from its profile.

    At every value of the parameter `name` the misfit is minimised over the other parameter.
    """
    other = "stiffness" if name == "friction" else "friction"
    grid = np.unique(np.append(np.geomspace(*BOUNDS[other], PROFILE_GRID), best[other]))
    level = profile_level(count - 2)

    def at(value: float, others: Values) -> Values:
        given = (value, others) if name == "friction" else (others, value)
        return misfit(*(np.asarray(each) for each in given))

    def excess(value: float) -> float:
        """Return the misfit, minimised over the other parameter, minus the level."""
        values = np.asarray(at(value, grid))
        k = int(np.argmin(values))
        ends = (grid[max(k - 1, 0)], grid[min(k + 1, len(grid) - 1)])
        nearest = minimize_scalar(
            lambda each: float(at(value, each)), bounds=ends, method="bounded",
            options={"xatol": 1e-9},
        )  # fmt: skip
        return min(float(nearest.fun), float(values[k])) - level

    return ends_of_profile(excess, best[name], 0.01 * best[name], BOUNDS[name])


def _ends(bounds: dict[str, Interval], name: str) -> Interval:
    """Return the ends of an interval; an end that reaches a bound of the search becomes None."""
    low, high = bounds.get(name, (None, None))
    first, last = (SMALLEST, LARGEST) if name == "friction" else STIFFNESS
    return (
        None if low is None or low <= first * 1.001 else low,
        None if high is None or high >= last * 0.999 else high,
    )
