"""The contract of a study: the jobs that it needs, and the reduction of their results.

A new study needs a frozen dataclass in a file of its own, and one line in `studies.registry`
(docs/developing.md, "Add a study").
"""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import Executor
from pathlib import Path
from typing import Any, Protocol, TypeVar, runtime_checkable

from stonepass.studies.executor import executor_for
from stonepass.studies.jobs import Job, Progress, Results, run_jobs
from stonepass.studies.progress import reported

__all__ = ["Study", "run_studies", "run_study"]

Outcome = TypeVar("Outcome")
Outcome_co = TypeVar("Outcome_co", covariant=True)


@runtime_checkable
class Study(Protocol[Outcome_co]):
    """A calculation that needs the results of many jobs.

    A study solves nothing itself. It lists the jobs, which may run anywhere and in any order, and
    computes its outcome from their results alone.

    Examples
    --------
    This study finds the largest of some stones that is not stuck:

    >>> from dataclasses import dataclass
    >>> import stonepass as sp
    >>> from stonepass.studies.jobs import PressureJob
    >>> @dataclass(frozen=True)
    ... class LargestLoose:
    ...     size_ratios: tuple[float, ...]
    ...
    ...     def jobs(self):
    ...         ureter = sp.Ureter(wall_ratio=1.5)
    ...         stones = [sp.Stone(size_ratio=each) for each in self.size_ratios]
    ...         return [PressureJob(sp.Case(stone, ureter)) for stone in stones]
    ...
    ...     def reduce(self, results):
    ...         answers = [results[job] for job in self.jobs()]
    ...         loose = [each for each in answers if each.outcome is sp.Outcome.LOOSE]
    ...         return max(each.case.size_ratio for each in loose)
    >>> run_study(LargestLoose((0.7, 0.9, 0.8)))
    0.9
    """

    def jobs(self) -> Sequence[Job[Any]]:
        """Return the jobs that the study needs, in the same order each time."""

    def reduce(self, results: Results) -> Outcome_co:
        """Return the outcome; `results` contains the results of all jobs of the study."""


def run_study(
    study: Study[Outcome],
    executor: Executor | None = None,
    cache_folder: Path | None = None,
    progress: bool | Progress = False,
) -> Outcome:
    """Run the jobs of a study and return its outcome.

    Parameters
    ----------
    study : Study
        The study to be run.
    executor : concurrent.futures.Executor, optional
        Where the jobs run; by default in this process.
    cache_folder : Path, optional
        Folder of the solution cache; by default there is no cache.
    progress : bool or callable
        True shows a progress bar in a terminal and in a notebook. A function is called with
        (done, all) after each job.

    Raises
    ------
    Exception
        An error that a job raises is passed on.

    Warns
    -----
    CacheWarning
        The cache folder cannot be written, or it contained a damaged result.
    """
    with reported(progress, "jobs") as told:
        return study.reduce(run_jobs(study.jobs(), executor, cache_folder, told))


def run_studies(
    studies: Sequence[Study[Outcome]],
    executor: Executor | None = None,
    cache_folder: Path | None = None,
    progress: Progress | None = None,
) -> list[Outcome]:
    """Run several studies together and return their outcomes in the same order.

    Jobs that several studies need run once, and the reductions run in parallel.

    Parameters
    ----------
    studies : sequence of Study
        The studies to be run.
    executor, cache_folder
        As for `run_study`.
    progress : callable, optional
        Function that is called with (done, all) after each job.
    """
    jobs = [list(study.jobs()) for study in studies]
    results = run_jobs((job for each in jobs for job in each), executor, cache_folder, progress)
    parts = [results.of(each) for each in jobs]
    pool = executor_for((list(studies), parts), executor)
    futures = [pool.submit(study.reduce, part) for study, part in zip(studies, parts, strict=True)]
    return [future.result() for future in futures]
