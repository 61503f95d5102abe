"""The critical pressure: what can be said before any model answers, and the model's answer."""

from __future__ import annotations

from typing import Any

from stonepass.errors import BadInput, Misplaced, Outcome
from stonepass.fe.axisymmetric.problem import Resolution
from stonepass.materials.stability import check
from stonepass.model.answer import Answer, Model, unanswered
from stonepass.model.case import Case
from stonepass.model.far_field import lumen_ratio
from stonepass.model.load import Load
from stonepass.model.models.seated_balance import SeatedBalance
from stonepass.model.numerics import Numerics
from stonepass.model.problem import require_kind
from stonepass.model.states.state_solver import StateSolver
from stonepass.model.states.uncached import UNCACHED
from stonepass.model.stone import Stone
from stonepass.model.ureter import Ureter

__all__ = ["SMALLEST_RESOLVED_OVERSIZE", "critical_pressure", "refuse_parts", "solve"]

# Finite elements do not resolve a stone that exceeds the lumen by less than this fraction of it.
SMALLEST_RESOLVED_OVERSIZE = 1e-4


def critical_pressure(
    stone: Stone | Case,
    ureter: Ureter | None = None,
    load: Load | None = None,
    model: Model | None = None,
    numerics: Numerics | None = None,
    *,
    states: StateSolver = UNCACHED,
) -> Answer:
    """Find the urine pressure at which a stone starts to move.

    Parameters
    ----------
    stone : Stone or Case
        A case contains everything that follows, apart from `states`.
    ureter : Ureter
        Required beside a stone.
    load : Load, optional
        Confining pressure and pre-stretch; none by default.
    model : Model, optional
        `SeatedBalance` (the paper's, the default), `PushThrough` or `ElasticFoundation`.
    numerics : Numerics, optional
        Accuracy and length of the tube.
    states : StateSolver, optional
        Where finite-element states come from: a `SolutionCache` reads and stores them; by default
        they are solved.

    Returns
    -------
    Answer
        Its `outcome` says how the question ended; `pressure` is P_ucr in Pa where there is one.

    Raises
    ------
    BadInput
        The parts do not go together, or the model is not made for such a case.
    UnstableLaw
        The material law describes no solid.

    Notes
    -----
    docs/theory.md, sections "Closure and critical state" and "The push-through, solved directly";
    Liu et al. 2022, Eqs 4 to 17.

    Examples
    --------
    >>> import stonepass as sp
    >>> answer = sp.critical_pressure(sp.Stone(size_ratio=0.9), sp.Ureter(wall_ratio=1.5))
    >>> answer.outcome.name, answer.pressure
    ('LOOSE', 0.0)
    """
    if isinstance(stone, Case):
        refuse_parts(ureter=ureter, load=load, model=model, numerics=numerics)
        return solve(stone, states=states)
    if ureter is None:
        remedy = "write critical_pressure(stone, ureter), or critical_pressure(case)"
        raise BadInput("ureter", "missing", "given beside the stone", remedy)
    case = Case(stone, ureter, load or Load(), model or SeatedBalance(), numerics or Numerics())
    return solve(case, states=states)


def refuse_parts(**parts: Any) -> None:
    """Refuse arguments that stand beside a case, which has them itself."""
    given = next((name for name, value in parts.items() if value is not None), None)
    if given is not None:
        remedy = "change the case, e.g. with dataclasses.replace"
        raise Misplaced(given, "a Case", "is part of the case", remedy)


def solve(
    case: Case, resolution: Resolution | None = None, states: StateSolver = UNCACHED
) -> Answer:
    """Answer one case; every way in which it can end is an `Outcome`.

    Parameters
    ----------
    case : Case
        The problem, the model and its numerics.
    resolution : Resolution, optional
        Solve on this mesh alone, without an estimate of the error.
    states : StateSolver, optional
        Where finite-element states come from; by default they are solved.

    Returns
    -------
    Answer

    Raises
    ------
    BadInput
        The model is not made for such a case.
    UnstableLaw
        The material law describes no solid.
    """
    require_kind("case", case, Case, "Case(stone, ureter)")
    check(case.ureter.material)
    lumen = lumen_ratio(case.wall_ratio, case.ureter.material.law, case.load)
    model, numerics = case.model, case.numerics
    if lumen is None:
        reason = "the load closes the lumen, or no uniform tube of this law is in equilibrium"
        return unanswered(case, model, numerics, reason)
    if case.size_ratio <= lumen:
        return Answer(case, model, numerics, Outcome.LOOSE, pressure=0.0)
    smallest = lumen * (1.0 + SMALLEST_RESOLVED_OVERSIZE)
    if model.NEEDS_ELEMENTS and case.size_ratio < smallest:
        reason = (
            f"the stone exceeds the lumen by less than {SMALLEST_RESOLVED_OVERSIZE:.0e} of it, "
            "which is below what the finite elements resolve"
        )
        return unanswered(case, model, numerics, reason)
    return model.solve(case, numerics, states, resolution)
