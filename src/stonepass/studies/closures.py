"""One stone by every closure: the paper's, a fitted series, energy, and the direct model."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import as_completed
from dataclasses import dataclass, replace
from typing import Any

from stonepass.errors import Outcome, require
from stonepass.model.accuracy import LEVELS
from stonepass.model.answer import Answer
from stonepass.model.case import Case
from stonepass.model.closure import ORDER, Series
from stonepass.model.critical import solve
from stonepass.model.energy_balance import advance_force
from stonepass.model.models.seated_balance import balance_pressure, with_whole_law
from stonepass.model.opening_curve import OpeningCurve
from stonepass.model.states.loaded import PushedState, push_along
from stonepass.model.states.opening import series_through, solve_opening_curve
from stonepass.studies.executor import can_travel, executor
from stonepass.units import Pressure

__all__ = ["CLOSURES", "ClosureComparison", "closure_map", "compare_closures"]

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


@dataclass(frozen=True)
class ClosureComparison:
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
    warnings : tuple of str
        Of the paper's model and of the direct one, and why a closure has no pressure.
    series : Series or None
        The fitted one.
    pairs : OpeningCurve or None
        α and r_a/R_a of the direct states it was fitted to.
    """

    case: Case
    pressures: dict[str, float | None]
    outcome: Outcome
    message: str
    warnings: tuple[str, ...] = ()
    series: Series | None = None
    pairs: OpeningCurve | None = None

    def error(self, name: str) -> float | None:
        """P_ucr by the closure `name` over that of the direct model, less 1; None without one."""
        found, direct = self.pressures[name], self.pressures["direct"]
        return None if found is None or not direct else found / direct - 1.0


def compare_closures(case: Case, order: int = SERIES_ORDER) -> ClosureComparison:
    """Answer one case by every closure.

    The seated contact pressure is that of the case's seating for the paper's closures and the
    series; the loaded one for energy and direct.
    """
    require(ORDER[0] <= order <= ORDER[1], "order", order, f"{ORDER[0]} to {ORDER[1]}")
    # No errors are estimated: closures differ by more.
    resolution = LEVELS[case.method.accuracy].resolution
    chosen = {
        "as_printed": False,
        "closure_start": "inner-radius",
        "closure": "linear",
        "pairs": None,
    }
    paper = solve(_by(case, model="paper", **chosen), resolution)
    direct = solve(_by(case, model="direct"), resolution)
    pressures: dict[str, float | None] = dict.fromkeys(CLOSURES)
    pressures |= {"derived": paper.pressure, "direct": direct.pressure}
    pressures["energy"] = _by_energy(direct)
    lost = () if paper.outcome.answered else (f"{paper.outcome.name} by Eq. 15: {paper.message}",)
    warnings = _said_once([*paper.warnings, *direct.warnings, *lost])
    found = ClosureComparison(paper.case, pressures, direct.outcome, direct.message, warnings)
    if paper.seated is None:
        return found
    printed = replace(paper.seated, case=_by(paper.case, as_printed=True))
    pressures["printed"] = balance_pressure(printed)
    pairs = solve_opening_curve(case)
    series = None if pairs is None else series_through(case, pairs, order)
    if pairs is None or series is None:
        return found
    pressures["series"] = balance_pressure(with_whole_law(paper.seated), series)
    return replace(found, series=series, pairs=pairs)


def closure_map(
    cases: Sequence[Case],
    progress: Callable[[int, int], None] | None = None,
    workers: int = 1,
    order: int = SERIES_ORDER,
) -> list[ClosureComparison]:
    """Compare the closures for many cases; `progress` is told (done, all) after each."""
    with executor(workers if can_travel(list(cases)) else 1) as pool:
        futures = [pool.submit(compare_closures, case, order) for case in cases]
        for done, _ in enumerate(as_completed(futures), start=1):
            if progress is not None:
                progress(done, len(cases))
        return [future.result() for future in futures]


def _said_once(sentences: Sequence[str]) -> tuple[str, ...]:
    """Each sentence once; that no error is estimated is our own choice here."""
    return tuple(dict.fromkeys(s for s in sentences if not s.startswith("the error is not")))


def _by(case: Case, **changed: Any) -> Case:
    """The case by another method."""
    method = case.method.by(changed.pop("model", case.method.model))
    return replace(case, method=replace(method, **changed))


def _by_energy(direct: Answer) -> float | None:
    """The root of I(P) = D(P), D of two loaded states around the direct answer."""
    if direct.pressure is None or direct.pressure == 0.0:
        return direct.pressure
    near = [Pressure(direct.pressure * (1.0 + s * NEAR)) for s in (-1.0, 1.0)]
    states = push_along(direct.case, near, LEVELS["fast"].resolution)
    excess = []
    for state in states:
        if not isinstance(state, PushedState):
            return None
        gained = advance_force(direct.case, state.urine_pressure)
        if gained is None:
            return None
        excess.append(gained - state.friction_work)
    low, high = excess
    return float(near[0] - low * (near[1] - near[0]) / (high - low))
