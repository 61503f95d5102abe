"""Critical pressure as a smooth function of sizes, wall, friction and load, from some solves.

ln(P_ucr/(μ P_s)) varies little: P_s is the pressure that holds a tube as wide as the stone, which
vanishes at the lumen as P_ucr does, and near μ = 0 P_ucr grows with μ. Between the solves it is a
cubic radial-basis interpolant over √(ξ/ξ_lumen − 1), ln(η − 1), √μ and the load.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product

import numpy as np
from scipy.interpolate import RBFInterpolator
from scipy.spatial import KDTree
from scipy.stats import qmc

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Bool, Float
from stonepass.errors import BadInput, Outcome
from stonepass.model.answer import Answer
from stonepass.model.case import Case
from stonepass.model.far_field import confining_traction, inflation
from stonepass.model.load import CONFINING, Load
from stonepass.model.numerics import Numerics
from stonepass.model.stone import Stone
from stonepass.model.ureter import Ureter
from stonepass.studies.case_solver import CaseSolver
from stonepass.studies.conditions import Conditions, lumen_ratios, transmural
from stonepass.units import Pressure

__all__ = ["OVERSIZE", "ResponseSurface", "response_surface"]

OVERSIZE = (0.005, 0.8)  # of the lumen, over which the surface is built
SMALLEST_FRICTION = 0.01
SEED = 7  # of the design
SCATTERED = {1: 8, 2: 16, 3: 32, 4: 64}  # points beside corners and centres of faces, by dimension
TAILS = (0.002, 0.998)  # of walls, frictions and loads, between which the surface is built
NARROW = 1e-9  # a range that counts as one value
FEWEST = 10  # solves with an answer
NEAR_END = 0.02  # of the closure's end, within which P_ucr may as well lie beyond it
HALF_LENGTHS = 2.5  # half the tube's length, in radii of the largest stone


@array_dataclass
@dataclass(frozen=True)
class ResponseSurface:
    """What was solved, and the interpolant through it.

    Attributes
    ----------
    case : Case
        Material, load, method and shape of all of it.
    solved : Conditions
    pressure : array (n)
        P_ucr in Pa of what was solved; where the closure ended first, its end.
    ended : array (n)
        Where it did.
    lost : Conditions
        What was tried and has no answer.
    reason : str
        What most of those say; empty where there are none.
    """

    case: Case
    solved: Conditions
    pressure: Float[np.ndarray, " n"]
    ended: Bool[np.ndarray, " n"]
    lost: Conditions
    reason: str

    @property
    def tried(self) -> int:
        """How many cases were solved, those without an answer included."""
        return len(self.pressure) + len(self.lost.friction)

    @property
    def usable(self) -> bool:
        """Whether enough of them have an answer for a surface."""
        return len(self.pressure) >= FEWEST

    def __call__(self, asked: Conditions) -> tuple[Float[np.ndarray, " n"], Bool[np.ndarray, " n"]]:
        """Return P_ucr in Pa, and where it is censored: where that is only a lower bound.

        P_ucr is 0 for a stone that is no larger than the lumen. Above the sizes that were solved,
        and where the paper's closure ends first, P_ucr is at least what is returned; where the load
        closes the lumen, or the nearest case that was tried has no answer, no more than 0 is known.
        """
        lumen = lumen_ratios(self.case, asked.wall_ratio, asked.load_factor)
        closed = ~np.isfinite(lumen)
        lumen = np.where(closed, 1.0, lumen)
        over = asked.size_ratio / lumen - 1.0
        top = self._top
        held = np.clip(over, 0.0, top)
        at = replace(asked, size_ratio=lumen * (1.0 + np.clip(held, OVERSIZE[0], None)))
        friction = np.maximum(asked.friction, SMALLEST_FRICTION)
        near = self._coordinates(replace(at, friction=friction))
        found = np.exp(self._interpolant(near)) * asked.friction * self._scale(at)
        # Below the smallest size that was solved it falls in proportion to the oversize.
        found *= np.minimum(held / OVERSIZE[0], 1.0)
        censored = over > top
        if self.ended.any():  # near the closure's end the surface cannot say on which side it is
            end = self._closure_end(at)
            censored |= found >= (1.0 - NEAR_END) * end
            found = np.minimum(found, end)
        unknown = closed | ((over > 0.0) & self._lost(near))
        stuck = (over > 0.0) & ~unknown
        return np.where(stuck, found, 0.0), (censored & stuck) | unknown

    @cached_property
    def errors(self) -> Float[np.ndarray, " n"]:
        """Relative error at each solved case of the surface through all others."""
        coordinates, values = self._coordinates(self.solved), self._values
        off = np.empty(len(values))
        for k in range(len(values)):
            others = np.arange(len(values)) != k
            off[k] = _interpolant(coordinates[others], values[others])(coordinates[k : k + 1])[0]
        return np.abs(np.expm1(off - values))

    def _lost(self, near: Float[np.ndarray, "n d"]) -> Bool[np.ndarray, " n"]:
        """Where the nearest case that was tried has no answer."""
        if len(self.lost.friction) == 0:
            return np.zeros(len(near), dtype=bool)
        with_answer, _ = KDTree(self._coordinates(self.solved)).query(near)
        without, _ = KDTree(self._coordinates(self.lost)).query(near)
        return without < with_answer

    @cached_property
    def _top(self) -> float:
        """The largest oversize of the lumen that was solved."""
        lumen = lumen_ratios(self.case, self.solved.wall_ratio, self.solved.load_factor)
        return float((self.solved.size_ratio / lumen - 1.0).max())

    @cached_property
    def _values(self) -> Float[np.ndarray, " n"]:
        return np.log(self.pressure / (self.solved.friction * self._scale(self.solved)))

    def _scale(self, at: Conditions) -> Float[np.ndarray, " n"]:
        """Pressure that holds a tube as wide as the stone, by the whole law as the lumen is."""
        law, load = self.case.ureter.material.law, self.case.load
        across = np.asarray(inflation(at.size_ratio, at.wall_ratio, law, load.prestretch))
        return across + self._outside(at)

    def _closure_end(self, at: Conditions) -> Float[np.ndarray, " n"]:
        """The same by the far field of the method, where the paper's closure ends."""
        return transmural(self.case, at.size_ratio, at.wall_ratio) + self._outside(at)

    def _outside(self, at: Conditions) -> Float[np.ndarray, " n"]:
        traction = confining_traction(at.size_ratio, at.wall_ratio, self.case.load)
        return at.load_factor * np.asarray(traction)

    @cached_property
    def _interpolant(self) -> RBFInterpolator:
        return _interpolant(self._coordinates(self.solved), self._values)

    def _coordinates(self, at: Conditions) -> Float[np.ndarray, "n d"]:
        """In units of the solved range and held to it; what does not vary is left out."""
        low, high = self._range
        varying = high - low > NARROW
        scaled = (_raw(self.case, at) - low)[:, varying] / (high - low)[varying]
        return np.clip(np.nan_to_num(scaled), 0.0, 1.0)  # a closed lumen has no place here

    @cached_property
    def _range(self) -> tuple[Float[np.ndarray, " d"], Float[np.ndarray, " d"]]:
        raw = _raw(self.case, self.solved)
        return raw.min(axis=0), raw.max(axis=0)


def response_surface(case: Case, over: Conditions, solver: CaseSolver) -> ResponseSurface:
    """Solve enough of the cases that `over` spans for a surface over all of them.

    Sizes are taken from the lumen up to `OVERSIZE` beyond it, whatever `over` has of them.
    """
    if not case.model.NEEDS_ELEMENTS:
        raise BadInput("model", case.model.NAME, "one of finite elements, such as paper or direct")
    longest = HALF_LENGTHS * (1.0 + OVERSIZE[1]) * max(1.0, case.stone.shape.reach)
    half_length = max(case.numerics.half_length, longest)
    quick = replace(case, numerics=Numerics("fast", half_length))
    design = _design(case, over)
    cases = [_case(quick, design, k) for k in range(len(design.friction))]
    answers = solver.answers(cases, error=False)
    pressures = np.array([_pressure(answer) for answer in answers])
    known = np.isfinite(pressures) & (pressures > 0.0)
    reasons = Counter(
        a.reason or a.outcome.value for a, k in zip(answers, known, strict=True) if not k
    )
    return ResponseSurface(
        case,
        design.where(known),
        pressures[known],
        np.array([answer.outcome is Outcome.BEYOND_CLOSURE for answer in answers])[known],
        design.where(~known),
        reasons.most_common(1)[0][0] if reasons else "",
    )


def _pressure(answer: Answer) -> float:
    if answer.outcome is Outcome.BEYOND_CLOSURE and answer.closure_end_pressure is not None:
        return answer.closure_end_pressure
    return np.nan if answer.pressure is None else answer.pressure


def _case(case: Case, at: Conditions, k: int) -> Case:
    load = Load(
        Pressure(at.load_factor[k] * case.load.confining_pressure),
        case.load.confinement,
        case.load.prestretch,
    )
    stone = Stone(None, float(at.friction[k]), float(at.size_ratio[k]), shape=case.stone.shape)
    ureter = Ureter(material=case.ureter.material, wall_ratio=float(at.wall_ratio[k]))
    return Case(stone, ureter, load, case.model, case.numerics)


def _raw(case: Case, at: Conditions) -> Float[np.ndarray, "n 4"]:
    lumen = lumen_ratios(case, at.wall_ratio, at.load_factor)
    over = np.clip(at.size_ratio / lumen - 1.0, 0.0, None)
    return np.stack(
        [
            np.sqrt(over),
            np.log(at.wall_ratio - 1.0),
            np.sqrt(at.friction),
            at.load_factor if case.load.confining_pressure > 0.0 else 0.0 * at.load_factor,
        ],
        axis=1,
    )


def _design(case: Case, over: Conditions) -> Conditions:
    """Corners, centres of faces and scattered points of the box round `over`."""
    friction = np.maximum(over.friction, SMALLEST_FRICTION)
    factor = np.ones(1)
    if case.load.confining_pressure > 0.0:
        factor = np.minimum(over.load_factor, CONFINING[1] / case.load.confining_pressure)
    spans = [
        np.sqrt(np.array(OVERSIZE)),
        _span(np.log(over.wall_ratio - 1.0)),
        _span(np.sqrt(friction)),
        _span(factor),
    ]
    varying = [k for k, span in enumerate(spans) if span[1] - span[0] > NARROW]
    unit = _unit_points(len(varying))
    points = np.array([np.full(len(unit), span[0]) for span in spans]).T
    for column, k in enumerate(varying):
        points[:, k] = spans[k][0] + unit[:, column] * (spans[k][1] - spans[k][0])
    wall = 1.0 + np.exp(points[:, 1])
    lumen = lumen_ratios(case, wall, points[:, 3])
    size = lumen * (1.0 + points[:, 0] ** 2)
    return Conditions(size, wall, points[:, 2] ** 2, points[:, 3]).where(np.isfinite(lumen))


def _span(values: Float[np.ndarray, " n"]) -> Float[np.ndarray, "2"]:
    return np.quantile(values, TAILS)


def _unit_points(dimensions: int) -> Float[np.ndarray, "n d"]:
    corners = np.array(list(product((0.0, 1.0), repeat=dimensions)))
    centres = np.full((2 * dimensions, dimensions), 0.5)
    for k in range(dimensions):
        centres[2 * k, k], centres[2 * k + 1, k] = 0.0, 1.0
    engine = qmc.Sobol(dimensions, seed=SEED)
    scattered = engine.random(SCATTERED[dimensions])
    return np.unique(np.concatenate([corners, centres, scattered]), axis=0)


def _interpolant(
    coordinates: Float[np.ndarray, "n d"], values: Float[np.ndarray, " n"]
) -> RBFInterpolator:
    return RBFInterpolator(coordinates, values, kernel="cubic", degree=1)
