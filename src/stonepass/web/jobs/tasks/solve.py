"""Jobs about one case: critical pressure, critical size, and a held stone under rising pressure."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from stonepass.fe.axisymmetric.problem import Resolution
from stonepass.model.critical import solve
from stonepass.model.numerics import Numerics
from stonepass.model.opening_curve import OpeningCurve
from stonepass.model.pressure_limit import read_limit
from stonepass.model.problem import Problem
from stonepass.model.seating import Seating
from stonepass.model.size import critical_size
from stonepass.model.states.loaded_state import Critical, NoPush, PushedState
from stonepass.model.states.seated_state import NoSeat, SeatedState
from stonepass.model.states.state_solver import StateSolver
from stonepass.records.answer import answer_record
from stonepass.records.rising import rising_record
from stonepass.records.size import size_record
from stonepass.report.answer_page import pressure_page, size_page
from stonepass.studies.jobs import state_solver
from stonepass.studies.rising import raise_pressure
from stonepass.units import Pressure, pressure
from stonepass.web.jobs.bodies import PressureJob, PushJob, SizeJob, solved_case
from stonepass.web.jobs.context import Context, Done
from stonepass.web.section.outline import solved_section

__all__ = ["TASKS"]


@dataclass(frozen=True)
class _Telling:
    """A state solver that says which state it is about to obtain.

    Attributes
    ----------
    states : StateSolver
        Obtains the states.
    context : Context
        Where the progress is reported.
    """

    states: StateSolver
    context: Context

    def seat(
        self,
        case: Problem,
        seating: Seating,
        numerics: Numerics,
        resolution: Resolution | None = None,
    ) -> SeatedState | NoSeat:
        """Report the progress and obtain a seated state; see `StateSolver.seat`."""
        self._say(f"Seating a stone of size ratio {case.size_ratio:.4f}.")
        return self.states.seat(case, seating, numerics, resolution)

    def push(
        self,
        case: Problem,
        numerics: Numerics,
        resolutions: Sequence[Resolution],
        *,
        wetted: bool,
        leak: bool,
    ) -> list[Critical | NoPush]:
        """Report the progress and obtain critical states; see `StateSolver.push`."""
        self._say(f"Pushing a stone of size ratio {case.size_ratio:.4f} until it moves.")
        return self.states.push(case, numerics, resolutions, wetted=wetted, leak=leak)

    def hold(
        self,
        case: Problem,
        numerics: Numerics,
        pressures: Sequence[Pressure],
        resolution: Resolution,
        *,
        wetted: bool,
    ) -> list[PushedState | NoPush]:
        """Report the progress and obtain held states; see `StateSolver.hold`."""
        self._say(f"Raising the pressure on a held stone in {len(pressures)} steps.")
        return self.states.hold(case, numerics, pressures, resolution, wetted=wetted)

    def opening_curve(self, case: Problem, numerics: Numerics) -> OpeningCurve | None:
        """Report the progress and obtain the opening curve; see `StateSolver.opening_curve`."""
        self._say("Following the wall as it opens.")
        return self.states.opening_curve(case, numerics)

    def _say(self, sentence: str) -> None:
        self.context.tell(0, 0, sentence)


def _states(context: Context) -> StateSolver:
    return _Telling(state_solver(context.cache_folder, walls=True), context)


def _pressure(request: Mapping[str, Any], context: Context) -> Done:
    """Return the record of the critical pressure, and the section through stone and wall."""
    case = solved_case(PressureJob.model_validate(request))
    answer = solve(case, states=_states(context))
    record = answer_record(answer).to_dict() | {"section": solved_section(answer)}
    return Done(record, pressure_page(answer, case) if context.format else "")


def _size(request: Mapping[str, Any], context: Context) -> Done:
    """Return the record of the critical size, and the section for a stone of this size."""
    body = SizeJob.model_validate(request)

    def tried(size_ratio: float) -> None:
        context.tell(0, 0, f"Trying the size ratio {size_ratio:.4f}.")

    case, limit = body.solved(), read_limit(body.limit)
    found = critical_size(case, limit, progress=tried, states=_states(context))
    section = None if found.at_size is None else solved_section(found.at_size)
    record = size_record(found).to_dict() | {"section": section}
    return Done(record, size_page(found, case) if context.format else "")


def _push(request: Mapping[str, Any], context: Context) -> Done:
    """Return the record of a held stone under rising pressure."""
    body = PushJob.model_validate(request)
    top = None if body.to is None else pressure(body.to, "to")
    case = solved_case(body)
    return Done(rising_record(raise_pressure(case, top, body.steps, _states(context))).to_dict())


TASKS = {"pressure": _pressure, "size": _size, "push": _push}
