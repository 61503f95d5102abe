"""Construction of a surrogate: solve the cases of all levels, fit the functions, claim an error."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Bool, Float
from stonepass.errors import BadInput
from stonepass.model.answer import Answer
from stonepass.model.case import Case
from stonepass.model.load import Load
from stonepass.model.models.push_through import PushThrough
from stonepass.model.models.seated_balance import SeatedBalance
from stonepass.studies.case_solver import CaseSolver, JobSolver
from stonepass.studies.conditions import Conditions, case_at
from stonepass.studies.surrogates.box import (
    Box,
    Setting,
    fit_lumen,
)
from stonepass.studies.surrogates.buckling_limit import stable_loads
from stonepass.studies.surrogates.build_held import build_held_stone
from stonepass.studies.surrogates.claimed_error import FLOOR, claimed_error
from stonepass.studies.surrogates.domain import Domain
from stonepass.studies.surrogates.learnt import LearntFunctions
from stonepass.studies.surrogates.levels import Level, levels_for
from stonepass.studies.surrogates.origin import origin
from stonepass.studies.surrogates.polynomial import SparsePolynomial
from stonepass.studies.surrogates.refinement import least_certain_cases
from stonepass.studies.surrogates.regression import fit_polynomial, joined
from stonepass.studies.surrogates.seated_contact import SeatedContact
from stonepass.studies.surrogates.surrogate import Surrogate

__all__ = ["build_surrogate"]


def build_surrogate(
    case: Case, box: Box | None = None, solver: CaseSolver | None = None, effort: float = 1.0
) -> Surrogate:
    """Build a surrogate of the answers to a case over a box of inputs.

    Parameters
    ----------
    case : Case
        Material, load, model and numerics. The confining pressure is the largest one of the box.
        Size, wall and friction of the case do not matter.
    box : Box, optional
        The range of the inputs; by default ξ from the lumen to 1.6, η 1.1 to 4, μ 0 to 1.
    solver : CaseSolver, optional
        Solves several hundred cases without error estimates; by default in this process.
    effort : float
        Factor on the number of cases, above 0.

    Raises
    ------
    BadInput
        The model has no surrogate, or too few cases have an answer.

    References
    ----------
    docs/surrogates.md, "How a surrogate is built".
    """
    box, solver = box or Box(), solver or JobSolver(progress=True)
    if isinstance(case.model, PushThrough):
        return build_held_stone(case, box, solver, effort)
    _refuse(case)
    domain = Domain(box, stable_loads(case, box.wall_ratio))
    solved = [_solve(level, domain, solver) for level in levels_for(case, effort)]
    everything = [each for level in solved for each in level.answers]
    _refuse_unsolved(everything)
    physics = SeatedContact.fitted_to(everything)
    learnt: LearntFunctions | None = None
    left_out = []
    for first in solved:
        level = _refined(case, domain, physics, learnt, first, solver)
        values = physics.learnt(case, level.at, level.answers)
        learnt, left = _corrected(learnt, level, values)
        left_out.append((level, values, left))
    assert learnt is not None
    error = _claimed(case, physics, left_out)
    return Surrogate(
        case,
        box,
        physics,
        learnt,
        error,
        FLOOR,
        domain.stable,
        fit_lumen(case, box) if case.load != Load() else None,
        origin(case, [(each.level.case, each.answers) for each, _, _ in left_out]),
    )


@array_dataclass
@dataclass(frozen=True)
class _Solved:
    """The cases of a level and their answers."""

    level: Level
    at: Setting
    answers: list[Answer]


def _refuse(case: Case) -> None:
    """Raise BadInput if the model, one of its options, or the stone has no surrogate."""
    model = case.model
    if not isinstance(model, SeatedBalance):
        raise BadInput("model", model.NAME, "'paper' or 'direct'; other models have no surrogates")
    if model.closure != "linear" or model.closure_start != "inner-radius":
        raise BadInput("closure", f"{model.closure} from {model.closure_start}",
                       "linear from inner-radius, which is the default")  # fmt: skip
    if not case.stone.shape.symmetric:
        raise BadInput("shape", "not symmetric", "a stone whose halves are mirror images")


def _refuse_unsolved(answers: Sequence[Answer]) -> None:
    """Raise BadInput if some cases of the box have no seated state: there is nothing to learn."""
    lost = [each.reason for each in answers if each.contact is None]
    if lost:
        raise BadInput(
            "number of cases of the box without a seated state", f"{len(lost)} of {len(answers)}",
            "0", f"make the box smaller; the first reason is: {lost[0]}",
        )  # fmt: skip


def _solve(level: Level, domain: Domain, solver: CaseSolver) -> _Solved:
    return _solved_at(level, domain, domain.training(level.case, level.count), solver)


def _solved_at(level: Level, domain: Domain, at: Conditions, solver: CaseSolver) -> _Solved:
    cases = [case_at(level.case, at, k) for k in range(len(at.friction))]
    return _Solved(level, domain.setting(level.case, at), solver.answers(cases, error=False))


def _refined(
    case: Case,
    domain: Domain,
    physics: SeatedContact,
    before: LearntFunctions | None,
    level: _Solved,
    solver: CaseSolver,
) -> _Solved:
    """Return a level with further cases where the surrogate is least certain."""
    if level.level.refined == 0:
        return level
    values = physics.learnt(case, level.at, level.answers)

    def pressures(half: slice, there: Setting) -> Float[np.ndarray, " m"]:
        part = _Solved(level.level, level.at.where(_chosen(level, half)), level.answers[half])
        fitted, _ = _corrected(before, part, values[half])
        found: Float[np.ndarray, " m"] = physics.solve(case, there, fitted(there)).pressure
        return found

    added = least_certain_cases(domain, case, pressures, level.level.refined)
    more = _solved_at(level.level, domain, added, solver)
    return _Solved(level.level, level.at.joined(more.at), [*level.answers, *more.answers])


def _chosen(level: _Solved, part: slice) -> Bool[np.ndarray, " n"]:
    found = np.zeros(len(level.answers), dtype=bool)
    found[part] = True
    return found


def _corrected(
    before: LearntFunctions | None, level: _Solved, values: Float[np.ndarray, "n functions"]
) -> tuple[LearntFunctions, Float[np.ndarray, "n functions"]]:
    """Fit what earlier levels leave over; return all levels together and leave-one-out errors."""
    rest = values if before is None else values - before(level.at)
    points = level.at.unit if before is None else before.by_width(level.at)
    factor = None if before is None else level.at.conditions.friction
    degrees, total = level.level.degrees, level.level.total
    fits = [fit_polynomial(points, each, degrees, total, factor) for each in rest.T]
    added = joined([each.polynomial for each in fits])
    learnt = LearntFunctions(added) if before is None else before.corrected(added)
    return learnt, np.stack([each.left_out for each in fits], axis=1)


def _claimed(
    case: Case, physics: SeatedContact, left_out: Sequence[tuple[_Solved, Any, Any]]
) -> SparsePolynomial:
    """Return the logarithm of the claimed relative error of P_ucr, from leave-one-out errors.

    The cases of the last level count, which have the model and the options of the surrogate.
    """
    level, values, left = left_out[-1]
    whole = np.isfinite(values[:, :-1]).all(axis=1)
    at, true = level.at.where(whole), np.array([_number(a) for a in level.answers])[whole]
    shifted = np.where(np.isfinite(left), values + left, 0.0)[whole]
    return claimed_error(at.unit, physics.solve(case, at, shifted).pressure, true)


def _number(answer: Answer) -> float:
    return np.nan if answer.pressure is None else answer.pressure
