"""Critical pressure over a range of size ratios."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from stonepass.model.answer import Answer
from stonepass.model.case import Case
from stonepass.studies.jobs import PressureJob, Results

__all__ = ["Curve"]


@dataclass(frozen=True)
class Curve:
    """The study of the critical pressure of a case at several size ratios.

    The outcome is a list of answers in the order of the size ratios, without stress fields.

    Attributes
    ----------
    case : Case
        The case; the size of its own stone is ignored.
    size_ratios : sequence of float
        Size ratios ξ, each from 0.1 to 3.
    """

    case: Case
    size_ratios: Sequence[float]

    def jobs(self) -> list[PressureJob]:
        """Return one job for each size ratio."""
        return [PressureJob(self.case.with_size_ratio(float(each))) for each in self.size_ratios]

    def reduce(self, results: Results) -> list[Answer]:
        """Return the answers in the order of the size ratios."""
        return [results[job] for job in self.jobs()]
