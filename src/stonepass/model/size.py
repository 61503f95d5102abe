"""The critical size: the largest stone whose critical pressure stays within a limit."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from scipy.optimize import brentq

from stonepass.errors import Outcome, require
from stonepass.model.accuracy import LEVELS
from stonepass.model.answer import Answer
from stonepass.model.case import Case, Load, Method, Stone, Ureter
from stonepass.model.critical import solve
from stonepass.model.elements import Elements
from stonepass.model.far_field import lumen_ratio
from stonepass.model.shape import Shape
from stonepass.model.thin_wall import largest_beam_size
from stonepass.units import Length, Pressure, pressure

__all__ = ["SizeAnswer", "critical_size"]

SIZE_TOLERANCE = 1e-6
LIMIT_TOLERANCE = 1e-6  # of the limit: P_ucr grows at several limits per unit of ξ
SLOPE_BASE = 1e-4  # sizes nearer than this say too little of the slope
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
    elements: Elements | None = None,
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
    elements : Elements, optional
        Where finite-element results come from (`studies.store`); by default they are solved.
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
    return _search(case, bound, progress or (lambda size_ratio: None), elements)


def _search(
    case: Case,
    limit: Pressure,
    progress: Callable[[float], None],
    elements: Elements | None,
) -> SizeAnswer:
    tried: dict[float, Answer] = {}
    # The search needs no estimate of the error; the answer at the size that it finds has one.
    resolution = LEVELS[case.method.accuracy].resolution

    def excess(size_ratio: float) -> float:
        """P_ucr less the limit in Pa; without a balance the end of the closure stands in."""
        progress(size_ratio)
        if size_ratio not in tried:
            tried[size_ratio] = solve(case.with_size_ratio(size_ratio), resolution, elements)
        answer = tried[size_ratio]
        if answer.pressure is not None:
            return answer.pressure - limit
        end = answer.closure_end_pressure
        if end is not None and end >= limit:
            return end - limit  # no balance below the closure's end: P_ucr is above the limit
        raise _Unanswered(answer)

    lumen = lumen_ratio(case.wall_ratio, case.ureter.material.law, case.load)
    try:
        if lumen is None:  # then solve() says why, and so do we
            excess(case.size_ratio)
        assert lumen is not None
        high, top = _top(case.size_ratio, lumen, excess)
        if top < 0.0:
            return _beyond_range(case, limit, tried[high])
        smallest = lumen * (1.0 + SMALLEST_OVERSIZE)
        if limit < SMALL_LIMIT and excess(smallest) > 0.0:
            return _below_range(case, limit)
        known = {lumen: -float(limit), high: top}

        def bracketed(size_ratio: float) -> float:
            if size_ratio in known:
                return known[size_ratio]
            if size_ratio < smallest:  # P_ucr vanishes at the lumen: a straight line from there
                share = (size_ratio - lumen) / (smallest - lumen)
                return share * (excess(smallest) + limit) - limit
            missed = excess(size_ratio)
            return 0.0 if abs(missed) < LIMIT_TOLERANCE * limit else missed

        root = float(brentq(bracketed, lumen, high, xtol=SIZE_TOLERANCE))
    except _Unanswered as stop:
        answer = stop.answer
        where = f" (at size ratio {answer.case.size_ratio:.4g})"
        return SizeAnswer(
            case, answer.outcome, answer.message[:-1] + where + ".", limit, at_size=answer
        )
    return _found(case, limit, root, lumen, tried, elements)


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


def _found(
    case: Case,
    limit: Pressure,
    root: float,
    lumen: float,
    tried: dict[float, Answer],
    elements: Elements | None,
) -> SizeAnswer:
    if root <= lumen * (1.0 + SMALLEST_OVERSIZE):
        return _below_range(case, limit)
    at_size = solve(case.with_size_ratio(root), elements=elements)
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
        size_ratio_error=_size_ratio_error(at_size, tried),
        warnings=at_size.warnings,
    )


def _size_ratio_error(at_size: Answer, tried: dict[float, Answer]) -> float | None:
    """The error of P_ucr over its slope between the two sizes tried nearest to the root."""
    if at_size.error is None or at_size.error.critical_pressure is None:
        return None
    root = at_size.case.size_ratio
    near = sorted(tried, key=lambda x: abs(x - root))
    known = [(x, tried[x].pressure) for x in near if abs(x - root) > SLOPE_BASE]
    pressures = [(x, p) for x, p in known if p is not None]
    if not pressures or at_size.pressure is None:
        return None
    size_ratio, pressure = pressures[0]
    slope = (pressure - at_size.pressure) / (size_ratio - root)
    return abs(at_size.error.critical_pressure / slope) + SIZE_TOLERANCE


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


class _Unanswered(Exception):
    """Carries an answer without a pressure out of the root search."""

    def __init__(self, answer: Answer) -> None:
        super().__init__(answer)
        self.answer = answer
