"""The critical state: where drive and resistance balance (paper, Eqs 4, 16, 17)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from scipy.optimize import brentq

from stonepass.errors import Outcome
from stonepass.fe.problem import Resolution
from stonepass.materials.stability import check
from stonepass.model.accuracy import LEVELS, ErrorEstimate, Level
from stonepass.model.balance import drive, resistance
from stonepass.model.case import Case, Load, Method, Stone, Ureter
from stonepass.model.closure import linear_closure
from stonepass.model.far_field import far_field_law, lumen_ratio, urine_pressure
from stonepass.model.push_through import Critical, NoPush, PushedState, critical_push
from stonepass.model.seated import Contact, NoSeat, SeatedState, seat
from stonepass.model.soundness import folding_warning
from stonepass.units import Values

__all__ = ["Answer", "balance_pressure", "critical_pressure", "pressure_of_angle", "solve"]

SCAN_POINTS = 721
# (ρ_α/R_s, ρ₀/R_s, ξ) to r_a/R_a, ρ₀ that of α₀.
Closure = Callable[[Values, float, float], Values]
SMALLEST_OVERSIZE = 1e-4


@dataclass(frozen=True)
class Answer:
    """The critical pressure of one case, or why there is none.

    Attributes
    ----------
    outcome : Outcome
    message : str
        Its sentence, with the cause where there is one.
    pressure : float or None
        Critical urine pressure P_ucr in Pa.
    critical_angle : float or None
        α_cr in rad, the contact angle at which the stone starts to move.
    closure_end_pressure : float or None
        P_u in Pa at which the closure ends (r_a = R_s), not a physical bound.
    seated : SeatedState or None
        The finite-element state behind it; none in the direct model.
    pushed : PushedState or None
        Direct model: the loaded state in which the stone starts to move; where urine passes first,
        the last one before.
    leak_pressure : float or None
        Direct model: urine pressure in Pa at which urine passes the held stone.
    error : ErrorEstimate or None
        Estimated discretisation error of α₀ (in the direct model of the contact's upstream edge),
        σ(π/2) and P_ucr; None where there is no state or no second solve could be made.
    newton_steps, seconds : int, float
        Work of the finite elements, also where they failed.
    warnings : tuple of str
        Where the answer leaves what its parts are known for.
    """

    case: Case
    outcome: Outcome
    message: str
    pressure: float | None = None
    critical_angle: float | None = None
    closure_end_pressure: float | None = None
    seated: SeatedState | None = None
    pushed: PushedState | None = None
    leak_pressure: float | None = None
    error: ErrorEstimate | None = None
    newton_steps: int = 0
    seconds: float = 0.0
    warnings: tuple[str, ...] = ()

    @property
    def state(self) -> SeatedState | PushedState | None:
        """The finite-element state behind it, whichever model it is of."""
        return self.seated if self.pushed is None else self.pushed


def critical_pressure(
    stone: Stone,
    ureter: Ureter,
    load: Load | None = None,
    method: Method | None = None,
) -> Answer:
    """At what urine pressure does this stone move in this ureter?

    Parameters
    ----------
    stone, ureter : Stone, Ureter
    load : Load, optional
        Confining pressure and pre-stretch; none by default.
    method : Method, optional
        Model, seating, half-length and switches; the paper's by default.

    Examples
    --------
    >>> import stonepass as sp
    >>> answer = sp.critical_pressure(sp.Stone(size_ratio=0.9), sp.Ureter(wall_ratio=1.5))
    >>> answer.outcome.name, answer.pressure
    ('LOOSE', 0.0)
    """
    return solve(Case(stone, ureter, load or Load(), method or Method()))


def solve(case: Case, resolution: Resolution | None = None) -> Answer:
    """Answer one case; every way it can end is an `Outcome` (model: section 6).

    With a `resolution` the finite elements use that mesh alone, and no error is estimated.
    """
    check(case.ureter.material)
    lumen = lumen_ratio(case.wall_ratio, case.ureter.material.law, case.load)
    if lumen is None:
        reason = "the load closes the lumen, or no uniform tube of this law is in equilibrium"
        return _unanswered(case, Outcome.NO_SOLUTION, reason)
    if case.size_ratio <= lumen:
        return Answer(case, Outcome.LOOSE, Outcome.LOOSE.value, pressure=0.0)
    if case.size_ratio < lumen * (1.0 + SMALLEST_OVERSIZE):
        reason = (
            f"the stone exceeds the lumen by less than {SMALLEST_OVERSIZE:.0e} of it, "
            "which is below what the finite elements resolve"
        )
        return _unanswered(case, Outcome.NO_SOLUTION, reason)
    if case.method.model == "direct":
        return _direct(case, resolution)
    if _closure_start(case) is None:
        reason = "the far field without the ground matrix has no lumen under this load"
        return _unanswered(case, Outcome.NO_SOLUTION, reason)
    seated = seat(case, resolution)
    if isinstance(seated, NoSeat):
        return _unanswered(
            case, Outcome.NO_SOLUTION, seated.reason, seated.newton_steps, seated.seconds
        )
    return _balance(case, seated)


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


def _unanswered(
    case: Case, outcome: Outcome, reason: str, steps: int = 0, seconds: float = 0.0
) -> Answer:
    message = f"{outcome.value[:-1]}: {reason}."
    return Answer(case, outcome, message, newton_steps=steps, seconds=seconds)


def _balance(case: Case, seated: SeatedState) -> Answer:
    """The answer of a seated state."""
    found = _critical(seated)
    coarse = None if seated.coarse is None else _critical(seated.coarse)
    undecided = seated.coarse is not None and (found is None) != (coarse is None)
    answer = Answer(
        case=case,
        outcome=Outcome.BEYOND_CLOSURE,
        message=Outcome.BEYOND_CLOSURE.value,
        closure_end_pressure=_closure_end(seated),
        seated=seated,
        error=_error(seated, found, coarse),
        newton_steps=seated.solver.newton_steps,
        seconds=seated.solver.seconds,
        warnings=(
            *case.stone.shape.warnings(),
            *_range_warnings(case),
            *folding_warning(case),
            *seated.warnings(),
            *([_UNDECIDED_WARNING] if undecided else []),
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
        warnings=(*answer.warnings, *([_EDGE_WARNING] if found.at_edge else [])),
    )


def _direct(case: Case, resolution: Resolution | None) -> Answer:
    """The answer of the loaded push-through, with its error from a coarser solve."""
    level = LEVELS[case.method.accuracy]
    wanted = (level.companion, level.resolution) if resolution is None else (resolution,)
    *coarser, found = critical_push(case, wanted, leak=resolution is None)
    if isinstance(found, NoPush):
        return _unanswered(
            case, Outcome.NO_SOLUTION, found.reason, found.newton_steps, found.seconds
        )
    coarse = coarser[0] if coarser and isinstance(coarser[0], Critical) else None
    state = found.state
    undecided = coarse is not None and coarse.clears != found.clears
    answer = Answer(
        case=case,
        outcome=Outcome.CLEARS if found.clears else Outcome.MOVES,
        message=(Outcome.CLEARS if found.clears else Outcome.MOVES).value,
        pushed=state,
        leak_pressure=found.leak_pressure if coarse is None else coarse.leak_pressure,
        newton_steps=sum(each.newton_steps for each in (*coarser, found)),
        seconds=found.seconds,
        warnings=(
            *case.stone.shape.warnings(),
            *_range_warnings(case),
            *folding_warning(case),
            *state.warnings(),
            *([_UNDECIDED_WARNING] if undecided else []),
        ),
    )
    if not found.clears:
        # Without friction nothing holds the stone: the root is 0, and rounding tells nothing.
        pressure = 0.0 if case.stone.friction == 0.0 else state.urine_pressure
        answer = replace(answer, pressure=pressure, critical_angle=state.contact_angle)
    if coarse is None or undecided:
        return answer
    return replace(answer, error=_push_error(level, coarse.state, state, answer.pressure))


def _push_error(
    level: Level, coarse: PushedState, fine: PushedState, pressure: float | None
) -> ErrorEstimate:
    width = fine.downstream_angle - fine.contact_angle
    equator = fine.equator_contact_pressure
    return ErrorEstimate(
        contact_angle=level.claim(coarse.contact_angle - fine.contact_angle, width),
        equator_contact_pressure=level.claim(coarse.equator_contact_pressure - equator, equator),
        critical_pressure=(
            None if pressure is None else level.claim(coarse.urine_pressure - pressure, pressure)
        ),
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

    found = _first_root(excess, first, last)
    if found is None:
        return None
    if found == first:
        disc = float(width(np.array(first))) ** 2
        # P_u whose drive equals the resistance of the whole contact.
        return _Critical(first, max(float(forces.total(np.array(first))), 0.0) / disc, at_edge=True)
    return _Critical(found, float(pressure_of_angle(contact, np.array(found), closure)))


def _closure_end(contact: Contact) -> float:
    return float(pressure_of_angle(contact, np.array(np.pi / 2)))


def _error(
    seated: SeatedState, found: _Critical | None, coarse: _Critical | None
) -> ErrorEstimate | None:
    """The error of the contact, with that of P_ucr, from the balance of the coarser contact.

    Where that one has no balance, its pressure lies beyond the end of its closure.
    """
    if seated.error is None or seated.coarse is None or found is None:
        return seated.error
    pressure = _closure_end(seated.coarse) if coarse is None else coarse.pressure
    level = LEVELS[seated.case.method.accuracy]
    claim = level.claim(pressure - found.pressure, found.pressure)
    return replace(seated.error, critical_pressure=claim)


_UNDECIDED_WARNING = (
    "a coarser solve ends otherwise: whether the stone moves before its model ends is within the "
    "solver error"
)
_EDGE_WARNING = (
    "the drive outweighs the resistance as soon as the stone is seated: the paper's closure starts "
    "at the unloaded inner radius although the load has narrowed the lumen; the critical pressure "
    "is taken from the seated contact angle, and closure_start = 'lumen' is the alternative"
)


def _first_root(excess: Callable[[Values], Values], first: float, last: float) -> float | None:
    """Smallest root of `excess` in [first, last]; `first` itself where it starts at or below 0."""
    grid = np.linspace(first, last, SCAN_POINTS)
    values = np.asarray(excess(grid))
    if not np.all(np.isfinite(values)):
        raise FloatingPointError("the force balance is not finite")
    if values[0] <= 1e-12 * np.abs(values).max():
        return first
    below = np.flatnonzero(values <= 0.0)
    if below.size == 0:
        return None
    k = int(below[0])
    return float(brentq(excess, grid[k - 1], grid[k], xtol=1e-14))


def _closure_start(case: Case) -> float | None:
    if case.method.closure_start == "inner-radius":
        return 1.0
    return lumen_ratio(case.wall_ratio, far_field_law(case), case.load)


def _range_warnings(case: Case) -> list[str]:
    material = case.ureter.material
    low, high = material.strain_range
    known = (
        f"but the constants of material '{material.name}' were used for stretches "
        f"{low:g} to {high:g} only"
    )
    warnings = []
    if case.size_ratio > high:
        warnings.append(
            f"the stone stretches the wall to {case.size_ratio:.3g} times its circumference, "
            + known
        )
    lumen = lumen_ratio(case.wall_ratio, material.law, case.load)
    if lumen is not None and lumen < low:
        warnings.append(f"the load shrinks the lumen to {lumen:.3g} times its width, {known}")
    return warnings
