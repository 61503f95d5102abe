"""Solved cases that a surrogate is fitted to."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Bool, Float
from stonepass.model.answer import Answer
from stonepass.studies.surrogates.box import Setting

__all__ = ["LearntCases"]


@array_dataclass
@dataclass(frozen=True)
class LearntCases:
    """Cases with their answers and the values that a surrogate learns from them.

    Attributes
    ----------
    at : Setting
        The conditions of the cases, and their coordinates in the box.
    answers : list of Answer
    values : array (n, functions)
        Values of the learnt functions, NaN where an answer does not determine them.
    """

    at: Setting
    answers: list[Answer]
    values: Float[np.ndarray, "n functions"]

    @property
    def pressures(self) -> Float[np.ndarray, " n"]:
        """Critical pressures in Pa; NaN where there is none."""
        return np.array([each.pressure for each in self.answers], dtype=float)

    def joined(self, other: LearntCases) -> LearntCases:
        """Return the cases of both."""
        return LearntCases(
            self.at.joined(other.at),
            [*self.answers, *other.answers],
            np.concatenate([self.values, other.values]),
        )

    def part(self, rows: slice) -> LearntCases:
        """Return some of the cases."""
        chosen: Bool[np.ndarray, " n"] = np.zeros(len(self.answers), dtype=bool)
        chosen[rows] = True
        return LearntCases(self.at.where(chosen), self.answers[rows], self.values[rows])
