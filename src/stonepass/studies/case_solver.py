"""The interface to solvers of many cases, which fits and response surfaces use."""

from __future__ import annotations

from collections.abc import Sequence
from concurrent.futures import Executor
from dataclasses import dataclass
from pathlib import Path
from typing import Protocol, runtime_checkable

from stonepass.model.answer import Answer
from stonepass.model.case import Case
from stonepass.studies.jobs import PressureJob, Progress, run_jobs

__all__ = ["CaseSolver", "JobSolver"]


@runtime_checkable
class CaseSolver(Protocol):
    """A solver of the critical pressures of many cases."""

    def answers(self, cases: Sequence[Case], *, error: bool = True) -> list[Answer]:
        """Return the answer of every case, in the order of the cases.

        Parameters
        ----------
        cases : sequence of Case
            Cases to be solved.
        error : bool
            Whether the discretisation error is estimated too, which needs a second solve per case.
        """


@dataclass(frozen=True)
class JobSolver:
    """A solver that runs one job for each case.

    Attributes
    ----------
    executor : concurrent.futures.Executor or None
        Where the jobs run; None for this process.
    cache_folder : Path or None
        Folder of the solution cache; None for no cache.
    progress : callable or None
        Function that is called with (done, all) after each job.
    """

    executor: Executor | None = None
    cache_folder: Path | None = None
    progress: Progress | None = None

    def answers(self, cases: Sequence[Case], *, error: bool = True) -> list[Answer]:
        """Return the answer of every case, in the order of the cases; equal cases are solved once.

        Parameters
        ----------
        cases : sequence of Case
            Cases to be solved.
        error : bool
            Whether the discretisation error is estimated too.
        """
        jobs = [PressureJob(case, error=error) for case in cases]
        results = run_jobs(jobs, self.executor, self.cache_folder, self.progress)
        return [results[job] for job in jobs]
