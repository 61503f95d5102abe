"""Comparison of a measured series of critical pressures with the model: bias, RMSE and R²."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import TypeVar

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Float
from stonepass.errors import Outcome
from stonepass.inputs.measured_pressures import Point
from stonepass.materials.protocol import Material
from stonepass.model.answer import Answer, Model
from stonepass.model.case import Case
from stonepass.model.load import Load
from stonepass.model.models.seated_balance import SeatedBalance
from stonepass.model.numerics import Numerics
from stonepass.model.stone import Stone
from stonepass.model.ureter import Ureter
from stonepass.studies.case_solver import CaseSolver

__all__ = [
    "SeriesComparison",
    "SeriesSetting",
    "SizeCurve",
    "compare",
    "point_curves",
    "size_curves",
]

T = TypeVar("T")

SIZES = 9  # number of size ratios on a curve


@dataclass(frozen=True)
class SeriesSetting:
    """Properties that all stones and tubes of a series have in common.

    Attributes
    ----------
    material : Material
        Material of the wall.
    confinement : {"hydrostatic", "dead"}
        How the confining pressure acts (see `Load`). The pressure of a water bath is hydrostatic.
    model : Model
        Model that predicts the critical pressures.
    numerics : Numerics
        Accuracy and length of the tube.
    """

    material: Material
    confinement: str = "hydrostatic"
    model: Model = field(default_factory=SeatedBalance)
    numerics: Numerics = field(default_factory=Numerics)

    def case(self, point: Point, friction: float, load_factor: float = 1.0) -> Case:
        """Return the case that belongs to a measured point.

        Parameters
        ----------
        point : Point
            Size ratio, wall ratio and confining pressure of the measurement.
        friction : float
            Friction coefficient μ_f, 0 to 2.
        load_factor : float
            Dimensionless factor on the confining pressure of the point.
        """
        pressure = type(point.confining_pressure)(load_factor * point.confining_pressure)
        load = Load(pressure, self.confinement if pressure > 0.0 else "dead")
        ureter = Ureter(wall_ratio=point.wall_ratio, material=self.material)
        stone = Stone(None, friction, point.size_ratio)
        return Case(stone, ureter, load, self.model, self.numerics)


@dataclass(frozen=True)
class SeriesComparison:
    """Measured points and the answers of the model at one friction coefficient.

    Attributes
    ----------
    friction : float
        Friction coefficient μ_f of all answers.
    points : tuple of Point
        Measured critical pressures.
    answers : tuple of Answer
        The answer of the model for each point.

    References
    ----------
    docs/bench.md, "A series in vitro".
    """

    friction: float
    points: tuple[Point, ...]
    answers: tuple[Answer, ...]

    @property
    def measured(self) -> Float[np.ndarray, " n"]:
        """Measured pressures in Pa of the points for which the model predicts a pressure."""
        pairs = zip(self.points, self.answers, strict=True)
        return np.array([point.pressure for point, answer in pairs if _moves(answer)])

    @property
    def predicted(self) -> Float[np.ndarray, " n"]:
        """Predicted pressures in Pa of the points in `measured`."""
        return np.array([each.pressure for each in self.answers if _moves(each)])

    @property
    def compared(self) -> int:
        """Number of points for which the model predicts a pressure."""
        return len(self.predicted)

    @property
    def bias(self) -> float | None:
        """Mean of predicted minus measured pressure in Pa; None if no point can be compared."""
        return float(np.mean(self.predicted - self.measured)) if self.compared else None

    @property
    def rmse(self) -> float | None:
        """Root mean square of predicted minus measured pressure in Pa; None as for `bias`."""
        if not self.compared:
            return None
        return float(np.sqrt(np.mean((self.predicted - self.measured) ** 2)))

    @property
    def r_squared(self) -> float | None:
        """Coefficient of determination, 1 − Σ (predicted − measured)²/Σ (measured − mean)².

        It is None if no point can be compared or all measured pressures are equal.
        """
        spread = float(np.sum((self.measured - self.measured.mean()) ** 2)) if self.compared else 0
        if spread == 0.0:
            return None
        return 1.0 - float(np.sum((self.predicted - self.measured) ** 2)) / spread

    @property
    def not_compared(self) -> dict[str, int]:
        """Number of points without a predicted pressure, by the name of the outcome."""
        names = [each.outcome.name for each in self.answers if not _moves(each)]
        return {name: names.count(name) for name in dict.fromkeys(names)}


def _moves(answer: Answer) -> bool:
    return answer.outcome is Outcome.MOVES and answer.pressure is not None


def compare(
    points: Sequence[Point], friction: float, setting: SeriesSetting, solver: CaseSolver
) -> SeriesComparison:
    """Compute the critical pressure of every point of a series at one friction coefficient.

    Parameters
    ----------
    points : sequence of Point
        Measured critical pressures.
    friction : float
        Friction coefficient μ_f, 0 to 2.
    setting : SeriesSetting
        Material, confinement, model and numerics.
    solver : CaseSolver
        Solves the cases.
    """
    cases = [setting.case(point, friction) for point in points]
    return SeriesComparison(friction, tuple(points), tuple(solver.answers(cases)))


@array_dataclass
@dataclass(frozen=True)
class SizeCurve:
    """Critical pressure as a function of the size ratio for one tube under one load.

    Attributes
    ----------
    wall_ratio : float
        Wall ratio η of the tube.
    confining_pressure : float
        Confining pressure P_out in Pa.
    size_ratio : array (n)
        Size ratios ξ, rising.
    pressure : array (n)
        Critical pressure P_ucr in Pa at each size ratio; NaN if the model has no answer.
    """

    wall_ratio: float
    confining_pressure: float
    size_ratio: Float[np.ndarray, " n"]
    pressure: Float[np.ndarray, " n"]


def size_curves(
    comparison: SeriesComparison, setting: SeriesSetting, solver: CaseSolver
) -> list[SizeCurve]:
    """Compute a curve of the model for each tube and load that was measured at several sizes.

    Parameters
    ----------
    comparison : SeriesComparison
        It gives the tubes, the loads, the range of sizes and the friction coefficient.
    setting : SeriesSetting
        Material, confinement, model and numerics.
    solver : CaseSolver
        Solves the cases, without error estimates.
    """
    grids = {}
    for tube, some in _by_tube(comparison.points, comparison.points).items():
        sizes = [point.size_ratio for point in some]
        if max(sizes) > min(sizes):
            grid = np.round(np.linspace(min(sizes), max(sizes), SIZES), 10)
            grids[tube] = [replace(some[0], size_ratio=float(xi)) for xi in grid]
    cases = {
        tube: [setting.case(point, comparison.friction) for point in some]
        for tube, some in grids.items()
    }
    flat = [case for some in cases.values() for case in some]
    known = dict(zip(flat, solver.answers(flat, error=False), strict=True))
    return [
        SizeCurve(
            *tube,
            np.array([case.size_ratio for case in some]),
            np.array(
                [np.nan if known[case].pressure is None else known[case].pressure for case in some]
            ),
        )
        for tube, some in cases.items()
    ]


def point_curves(comparison: SeriesComparison) -> list[SizeCurve]:
    """Return the model's pressures at the measured sizes as curves; nothing is solved.

    There is a curve for each tube and load for which the model predicts at least two pressures.

    Parameters
    ----------
    comparison : SeriesComparison
    """
    curves = []
    for tube, some in _by_tube(comparison.points, comparison.answers).items():
        known = {each.case.size_ratio: each.pressure for each in some if _moves(each)}
        if len(known) > 1:
            sizes = np.array(sorted(known))
            curves.append(SizeCurve(*tube, sizes, np.array([known[size] for size in sizes])))
    return curves


def _by_tube(points: Sequence[Point], values: Sequence[T]) -> dict[tuple[float, float], list[T]]:
    """Return values, one for each point, grouped by wall ratio and confining pressure."""
    found: dict[tuple[float, float], list[T]] = {}
    for point, value in zip(points, values, strict=True):
        found.setdefault((point.wall_ratio, point.confining_pressure), []).append(value)
    return found
