"""Jobs, the units of work of a study, and functions that run them.

A job can run in any executor, with or without a solution cache. This module does not load the
finite elements, so that a scheduler can import it, make jobs and send them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import Any, Protocol, TypeVar, runtime_checkable

from stonepass.model.answer import Answer
from stonepass.model.case import Case
from stonepass.model.critical import solve
from stonepass.model.size import SizeAnswer, critical_size
from stonepass.model.states.state_solver import StateSolver
from stonepass.model.states.uncached import UNCACHED
from stonepass.studies.executor import executor_for, stream
from stonepass.studies.solution_cache import SolutionCache
from stonepass.units import Pressure

__all__ = [
    "Job",
    "PressureJob",
    "Progress",
    "Results",
    "SizeJob",
    "iterate_jobs",
    "run_jobs",
    "state_solver",
]

Progress = Callable[[int, int], None]
Found = TypeVar("Found")
Found_co = TypeVar("Found_co", covariant=True)


@runtime_checkable
class Job(Protocol[Found_co]):
    """A unit of work that one process does.

    A job is hashable, and equal jobs have the same result. A job can be pickled unless it contains
    a user's own function; its result can always be pickled.
    """

    def run(self, cache_folder: Path | None) -> Found_co:
        """Return the result; `cache_folder` is the folder of the solution cache, or None."""


@dataclass(frozen=True)
class PressureJob:
    """The job that computes the critical pressure of a case.

    Attributes
    ----------
    case : Case
        The case to be solved.
    wall : bool
        True if the answer keeps the stress field of its state.
    error : bool
        True if the discretisation error is estimated, which needs a second, coarser solve.
    """

    case: Case
    wall: bool = False
    error: bool = True

    def fuller(self) -> list[PressureJob]:
        """Return the other jobs whose answers include the answer of this job, cheapest first."""
        others = (PressureJob(self.case, *more) for more in ((False, True), (True, True)))
        return [job for job in others if job.wall >= self.wall and job.error >= self.error
                and job != self]  # fmt: skip

    def run(self, cache_folder: Path | None) -> Answer:
        """Return the answer of `model.critical.solve`."""
        alone = None if self.error else self.case.numerics.resolution
        answer = solve(self.case, alone, state_solver(cache_folder, walls=self.wall))
        return answer if self.wall else answer.without_wall()


@dataclass(frozen=True)
class SizeJob:
    """The job that computes the critical size at a pressure limit.

    Attributes
    ----------
    case : Case
        The case; the size of its own stone is ignored.
    limit : Pressure
        Pressure limit in Pa, above 0.
    """

    case: Case
    limit: Pressure

    def run(self, cache_folder: Path | None) -> SizeAnswer:
        """Return the answer of `model.size.critical_size`, without its stress field."""
        found = critical_size(self.case, self.limit, states=state_solver(cache_folder))
        return replace(
            found, at_size=None if found.at_size is None else found.at_size.without_wall()
        )


@dataclass(frozen=True)
class Results:
    """The results of jobs.

    Attributes
    ----------
    by_job : mapping of Job to result
        The result of each job.
    """

    by_job: Mapping[Job[Any], Any]

    def __getitem__(self, job: Job[Found]) -> Found:
        """Return the result of a job, or of another job whose result includes it."""
        return self.by_job[self._serving(job)]

    @property
    def pressures(self) -> dict[PressureJob, Answer]:
        """The answers of all pressure jobs."""
        return {job: each for job, each in self.by_job.items() if isinstance(job, PressureJob)}

    @property
    def sizes(self) -> dict[SizeJob, SizeAnswer]:
        """The answers of all size jobs."""
        return {job: each for job, each in self.by_job.items() if isinstance(job, SizeJob)}

    def answer(self, case: Case, *, wall: bool = False, error: bool = True) -> Answer:
        """Return the answer of a `PressureJob` with these attributes.

        Parameters
        ----------
        case : Case
            The solved case.
        wall : bool
            True if the answer must have its stress field.
        error : bool
            True if the answer must have an error estimate.
        """
        return self[PressureJob(case, wall, error)]

    def size(self, case: Case, limit: Pressure) -> SizeAnswer:
        """Return the answer of a `SizeJob` with these attributes.

        Parameters
        ----------
        case : Case
            The solved case.
        limit : Pressure
            Pressure limit in Pa.
        """
        return self[SizeJob(case, limit)]

    def of(self, jobs: Iterable[Job[Any]]) -> Results:
        """Return the results of a part of the jobs."""
        serving = dict.fromkeys(map(self._serving, jobs))
        return Results({job: self.by_job[job] for job in serving})

    def _serving(self, job: Job[Any]) -> Job[Any]:
        return next(each for each in (job, *_fuller(job)) if each in self.by_job)


def iterate_jobs(
    jobs: Iterable[Job[Found]],
    executor: Executor | None = None,
    cache_folder: Path | None = None,
    progress: Progress | None = None,
) -> Iterator[tuple[Job[Found], Found]]:
    """Run every job once and yield (job, result) as the results arrive.

    Parameters
    ----------
    jobs : iterable of Job
        Equal jobs are run once, and a job is left out if the result of another one includes its
        result.
    executor : concurrent.futures.Executor, optional
        Where the jobs run. By default, and for jobs that cannot be pickled, they run in this
        process.
    cache_folder : Path, optional
        Folder of the solution cache; by default there is no cache.
    progress : callable, optional
        Function that is called with (done, all) after each job.

    Raises
    ------
    Exception
        An error that a job raises is passed on.

    Warns
    -----
    CacheWarning
        The cache folder cannot be written, or it contained a damaged result.
    """
    # Jobs other than pressure jobs take several solves each, so that they are started first.
    queue = sorted(_once(jobs), key=lambda job: isinstance(job, PressureJob))
    results = stream(executor_for(queue, executor), partial(_run, cache_folder=cache_folder), queue)
    for done, (index, found) in enumerate(results, start=1):
        if progress is not None:
            progress(done, len(queue))
        yield queue[index], found


def run_jobs(
    jobs: Iterable[Job[Any]],
    executor: Executor | None = None,
    cache_folder: Path | None = None,
    progress: Progress | None = None,
) -> Results:
    """Run every job once and return all results.

    Parameters
    ----------
    jobs, executor, cache_folder, progress
        As for `iterate_jobs`.
    """
    listed = list(jobs)
    found = dict(iterate_jobs(listed, executor, cache_folder, progress))
    return Results({job: found[job] for job in _once(listed)})


def state_solver(cache_folder: Path | None, *, walls: bool = False) -> StateSolver:
    """Return the solver of finite-element states that a job uses.

    Parameters
    ----------
    cache_folder : Path or None
        Folder of the solution cache; None for a solver without a cache.
    walls : bool
        True if the cache stores the stress fields of the states. Without a cache the states always
        have their stress fields.
    """
    if cache_folder is None:
        return UNCACHED
    return SolutionCache(cache_folder, walls=walls)


def _run(job: Job[Found], cache_folder: Path | None) -> Found:
    return job.run(cache_folder)


def _fuller(job: Job[Any]) -> Sequence[Job[Any]]:
    return job.fuller() if isinstance(job, PressureJob) else ()


def _once(jobs: Iterable[Job[Found]]) -> list[Job[Found]]:
    """Return each job once, without jobs whose answer is included in that of another job."""
    listed = dict.fromkeys(jobs)
    return [job for job in listed if not any(other in listed for other in _fuller(job))]
