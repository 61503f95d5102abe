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
from stonepass.studies.progress import reported

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
            True if the discretisation error is estimated too, which needs a second solve per case.
        """


@dataclass(frozen=True)
class JobSolver:
    """A case solver that runs one job for each case.

    Attributes
    ----------
    executor : concurrent.futures.Executor, optional
        Where the jobs run, e.g. the executor of `process_pool`; by default in this process.
    cache_folder : Path, optional
        Folder of the solution cache; by default there is no cache.
    progress : bool or callable
        True shows a progress bar in a terminal and in a notebook. A function is called with
        (done, all) after each job.
    """

    executor: Executor | None = None
    cache_folder: Path | None = None
    progress: bool | Progress = False

    def answers(self, cases: Sequence[Case], *, error: bool = True) -> list[Answer]:
        """Return the answer of every case, in the order of the cases; equal cases are solved once.

        Parameters
        ----------
        cases : sequence of Case
            Cases to be solved.
        error : bool
            True if the discretisation error is estimated too.
        """
        jobs = [PressureJob(case, error=error) for case in cases]
        with reported(self.progress, "cases") as told:
            results = run_jobs(jobs, self.executor, self.cache_folder, told)
        return [results[job] for job in jobs]
