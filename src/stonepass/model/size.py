"""The critical size: the largest stone whose critical pressure stays within a limit."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING

from scipy.optimize import brentq

from stonepass.errors import Outcome, require
from stonepass.model.accuracy import LEVELS
from stonepass.model.answer import Answer
from stonepass.model.case import Case, Load, Method, Stone, Ureter
from stonepass.model.critical import solve
from stonepass.model.far_field import lumen_ratio
from stonepass.model.models.elastic_foundation import largest_beam_size
from stonepass.model.shape import Shape
from stonepass.model.states.state_solver import StateSolver
from stonepass.units import Length, Pressure, pressure

if TYPE_CHECKING:  # loads the finite elements
    from stonepass.fe.axisymmetric.problem import Resolution

__all__ = ["SizeAnswer", "critical_size"]

TOLERANCE = 1e-6  # of ξ, and of the limit: P_ucr grows at several limits per unit of ξ
FIRST_TOLERANCE = 1e-4  # on the coarser mesh, whose root is only where to begin
SLOPE_BASE = 1e-4  # sizes nearer than this say too little of the slope
CLOSE = 1e-3  # to the root, by the step there: probably the last one
SECANTS = 5  # steps from the root of a coarser mesh
FARTHEST = 0.03  # of such a step
# Stones less than this fraction above the lumen are not told from the lumen itself.
SMALLEST_OVERSIZE = 2e-4
SMALL_LIMIT = 100.0  # Pa; only below it can a limit lie under every stuck stone
SMALLER = (0.75, 0.5, 0.35, 0.25)  # of the largest oversize
LARGER = 3  # sizes tried between one that moves below the limit and one without an answer
LIMIT = (1.0, 1e6)


@dataclass(frozen=True)
class SizeAnswer:
    """The critical size at a pressure limit, or why there is none.

    Attributes
    ----------
    outcome : Outcome
        MOVES where a size was found.
    size_ratio : float or None
        ξ_cr, critical stone size over inner diameter.
    diameter : Length or None
        Critical stone diameter in m, where the ureter has lengths.
    limit : Pressure
        The pressure limit in Pa.
    at_size : Answer or None
        The answer at the critical size; without one, at the size where the search ended.
    size_ratio_error : float or None
        Estimated discretisation error of ξ_cr: that of P_ucr over its slope dP_ucr/dξ.
    """

    case: Case
    outcome: Outcome
    message: str
    limit: Pressure
    size_ratio: float | None = None
    diameter: Length | None = None
    at_size: Answer | None = None
    size_ratio_error: float | None = None
    warnings: tuple[str, ...] = ()


def critical_size(
    ureter: Ureter,
    limit: str | Pressure,
    friction: float = 0.5,
    load: Load | None = None,
    method: Method | None = None,
    progress: Callable[[float], None] | None = None,
    shape: Shape | None = None,
    states: StateSolver | None = None,
) -> SizeAnswer:
    """How large may a stone be that moves at `limit`?

    P_ucr rises with ξ from 0 at the lumen, so ξ_cr is bracketed by the lumen and the end of the
    material's strain range (of the beam model, of what it holds for) and found to 1e-6. `progress`
    is told every ξ that is tried.

    Parameters
    ----------
    limit : str or Pressure
        Bearable urine pressure, e.g. ``"12 kPa"``; 0.001 to 1000 kPa.
    shape : Shape, optional
        Of the stone; a sphere by default, ``Shape(1.4)`` a spheroid 1.4 times as long as wide.
    states : StateSolver, optional
        Where finite-element results come from (`studies.solution_cache`); by default they are
        solved.
    """
    bound = pressure(limit, "limit")
    require(LIMIT[0] <= bound <= LIMIT[1], "limit", limit, "0.001 kPa to 1000 kPa")
    high = ureter.material.strain_range[1]
    case = Case(
        Stone(size_ratio=high, friction=friction, shape=shape),
        ureter,
        load or Load(),
        method or Method(),
    )
    if case.method.model == "beam":
        case = case.with_size_ratio(largest_beam_size(case))
    return _search(case, bound, progress or (lambda size_ratio: None), states)


def _search(
    case: Case,
    limit: Pressure,
    progress: Callable[[float], None],
    states: StateSolver | None,
) -> SizeAnswer:
    level = LEVELS[case.method.accuracy]
    search = _Search(case, limit, level.resolution, progress, states)
    try:
        if search.lumen is None:  # then solve() says why, and so do we
            search.excess(case.size_ratio)
        coarse = replace(
            search, resolution=level.companion, tolerance=FIRST_TOLERANCE, tried={}, whole={}
        )
        found = search.near(coarse) or search.bracketed()
    except _Unanswered as stop:
        answer = stop.answer
        where = f" (at size ratio {answer.case.size_ratio:.4g})"
        return SizeAnswer(
            case, answer.outcome, answer.message[:-1] + where + ".", limit, at_size=answer
        )
    except _BeyondRange as stop:
        return _beyond_range(case, limit, stop.answer)
    return _below_range(case, limit) if found is None else _found(search, found)


@dataclass(frozen=True)
class _Root:
    """A size whose P_ucr is the limit, and dP_ucr/dξ there in Pa, where two sizes tell it."""

    size_ratio: float
    slope: float | None


@dataclass(frozen=True)
class _Search:
    """Looks for the size whose P_ucr is the limit, on one mesh; `tried` has what was solved.

    The search needs no estimate of the error. Close to the root the whole answer, which has one, is
    solved in its place (`whole`).
    """

    case: Case
    limit: Pressure
    resolution: Resolution
    progress: Callable[[float], None]
    states: StateSolver | None
    tolerance: float = TOLERANCE
    tried: dict[float, Answer] = field(default_factory=dict)
    whole: dict[float, Answer] = field(default_factory=dict)

    @cached_property
    def lumen(self) -> float | None:
        """Size ratio of a stone as large as the loaded lumen."""
        case = self.case
        return lumen_ratio(case.wall_ratio, case.ureter.material.law, case.load)

    def answer(self, size_ratio: float) -> Answer:
        """The answer of a size on this mesh, solved once."""
        self.progress(size_ratio)
        if size_ratio not in self.tried:
            question = self.case.with_size_ratio(size_ratio)
            self.tried[size_ratio] = solve(question, self.resolution, self.states)
        return self.tried[size_ratio]

    def whole_answer(self, size_ratio: float) -> Answer:
        """The answer of a size with the estimate of its error, solved once."""
        if size_ratio not in self.whole:
            self.progress(size_ratio)
            question = self.case.with_size_ratio(size_ratio)
            self.whole[size_ratio] = solve(question, states=self.states)
        return self.whole[size_ratio]

    def excess(self, size_ratio: float) -> float:
        """P_ucr less the limit in Pa; without a balance the end of the closure stands in."""
        answer = self.answer(size_ratio)
        if answer.pressure is not None:
            return answer.pressure - self.limit
        end = answer.closure_end_pressure
        if end is not None and end >= self.limit:
            return end - self.limit  # no balance below the closure's end: P_ucr is above the limit
        raise _Unanswered(answer)

    def bracketed(self) -> _Root | None:
        """The root between the lumen and the largest size; None where it lies below every size."""
        lumen, limit = self.lumen, self.limit
        assert lumen is not None
        high, top = _top(self.case.size_ratio, lumen, self.excess)
        if top < 0.0:
            raise _BeyondRange(self.tried[high])
        smallest = lumen * (1.0 + SMALLEST_OVERSIZE)
        if limit < SMALL_LIMIT and self.excess(smallest) > 0.0:
            return None
        known = {lumen: -float(limit), high: top}

        def excess(size_ratio: float) -> float:
            if size_ratio in known:
                return known[size_ratio]
            if size_ratio < smallest:  # P_ucr vanishes at the lumen: a straight line from there
                share = (size_ratio - lumen) / (smallest - lumen)
                return share * (self.excess(smallest) + limit) - limit
            missed = self.excess(size_ratio)
            return 0.0 if abs(missed) < self.tolerance * limit else missed

        root = float(brentq(excess, lumen, high, xtol=self.tolerance))
        return _Root(root, self._slope(root))

    def near(self, coarse: _Search) -> _Root | None:
        """The root by secants from that on a coarser mesh; None where they do not lead to one."""
        if self.case.method.model == "beam":
            return None  # which has no mesh
        try:
            first = coarse.bracketed()
        except (_Unanswered, _BeyondRange):
            return None
        if first is None or first.slope is None or self.lumen is None:
            return None
        last, slope, before = first.size_ratio, first.slope, self.answer(first.size_ratio).pressure
        for _ in range(SECANTS):
            if before is None or not abs(before - self.limit) < slope * FARTHEST:
                return None
            size_ratio = last - (before - self.limit) / slope
            if not self.lumen * (1.0 + SMALLEST_OVERSIZE) < size_ratio <= self.case.size_ratio:
                return None  # bracketed() says on which side of the range it lies
            step = abs(size_ratio - last)
            solved = self.whole_answer if step < CLOSE else self.answer
            pressure = solved(size_ratio).pressure
            if pressure is None:
                return None
            if step > SLOPE_BASE:
                slope = (pressure - before) / (size_ratio - last)
            if abs(pressure - self.limit) < self.tolerance * max(self.limit, slope):
                return _Root(size_ratio, slope)
            last, before = size_ratio, pressure
        return None

    def _slope(self, size_ratio: float) -> float | None:
        """dP_ucr/dξ in Pa, by the nearest size that is not too near."""
        known = {x: a.pressure for x, a in self.tried.items() if a.pressure is not None}
        for x in sorted(known, key=lambda x: abs(x - size_ratio)):
            if abs(x - size_ratio) > SLOPE_BASE and size_ratio in known:
                return (known[x] - known[size_ratio]) / (x - size_ratio)
        return None


def _found(search: _Search, found: _Root) -> SizeAnswer:
    case, limit, root = search.case, search.limit, found.size_ratio
    assert search.lumen is not None
    if root <= search.lumen * (1.0 + SMALLEST_OVERSIZE):
        return _below_range(case, limit)
    at_size = search.whole_answer(root)
    if at_size.outcome is not Outcome.MOVES:
        message = f"{at_size.message[:-1]} (at size ratio {root:.4g}, where the limit is reached)."
        return SizeAnswer(case, at_size.outcome, message, limit, at_size=at_size)
    inner = case.ureter.inner_diameter
    return SizeAnswer(
        case=case,
        outcome=Outcome.MOVES,
        message=f"A stone of {root:.4g} times the inner diameter moves at the pressure limit.",
        limit=limit,
        size_ratio=root,
        diameter=None if inner is None else Length(root * inner),
        at_size=at_size,
        size_ratio_error=_size_ratio_error(at_size, found.slope),
        warnings=at_size.warnings,
    )


def _size_ratio_error(at_size: Answer, slope: float | None) -> float | None:
    """The error of P_ucr over its slope."""
    if at_size.error is None or at_size.error.critical_pressure is None or slope is None:
        return None
    return abs(at_size.error.critical_pressure / slope) + TOLERANCE


def _top(largest: float, lumen: float, excess: Callable[[float], float]) -> tuple[float, float]:
    """The largest size that has an answer, and its excess over the limit.

    Where the largest of all has none, smaller ones are tried, then larger ones up to what has none;
    they serve as the upper end if their pressure is above the limit.
    """
    try:
        return largest, excess(largest)
    except _Unanswered as stop:
        unanswered = stop
    answered, lost, shares = 0.0, 1.0, [*SMALLER]
    for _ in range(len(SMALLER) + LARGER):
        share = shares.pop(0) if shares else (answered + lost) / 2.0
        size_ratio = lumen + share * (largest - lumen)
        try:
            top = excess(size_ratio)
        except _Unanswered:
            lost = share
            continue
        if top >= 0.0:
            return size_ratio, top
        answered, shares = share, []
    raise unanswered


def _below_range(case: Case, limit: Pressure) -> SizeAnswer:
    message = (
        f"{Outcome.BELOW_RANGE.value[:-1]}, {limit / 1e3:.4g} kPa, "
        f"if it is more than {SMALLEST_OVERSIZE:.2%} larger than the lumen."
    )
    return SizeAnswer(case, Outcome.BELOW_RANGE, message, limit)


def _beyond_range(case: Case, limit: Pressure, top: Answer) -> SizeAnswer:
    assert top.pressure is not None
    if case.stone.friction == 0.0:
        message = (
            "Without friction nothing holds the stone: every size moves, and none is critical."
        )
        return SizeAnswer(case, Outcome.BEYOND_RANGE, message, limit, at_size=top)
    within = Outcome.BEYOND_RANGE.value
    if case.method.model == "beam":
        within = "The pressure limit is not reached within the sizes that the beam model holds for."
    message = (
        f"{within[:-1]}: at its end, size ratio {case.size_ratio:.4g}, the "
        f"critical pressure is {top.pressure / 1e3:.4g} kPa, so the critical size lies above it."
    )
    return SizeAnswer(case, Outcome.BEYOND_RANGE, message, limit, at_size=top)


class _Stop(Exception):
    """Carries an answer out of the search."""

    def __init__(self, answer: Answer) -> None:
        super().__init__(answer)
        self.answer = answer


class _Unanswered(_Stop):
    """An answer without a pressure."""


class _BeyondRange(_Stop):
    """The answer of the largest size, whose pressure is below the limit."""
