"""The critical pressure: checks that do not depend on the model, and the solution by the model."""

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
    """Compute the urine pressure at which a stone starts to move.

    Parameters
    ----------
    stone : Stone or Case
        The stone; or a complete case, which then replaces all arguments except `states`.
    ureter : Ureter
        The ureter; required unless the first argument is a case.
    load : Load, optional
        Confining pressure and pre-stretch; none by default.
    model : Model, optional
        `SeatedBalance` (the paper's model, the default), `PushThrough` or `ElasticFoundation`.
    numerics : Numerics, optional
        Accuracy of the solution and length of the tube.
    states : StateSolver, optional
        Source of the finite-element states, e.g. a `SolutionCache`; by default they are solved.

    Returns
    -------
    Answer
        Its attribute `pressure` is P_ucr in Pa, or None if P_ucr does not exist; its `outcome` and
        `reason` then say why.

    Raises
    ------
    BadInput
        An argument is missing, out of bounds, of the wrong type, or given in addition to a case; or
        the model does not apply to the case.
    UnstableLaw
        The material law is not stable.

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
        raise BadInput("ureter", "missing", "given in addition to the stone", remedy)
    case = Case(stone, ureter, load or Load(), model or SeatedBalance(), numerics or Numerics())
    return solve(case, states=states)


def refuse_parts(**parts: Any) -> None:
    """Refuse arguments that are given in addition to a case, because the case contains them.

    Parameters
    ----------
    **parts
        Values of the arguments by name; None stands for an argument that is not given.

    Raises
    ------
    Misplaced
        One of the arguments is given.
    """
    given = next((name for name, value in parts.items() if value is not None), None)
    if given is not None:
        remedy = "change the case, e.g. with dataclasses.replace"
        raise Misplaced(given, "a Case", "is part of the case", remedy)


def solve(
    case: Case, resolution: Resolution | None = None, states: StateSolver = UNCACHED
) -> Answer:
    """Compute the critical pressure of a case.

    Parameters
    ----------
    case : Case
        The problem, the model and the numerics.
    resolution : Resolution, optional
        Resolution of a single solve without an error estimate. By default both resolutions of the
        accuracy level are solved, and the error is estimated from their difference.
    states : StateSolver, optional
        Source of the finite-element states; by default they are solved.

    Returns
    -------
    Answer
        If no critical pressure exists, its `outcome` and `reason` say why.

    Raises
    ------
    BadInput
        `case` is not a `Case`, or the model does not apply to it.
    UnstableLaw
        The material law is not stable.
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
