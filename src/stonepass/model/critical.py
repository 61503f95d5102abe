"""The critical pressure: which model answers, and what can be said before any does."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

from stonepass.errors import Outcome
from stonepass.materials.stability import check
from stonepass.model.answer import Answer, unanswered
from stonepass.model.case import Case, Load, Method, Stone, Ureter
from stonepass.model.far_field import lumen_ratio
from stonepass.model.states.state_solver import StateSolver

if TYPE_CHECKING:  # loads the finite elements
    from stonepass.fe.axisymmetric.problem import Resolution

__all__ = ["SMALLEST_OVERSIZE", "critical_pressure", "solve"]

SMALLEST_OVERSIZE = 1e-4  # of a stone over the lumen that is held by more than a touch
# Each model loads what it needs when it is first asked: the beam needs no finite elements.
MODELS = {
    "paper": ("models.seated_balance", "solve_by_balance"),
    "direct": ("models.push_through", "solve_by_push"),
    "beam": ("models.elastic_foundation", "solve_by_beam"),
}


def critical_pressure(
    stone: Stone,
    ureter: Ureter,
    load: Load | None = None,
    method: Method | None = None,
) -> Answer:
    """At what urine pressure does this stone move in this ureter?

    Parameters
    ----------
    stone, ureter : Stone, Ureter
    load : Load, optional
        Confining pressure and pre-stretch; none by default.
    method : Method, optional
        Model, seating, half-length and switches; the paper's by default.

    Examples
    --------
    >>> import stonepass as sp
    >>> answer = sp.critical_pressure(sp.Stone(size_ratio=0.9), sp.Ureter(wall_ratio=1.5))
    >>> answer.outcome.name, answer.pressure
    ('LOOSE', 0.0)
    """
    return solve(Case(stone, ureter, load or Load(), method or Method()))


def solve(
    case: Case, resolution: Resolution | None = None, states: StateSolver | None = None
) -> Answer:
    """Answer one case; every way it can end is an `Outcome` (model: section 6).

    With a `resolution` the finite elements use that mesh alone, and no error is estimated.
    `states` says where their results come from (`studies.solution_cache`); by default they are
    solved.
    """
    check(case.ureter.material)
    lumen = lumen_ratio(case.wall_ratio, case.ureter.material.law, case.load)
    if lumen is None:
        reason = "the load closes the lumen, or no uniform tube of this law is in equilibrium"
        return unanswered(case, Outcome.NO_SOLUTION, reason)
    if case.size_ratio <= lumen:
        return Answer(case, Outcome.LOOSE, Outcome.LOOSE.value, pressure=0.0)
    with_elements = case.method.model != "beam"
    if with_elements and case.size_ratio < lumen * (1.0 + SMALLEST_OVERSIZE):
        reason = (
            f"the stone exceeds the lumen by less than {SMALLEST_OVERSIZE:.0e} of it, "
            "which is below what the finite elements resolve"
        )
        return unanswered(case, Outcome.NO_SOLUTION, reason)
    module, function = MODELS[case.method.model]
    by_model = getattr(import_module(f"stonepass.model.{module}"), function)
    given = {} if states is None else {"states": states}
    answer: Answer = by_model(case, resolution, **given) if with_elements else by_model(case)
    return answer
