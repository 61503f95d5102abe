"""Critical pressures of a series as a smooth function of friction and stiffness.

The function interpolates a few solved cases over friction. Stiffness needs no solves without a
confining pressure, because a wall that is s times as stiff needs s times the pressure under s times
the load: P_ucr(s w, P_out) = s P_ucr(w, P_out/s) (docs/theory.md, "A stiffer wall").
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Float
from stonepass.bench.comparison import SeriesSetting
from stonepass.caution import Caution, caution
from stonepass.errors import Outcome
from stonepass.inputs.measured_pressures import Point
from stonepass.model.answer import Answer
from stonepass.model.case import Case
from stonepass.model.load import CONFINING
from stonepass.studies.case_solver import CaseSolver
from stonepass.units import Values

__all__ = ["OverFriction", "PressureCurve", "SeriesModel", "series_curves"]

NODES = (0.05, 0.2, 0.5, 1.0)  # friction coefficients that are solved first
# Factors on the confining pressure that are solved for the dependence on stiffness.
LOAD_FACTORS = (0.5, 1.0, 2.0)


@dataclass(frozen=True)
class OverFriction:
    """Critical pressure of one case as a function of friction.

    ln(P_ucr/μ) is a polynomial in √μ through the solved friction coefficients.

    Attributes
    ----------
    friction : tuple of float
        Solved friction coefficients μ.
    pressure : tuple of float
        P_ucr in Pa at each of them.
    end : float
        Pressure in Pa at which the paper's closure ends, the largest that the model can predict;
        infinite without such an end.

    References
    ----------
    docs/bench.md, "A series in vitro".
    """

    friction: tuple[float, ...]
    pressure: tuple[float, ...]
    end: float

    @cached_property
    def coefficients(self) -> Float[np.ndarray, " k"]:
        """Coefficients of the polynomial, highest power first."""
        mu = np.array(self.friction)
        return np.polyfit(np.sqrt(mu), np.log(np.array(self.pressure) / mu), len(mu) - 1)

    @cached_property
    def rise(self) -> float:
        """Slope d ln P_ucr/dμ at the largest solved friction coefficient."""
        most = max(self.friction)
        slope = np.polyval(np.polyder(self.coefficients), np.sqrt(most)) / (2.0 * np.sqrt(most))
        return max(float(1.0 / most + slope), 0.0)

    def __call__(self, mu: Values) -> Values:
        """Return P_ucr in Pa at friction μ, but at most `end`.

        Above the largest solved friction coefficient P_ucr is extrapolated linearly.
        """
        most = max(self.friction)
        inside = np.minimum(mu, most)
        value = inside * np.exp(np.polyval(self.coefficients, np.sqrt(inside)))
        return np.minimum(value * (1.0 + self.rise * (mu - inside)), self.end)

    def through(self, mu: float, pressure: float | None) -> OverFriction:
        """Return the curve with one more solved point.

        It replaces points whose friction coefficient differs from μ by less than 10 %.

        Parameters
        ----------
        mu : float
            Friction coefficient of the new point.
        pressure : float or None
            P_ucr in Pa at the new point. The curve is returned unchanged if it is None or 0.
        """
        if not pressure:
            return self
        kept = [k for k, old in enumerate(self.friction) if abs(old - mu) > 0.1 * mu]
        return replace(
            self,
            friction=(*(self.friction[k] for k in kept), mu),
            pressure=(*(self.pressure[k] for k in kept), pressure),
        )


@dataclass(frozen=True)
class PressureCurve:
    """Critical pressure of one measured point as a function of friction and stiffness.

    Attributes
    ----------
    factors : tuple of float
        Solved factors on the confining pressure; only the factor 1 without a confining pressure.
    over : tuple of OverFriction
        Dependence on friction for each factor.

    References
    ----------
    docs/theory.md, "A stiffer wall".
    """

    factors: tuple[float, ...]
    over: tuple[OverFriction, ...]

    def __call__(self, mu: Any, stiffness: Any) -> Any:
        """Return s P_ucr(μ; P_out/s) in Pa for stiffness s, interpolated over the load factors."""
        if len(self.factors) == 1:
            return stiffness * self.over[0](mu)
        factor = 1.0 / stiffness
        total: Values = 0.0
        for k, one in enumerate(self.factors):
            weight = 1.0
            for other in (f for f in self.factors if f != one):
                weight = weight * (factor - other) / (one - other)
            total = total + weight * self.over[k](mu)
        return stiffness * total

    def through(self, mu: float, answers: Mapping[float, Answer]) -> PressureCurve:
        """Return the curve with answers at one more friction coefficient.

        Parameters
        ----------
        mu : float
            Friction coefficient of the answers.
        answers : mapping of float to Answer
            Answers by their factor on the confining pressure.
        """
        found = [
            over if answers.get(factor) is None else over.through(mu, answers[factor].pressure)
            for factor, over in zip(self.factors, self.over, strict=True)
        ]
        return replace(self, over=tuple(found))


@array_dataclass
@dataclass(frozen=True)
class SeriesModel:
    """Predictions of the model for a series of points, by friction and stiffness.

    Attributes
    ----------
    curves : tuple of PressureCurve
        Prediction for each of the n points.
    points : sequence of Point
        Measured critical pressures.
    weights : array (n)
        Weights of the residuals in 1/Pa.
    setting : SeriesSetting
        Material, confinement, model and numerics.

    References
    ----------
    docs/bench.md, "A series in vitro".
    """

    curves: tuple[PressureCurve, ...]
    points: Sequence[Point]
    weights: Float[np.ndarray, " n"]
    setting: SeriesSetting

    def residuals(self, parameters: Any) -> Float[np.ndarray, " n"]:
        """Return the weighted differences of prediction and measurement for lmfit parameters."""
        values = parameters.valuesdict()
        return self._residuals(values["friction"], values["stiffness"])

    def misfit(self, mu: Any, stiffness: Any) -> Any:
        """Return the sum of the squared weighted residuals.

        Parameters
        ----------
        mu, stiffness : float or array
            Friction coefficients and stiffness factors that broadcast against each other.
        """
        return np.sum(np.square(self._residuals(mu, stiffness)), axis=-1)

    def where(self, chosen: Sequence[bool]) -> SeriesModel:
        """Return the model of the points for which `chosen` is true."""
        return replace(
            self,
            curves=tuple(c for c, yes in zip(self.curves, chosen, strict=True) if yes),
            points=[p for p, yes in zip(self.points, chosen, strict=True) if yes],
            weights=self.weights[np.array(chosen)],
        )

    def ended(self, mu: float) -> list[bool]:
        """Return for each point whether it lies at the end of the paper's closure at friction μ.

        The prediction is then a lower bound that does not depend on friction.
        """
        return [any(float(over(mu)) >= over.end for over in curve.over) for curve in self.curves]

    def through(self, mu: float, answers: Sequence[Mapping[float, Answer]]) -> SeriesModel:
        """Return the model with answers at one more friction coefficient.

        Parameters
        ----------
        mu : float
            Friction coefficient of the answers.
        answers : sequence of mapping
            For each point the answers by their factor on the confining pressure.
        """
        pairs = zip(self.curves, answers, strict=True)
        return replace(self, curves=tuple(curve.through(mu, found) for curve, found in pairs))

    def solved_at(self, mu: float, solver: CaseSolver) -> SeriesModel:
        """Solve every point at one more friction coefficient and return the refined model.

        Parameters
        ----------
        mu : float
            Friction coefficient μ_f, 0 to 2.
        solver : CaseSolver
            Solves the cases, without error estimates.
        """
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


def series_curves(
    points: Sequence[Point], setting: SeriesSetting, solver: CaseSolver
) -> tuple[list[PressureCurve | None], list[Caution]]:
    """Solve every point at a few friction coefficients and factors on its confining pressure.

    Parameters
    ----------
    points : sequence of Point
        Measured critical pressures.
    setting : SeriesSetting
        Material, confinement, model and numerics.
    solver : CaseSolver
        Solves the cases, without error estimates.

    Returns
    -------
    curves : list of PressureCurve or None
        None for a point with a critical pressure at fewer than two friction coefficients.
    warnings : list of Caution
        Cautions about the points that have no curve.
    """
    asked = [_asked(point, setting) for point in points]
    flat = list(dict.fromkeys(case for each in asked for case in each.values()))
    known = dict(zip(flat, solver.answers(flat, error=False), strict=True))
    curves = [_curve({key: known[case] for key, case in each.items()}) for each in asked]
    loose = [
        any(known[case].outcome is Outcome.LOOSE for (f, _), case in each.items() if f == 1.0)
        for each in asked
    ]
    lost = sum(curve is None for curve in curves) - sum(loose)
    warnings = []
    if any(loose):
        warnings.append(caution("loose_points", count=sum(loose), points=len(points)))
    if lost:
        warnings.append(caution("unanswered_points", count=lost, points=len(points)))
    return curves, warnings


def _asked(point: Point, setting: SeriesSetting) -> dict[tuple[float, float], Case]:
    outside = float(point.confining_pressure)
    factors = tuple(f for f in LOAD_FACTORS if f * outside <= CONFINING[1]) if outside else (1.0,)
    return {(f, mu): setting.case(point, mu, f) for f in factors for mu in NODES}


def _curve(answers: dict[tuple[float, float], Answer]) -> PressureCurve | None:
    found = {}
    for factor in dict.fromkeys(f for f, _ in answers):
        over = {mu: a.pressure for (f, mu), a in answers.items() if f == factor and a.pressure}
        ends = [a.closure_end_pressure for (f, _), a in answers.items()
                if f == factor and a.outcome is Outcome.BEYOND_CLOSURE]  # fmt: skip
        end = min((each for each in ends if each is not None), default=np.inf)
        if len(over) > 1:
            found[factor] = OverFriction(tuple(over), tuple(over.values()), end)
    if 1.0 not in found:
        return None
    return PressureCurve(tuple(found), tuple(found.values()))
