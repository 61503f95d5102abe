"""Comparison of a surrogate with solved cases that were not used to build it."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np

from stonepass.array_types import Float
from stonepass.errors import BadInput, Outcome
from stonepass.model.answer import Answer
from stonepass.studies.case_solver import CaseSolver
from stonepass.studies.conditions import Conditions, case_at
from stonepass.studies.surrogates.box import HELD_OUT
from stonepass.studies.surrogates.claimed_error import NONE
from stonepass.studies.surrogates.domain import POOL
from stonepass.studies.surrogates.held_stone import balanced
from stonepass.studies.surrogates.solved import NO_SOLUTION, OUTCOMES
from stonepass.studies.surrogates.surrogate import Surrogate

__all__ = ["HeldOut", "check_surrogate", "compare", "with_check"]

CASES = 300  # number of cases of a check
MOST = POOL - HELD_OUT  # number of cases that are left to checks


@dataclass(frozen=True)
class HeldOut:
    """Errors of a surrogate, measured with cases that were not used to build it.

    Attributes
    ----------
    cases : int
        Number of solved cases.
    compared : int
        Number of cases for which both the surrogate and the model have a P_ucr.
    same_outcome : int
        Number of cases with the same outcome.
    largest, typical : float
        Largest and root-mean-square error of P_ucr relative to the model. A difference of up to 10
        Pa counts as none.
    percentile_95 : float
        Relative error that 95 % of the compared cases do not exceed, counted alike.
    within : float
        Fraction of the compared cases whose difference is within the claimed error.
    """

    cases: int
    compared: int
    same_outcome: int
    largest: float
    typical: float
    percentile_95: float
    within: float


def check_surrogate(surrogate: Surrogate, solver: CaseSolver, count: int = CASES) -> HeldOut:
    """Solve cases that were not used to build a surrogate, and compare.

    Parameters
    ----------
    surrogate : Surrogate
    solver : CaseSolver
        Solves the cases with the numerics of the surrogate, without error estimates.
    count : int
        Number of cases, 1 to 1024.

    Raises
    ------
    BadInput
        The number of cases is out of bounds, or none of them can be compared.
    """
    if not 1 <= count <= MOST:
        raise BadInput("number of cases", count, f"1 to {MOST}")
    asked = _covered(surrogate, count)
    cases = [case_at(surrogate.case, asked, k) for k in range(len(asked.friction))]
    return compare(surrogate, asked, solver.answers(cases, error=False))


def _covered(surrogate: Surrogate, count: int) -> Conditions:
    """Return held-out conditions that the surrogate covers.

    A surrogate of the direct model does not cover large pressures, so that more are drawn.
    """
    drawn = surrogate.box.sample(surrogate.case, surrogate.stable, min(2 * count, MOST), HELD_OUT)
    covered = surrogate.solve(drawn).outcome != NO_SOLUTION
    return drawn.where(covered & (np.cumsum(covered) <= count))


def compare(surrogate: Surrogate, asked: Conditions, answers: list[Answer]) -> HeldOut:
    """Compare a surrogate with the answers of a model.

    Parameters
    ----------
    surrogate : Surrogate
    asked : Conditions
        The n conditions of the answers.
    answers : list of Answer
        The n answers of the model.

    Raises
    ------
    BadInput
        No case has a P_ucr by both.
    """
    found = surrogate.solve(asked)
    true = np.array([_pressure(each) for each in answers])
    known = np.isfinite(true) & np.isfinite(found.pressure) & (true > 0.0)
    if not known.any():
        raise BadInput("number of cases that can be compared", 0, "at least 1", "solve more cases")
    off = np.abs(found.pressure - true)[known]
    relative = _relative(off, true[known])
    outcomes = [OUTCOMES[k] for k in found.outcome]
    same = sum(one is _of_surrogate(each) for one, each in zip(outcomes, answers, strict=True))
    return HeldOut(
        cases=len(answers),
        compared=int(known.sum()),
        same_outcome=same,
        largest=float(relative.max()),
        typical=float(np.sqrt(np.mean(relative**2))),
        percentile_95=float(np.quantile(relative, 0.95)),
        within=float(np.mean(off <= found.quantities["error"][known])),
    )


def with_check(surrogate: Surrogate, found: HeldOut) -> Surrogate:
    """Return a surrogate that remembers the result of a check."""
    about: Mapping[str, Any] = {**surrogate.about, "check": asdict(found)}
    return replace(surrogate, about=about)


def _pressure(answer: Answer) -> float:
    """Return P_ucr in Pa; NaN if there is none, or if the answer does not keep its own balance."""
    if answer.pressure is None or not balanced(answer):
        return np.nan
    return answer.pressure


def _relative(
    off: Float[np.ndarray, " n"], true: Float[np.ndarray, " n"]
) -> Float[np.ndarray, " n"]:
    return np.where(off <= NONE, 0.0, off / true)


def _of_surrogate(answer: Answer) -> Outcome:
    return answer.outcome if answer.outcome in OUTCOMES else Outcome.NO_SOLUTION
