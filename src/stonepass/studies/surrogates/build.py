"""Construction of a surrogate: solve the cases of all levels, fit the functions, claim an error."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import chain

import numpy as np

from stonepass.array_types import Float
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
from stonepass.studies.surrogates.levels import FitLevel, levels_for
from stonepass.studies.surrogates.origin import origin
from stonepass.studies.surrogates.polynomial import SparsePolynomial
from stonepass.studies.surrogates.refinement import least_certain_cases
from stonepass.studies.surrogates.regression import fit_polynomial, joined
from stonepass.studies.surrogates.seated_contact import SeatedContact
from stonepass.studies.surrogates.solved_cases import LearntCases
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
    levels = levels_for(case, effort)
    asked = [domain.training(level.case, level.count) for level in levels]
    answers = [_answers(level, at, solver) for level, at in zip(levels, asked, strict=True)]
    _refuse_unsolved(list(chain(*answers)))
    physics = SeatedContact.fitted_to(list(chain(*answers)))

    def solved(level: FitLevel, at: Conditions, found: list[Answer]) -> LearntCases:
        setting = domain.setting(level.case, at)
        return LearntCases(setting, found, physics.learnt(case, setting, found))

    learnt: LearntFunctions | None = None
    fitted = []
    for level, at, found in zip(levels, asked, answers, strict=True):
        cases = solved(level, at, found)
        if level.refined:
            more = _least_certain(case, domain, physics, learnt, level, cases)
            cases = cases.joined(solved(level, more, _answers(level, more, solver)))
        learnt, left_out = _corrected(learnt, level, cases)
        fitted.append((level, cases, left_out))
    assert learnt is not None
    _, cases, left_out = fitted[-1]  # this level has the model and options of the surrogate
    return Surrogate(
        case,
        box,
        physics,
        learnt,
        _claimed(case, physics, cases, left_out),
        FLOOR,
        domain.stable,
        fit_lumen(case, box) if case.load != Load() else None,
        origin(case, [(level.case, cases.answers) for level, cases, _ in fitted]),
    )


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


def _answers(level: FitLevel, at: Conditions, solver: CaseSolver) -> list[Answer]:
    cases = [case_at(level.case, at, k) for k in range(len(at.friction))]
    return solver.answers(cases, error=False)


def _least_certain(
    case: Case,
    domain: Domain,
    physics: SeatedContact,
    before: LearntFunctions | None,
    level: FitLevel,
    solved: LearntCases,
) -> Conditions:
    """Return the conditions of a level at which the surrogate is least certain."""

    def pressures(half: slice, there: Setting) -> Float[np.ndarray, " m"]:
        """Return P_ucr by a fit to a part of the cases."""
        fitted, _ = _corrected(before, level, solved.part(half))
        found: Float[np.ndarray, " m"] = physics.solve(case, there, fitted(there)).pressure
        return found

    return least_certain_cases(domain, case, pressures, level.refined, level.candidates)


def _corrected(
    before: LearntFunctions | None, level: FitLevel, solved: LearntCases
) -> tuple[LearntFunctions, Float[np.ndarray, "n functions"]]:
    """Fit what earlier levels leave over; return all levels together and leave-one-out errors."""
    at, values = solved.at, solved.values
    rest = values if before is None else values - before(at)
    points = at.unit if before is None else before.by_width(at)
    factor = None if before is None else at.conditions.friction
    fits = [fit_polynomial(points, each, level.degrees, level.total, factor) for each in rest.T]
    added = joined([each.polynomial for each in fits])
    learnt = LearntFunctions(added) if before is None else before.corrected(added)
    return learnt, np.stack([each.left_out for each in fits], axis=1)


def _claimed(
    case: Case,
    physics: SeatedContact,
    solved: LearntCases,
    left_out: Float[np.ndarray, "n functions"],
) -> SparsePolynomial:
    """Return the logarithm of the claimed relative error of P_ucr, from leave-one-out errors."""
    whole = np.isfinite(solved.values[:, :-1]).all(axis=1)
    at = solved.at.where(whole)
    shifted = np.where(np.isfinite(left_out), solved.values + left_out, 0.0)[whole]
    found = physics.solve(case, at, shifted).pressure
    return claimed_error(at.unit, found, solved.pressures[whole])
