"""Evaluation of a sensitivity study by solving every case, with finite elements or the beam."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Generic, TypeVar

from stonepass.errors import BadInput, Outcome
from stonepass.model.answer import Answer
from stonepass.model.case import Case
from stonepass.model.size import SizeAnswer
from stonepass.studies.jobs import Job, PressureJob, Progress, SizeJob, run_jobs
from stonepass.studies.progress import reported
from stonepass.studies.sensitivity.evaluator import Evaluations, evaluations
from stonepass.studies.sensitivity.uncertain_case import Inputs, UncertainCase
from stonepass.units import Pressure

__all__ = ["CaseEvaluator", "Refusal", "TriedJob"]

Found = TypeVar("Found")


@dataclass(frozen=True)
class CaseEvaluator:
    """An evaluator that solves every case; equal cases are solved once.

    Attributes
    ----------
    uncertain : UncertainCase
        The case with its uncertain inputs.
    executor : concurrent.futures.Executor, optional
        Where the cases are solved; by default in this process.
    cache_folder : Path, optional
        Folder of the solution cache; by default there is no cache.
    progress : bool or callable
        True shows a progress bar. A function is called with (done, all) after each case.
    """

    uncertain: UncertainCase
    executor: Executor | None = None
    cache_folder: Path | None = None
    progress: bool | Progress = False

    @property
    def source(self) -> str:
        """Origin of the values in words."""
        model = self.uncertain.median_case.model
        how = "finite elements" if model.NEEDS_ELEMENTS else "equations"
        return f"{how} of the model '{model.NAME}'"

    def __call__(self, inputs: Inputs) -> Evaluations:
        """Return the critical pressures; for the parameters see `Evaluator`."""
        found = self._results(inputs, lambda case: PressureJob(case, error=False), "cases")
        return _evaluations(found, lambda answer: answer.pressure, _least)

    def critical_sizes(self, inputs: Inputs, limit: float) -> Evaluations:
        """Return the critical size ratios; for the parameters see `Evaluator`."""
        bound = Pressure(limit)
        found = self._results(inputs, lambda case: SizeJob(case, bound), "critical sizes")
        return _evaluations(found, lambda answer: answer.size_ratio, _least_size)

    def _results(
        self, inputs: Inputs, job_of: Callable[[Case], Job[Found]], what: str
    ) -> list[Found | Refusal]:
        """Return the result of every case; equal cases are solved once."""
        rows = zip(*(values.tolist() for values in inputs.values()), strict=True)
        asked = [self._job(dict(zip(inputs, row, strict=True)), job_of) for row in rows]
        jobs = [each for each in asked if not isinstance(each, Refusal)]
        with reported(self.progress, what) as told:
            results = run_jobs(jobs, self.executor, self.cache_folder, told)
        return [each if isinstance(each, Refusal) else results[each] for each in asked]

    def _job(
        self, values: dict[str, float], job_of: Callable[[Case], Job[Found]]
    ) -> TriedJob[Found] | Refusal:
        try:
            return TriedJob(job_of(self.uncertain.case(values)))
        except BadInput as problem:
            return Refusal(str(problem))


@dataclass(frozen=True)
class Refusal:
    """The refusal of inputs that describe no case that the model can solve.

    Attributes
    ----------
    reason : str
        The refusal as a sentence.
    """

    reason: str


@dataclass(frozen=True)
class TriedJob(Generic[Found]):
    """A job whose result is a refusal if its case is refused, e.g. because its law is unstable.

    Attributes
    ----------
    job : Job
        The job that is tried.
    """

    job: Job[Found]

    def run(self, cache_folder: Path | None) -> Found | Refusal:
        """Return the result of the job, or a refusal."""
        try:
            return self.job.run(cache_folder)
        except BadInput as problem:
            return Refusal(str(problem))


def _evaluations(
    results: Sequence[Any],
    value: Callable[[Any], float | None],
    lower_bound: Callable[[Any], float | None],
) -> Evaluations:
    """Make evaluations from answers and refusals."""
    solved = [None if isinstance(each, Refusal) else each for each in results]
    reasons = Counter(each.reason for each in results if isinstance(each, Refusal))
    return evaluations(
        [None if each is None else each.outcome for each in solved],
        [None if each is None else value(each) for each in solved],
        [None if each is None else lower_bound(each) for each in solved],
        reasons.most_common(1)[0][0] if reasons else "",
    )


def _least(answer: Answer) -> float | None:
    """Return a pressure in Pa up to which the stone is known to be held, if it has no P_ucr."""
    if answer.pressure is not None:
        return None
    if answer.outcome is Outcome.BEYOND_CLOSURE:
        return answer.closure_end_pressure
    leak: float | None = getattr(answer.detail, "leak_pressure", None)
    return leak if answer.outcome is Outcome.LEAKS else None


def _least_size(found: SizeAnswer) -> float | None:
    """Return a size ratio at which the critical pressure is still below the limit."""
    if found.outcome is Outcome.BEYOND_RANGE and found.at_size is not None:
        return found.at_size.case.size_ratio
    return None
