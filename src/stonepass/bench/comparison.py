"""A measured series beside the model: bias, scatter, and how much of the spread it explains."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

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

__all__ = ["Comparison", "Setting", "SizeCurve", "compare", "size_curves"]

SIZES = 9  # of a curve


@dataclass(frozen=True)
class Setting:
    """What every stone and tube of a series shares.

    Attributes
    ----------
    material : Material
    confinement : {"hydrostatic", "dead"}
        Of the confining pressures (`model.case.Load`); a water bath is hydrostatic.
    model : Model
    numerics : Numerics
    """

    material: Material
    confinement: str = "hydrostatic"
    model: Model = field(default_factory=SeatedBalance)
    numerics: Numerics = field(default_factory=Numerics)

    def case(self, point: Point, friction: float, load_factor: float = 1.0) -> Case:
        """The case of a point; its confining pressure times `load_factor`."""
        pressure = type(point.confining_pressure)(load_factor * point.confining_pressure)
        load = Load(pressure, self.confinement if pressure > 0.0 else "dead")
        ureter = Ureter(wall_ratio=point.wall_ratio, material=self.material)
        stone = Stone(None, friction, point.size_ratio)
        return Case(stone, ureter, load, self.model, self.numerics)


@dataclass(frozen=True)
class Comparison:
    """Points and the model's answers at one friction coefficient.

    Attributes
    ----------
    friction : float
    points : tuple of Point
    answers : tuple of Answer
    """

    friction: float
    points: tuple[Point, ...]
    answers: tuple[Answer, ...]

    @property
    def measured(self) -> Float[np.ndarray, " n"]:
        """Measured pressures in Pa of the points whose stone is held and has an answer."""
        pairs = zip(self.points, self.answers, strict=True)
        return np.array([point.pressure for point, answer in pairs if _moves(answer)])

    @property
    def predicted(self) -> Float[np.ndarray, " n"]:
        """The model's in Pa, of the same."""
        return np.array([each.pressure for each in self.answers if _moves(each)])

    @property
    def compared(self) -> int:
        """How many points that is."""
        return len(self.predicted)

    @property
    def bias(self) -> float | None:
        """Mean of model less measured in Pa; None where no point has an answer."""
        return float(np.mean(self.predicted - self.measured)) if self.compared else None

    @property
    def rmse(self) -> float | None:
        """Root mean square of model less measured in Pa."""
        if not self.compared:
            return None
        return float(np.sqrt(np.mean((self.predicted - self.measured) ** 2)))

    @property
    def r_squared(self) -> float | None:
        """1 − Σ (model − measured)²/Σ (measured − mean)²; None for points of one pressure."""
        spread = float(np.sum((self.measured - self.measured.mean()) ** 2)) if self.compared else 0
        if spread == 0.0:
            return None
        return 1.0 - float(np.sum((self.predicted - self.measured) ** 2)) / spread

    @property
    def not_compared(self) -> dict[str, int]:
        """How many points are left out, by outcome: loose stones, and those without an answer."""
        names = [each.outcome.name for each in self.answers if not _moves(each)]
        return {name: names.count(name) for name in dict.fromkeys(names)}


def _moves(answer: Answer) -> bool:
    return answer.outcome is Outcome.MOVES and answer.pressure is not None


def compare(
    points: Sequence[Point], friction: float, setting: Setting, solver: CaseSolver
) -> Comparison:
    """Answer every point of a series at one friction coefficient."""
    cases = [setting.case(point, friction) for point in points]
    return Comparison(friction, tuple(points), tuple(solver.answers(cases)))


@array_dataclass
@dataclass(frozen=True)
class SizeCurve:
    """P_ucr in Pa over size ratio in one tube under one load; NaN where there is no answer."""

    wall_ratio: float
    confining_pressure: float
    size_ratio: Float[np.ndarray, " n"]
    pressure: Float[np.ndarray, " n"]


def size_curves(comparison: Comparison, setting: Setting, solver: CaseSolver) -> list[SizeCurve]:
    """Curves of the model through each tube and load of a series that has several sizes."""
    tubes: dict[tuple[float, float], list[Point]] = {}
    for point in comparison.points:
        tubes.setdefault((point.wall_ratio, point.confining_pressure), []).append(point)
    grids = {}
    for tube, some in tubes.items():
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
