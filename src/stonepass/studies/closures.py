"""One stone by every closure: the paper's, a fitted series, energy, and the direct model."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from stonepass.array_dataclass import array_dataclass
from stonepass.caution import Caution, caution
from stonepass.errors import BadInput, Outcome, require
from stonepass.model.accuracy import LEVELS
from stonepass.model.answer import Answer
from stonepass.model.case import Case
from stonepass.model.closure import ORDER, Series, first_radius, series_through
from stonepass.model.critical import solve
from stonepass.model.energy_balance import advance_force
from stonepass.model.far_field import far_field_law
from stonepass.model.models.push_through import PushThrough
from stonepass.model.models.seated_balance import Closure, SeatedBalance, balance_pressure
from stonepass.model.opening_curve import OpeningCurve
from stonepass.model.states.loaded_state import PushedState
from stonepass.model.states.seated_state import SeatedState
from stonepass.model.states.state_solver import StateSolver
from stonepass.model.states.uncached import UNCACHED
from stonepass.result import Result
from stonepass.studies.jobs import Results, state_solver
from stonepass.units import Pressure

__all__ = [
    "CLOSURES",
    "ClosureComparison",
    "ClosureJob",
    "ClosureMap",
    "closures",
    "seated_model",
]

# Names at the door, and what they say.
CLOSURES = {
    "derived": "Eq. 15, Eq. 5 with the derived sign",
    "printed": "Eq. 15, Eq. 5 as printed",
    "series": "series of Eqs 13–14, fitted to direct states",
    "energy": "energy: I(P) = D",
    "direct": "direct push-through",
}
SERIES_ORDER = 3
NEAR = 0.03  # how far around the direct answer D is taken


@array_dataclass
@dataclass(frozen=True, repr=False)
class ClosureComparison(Result):
    """Critical pressures of one stone by every closure.

    Attributes
    ----------
    case : Case
        With the paper's model.
    pressures : dict
        Name of the closure (`CLOSURES`) to P_ucr in Pa; None where it has none.
    outcome : Outcome
        Of the direct model.
    message : str
    warnings : tuple of Caution
        Those of the paper's model and of the direct one, and why a closure has no pressure.
    series : Series or None
        The fitted one.
    opening_curve : OpeningCurve or None
        α and r_a/R_a of the direct states it was fitted to.
    """

    case: Case
    pressures: dict[str, float | None]
    outcome: Outcome
    message: str
    warnings: tuple[Caution, ...] = ()
    series: Series | None = None
    opening_curve: OpeningCurve | None = None

    def summary(self) -> str:
        """Return the pressures of all closures in one line."""
        pressures = ", ".join(
            f"{name} {'none' if found is None else f'{found / 1e3:.4g} kPa'}"
            for name, found in self.pressures.items()
        )
        case = self.case
        return (
            f"{pressures}; ξ {case.size_ratio:.4g}, η {case.wall_ratio:.4g}, "
            f"{case.ureter.material.name}, friction {case.stone.friction:g}"
        )

    def error(self, name: str) -> float | None:
        """P_ucr by the closure `name` over that of the direct model, less 1; None without one."""
        found, direct = self.pressures[name], self.pressures["direct"]
        return None if found is None or not direct else found / direct - 1.0


def closures(
    case: Case,
    order: int = SERIES_ORDER,
    states: StateSolver = UNCACHED,
    *,
    wetted: bool = False,
) -> ClosureComparison:
    """Answer one case by every closure.

    The seated contact pressure is that of the case's seating for the paper's closures and the
    series; the loaded one for energy and direct.

    Parameters
    ----------
    case : Case
        Its model is the paper's, of which the seating and the far field are taken.
    order : int
        Order of the fitted series, within `model.closure.ORDER`.
    states : StateSolver
        Where finite-element states come from.
    wetted : bool
        Whether the direct model is wetted (see `PushThrough`).

    Raises
    ------
    BadInput
        For an order out of bounds, or a case of another model.
    """
    require(ORDER[0] <= order <= ORDER[1], "order", order, f"{ORDER[0]} to {ORDER[1]}")
    # No errors are estimated: closures differ by more.
    resolution = case.numerics.resolution
    seated = seated_model(case)
    paper = solve(replace(case, model=seated), resolution, states)
    direct = solve(replace(case, model=PushThrough(wetted)), resolution, states)
    pressures: dict[str, float | None] = dict.fromkeys(CLOSURES)
    pressures |= {"derived": paper.pressure, "direct": direct.pressure}
    pressures["energy"] = _by_energy(direct, states, wetted=wetted)
    lost = caution("no_closed_answer", outcome=paper.outcome.name, message=paper.message)
    warnings = _once(
        [*paper.warnings, *direct.warnings, *([] if paper.outcome.answered else [lost])]
    )
    found = ClosureComparison(
        replace(case, model=seated), pressures, direct.outcome, direct.message, warnings
    )
    contact = paper.contact
    if not isinstance(contact, SeatedState):
        return found
    far_field = far_field_law(case, ground=seated.far_field_ground)
    eq15 = Closure(far_field, first_radius(case.size_ratio))
    pressures["printed"] = balance_pressure(contact, eq15, as_printed=True)
    curve = states.opening_curve(case, case.numerics)
    series = None if curve is None else series_through(case, curve, order)
    if curve is None or series is None:
        return found
    # The loaded states are of the whole law, so the series is turned back by the whole law.
    fitted = Closure(far_field_law(case, ground=True), series.start, series)
    pressures["series"] = balance_pressure(contact, fitted)
    return replace(found, series=series, opening_curve=curve)


def seated_model(case: Case) -> SeatedBalance:
    """The paper's model with the seating and the far field of a case, and the closure of Eq. 15.

    Raises
    ------
    BadInput
        The case has another model.
    """
    model = case.model
    if not isinstance(model, SeatedBalance):
        raise BadInput("model", model.NAME, "'paper' where its seated state is compared")
    return SeatedBalance(
        model.seating, model.seating_friction, far_field_ground=model.far_field_ground
    )


@dataclass(frozen=True)
class ClosureJob:
    """The comparison of the closures for one case."""

    case: Case
    order: int = SERIES_ORDER
    wetted: bool = False

    def run(self, cache_folder: Path | None) -> ClosureComparison:
        """Return the outcome of `closures`."""
        states = state_solver(cache_folder)
        return closures(self.case, self.order, states, wetted=self.wetted)


@dataclass(frozen=True)
class ClosureMap:
    """The comparison of the closures for many cases; the outcome is a list in their order."""

    cases: Sequence[Case]
    order: int = SERIES_ORDER
    wetted: bool = False

    def jobs(self) -> list[ClosureJob]:
        """Return one job for each case."""
        return [ClosureJob(case, self.order, self.wetted) for case in self.cases]

    def reduce(self, results: Results) -> list[ClosureComparison]:
        """Return the comparisons in the order of the cases."""
        return [results[job] for job in self.jobs()]


def _once(cautions: Sequence[Caution]) -> tuple[Caution, ...]:
    """Each caution once; that no error is estimated is a choice of this comparison."""
    return tuple(dict.fromkeys(c for c in cautions if c.code != "error_not_estimated"))


def _by_energy(direct: Answer, states: StateSolver, *, wetted: bool) -> float | None:
    """The root of I(P) = D(P), D of two loaded states around the direct answer."""
    if direct.pressure is None or direct.pressure == 0.0:
        return direct.pressure
    near = [Pressure(direct.pressure * (1.0 + s * NEAR)) for s in (-1.0, 1.0)]
    excess = []
    coarse = LEVELS["fast"].resolution
    for state in states.hold(direct.case, direct.numerics, near, coarse, wetted=wetted):
        if not isinstance(state, PushedState):
            return None
        gained = advance_force(direct.case, state.urine_pressure)
        if gained is None:
            return None
        excess.append(gained - state.friction_work)
    low, high = excess
    return float(near[0] - low * (near[1] - near[0]) / (high - low))
