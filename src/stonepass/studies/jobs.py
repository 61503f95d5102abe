"""What figures and series need solved: each job once, in a pool, with a store behind it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import as_completed
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Protocol, runtime_checkable

from stonepass.io.folder import require_writable
from stonepass.model.accuracy import LEVELS
from stonepass.model.answer import Answer
from stonepass.model.case import Case
from stonepass.model.critical import solve
from stonepass.model.size import SizeAnswer, critical_size
from stonepass.studies.executor import can_travel, executor
from stonepass.studies.solution_cache import SolutionCache
from stonepass.units import Pressure

__all__ = ["Job", "PooledSolver", "PressureJob", "Results", "SizeJob", "Solver", "run_jobs"]


@dataclass(frozen=True)
class PressureJob:
    """The critical pressure of a case, with its stress field where `wall` says so.

    Without `error` the coarser companion is left out, and with it the estimate of the error.
    """

    case: Case
    wall: bool = False
    error: bool = True

    def fuller(self) -> list[PressureJob]:
        """Jobs whose answer says all that this one's does, and more; the least first."""
        others = (PressureJob(self.case, *more) for more in ((False, True), (True, True)))
        return [job for job in others if job.wall >= self.wall and job.error >= self.error
                and job != self]  # fmt: skip

    def run(self, folder: Path | None) -> Answer:
        """Solve it, or remember it from a folder."""
        states = None if folder is None else SolutionCache(folder, walls=self.wall)
        alone = None if self.error else LEVELS[self.case.method.accuracy].resolution
        answer = solve(self.case, alone, states)
        return answer if self.wall else answer.without_wall()


@dataclass(frozen=True)
class SizeJob:
    """The critical size of a case, whatever its own size, at a limit."""

    case: Case
    limit: Pressure

    def run(self, folder: Path | None) -> SizeAnswer:
        """Solve it, or remember it from a folder."""
        case = self.case
        found = critical_size(
            case.ureter,
            self.limit,
            case.stone.friction,
            case.load,
            case.method,
            shape=case.stone.shape,
            states=None if folder is None else SolutionCache(folder),
        )
        return replace(
            found, at_size=None if found.at_size is None else found.at_size.without_wall()
        )


Job = PressureJob | SizeJob


@dataclass(frozen=True)
class Results:
    """What the jobs came to."""

    pressures: dict[PressureJob, Answer]
    sizes: dict[SizeJob, SizeAnswer]

    def answer(self, case: Case, *, wall: bool = False, error: bool = True) -> Answer:
        """The answer of a case; one that says more serves for it."""
        return self.pressures[self._serving(PressureJob(case, wall, error))]

    def size(self, case: Case, limit: Pressure) -> SizeAnswer:
        """The critical size of a case."""
        return self.sizes[SizeJob(case, limit)]

    def of(self, jobs: Iterable[Job]) -> Results:
        """Those of some jobs only."""
        pressures, sizes = {}, {}
        for job in jobs:
            if isinstance(job, SizeJob):
                sizes[job] = self.sizes[job]
            else:
                serving = self._serving(job)
                pressures[serving] = self.pressures[serving]
        return Results(pressures, sizes)

    def _serving(self, job: PressureJob) -> PressureJob:
        return next(each for each in (job, *job.fuller()) if each in self.pressures)


def run_jobs(
    jobs: Iterable[Job],
    folder: Path | None,
    workers: int = 1,
    progress: Callable[[int, int], None] | None = None,
) -> Results:
    """Run every job once; `progress` is told (done, all) after each.

    Jobs that cannot be sent to another process (a user's own function) run in this one.
    """
    if folder is not None:
        require_writable(folder, "cache folder", "name another one, or none")
    once = _once(jobs)
    # Long ones first: sizes take several solves.
    queue = sorted(once, key=lambda job: isinstance(job, PressureJob))
    with executor(workers if can_travel(queue) else 1) as pool:
        futures = {job: pool.submit(job.run, folder) for job in queue}
        for done, _ in enumerate(as_completed(futures.values()), start=1):
            if progress is not None:
                progress(done, len(queue))
        found = {job: future.result() for job, future in futures.items()}
    pressures, sizes = {}, {}
    for job in once:
        answer = found[job]
        if isinstance(job, PressureJob):
            assert isinstance(answer, Answer)
            pressures[job] = answer
        else:
            assert isinstance(answer, SizeAnswer)
            sizes[job] = answer
    return Results(pressures, sizes)


def _once(jobs: Iterable[Job]) -> list[Job]:
    """Each job once, and none that another one covers."""
    listed = dict.fromkeys(jobs)
    return [
        job
        for job in listed
        if isinstance(job, SizeJob) or not any(other in listed for other in job.fuller())
    ]


@runtime_checkable
class Solver(Protocol):
    """Whoever answers many cases."""

    def answers(self, cases: Sequence[Case], *, error: bool = True) -> list[Answer]:
        """The answer of every case; without `error` the estimate of it may be left out."""


@dataclass(frozen=True)
class PooledSolver:
    """Where cases are solved: how many processes, what is remembered, who is told."""

    folder: Path | None = None
    workers: int = 1
    progress: Callable[[int, int], None] | None = None

    def answers(self, cases: Sequence[Case], *, error: bool = True) -> list[Answer]:
        """The answer of every case, each solved once."""
        jobs = [PressureJob(case, error=error) for case in cases]
        found = run_jobs(jobs, self.folder, self.workers, self.progress)
        return [found.answer(case, error=error) for case in cases]
