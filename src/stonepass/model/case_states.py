"""Finite-element states of a case, without asking for its critical pressure."""

from __future__ import annotations

from collections.abc import Sequence

from stonepass.errors import Misplaced
from stonepass.fe.axisymmetric.problem import Resolution
from stonepass.model.case import Case
from stonepass.model.models.push_through import PushThrough
from stonepass.model.models.seated_balance import SeatedBalance
from stonepass.model.states.loaded import solve_loaded
from stonepass.model.states.loaded_state import NoPush, PushedState
from stonepass.model.states.seated import solve_seated
from stonepass.model.states.seated_state import NoSeat, SeatedState
from stonepass.units import Pressure

__all__ = ["push_along", "push_through", "seat"]


def seat(case: Case, resolution: Resolution | None = None) -> SeatedState | NoSeat:
    """Solve the seated state of a stone that is larger than the lumen.

    Parameters
    ----------
    case : Case
        Its model is `SeatedBalance`, whose seating is taken.
    resolution : Resolution, optional
        Solve on this mesh alone, without an estimate of the error; by default at the accuracy of
        the case's numerics, with an estimate from a second, coarser solve.

    Raises
    ------
    UnstableLaw
        The material law is no solid.
    BadInput
        The stone is not larger than the lumen, so it is not seated at all.
    """
    model = case.model
    if not isinstance(model, SeatedBalance):
        raise Misplaced("seat", f"the model '{model.NAME}'", "is of SeatedBalance")
    return solve_seated(case, model.seating_of(case), case.numerics, resolution)


def push_through(
    case: Case,
    urine: str | Pressure,
    resolution: Resolution | None = None,
    *,
    tether: float = 0.0,
    offset: float = 0.0,
) -> PushedState | NoPush:
    """Hold the stone under a urine pressure, the slide imminent everywhere.

    See `push_along` for the parameters; this is one pressure alone.
    """
    (found,) = push_along(case, [urine], resolution, tether=tether, offset=offset)
    return found


def push_along(
    case: Case,
    urine: Sequence[str | Pressure],
    resolution: Resolution | None = None,
    *,
    tether: float = 0.0,
    offset: float = 0.0,
) -> list[PushedState | NoPush]:
    """Hold the stone under one pressure after the other, each state the start of the next.

    Parameters
    ----------
    case : Case
        Where its model is `PushThrough`, that says whether the contact is wetted; else it is dry.
    urine : sequence of str or Pressure
        P_u above the stone, e.g. ``"8 kPa"``; zero or positive.
    resolution, tether, offset
        See `model.states.loaded.solve_loaded`.

    Raises
    ------
    UnstableLaw
        The material law is no solid.
    BadInput
        The stone is not larger than the lumen, or a number is out of range.
    """
    wetted = isinstance(case.model, PushThrough) and case.model.wetted
    return solve_loaded(
        case, case.numerics, urine, resolution, wetted=wetted, tether=tether, offset=offset
    )
