"""The paper's model: the seated contact, cut off at an angle, balances the urine (Eqs 4–17)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from stonepass.errors import Outcome, require
from stonepass.fe.axisymmetric.problem import Resolution
from stonepass.model.accuracy import LEVELS, ErrorEstimate
from stonepass.model.answer import Answer, unanswered
from stonepass.model.case import Case
from stonepass.model.closure import Series, fit_series, linear_closure
from stonepass.model.far_field import far_field_law, lumen_ratio, urine_pressure
from stonepass.model.force_balance import drive, resistance
from stonepass.model.roots import first_root
from stonepass.model.states.opening import series_through
from stonepass.model.states.seated import Contact, NoSeat, SeatedState
from stonepass.model.states.stability_report import folding_warning
from stonepass.model.states.state_solver import StateSolver
from stonepass.model.states.uncached import UNCACHED
from stonepass.model.validity import range_warnings
from stonepass.units import Values

__all__ = ["balance_pressure", "pressure_of_angle", "solve_by_balance", "with_whole_law"]

# (ρ_α/R_s, ρ₀/R_s, ξ) to r_a/R_a, ρ₀ that of α₀.
Closure = Callable[[Values, float, float], Values]
UNDECIDED = (
    "a coarser solve ends otherwise: whether the stone moves before the closure ends is within the "
    "solver error"
)
SMALLEST_OPENING, LARGEST_OPENING = 0.5, 2.0  # of a series: r_a/R_a, r_a/R_s
NO_PAIRS = "too few direct states were found for the series that closes the gap to be fitted"
AT_EDGE = (
    "the drive outweighs the resistance as soon as the stone is seated: the paper's closure starts "
    "at the unloaded inner radius although the load has narrowed the lumen; the critical pressure "
    "is taken from the seated contact angle, and closure_start = 'lumen' is the alternative"
)


def solve_by_balance(
    case: Case, resolution: Resolution | None = None, states: StateSolver = UNCACHED
) -> Answer:
    """Answer a stuck stone by its seated contact, the closure and the far field."""
    if _closure_start(case) is None:
        reason = "the far field without the ground matrix has no lumen under this load"
        return unanswered(case, Outcome.NO_SOLUTION, reason)
    seated = states.seat(case, resolution)
    if isinstance(seated, NoSeat):
        return unanswered(
            case, Outcome.NO_SOLUTION, seated.reason, seated.newton_steps, seated.seconds
        )
    if case.method.closure == "linear":
        return _balance(case, seated)
    series = _series(case, seated, states)
    if series is None:
        did = seated.solver
        return unanswered(case, Outcome.NO_SOLUTION, NO_PAIRS, did.newton_steps, did.seconds)
    if case.method.pairs is None:
        seated = with_whole_law(seated)
    return _balance(case, seated, series)


def with_whole_law(seated: SeatedState) -> SeatedState:
    """Return the same contact in a far field of the whole law, ground matrix included.

    Direct states are of that law, so that a series fitted to them gives each its own pressure.
    """
    method = replace(seated.case.method, far_field_ground=True)
    case = replace(seated.case, method=method)
    coarse = None if seated.coarse is None else replace(seated.coarse, case=case)
    return replace(seated, case=case, coarse=coarse)


def _series(case: Case, seated: SeatedState, states: StateSolver) -> Series | None:
    """The closure fitted to the pairs given, or to direct states of the case."""
    width, order, pairs = case.stone.shape.width, case.method.series_order, case.method.pairs
    if pairs is not None:
        alpha, radius = pairs.arrays
        start = _closure_start(case)
        assert start is not None, "asked before the stone is seated"
        first = float(width(np.array(seated.contact_angle)))
        fitted = fit_series(width(alpha), radius, first, case.size_ratio, order, start)
        opened = np.asarray(fitted(np.linspace(first, 1.0, 91), first, case.size_ratio))
        reach = float(opened.flat[np.argmax(np.abs(opened - 1.0))])
        low, high = SMALLEST_OPENING, LARGEST_OPENING * case.size_ratio
        shown = f"such that their series reaches r_a = {reach:.3g} R_a"
        allowed = f"of a series that stays from {low:g} to {high:.3g} R_a"
        within = bool(low <= opened.min() and opened.max() <= high)
        require(within, "pairs", shown, allowed, "give more pairs or a lower order")
        return fitted
    found = states.pairs(case)
    return None if found is None else series_through(case, found, order)


def pressure_of_angle(contact: Contact, alpha: Values, closure: Closure | None = None) -> Values:
    """P_u(α) in Pa (Eq. 16): the far field at the radius the closure gives to the angle α.

    `closure` takes the stone's half-widths at α and α₀ over R_s, and ξ, and gives r_a/R_a; Eq. 15
    by default.
    """
    case, width = contact.case, contact.case.stone.shape.width
    if closure is None:
        start = _closure_start(case)
        assert start is not None, "a seated stone under a load that closes the far field"
        closure = partial(linear_closure, start=start)
    first = float(width(np.array(contact.contact_angle)))
    radius = closure(width(np.asarray(alpha)), first, case.size_ratio)
    return urine_pressure(radius, case.wall_ratio, far_field_law(case), case.load)


def balance_pressure(contact: Contact, closure: Closure | None = None) -> float | None:
    """P_ucr in Pa of a seated stone by a closure; None where the forces do not balance."""
    found = _critical(contact, closure)
    return None if found is None else found.pressure


def _balance(case: Case, seated: SeatedState, series: Series | None = None) -> Answer:
    """The answer of a seated state, by a series or Eq. 15."""
    found = _critical(seated, series)
    coarse = None if seated.coarse is None else _critical(seated.coarse, series)
    undecided = seated.coarse is not None and (found is None) != (coarse is None)
    answer = Answer(
        case=case,
        outcome=Outcome.BEYOND_CLOSURE,
        message=Outcome.BEYOND_CLOSURE.value,
        closure_end_pressure=_closure_end(seated, series),
        seated=seated,
        series=series,
        error=_error(seated, found, coarse, series),
        newton_steps=seated.solver.newton_steps,
        seconds=seated.solver.seconds,
        warnings=(
            *case.stone.shape.warnings(),
            *range_warnings(case),
            *folding_warning(case),
            *seated.warnings(),
            *([UNDECIDED] if undecided else []),
        ),
    )
    if found is None:
        return answer
    return replace(
        answer,
        outcome=Outcome.MOVES,
        message=Outcome.MOVES.value,
        pressure=found.pressure,
        critical_angle=found.angle,
        warnings=(*answer.warnings, *([AT_EDGE] if found.at_edge else [])),
    )


@dataclass(frozen=True)
class _Critical:
    """Where drive and resistance balance; `at_edge` where the drive wins from the first angle."""

    angle: float
    pressure: float
    at_edge: bool = False


def _critical(contact: Contact, closure: Closure | None = None) -> _Critical | None:
    """Smallest α in [α₀, π/2] with F_re = F_dr: scan first, since it need not be the only one."""
    forces, width = resistance(contact), contact.case.stone.shape.width
    first, last = contact.contact_angle, np.pi / 2
    # Without friction nothing holds the stone, whatever the load: the root is α₀, and P_ucr = 0.
    if contact.case.stone.friction == 0.0:
        return _Critical(first, 0.0)

    def excess(alpha: Values) -> Values:
        push = drive(pressure_of_angle(contact, alpha, closure), width(np.asarray(alpha)))
        return forces.total(alpha) - push

    found = first_root(excess, first, last)
    if found is None:
        return None
    if found == first:
        disc = float(width(np.array(first))) ** 2
        # P_u whose drive equals the resistance of the whole contact.
        return _Critical(first, max(float(forces.total(np.array(first))), 0.0) / disc, at_edge=True)
    return _Critical(found, float(pressure_of_angle(contact, np.array(found), closure)))


def _closure_end(contact: Contact, series: Series | None) -> float:
    return float(pressure_of_angle(contact, np.array(np.pi / 2), series))


def _error(
    seated: SeatedState,
    found: _Critical | None,
    coarse: _Critical | None,
    series: Series | None,
) -> ErrorEstimate | None:
    """The error of the contact, with that of P_ucr, from the balance of the coarser contact.

    Where that one has no balance, its pressure lies beyond the end of its closure.
    """
    if seated.error is None or seated.coarse is None or found is None:
        return seated.error
    pressure = _closure_end(seated.coarse, series) if coarse is None else coarse.pressure
    level = LEVELS[seated.case.method.accuracy]
    claim = level.claim(pressure - found.pressure, found.pressure)
    return replace(seated.error, critical_pressure=claim)


def _closure_start(case: Case) -> float | None:
    if case.method.closure_start == "inner-radius":
        return 1.0
    return lumen_ratio(case.wall_ratio, far_field_law(case), case.load)
