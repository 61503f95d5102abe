"""Urine pressure rising on a held stone, and whether the contact pressure stays the seated one."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Float
from stonepass.errors import Outcome, require
from stonepass.model.answer import Answer
from stonepass.model.case import Case
from stonepass.model.critical import solve
from stonepass.model.energy_balance import opening_pressure
from stonepass.model.models.push_through import PushThrough
from stonepass.model.states.loaded_state import NoPush, PushedState
from stonepass.model.states.seated_state import NoSeat, SeatedState
from stonepass.model.states.state_solver import StateSolver
from stonepass.model.states.uncached import UNCACHED
from stonepass.result import Result
from stonepass.studies.closures import seated_model
from stonepass.studies.jobs import Results, state_solver
from stonepass.units import Pressure

__all__ = ["Rising", "RisingPressure", "contact_deviation", "raise_pressure"]

STEPS = (2, 200)
SAMPLES = 400


@array_dataclass
@dataclass(frozen=True, repr=False)
class Rising(Result):
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

    def summary(self) -> str:
        """Return how many states were found, and the critical pressure, in one line."""
        top = f" up to {self.states[-1].urine_pressure / 1e3:.4g} kPa" if self.states else ""
        return f"{len(self.states)} states{top}; {self.critical.summary()}"


@dataclass(frozen=True)
class RisingPressure:
    """A stone that is held while P_u rises, as a study of one job; see `raise_pressure`.

    Its states keep their stress fields.
    """

    case: Case
    top: Pressure | None = None
    steps: int = 13
    wetted: bool = False

    def jobs(self) -> list[RisingPressure]:
        """Return the study itself: each state is the start of the next one, so it is one job."""
        return [self]

    def run(self, cache_folder: Path | None) -> Rising:
        """Return the outcome of `raise_pressure`."""
        states = state_solver(cache_folder, walls=True)
        return raise_pressure(self.case, self.top, self.steps, states, wetted=self.wetted)

    def reduce(self, results: Results) -> Rising:
        """Return the result of the job."""
        return results[self]


def raise_pressure(
    case: Case,
    top: Pressure | None = None,
    steps: int = 13,
    states: StateSolver = UNCACHED,
    *,
    wetted: bool = False,
) -> Rising:
    """Hold the stone while P_u rises in equal steps from 0 to `top`.

    Parameters
    ----------
    case : Case
        Its model is the paper's, whose seating is compared; the states are those of the direct
        model.
    top : Pressure, optional
        In Pa, above 0; by default P_ucr, or, where P_ucr is 0 (without friction) or not found, the
        pressure that opens the tube to R_s.
    steps : int
        Number of pressures, 0 included, 2 to 200.
    states : StateSolver
        Where finite-element states come from.
    wetted : bool
        Whether the direct model is wetted (see `PushThrough`).

    Returns
    -------
    Rising
        Without states for a loose stone.

    Raises
    ------
    BadInput
        For `top` or `steps` out of bounds.
    """
    require(STEPS[0] <= steps <= STEPS[1], "steps", steps, f"{STEPS[0]} to {STEPS[1]}")
    if top is not None:
        require(0.0 < top < np.inf, "highest pressure", f"{top:g} Pa", "above zero")
    model, numerics = seated_model(case), case.numerics
    critical = solve(replace(case, model=PushThrough(wetted)), None, states)
    if critical.contact is None and critical.outcome is not Outcome.NO_SOLUTION:
        return Rising(critical, [], None, np.empty(0), "")
    last = opening_pressure(case) if top is None and not critical.pressure else top
    if last is None:
        assert critical.pressure is not None
        last = critical.pressure
    pressures = [Pressure(float(p)) for p in np.linspace(0.0, last, steps)]
    found = states.hold(case, numerics, pressures, numerics.resolution, wetted=wetted)
    held = [state for state in found if isinstance(state, PushedState)]
    lost = next((state for state in found if isinstance(state, NoPush)), None)
    seated = states.seat(case, model.seating_of(case), numerics)
    reason = "" if lost is None else lost.reason
    if isinstance(seated, NoSeat):
        return Rising(critical, held, None, np.full(len(held), np.nan), reason)
    deviation = np.array([contact_deviation(state, seated) for state in held])
    return Rising(critical, held, seated, deviation, reason)


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
