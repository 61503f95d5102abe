"""The friction coefficient that fits a series of critical pressures, and what the series can tell.

A wall s times as stiff needs s times the pressure under s times the load,
P_ucr(s w, P_out) = s P_ucr(w, P_out/s), so that stiffness needs no solve of its own where nothing
confines the tube. Stiffness and friction both raise P_ucr; a series tells them apart only by how
they do it, and the joint fit shows how well.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np
from jaxtyping import Float
from scipy.stats import f as f_distribution

from stonepass.errors import BadInput, Outcome, require
from stonepass.laboratory.comparison import Comparison, Setting, compare
from stonepass.laboratory.least_squares import LEVEL, Interval, correlations, intervals, lmfit
from stonepass.model.answer import Answer
from stonepass.model.case import FRICTION, Case
from stonepass.model.points import Point
from stonepass.studies.jobs import PooledSolver, Solver
from stonepass.units import Values

__all__ = ["LARGEST", "SMALLEST", "STIFFNESS", "Estimate", "InVitro", "JointFit", "fit_friction"]

NODES = (0.05, 0.2, 0.5, 1.0)  # of friction, solved first
LOAD_FACTORS = (0.5, 1.0, 2.0)  # of confining pressures, where stiffness varies
SMALLEST, LARGEST = 0.01, FRICTION[1]
STIFFNESS = (1.0 / 3.0, 3.0)
START = (0.3, 1.0)
REFINED, JOINTLY_REFINED = 3, 2  # times that the series is solved at the friction fitted so far
SETTLED = 1e-3  # of friction, relative
FEWEST = 4  # points for two parameters


@dataclass(frozen=True)
class Estimate:
    """A fitted number and its 95 % interval; an end is None where the data do not bound it."""

    value: float
    low: float | None
    high: float | None


@dataclass(frozen=True)
class JointFit:
    """Friction and stiffness fitted together.

    Attributes
    ----------
    friction, stiffness : Estimate
        Stiffness as a factor on the material's.
    correlation : float or None
        Of the two estimates.
    misfit : callable
        χ² of frictions and stiffnesses, as arrays that broadcast, over its least value.
    level : float
        Of the misfit, round the joint 95 % region.
    """

    friction: Estimate
    stiffness: Estimate
    correlation: float | None
    misfit: Callable[[Values, Values], Values]
    level: float


@dataclass(frozen=True)
class InVitro:
    """A series, the model at a friction coefficient, and the coefficient that fits.

    Attributes
    ----------
    comparison : Comparison
        At the fitted friction, or at the one that was asked for.
    fitted : Comparison
        At the fitted friction.
    friction : Estimate
        With the material's own stiffness.
    joint : JointFit or None
        With the stiffness unknown; None for fewer than four points.
    setting : Setting
    weighted : bool
        Whether residuals are weighted by the points' standard deviations.
    warnings : tuple of str
    """

    comparison: Comparison
    fitted: Comparison
    friction: Estimate
    joint: JointFit | None
    setting: Setting
    weighted: bool
    warnings: tuple[str, ...] = ()


def fit_friction(
    points: Sequence[Point],
    setting: Setting,
    friction: float | None = None,
    solver: Solver | None = None,
) -> InVitro:
    """Find the friction coefficient that fits a series, with its interval.

    The series is solved at a few frictions and interpolated between them, then solved again at the
    friction that fits until that stays, so that the answer is the model's own.

    Parameters
    ----------
    points : sequence of Point
        Two at least; with an `sd` of every one, residuals are weighted.
    setting : Setting
    friction : float, optional
        To compare with; by default the fitted one.
    solver : Solver, optional

    Raises
    ------
    BadInput
        Fewer than two points that the model answers, or standard deviations of 0.
    """
    library, solver = lmfit(), solver or PooledSolver()
    weights, weighted = _weights(points)
    curves, lost = _curves(points, setting, solver)
    kept = [k for k, curve in enumerate(curves) if curve is not None]
    require(len(kept) > 1, "series", f"{len(kept)} points that the model answers", "two at least")
    some = [points[k] for k in kept]
    known = tuple(curve for curve in curves if curve is not None)
    series = _Model(known, some, weights[kept], setting)
    parameters = library.Parameters()
    parameters.add("friction", START[0], min=SMALLEST, max=LARGEST)
    parameters.add("stiffness", START[1], min=STIFFNESS[0], max=STIFFNESS[1], vary=False)
    fitted = None
    for _ in range(REFINED):
        minimizer, found = _minimized(library, series, parameters)
        value = float(found.params["friction"].value)
        if fitted is not None and abs(value - fitted.friction) < SETTLED * value:
            break
        fitted = compare(points, value, setting, solver)
        series = series.through(value, [{1.0: fitted.answers[k]} for k in kept])
    assert fitted is not None
    minimizer, found = _minimized(library, series, parameters)
    bounds, told = intervals(minimizer, found, ["friction"])
    estimate = Estimate(float(found.params["friction"].value), *_ends(bounds, "friction"))
    joint, more = _joint(library, series, parameters, solver)
    asked = fitted if friction is None else compare(points, friction, setting, solver)
    return InVitro(
        comparison=asked,
        fitted=fitted,
        friction=estimate,
        joint=joint,
        setting=setting,
        weighted=weighted,
        warnings=tuple(dict.fromkeys([*lost, *_at_end(estimate), *told, *more])),
    )


def _minimized(library: Any, series: _Model, parameters: Any) -> tuple[Any, Any]:
    minimizer = library.Minimizer(series.residuals, parameters)
    return minimizer, minimizer.minimize(method="least_squares")


def _weights(points: Sequence[Point]) -> tuple[Float[np.ndarray, " n"], bool]:
    given = [point.sd for point in points if point.sd is not None]
    if len(given) < len(points):
        scale = max((abs(point.pressure) for point in points), default=0.0)
        require(scale > 0.0, "series", "zero throughout", "measured pressures")
        return np.full(len(points), 1.0 / scale), False
    if min(given) <= 0.0:
        raise BadInput("sd_kPa", min(given) / 1e3, "above 0", "leave the column out")
    return 1.0 / np.array(given), True


@dataclass(frozen=True)
class _OverFriction:
    """P_ucr of one case in Pa over friction: ln(P/μ) by a polynomial in √μ through what was solved.

    `end` is where the paper's closure ends, the most that such a model can say.
    """

    friction: tuple[float, ...]
    pressure: tuple[float, ...]
    end: float

    @cached_property
    def coefficients(self) -> Float[np.ndarray, " k"]:
        """Of the polynomial, highest power first."""
        mu = np.array(self.friction)
        return np.polyfit(np.sqrt(mu), np.log(np.array(self.pressure) / mu), len(mu) - 1)

    @cached_property
    def rise(self) -> float:
        """Slope d ln P/dμ at the largest friction solved."""
        most = max(self.friction)
        slope = np.polyval(np.polyder(self.coefficients), np.sqrt(most)) / (2.0 * np.sqrt(most))
        return max(float(1.0 / most + slope), 0.0)

    def __call__(self, mu: Values) -> Values:
        """The pressure at friction μ; beyond the last one solved that one's tangent leads on."""
        most = max(self.friction)
        inside = np.minimum(mu, most)
        value = inside * np.exp(np.polyval(self.coefficients, np.sqrt(inside)))
        return np.minimum(value * (1.0 + self.rise * (mu - inside)), self.end)

    def through(self, mu: float, pressure: float | None) -> _OverFriction:
        """The same through one more solve, if it has a pressure; one that is close gives way."""
        if not pressure:
            return self
        kept = [k for k, old in enumerate(self.friction) if abs(old - mu) > 0.1 * mu]
        return replace(
            self,
            friction=(*(self.friction[k] for k in kept), mu),
            pressure=(*(self.pressure[k] for k in kept), pressure),
        )


@dataclass(frozen=True)
class _Curve:
    """P_ucr of one point over friction and stiffness; `loose` stones need none."""

    factors: tuple[float, ...]
    over: tuple[_OverFriction, ...]
    loose: bool = False

    def __call__(self, mu: Any, stiffness: Any) -> Any:
        """s P_ucr(μ; P_out/s): between load factors by the polynomial through them."""
        if self.loose:
            return np.zeros(np.broadcast_shapes(np.shape(mu), np.shape(stiffness)))
        if len(self.factors) == 1:
            return stiffness * self.over[0](mu)
        factor = 1.0 / stiffness
        total: Values = 0.0
        for k, one in enumerate(self.factors):
            share = 1.0
            for other in (f for f in self.factors if f != one):
                share = share * (factor - other) / (one - other)
            total = total + share * self.over[k](mu)
        return stiffness * total

    def through(self, mu: float, answers: Mapping[float, Answer]) -> _Curve:
        """The same through answers at one more friction, by load factor."""
        found = [
            over if answers.get(factor) is None else over.through(mu, answers[factor].pressure)
            for factor, over in zip(self.factors, self.over, strict=True)
        ]
        return replace(self, over=tuple(found))


@dataclass(frozen=True)
class _Model:
    """The series as a function of friction and stiffness."""

    curves: tuple[_Curve, ...]
    points: Sequence[Point]
    weights: Float[np.ndarray, " n"]
    setting: Setting

    def residuals(self, parameters: Any) -> Float[np.ndarray, " n"]:
        """Model less measured, weighted."""
        values = parameters.valuesdict()
        return self._residuals(values["friction"], values["stiffness"])

    def misfit(self, mu: Any, stiffness: Any) -> Any:
        """Sum of squares on a grid."""
        return np.sum(np.square(self._residuals(mu, stiffness)), axis=-1)

    def through(self, mu: float, answers: Sequence[Mapping[float, Answer]]) -> _Model:
        """The same through answers at one more friction, of each point by load factor."""
        pairs = zip(self.curves, answers, strict=True)
        return replace(self, curves=tuple(curve.through(mu, found) for curve, found in pairs))

    def solved_at(self, mu: float, solver: Solver) -> _Model:
        """The same, solved at one more friction for every load factor."""
        asked = [
            {factor: self.setting.case(point, mu, factor) for factor in curve.factors}
            for curve, point in zip(self.curves, self.points, strict=True)
        ]
        flat = list(dict.fromkeys(case for each in asked for case in each.values()))
        known = dict(zip(flat, solver.answers(flat, error=False), strict=True))
        return self.through(mu, [{f: known[c] for f, c in each.items()} for each in asked])

    def _residuals(self, mu: Any, stiffness: Any) -> Any:
        measured = np.array([point.pressure for point in self.points])
        found = np.stack([curve(mu, stiffness) for curve in self.curves], axis=-1)
        return (found - measured) * self.weights


def _curves(
    points: Sequence[Point], setting: Setting, solver: Solver
) -> tuple[list[_Curve | None], list[str]]:
    """Every point over friction, and over its load where it has one; None without two answers."""
    asked = [_asked(point, setting) for point in points]
    flat = list(dict.fromkeys(case for each in asked for case in each.values()))
    known = dict(zip(flat, solver.answers(flat, error=False), strict=True))
    curves = [_curve({key: known[case] for key, case in each.items()}) for each in asked]
    lost = sum(curve is None for curve in curves)
    told = [f"{lost} of {len(points)} points have no answer and are left out"] if lost else []
    return curves, told


def _asked(point: Point, setting: Setting) -> dict[tuple[float, float], Case]:
    factors = LOAD_FACTORS if point.confining_pressure > 0.0 else (1.0,)
    return {(f, mu): setting.case(point, mu, f) for f in factors for mu in NODES}


def _curve(answers: dict[tuple[float, float], Answer]) -> _Curve | None:
    if any(a.outcome is Outcome.LOOSE for (f, _), a in answers.items() if f == 1.0):
        return _Curve((), (), loose=True)
    found = {}
    for factor in dict.fromkeys(f for f, _ in answers):
        over = {mu: a.pressure for (f, mu), a in answers.items() if f == factor and a.pressure}
        ends = [a.closure_end_pressure for (f, _), a in answers.items()
                if f == factor and a.outcome is Outcome.BEYOND_CLOSURE]  # fmt: skip
        end = min((each for each in ends if each is not None), default=np.inf)
        if len(over) > 1:
            found[factor] = _OverFriction(tuple(over), tuple(over.values()), end)
    if 1.0 not in found:
        return None
    return _Curve(tuple(found), tuple(found.values()))


def _at_end(estimate: Estimate) -> list[str]:
    for end in (SMALLEST, LARGEST):
        if abs(estimate.value - end) < 1e-3 * end:
            return [f"the friction that fits lies at the end of its range, {end:g}: no friction "
                    "makes this wall meet the series"]  # fmt: skip
    return []


def _joint(
    library: Any, series: _Model, parameters: Any, solver: Solver
) -> tuple[JointFit | None, list[str]]:
    """Fit friction and stiffness together, and map the misfit around."""
    count = len(series.curves)
    if count < FEWEST:
        return None, [f"{count} points are too few to tell stiffness from friction"]
    both = parameters.copy()
    both["stiffness"].set(vary=True)
    for _ in range(JOINTLY_REFINED):
        _, found = _minimized(library, series, both)
        series = series.solved_at(float(found.params["friction"].value), solver)
    minimizer, found = _minimized(library, series, both)
    bounds, told = intervals(minimizer, found, list(both))
    values = {name: float(found.params[name].value) for name in both}
    estimates = {name: Estimate(values[name], *_ends(bounds, name)) for name in both}
    least = max(float(np.sum(np.square(found.residual))), np.finfo(float).tiny)

    def misfit(mu: Values, stiffness: Values) -> Values:
        return series.misfit(mu, stiffness) / least

    share = 2.0 * float(f_distribution.ppf(LEVEL, 2, count - 2)) / (count - 2)
    joint = JointFit(
        estimates["friction"],
        estimates["stiffness"],
        correlations(found, list(both)).get(("friction", "stiffness")),
        misfit,
        1.0 + share,
    )
    return joint, [f"{sentence} when stiffness is fitted too" for sentence in told]


def _ends(bounds: dict[str, Interval], name: str) -> Interval:
    """Ends of an interval; none where it reaches the end of what was tried."""
    low, high = bounds.get(name, (None, None))
    first, last = (SMALLEST, LARGEST) if name == "friction" else STIFFNESS
    return (
        None if low is None or low <= first * 1.001 else low,
        None if high is None or high >= last * 0.999 else high,
    )
