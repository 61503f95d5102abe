"""Construction of a surrogate of the direct model: solve the cases, fit the functions of p."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Float
from stonepass.errors import BadInput
from stonepass.model.answer import Answer
from stonepass.model.case import Case
from stonepass.model.load import Load
from stonepass.model.numerics import Numerics
from stonepass.studies.case_solver import CaseSolver
from stonepass.studies.conditions import Conditions, case_at
from stonepass.studies.surrogates.box import Box, Setting
from stonepass.studies.surrogates.buckling_limit import stable_loads
from stonepass.studies.surrogates.claimed_error import FLOOR, claimed_error
from stonepass.studies.surrogates.domain import Domain
from stonepass.studies.surrogates.held_functions import HIGHEST, HeldFunctions
from stonepass.studies.surrogates.held_stone import HeldStone
from stonepass.studies.surrogates.learnt import half_width
from stonepass.studies.surrogates.origin import origin
from stonepass.studies.surrogates.polynomial import SparsePolynomial
from stonepass.studies.surrogates.regression import FEWEST, fit_known, joined
from stonepass.studies.surrogates.solved import MOVES
from stonepass.studies.surrogates.surrogate import Surrogate

__all__ = ["build_held_stone"]

NEARLY_NONE = 1e-4  # friction coefficient of the cases that stand for no friction
FREE, GENTLE, PUSHED = 384, 96, 448  # number of cases of the three levels
GENTLER = 0.3  # factor on the friction of the second level
# Numbers of cases of the levels whose leak pressure is computed too; that takes several times as
# long.
FREE_LEAKS, GENTLE_LEAKS, PUSHED_LEAKS = 160, 32, 128
BASE, BASE_TOTAL = (20, 16, 0, 0), 20  # degrees of the functions without friction
CHANGE, CHANGE_TOTAL = (8, 8, 8), 8  # degrees of what the pressure changes
MOST_LOST = 0.05  # largest fraction of cases without an answer

Values = Float[np.ndarray, "n functions"]


@array_dataclass
@dataclass(frozen=True)
class _Cases:
    """Solved cases: conditions, answers, and p with the functions at p."""

    at: Setting
    answers: list[Answer]
    values: Values


def build_held_stone(case: Case, box: Box, solver: CaseSolver, effort: float) -> Surrogate:
    """Build a surrogate of the direct model; for parameters see `build.build_surrogate`.

    Three levels of cases are solved: nearly without friction, with little friction, and with the
    friction of the box. Cases of the third level whose pressure would be above the largest one of a
    surrogate, by the fit to the second level, are left out.

    Raises
    ------
    BadInput
        The case has a load, or too many cases have no answer.

    References
    ----------
    docs/surrogates.md, "The direct model".
    """
    if case.load != Load():
        raise BadInput("confining pressure", "given", "0 for a surrogate of the direct model")
    quick = replace(case, numerics=Numerics("fast", case.numerics.half_length))
    domain, physics = Domain(box, stable_loads(case, box.wall_ratio)), HeldStone()

    def count(number: int) -> int:
        return max(FEWEST, round(effort * number))

    def solved(asked: Conditions, leaks: int) -> _Cases:
        """Solve cases; with an error estimate the model computes the leak pressure too."""
        cases = [case_at(quick, asked, k) for k in range(len(asked.friction))]
        answers = [*solver.answers(cases[:leaks]), *solver.answers(cases[leaks:], error=False)]
        at = domain.setting(quick, asked)
        return _Cases(at, answers, physics.learnt(quick, at, answers))

    asked = domain.training(quick, count(FREE))
    nearly = np.full(len(asked.friction), NEARLY_NONE)
    free = solved(replace(asked, friction=nearly), count(FREE_LEAKS))
    base = _base(free)

    gentle = count(GENTLE)
    asked = domain.training(quick, gentle + count(PUSHED))
    first = np.arange(len(asked.friction)) < gentle
    little = asked.where(first)
    second = solved(replace(little, friction=GENTLER * little.friction), count(GENTLE_LEAKS))
    functions, _ = _with_changes(base, second)

    rest = asked.where(~first)
    at = domain.setting(quick, rest)
    below = physics.solve(quick, at, functions(at)).outcome == MOVES
    third = solved(rest.where(below), count(PUSHED_LEAKS))
    _refuse_lost([*free.answers, *second.answers, *third.answers])
    both = _Cases(second.at.joined(third.at), [*second.answers, *third.answers],
                   np.concatenate([second.values, third.values]))  # fmt: skip
    learnt, left_out = _with_changes(base, both)
    error = _claimed(quick, physics, learnt, both, left_out)
    about = origin(case, [(quick, each.answers) for each in (free, second, third)])
    return Surrogate(case, box, physics, learnt, error, FLOOR, domain.stable, None, about)


def _base(free: _Cases) -> SparsePolynomial:
    """Fit ln((π/2 − α)/root) and the functions of p without friction."""
    _, *functions = free.values.T
    widths = np.log(functions[1])
    return joined([
        fit_known(free.at.unit, each, BASE, BASE_TOTAL).polynomial
        for each in (widths, *functions)
    ])  # fmt: skip


def _with_changes(base: SparsePolynomial, solved: _Cases) -> tuple[HeldFunctions, Values]:
    """Fit what the pressure changes in all functions; return leave-one-out errors too."""
    at, p = solved.at, solved.values[:, 0]
    without = base(at.unit)
    points = np.stack([half_width(at, without), at.unit[:, 1], p / HIGHEST], axis=1)
    rest = solved.values[:, 1:] - without[:, 1:]
    rest[~(p <= HIGHEST)] = np.nan  # beyond the largest pressure of a surrogate, or unknown
    fits = [fit_known(points, each, CHANGE, CHANGE_TOTAL, p) for each in rest.T]
    functions = HeldFunctions(base, joined([each.polynomial for each in fits]))
    return functions, np.stack([each.left_out for each in fits], axis=1)


def _claimed(
    case: Case, physics: HeldStone, learnt: HeldFunctions, solved: _Cases, left_out: Values
) -> SparsePolynomial:
    """Return the claimed error from the leave-one-out errors of ln h."""
    known = np.isfinite(left_out[:, 0])
    at = solved.at.where(known)
    coefficients = learnt(at)
    coefficients[:, 0] += left_out[known, 0]
    true = np.array([each.pressure for each in solved.answers], dtype=float)[known]
    return claimed_error(at.unit, physics.solve(case, at, coefficients).pressure, true)


def _refuse_lost(answers: Sequence[Answer]) -> None:
    """Raise BadInput if too many cases have no answer."""
    lost = [each.reason for each in answers if each.pressure is None]
    if len(lost) > MOST_LOST * len(answers):
        raise BadInput(
            "number of cases of the box without an answer", f"{len(lost)} of {len(answers)}",
            f"at most {100.0 * MOST_LOST:g} %",
            f"make the box smaller; the first reason is: {lost[0]}",
        )  # fmt: skip
