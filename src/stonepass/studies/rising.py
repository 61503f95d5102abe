"""Study of a held stone under rising urine pressure, compared with the seated state."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Float
from stonepass.declaration import read_declared
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
from stonepass.studies.rising_inputs import STEPS
from stonepass.units import Pressure

__all__ = ["Rising", "RisingPressure", "contact_deviation", "raise_pressure"]

SAMPLES = 400  # number of angles in the integrals over the contact


@array_dataclass
@dataclass(frozen=True, repr=False)
class Rising(Result):
    """States of one held stone under rising urine pressure.

    Attributes
    ----------
    critical : Answer
        Answer of the direct model, with the pressure at which a released stone would move.
    states : list of PushedState
        States in the order of rising P_u, which begins with 0. The list ends before the first state
        that could not be found.
    seated : SeatedState or None
        Seated state, which the paper uses instead of the loaded states; None if it was not found.
    deviation : array (states)
        Deviation of the contact pressure of each state from that of the seated state, dimensionless
        (see `contact_deviation`).
    reason : str
        Reason why states are missing; empty if none are missing.

    References
    ----------
    docs/closures.md; docs/theory.md, "The push-through, solved directly".
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
    """The study of a held stone under rising urine pressure, with stress fields.

    It is a single job, since each state is the starting point of the next one.

    Attributes
    ----------
    case, top, steps, wetted
        Arguments of `raise_pressure`.
    """

    case: Case
    top: Pressure | None = None
    steps: int = STEPS.default
    wetted: bool = False

    def jobs(self) -> list[RisingPressure]:
        """Return the study itself, which is its only job."""
        return [self]

    def run(self, cache_folder: Path | None) -> Rising:
        """Return the result of `raise_pressure`."""
        states = state_solver(cache_folder, walls=True)
        return raise_pressure(self.case, self.top, self.steps, states, wetted=self.wetted)

    def reduce(self, results: Results) -> Rising:
        """Return the result of the job."""
        return results[self]


def raise_pressure(
    case: Case,
    top: Pressure | None = None,
    steps: int = STEPS.default,
    states: StateSolver = UNCACHED,
    *,
    wetted: bool = False,
) -> Rising:
    """Compute the states of a held stone while P_u rises in equal steps from 0.

    Parameters
    ----------
    case : Case
        A case of the paper's model, whose seated state is compared with the loaded states of the
        direct model.
    top : Pressure, optional
        Highest pressure in Pa, above 0. The default is P_ucr; if P_ucr is 0 (without friction) or
        does not exist, it is the pressure that opens the tube to R_s.
    steps : int
        Number of pressures including 0, from 2 to 200.
    states : StateSolver
        Solver or cache of the finite-element states.
    wetted : bool
        True if the direct model is wetted (see `PushThrough`).

    Returns
    -------
    Rising
        It has no states for a loose stone.

    Raises
    ------
    BadInput
        `top` or `steps` is out of bounds, or the model of the case is not the paper's.

    References
    ----------
    docs/theory.md, "The push-through, solved directly"; docs/closures.md.
    """
    steps = read_declared(STEPS.declaration, "steps", steps)
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
    """Return ∫ |σ − σ⁰| dθ/∫ σ⁰ dθ over the contact of the loaded state.

    σ is the contact pressure of the loaded state and σ⁰ that of the seated state. The paper assumes
    that both are equal, so that the result would be 0.

    Parameters
    ----------
    state : PushedState
        The loaded state.
    seated : SeatedState
        The seated state of the same stone.

    Returns
    -------
    float
        A dimensionless number; NaN if the seated state has no contact within these angles.

    References
    ----------
    docs/closures.md.
    """
    theta = np.linspace(state.contact_angle, state.downstream_angle, SAMPLES)
    loaded, unloaded = state.pressure_at(theta), seated.pressure_at(theta)
    all_of_it = float(np.trapezoid(unloaded, theta))
    if all_of_it == 0.0:
        return float("nan")
    return float(np.trapezoid(np.abs(loaded - unloaded), theta)) / all_of_it
