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
    """The critical pressure of a case at every size ratio.

    The outcome is a list of answers in the order of the size ratios. They keep their states
    without the stress field, which a curve does not need.

    Attributes
    ----------
    case : Case
        Its own size is ignored.
    size_ratios : sequence of float
        ξ, each within the bounds of `model.case.Stone`.
    """

    case: Case
    size_ratios: Sequence[float]

    def jobs(self) -> list[PressureJob]:
        """Return one job for each size ratio."""
        return [PressureJob(self.case.with_size_ratio(float(each))) for each in self.size_ratios]

    def reduce(self, results: Results) -> list[Answer]:
        """Return the answers in the order of the size ratios."""
        return [results[job] for job in self.jobs()]
