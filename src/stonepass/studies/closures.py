"""One stone by every closure: the paper's, a fitted series, energy, and the direct model."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import as_completed
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from jaxtyping import Float

from stonepass.errors import Outcome, require
from stonepass.model.accuracy import LEVELS
from stonepass.model.advance import advance_force, opened_radius, opening_pressure
from stonepass.model.case import Case
from stonepass.model.closure import fit_series, series_closure
from stonepass.model.critical import Answer, balance_pressure, solve
from stonepass.model.push_through import PushedState, push_along
from stonepass.studies.executor import can_travel, executor
from stonepass.units import Pressure

__all__ = ["CLOSURES", "ClosureComparison", "closure_map", "compare_closures", "opening_pairs"]

# Names at the door, and what they say.
CLOSURES = {
    "derived": "Eq. 15, Eq. 5 with the derived sign",
    "printed": "Eq. 15, Eq. 5 as printed",
    "series": "series of Eqs 13–14, fitted to direct states",
    "energy": "energy: I(P) = D",
    "direct": "direct push-through",
}
SERIES_ORDER, PAIRS = 3, 13
ORDERS = (1, 8)
LAST_PAIR = 0.95  # of the pressure that opens the tube to R_s
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
    coefficients : array or None
        Of the series (`model.closure.series_closure`).
    pairs : (array, array) or None
        α in rad and r_a/R_a of the direct states the series was fitted to.
    """

    case: Case
    pressures: dict[str, float | None]
    outcome: Outcome
    message: str
    warnings: tuple[str, ...] = ()
    coefficients: Float[np.ndarray, " order"] | None = None
    pairs: tuple[Float[np.ndarray, " n"], Float[np.ndarray, " n"]] | None = None

    def error(self, name: str) -> float | None:
        """P_ucr by the closure `name` over that of the direct model, less 1; None without one."""
        found, direct = self.pressures[name], self.pressures["direct"]
        return None if found is None or not direct else found / direct - 1.0


def compare_closures(case: Case, order: int = SERIES_ORDER) -> ClosureComparison:
    """Answer one case by every closure.

    The seated contact pressure is that of the case's seating for the paper's closures and the
    series; the loaded one for energy and direct.
    """
    require(ORDERS[0] <= order <= ORDERS[1], "order", order, f"{ORDERS[0]} to {ORDERS[1]}")
    # No errors are estimated: closures differ by more.
    resolution = LEVELS[case.method.accuracy].resolution
    chosen = {"as_printed": False, "closure_start": "inner-radius"}
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
    pairs = opening_pairs(case)
    if pairs is None or len(pairs[0]) <= order:
        return found
    alpha, radius = pairs
    start = float(radius[0])
    first, *width = case.stone.shape.width(alpha)
    coefficients = fit_series(np.array(width), radius[1:], first, case.size_ratio, order, start)
    # Back to a pressure by the law that the pairs are of, so that each pair gives its own.
    whole = replace(paper.seated, case=_by(paper.case, far_field_ground=True))
    pressures["series"] = balance_pressure(
        whole, lambda rho, rho0, xi: series_closure(rho, rho0, xi, coefficients, start)
    )
    return replace(found, coefficients=coefficients, pairs=pairs)


def opening_pairs(
    case: Case,
) -> tuple[Float[np.ndarray, " pairs"], Float[np.ndarray, " pairs"]] | None:
    """α and r_a/R_a of frictionless direct states with rising P_u, from P_u = 0 on, α up to 90°.

    Without friction, because the series begins at the seated stone, as the wall opens then. None
    where no such states are found.
    """
    bare = _by(case.with_friction(0.0), model="direct")
    rising = LAST_PAIR * opening_pressure(case) * np.linspace(0.0, 1.0, PAIRS)
    states = push_along(bare, [Pressure(float(p)) for p in rising], LEVELS["fast"].resolution)
    kept = [s for s in states if isinstance(s, PushedState) and s.contact_angle <= np.pi / 2]
    if not kept:
        return None
    radii = [opened_radius(case, s.urine_pressure) for s in kept]
    pairs = [(s.contact_angle, r) for s, r in zip(kept, radii, strict=True) if r is not None]
    return np.array([alpha for alpha, _ in pairs]), np.array([r for _, r in pairs])


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
    return replace(case, method=replace(case.method, **changed))


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
