"""The interface to what a sensitivity study evaluates: outcomes and values for many inputs.

An evaluator is a function of arrays of inputs. It may solve the cases with finite elements, ask a
surrogate, or interpolate the results of a sweep. The indices do not depend on which of them it is.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol, runtime_checkable

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Int
from stonepass.errors import Outcome
from stonepass.studies.sensitivity.uncertain_case import Inputs

__all__ = [
    "BAD_INPUT",
    "OUTCOMES",
    "OUTSIDE",
    "Evaluations",
    "Evaluator",
    "evaluations",
    "outcome_fractions",
    "outcome_name",
]

OUTCOMES: tuple[Outcome, ...] = tuple(Outcome)
# Codes of inputs that have no outcome of a calculation, and their names in results.
BAD_INPUT, OUTSIDE = -1, -2
_NAMES = {BAD_INPUT: "BAD_INPUT", OUTSIDE: "OUTSIDE"}


@array_dataclass
@dataclass(frozen=True)
class Evaluations:
    """Outcomes and values of n cases.

    Attributes
    ----------
    outcome : array (n) of int
        Index of the outcome in `OUTCOMES`, `BAD_INPUT` for inputs that describe no case that can be
        solved, or `OUTSIDE` for a case outside the range of a surrogate or of a sweep.
    value : masked array (n)
        Critical pressure in Pa, or critical size ratio; masked where there is none.
    lower_bound : masked array (n)
        Lower bound of a value that does not exist, e.g. the pressure at the end of the closure;
        masked where no bound is known.
    reason : str
        The most frequent reason why inputs describe no possible case; empty if all of them do.
    error : float or None
        Largest stated error of a value of a surrogate or of an interpolation, in the unit of the
        values; None for solved cases.
    """

    outcome: Int[np.ndarray, " n"]
    value: np.ma.MaskedArray
    lower_bound: np.ma.MaskedArray
    reason: str = ""
    error: float | None = None


@runtime_checkable
class Evaluator(Protocol):
    """A function that evaluates many cases at once."""

    @property
    def source(self) -> str:
        """Origin of the values in words, e.g. "finite elements"."""

    def __call__(self, inputs: Inputs) -> Evaluations:
        """Return the critical pressures.

        Parameters
        ----------
        inputs : mapping of str to array (n)
            Values of every uncertain input by key, in SI units.
        """

    def critical_sizes(self, inputs: Inputs, limit: float) -> Evaluations:
        """Return the critical size ratios.

        Parameters
        ----------
        inputs : mapping of str to array (n)
            Values of every uncertain input by key, in SI units. The size of the stone is ignored.
        limit : float
            Pressure limit in Pa.
        """


def evaluations(
    outcomes: Sequence[Outcome | None],
    values: Sequence[float | None],
    lower_bounds: Sequence[float | None],
    reason: str = "",
) -> Evaluations:
    """Make evaluations from the results of n cases.

    Parameters
    ----------
    outcomes : sequence of Outcome or None
        None stands for inputs that describe no possible case.
    values, lower_bounds : sequence of float or None
        None stands for a number that does not exist.
    reason : str
        The most frequent reason why inputs describe no possible case.
    """
    codes = [BAD_INPUT if each is None else OUTCOMES.index(each) for each in outcomes]
    return Evaluations(np.array(codes, dtype=int), _masked(values), _masked(lower_bounds), reason)


def outcome_name(code: int) -> str:
    """Return the name of an outcome by its code."""
    return _NAMES[code] if code in _NAMES else OUTCOMES[code].name


def outcome_fractions(found: Evaluations) -> tuple[tuple[str, float], ...]:
    """Return the fraction of each outcome that occurs, by its name, in descending order."""
    counts = Counter(found.outcome.tolist())
    return tuple(
        (outcome_name(code), count / len(found.outcome)) for code, count in counts.most_common()
    )


def _masked(values: Sequence[float | None]) -> np.ma.MaskedArray:
    missing = [each is None for each in values]
    return np.ma.MaskedArray([0.0 if each is None else each for each in values], missing, float)
