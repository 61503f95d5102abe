"""Comparison of the critical pressures of one stone by different closures and the direct model."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from stonepass.array_dataclass import array_dataclass
from stonepass.caution import Caution, caution
from stonepass.declaration import inputs_of, read_declared
from stonepass.errors import BadInput, Outcome
from stonepass.model.accuracy import LEVELS
from stonepass.model.answer import Answer
from stonepass.model.case import Case
from stonepass.model.closure import Closure, Series, first_radius, series_through
from stonepass.model.critical import solve
from stonepass.model.critical_state import balance_pressure
from stonepass.model.energy_balance import advance_force
from stonepass.model.far_field import far_field_law
from stonepass.model.models.push_through import PushThrough
from stonepass.model.models.seated_balance import SeatedBalance
from stonepass.model.opening_curve import OpeningCurve
from stonepass.model.states.loaded_state import PushedState
from stonepass.model.states.seated_state import SeatedState
from stonepass.model.states.state_solver import StateSolver
from stonepass.model.states.uncached import UNCACHED
from stonepass.result import Result
from stonepass.studies.jobs import Results, state_solver
from stonepass.units import Pressure

__all__ = [
    "APPROXIMATE",
    "CLOSURES",
    "EXACT",
    "ClosureComparison",
    "ClosureJob",
    "ClosureMap",
    "closures",
    "seated_model",
]

# Names of the closures on the command line and in records, and their descriptions.
CLOSURES = {
    "derived": "Eq. 15, Eq. 5 with the derived sign",
    "printed": "Eq. 15, Eq. 5 as printed",
    "series": "series of Eqs 13–14, fitted to direct states",
    "energy": "energy: I(P) = D",
    "direct": "direct push-through",
}
EXACT = "direct"  # the others are compared with this one
APPROXIMATE = tuple(name for name in CLOSURES if name != EXACT)
SERIES_ORDER = inputs_of(SeatedBalance)["series_order"]
# D is computed at two pressures, which differ from the direct answer by ± this fraction of it.
NEAR = 0.03


@array_dataclass
@dataclass(frozen=True, repr=False)
class ClosureComparison(Result):
    """Critical pressures of one stone by every closure.

    Attributes
    ----------
    case : Case
        The case with the paper's model.
    pressures : dict of str to float or None
        P_ucr in Pa by the name of the closure (`CLOSURES`); None if the closure has no answer.
    outcome : Outcome
        Outcome of the direct model.
    message : str
        This outcome as a sentence.
    warnings : tuple of Caution
        Warnings of the paper's model and of the direct model, and a caution for a closure without
        an answer.
    series : Series or None
        The fitted series; None if it could not be fitted.
    opening_curve : OpeningCurve or None
        Opening angles α and radii r_a/R_a of the direct states to which the series was fitted.

    References
    ----------
    docs/closures.md; docs/theory.md, "Closure and critical state".
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
        """Return the relative error of P_ucr by the closure `name` against the direct model.

        It is None if one of both pressures does not exist.
        """
        found, direct = self.pressures[name], self.pressures[EXACT]
        return None if found is None or not direct else found / direct - 1.0


def closures(
    case: Case,
    order: int = SERIES_ORDER.default,
    states: StateSolver = UNCACHED,
    *,
    wetted: bool = False,
) -> ClosureComparison:
    """Compute the critical pressure of one case by every closure.

    The paper's closure and the fitted series use the contact pressure of the seated state. The
    energy balance and the direct model use the contact pressure of the loaded states.

    Parameters
    ----------
    case : Case
        A case of the paper's model, whose seating and far field are used.
    order : int
        Order of the fitted series, 1 to 8.
    states : StateSolver
        Solver or cache of the finite-element states.
    wetted : bool
        True if the direct model is wetted (see `PushThrough`).

    Returns
    -------
    ClosureComparison

    Raises
    ------
    BadInput
        The order is out of bounds, or the model of the case is not the paper's.

    References
    ----------
    Liu et al. 2022, Eqs 5, 13–15; docs/closures.md.
    """
    read_declared(SERIES_ORDER.declaration, "order", order)
    # Errors are not estimated, since the closures differ by more than the discretisation error.
    resolution = case.numerics.resolution
    seated = seated_model(case)
    paper = solve(replace(case, model=seated), resolution, states)
    direct = solve(replace(case, model=PushThrough(wetted)), resolution, states)
    pressures: dict[str, float | None] = dict.fromkeys(CLOSURES)
    pressures |= {"derived": paper.pressure, EXACT: direct.pressure}
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
    # The loaded states were solved with the ground matrix, so that the radii of the series must be
    # converted to pressures with the ground matrix as well.
    fitted = Closure(far_field_law(case, ground=True), series.start, series)
    pressures["series"] = balance_pressure(contact, fitted)
    return replace(found, series=series, opening_curve=curve)


def seated_model(case: Case) -> SeatedBalance:
    """Return the paper's model with the seating and far field of a case and the closure of Eq. 15.

    Raises
    ------
    BadInput
        The model of the case is not the paper's.
    """
    model = case.model
    if not isinstance(model, SeatedBalance):
        raise BadInput("model", model.NAME, "'paper', whose seated state is compared")
    return SeatedBalance(
        model.seating, model.seating_friction, far_field_ground=model.far_field_ground
    )


@dataclass(frozen=True)
class ClosureJob:
    """The job that compares the closures for one case.

    Attributes
    ----------
    case, order, wetted
        Arguments of `closures`.
    """

    case: Case
    order: int = SERIES_ORDER.default
    wetted: bool = False

    def run(self, cache_folder: Path | None) -> ClosureComparison:
        """Return the result of `closures`."""
        states = state_solver(cache_folder)
        return closures(self.case, self.order, states, wetted=self.wetted)


@dataclass(frozen=True)
class ClosureMap:
    """The study that compares the closures for many cases.

    Attributes
    ----------
    cases : sequence of Case
        Cases of the paper's model; the outcome is a list in their order.
    order, wetted
        Arguments of `closures`.
    """

    cases: Sequence[Case]
    order: int = SERIES_ORDER.default
    wetted: bool = False

    def jobs(self) -> list[ClosureJob]:
        """Return one job for each case."""
        return [ClosureJob(case, self.order, self.wetted) for case in self.cases]

    def reduce(self, results: Results) -> list[ClosureComparison]:
        """Return the comparisons in the order of the cases."""
        return [results[job] for job in self.jobs()]


def _once(cautions: Sequence[Caution]) -> tuple[Caution, ...]:
    """Return each caution once, without those that say that no error was estimated."""
    return tuple(dict.fromkeys(c for c in cautions if c.code != "error_not_estimated"))


def _by_energy(direct: Answer, states: StateSolver, *, wetted: bool) -> float | None:
    """Return the pressure P in Pa with I(P) = D(P), or None if it cannot be computed.

    I is the energy that the far field releases per unit advance of the stone, and D is the work of
    friction per unit advance. D is interpolated between two loaded states near the direct answer.
    """
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
