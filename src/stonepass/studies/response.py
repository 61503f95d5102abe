"""Response surface: the critical pressure as an interpolant through some solved cases.

The interpolated quantity is ln(P_ucr/(μ P_s)), where P_s is the pressure that opens the tube to the
width of the stone. It varies little, because P_ucr and P_s both vanish for a stone of the size of
the lumen, and P_ucr is proportional to μ for small μ. The interpolant is a cubic radial-basis
function of √(ξ/ξ_lumen − 1), ln(η − 1), √μ and the factor on the load (docs/assess.md, "What is
done").
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
from stonepass.model.load import CONFINING
from stonepass.model.numerics import Numerics
from stonepass.studies.case_solver import CaseSolver
from stonepass.studies.conditions import Conditions, case_at, lumen_ratios, transmural

__all__ = ["OVERSIZE", "ResponseSurface", "response_surface"]

OVERSIZE = (0.005, 0.8)  # smallest and largest solved oversize ξ/ξ_lumen − 1
SMALLEST_FRICTION = 0.01  # smallest solved friction coefficient
SEED = 7  # seed of the scattered points
# Number of scattered points, in addition to corners and centres of faces, by dimension.
SCATTERED = {1: 8, 2: 16, 3: 32, 4: 64}
# Quantiles of wall ratio, friction and load factor between which the surface is built.
TAILS = (0.002, 0.998)
NARROW = 1e-9  # width below which a range counts as a single value
FEWEST = 10  # smallest number of solved cases with an answer
# The surface cannot decide on which side of the end of the closure a pressure lies if the relative
# difference of both is smaller than this.
NEAR_END = 0.02
HALF_LENGTHS = 2.5  # half length of the tube, in radii of the largest stone


@array_dataclass
@dataclass(frozen=True)
class ResponseSurface:
    """The solved cases of a response surface, and the interpolant through them.

    Attributes
    ----------
    case : Case
        Material, load, model and shape of all cases.
    solved : Conditions
        Size, wall, friction and load factor of the n cases with an answer.
    pressure : array (n)
        P_ucr of these cases in Pa, or the pressure at the end of the closure if P_ucr lies beyond.
    ended : array (n) of bool
        True for a case in which the closure ended before the stone moved.
    lost : Conditions
        The cases without an answer.
    reason : str
        The most frequent reason why a case has no answer; empty if all have one.

    References
    ----------
    docs/assess.md, "What is done".
    """

    case: Case
    solved: Conditions
    pressure: Float[np.ndarray, " n"]
    ended: Bool[np.ndarray, " n"]
    lost: Conditions
    reason: str

    @property
    def tried(self) -> int:
        """Number of cases with and without an answer."""
        return len(self.pressure) + len(self.lost.friction)

    @property
    def usable(self) -> bool:
        """True if enough cases have an answer for an interpolant."""
        return len(self.pressure) >= FEWEST

    @property
    def error(self) -> float:
        """95th percentile of the relative errors of `errors`."""
        return float(np.quantile(self.errors, 0.95))

    def __call__(self, asked: Conditions) -> tuple[Float[np.ndarray, " n"], Bool[np.ndarray, " n"]]:
        """Return P_ucr in Pa for n conditions; some values are only lower bounds (*censored*).

        A value is censored if the stone is larger than the largest solved one, or if the paper's
        closure ends before the stone moves. If the load closes the lumen, or if the nearest case
        has no answer, the value is censored and the lower bound is 0. P_ucr is 0, and not censored,
        for a stone that is no larger than the lumen.

        Parameters
        ----------
        asked : Conditions
            Size ratio, wall ratio, friction and load factor of the n conditions.

        Returns
        -------
        pressure : array (n)
            P_ucr or its lower bound in Pa.
        censored : array (n) of bool
            True for a value that is only a lower bound.
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
        # Below the smallest solved size P_ucr is proportional to the oversize.
        found *= np.minimum(held / OVERSIZE[0], 1.0)
        censored = over > top
        if self.ended.any():
            end = self._closure_end(at)
            censored |= found >= (1.0 - NEAR_END) * end
            found = np.minimum(found, end)
        unknown = closed | ((over > 0.0) & self._lost(near))
        stuck = (over > 0.0) & ~unknown
        return np.where(stuck, found, 0.0), (censored & stuck) | unknown

    @cached_property
    def errors(self) -> Float[np.ndarray, " n"]:
        """Relative error at each solved case of the interpolant through all others, an array (n).

        This is the leave-one-out cross-validation error.
        """
        coordinates, values = self._coordinates(self.solved), self._values
        off = np.empty(len(values))
        for k in range(len(values)):
            others = np.arange(len(values)) != k
            off[k] = _interpolant(coordinates[others], values[others])(coordinates[k : k + 1])[0]
        return np.abs(np.expm1(off - values))

    def _lost(self, near: Float[np.ndarray, "n d"]) -> Bool[np.ndarray, " n"]:
        """Return whether the nearest case has no answer."""
        if len(self.lost.friction) == 0:
            return np.zeros(len(near), dtype=bool)
        with_answer, _ = KDTree(self._coordinates(self.solved)).query(near)
        without, _ = KDTree(self._coordinates(self.lost)).query(near)
        return without < with_answer

    @cached_property
    def _top(self) -> float:
        """The largest solved oversize ξ/ξ_lumen − 1."""
        lumen = lumen_ratios(self.case, self.solved.wall_ratio, self.solved.load_factor)
        return float((self.solved.size_ratio / lumen - 1.0).max())

    @cached_property
    def _values(self) -> Float[np.ndarray, " n"]:
        return np.log(self.pressure / (self.solved.friction * self._scale(self.solved)))

    def _scale(self, at: Conditions) -> Float[np.ndarray, " n"]:
        """Return the pressure P_s that opens the tube to the width of the stone.

        It includes the ground matrix, like the lumen, so that it vanishes at the size of the lumen.
        """
        law, load = self.case.ureter.material.law, self.case.load
        across = np.asarray(inflation(at.size_ratio, at.wall_ratio, law, load.prestretch))
        return across + self._outside(at)

    def _closure_end(self, at: Conditions) -> Float[np.ndarray, " n"]:
        """Return the pressure at the end of the paper's closure, by the far field of the model."""
        return transmural(self.case, at.size_ratio, at.wall_ratio) + self._outside(at)

    def _outside(self, at: Conditions) -> Float[np.ndarray, " n"]:
        traction = confining_traction(at.size_ratio, at.wall_ratio, self.case.load)
        return at.load_factor * np.asarray(traction)

    @cached_property
    def _interpolant(self) -> RBFInterpolator:
        return _interpolant(self._coordinates(self.solved), self._values)

    def _coordinates(self, at: Conditions) -> Float[np.ndarray, "n d"]:
        """Return the varying coordinates, scaled to 0–1 over the solved range and clipped to it."""
        low, high = self._range
        varying = high - low > NARROW
        scaled = (_raw(self.case, at) - low)[:, varying] / (high - low)[varying]
        return np.clip(np.nan_to_num(scaled), 0.0, 1.0)  # coordinates of a closed lumen are NaN

    @cached_property
    def _range(self) -> tuple[Float[np.ndarray, " d"], Float[np.ndarray, " d"]]:
        raw = _raw(self.case, self.solved)
        return raw.min(axis=0), raw.max(axis=0)


def response_surface(case: Case, over: Conditions, solver: CaseSolver) -> ResponseSurface:
    """Solve cases that span the given conditions, and return the response surface through them.

    Parameters
    ----------
    case : Case
        Material, load, model and shape of all cases.
    over : Conditions
        Walls, frictions and load factors that the surface shall cover. Their sizes are ignored: the
        surface covers stones up to 1.8 times as wide as the lumen.
    solver : CaseSolver
        Solves about fifty cases, without error estimates.

    Raises
    ------
    BadInput
        The model does not use finite elements.

    References
    ----------
    docs/assess.md, "What is done".
    """
    if not case.model.NEEDS_ELEMENTS:
        raise BadInput("model", case.model.NAME, "a model with finite elements: 'paper' or 'direct'"
                       )  # fmt: skip
    longest = HALF_LENGTHS * (1.0 + OVERSIZE[1]) * max(1.0, case.stone.shape.reach)
    half_length = max(case.numerics.half_length, longest)
    quick = replace(case, numerics=Numerics("fast", half_length))
    design = _design(case, over)
    cases = [case_at(quick, design, k) for k in range(len(design.friction))]
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
    """Return corners, centres of faces and scattered points of the box that contains `over`."""
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
