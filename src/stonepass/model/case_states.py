"""Finite-element states of a case, without the search for its critical pressure."""

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
from stonepass.units import Pressure, Quantity

__all__ = ["push_along", "push_through", "seat"]


def seat(case: Case, resolution: Resolution | None = None) -> SeatedState | NoSeat:
    """Solve the seated state: the wall stretched over the stone, without urine pressure.

    See "Seated state" in docs/theory.md.

    Parameters
    ----------
    case : Case
        Its model must be `SeatedBalance`, which says how the stone is seated.
    resolution : Resolution, optional
        Resolution of a single solve without an error estimate. By default the accuracy of the case
        is used, with an error estimate from a second, coarser solve.

    Returns
    -------
    SeatedState or NoSeat
        `NoSeat` gives the reason if no seated state was found.

    Raises
    ------
    UnstableLaw
        The material law is not stable.
    BadInput
        The stone is not larger than the lumen, so it is not seated.
    Misplaced
        The model of the case is not `SeatedBalance`.
    """
    model = case.model
    if not isinstance(model, SeatedBalance):
        raise Misplaced("seat", f"the model '{model.NAME}'", "needs the model SeatedBalance")
    return solve_seated(case, model.seating_of(case), case.numerics, resolution)


def push_through(
    case: Case,
    urine: str | Pressure | Quantity,
    resolution: Resolution | None = None,
    *,
    tether: float = 0.0,
    offset: float = 0.0,
) -> PushedState | NoPush:
    """Solve the state of a held stone under one urine pressure, with fully mobilised friction.

    Parameters
    ----------
    case, resolution, tether, offset
        See `push_along`.
    urine : str or Pressure
        Urine pressure P_u upstream of the stone, zero or positive, e.g. ``"8 kPa"``.

    Returns
    -------
    PushedState or NoPush
        `NoPush` gives the reason if no state was found.

    Raises
    ------
    UnstableLaw, BadInput
        See `push_along`.
    """
    (found,) = push_along(case, [urine], resolution, tether=tether, offset=offset)
    return found


def push_along(
    case: Case,
    urine: Sequence[str | Pressure | Quantity],
    resolution: Resolution | None = None,
    *,
    tether: float = 0.0,
    offset: float = 0.0,
) -> list[PushedState | NoPush]:
    """Solve the states of a held stone under a sequence of urine pressures.

    Friction is fully mobilised everywhere, because sliding is imminent. Each state is the starting
    point of the next one. See "The push-through, solved directly" in docs/theory.md.

    Parameters
    ----------
    case : Case
        If its model is `PushThrough`, the option `wetted` of the model is used. With any other
        model the contact is dry.
    urine : sequence of str or Pressure
        Urine pressures P_u upstream of the stone, zero or positive, e.g. ``"8 kPa"``.
    resolution, tether, offset
        See `model.states.loaded.solve_loaded`.

    Returns
    -------
    list of PushedState or NoPush
        One result for each pressure, in the same order.

    Raises
    ------
    UnstableLaw
        The material law is not stable.
    BadInput
        The stone is not larger than the lumen, or a number is out of range.
    """
    wetted = isinstance(case.model, PushThrough) and case.model.wetted
    return solve_loaded(
        case, case.numerics, urine, resolution, wetted=wetted, tether=tether, offset=offset
    )
