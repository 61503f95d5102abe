"""The direct model's answer: the loaded push-through, with its error from a coarser solve."""

from __future__ import annotations

from dataclasses import replace

from stonepass.errors import Outcome
from stonepass.fe.axisymmetric.problem import Resolution
from stonepass.model.accuracy import LEVELS, ErrorEstimate, Level
from stonepass.model.answer import Answer, unanswered
from stonepass.model.case import Case
from stonepass.model.states.loaded import Critical, NoPush, PushedState
from stonepass.model.states.stability_report import folding_warning
from stonepass.model.states.state_solver import StateSolver
from stonepass.model.states.uncached import UNCACHED
from stonepass.model.validity import range_warnings

__all__ = ["solve_by_push"]

UNDECIDED = (
    "a coarser solve ends otherwise: whether the stone moves before urine passes is within the "
    "solver error"
)


def solve_by_push(
    case: Case, resolution: Resolution | None = None, states: StateSolver = UNCACHED
) -> Answer:
    """Answer a stuck stone by the pressure at which no force is left on it."""
    level = LEVELS[case.method.accuracy]
    wanted = (level.companion, level.resolution) if resolution is None else (resolution,)
    *coarser, found = states.push(case, wanted, leak=resolution is None)
    if isinstance(found, NoPush):
        return unanswered(
            case, Outcome.NO_SOLUTION, found.reason, found.newton_steps, found.seconds
        )
    coarse = coarser[0] if coarser and isinstance(coarser[0], Critical) else None
    state = found.state
    undecided = coarse is not None and coarse.leaks != found.leaks
    answer = Answer(
        case=case,
        outcome=Outcome.LEAKS if found.leaks else Outcome.MOVES,
        message=(Outcome.LEAKS if found.leaks else Outcome.MOVES).value,
        pushed=state,
        leak_pressure=found.leak_pressure if coarse is None else coarse.leak_pressure,
        newton_steps=sum(each.newton_steps for each in (*coarser, found)),
        seconds=found.seconds,
        warnings=(
            *case.stone.shape.warnings(),
            *range_warnings(case),
            *folding_warning(case),
            *state.warnings(),
            *([UNDECIDED] if undecided else []),
        ),
    )
    if not found.leaks:
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
