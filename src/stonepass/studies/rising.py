"""Urine pressure rising on a held stone, and whether the contact pressure stays the seated one."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Float

from stonepass.errors import Outcome, require
from stonepass.model.accuracy import LEVELS
from stonepass.model.answer import Answer
from stonepass.model.case import Case
from stonepass.model.critical import solve
from stonepass.model.energy_balance import opening_pressure
from stonepass.model.states.loaded import NoPush, PushedState, push_along
from stonepass.model.states.seated import NoSeat, SeatedState, seat
from stonepass.units import Pressure

__all__ = ["Rising", "contact_deviation", "raise_pressure"]

STEPS = (2, 200)
SAMPLES = 400


@dataclass(frozen=True)
class Rising:
    """States of one held stone under rising pressure.

    Attributes
    ----------
    critical : Answer
        Of the direct model: where the stone would move if it were let go.
    states : list of PushedState
        With rising P_u, the first without; shorter than asked for where a state was not found.
    seated : SeatedState or None
        What the paper puts in their place: the seated state of the case's seating.
    deviation : array
        Of the contact pressure of each state from that of the seated one (`contact_deviation`).
    reason : str
        Why there are fewer states than asked for; empty where there are not.
    """

    critical: Answer
    states: list[PushedState]
    seated: SeatedState | None
    deviation: Float[np.ndarray, " states"]
    reason: str


def raise_pressure(case: Case, top: Pressure | None = None, steps: int = 13) -> Rising:
    """Hold the stone while P_u rises in equal steps from 0 to `top`, by default to P_ucr.

    Without friction, where P_ucr is 0, and where there is none, to the pressure that opens the tube
    to R_s. A loose stone has no states.
    """
    require(STEPS[0] <= steps <= STEPS[1], "steps", steps, f"{STEPS[0]} to {STEPS[1]}")
    if top is not None:
        require(0.0 < top < np.inf, "highest pressure", f"{top:g} Pa", "above zero")
    direct = replace(case, method=case.method.by("direct"))
    critical = solve(direct)
    if critical.pushed is None and critical.outcome is not Outcome.NO_SOLUTION:
        return Rising(critical, [], None, np.empty(0), "")
    last = opening_pressure(case) if top is None and not critical.pressure else top
    if last is None:
        assert critical.pressure is not None
        last = critical.pressure
    pressures = [Pressure(float(p)) for p in np.linspace(0.0, last, steps)]
    found = push_along(direct, pressures, LEVELS[case.method.accuracy].resolution)
    states = [state for state in found if isinstance(state, PushedState)]
    lost = next((state for state in found if isinstance(state, NoPush)), None)
    seated = seat(replace(case, method=case.method.by("paper")))
    reason = "" if lost is None else lost.reason
    if isinstance(seated, NoSeat):
        return Rising(critical, states, None, np.full(len(states), np.nan), reason)
    deviation = np.array([contact_deviation(state, seated) for state in states])
    return Rising(critical, states, seated, deviation, reason)


def contact_deviation(state: PushedState, seated: SeatedState) -> float:
    """∫ |σ − σ⁰| dθ over ∫ σ⁰ dθ, where the loaded wall is closed: what the paper takes as 0.

    NaN where the seated stone touches nowhere there.
    """
    theta = np.linspace(state.contact_angle, state.downstream_angle, SAMPLES)
    loaded, unloaded = state.pressure_at(theta), seated.pressure_at(theta)
    all_of_it = float(np.trapezoid(unloaded, theta))
    if all_of_it == 0.0:
        return float("nan")
    return float(np.trapezoid(np.abs(loaded - unloaded), theta)) / all_of_it
