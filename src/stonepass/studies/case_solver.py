"""Whoever answers many cases at a time: fits and response surfaces ask this interface."""

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
    """A source of critical pressures."""

    def answers(self, cases: Sequence[Case], *, error: bool = True) -> list[Answer]:
        """Return the answer of every case; without `error` its estimate may be left out."""


@dataclass(frozen=True)
class JobSolver:
    """Answers cases by jobs; see `studies.jobs.iterate_jobs` for the attributes."""

    executor: Executor | None = None
    cache_folder: Path | None = None
    progress: Progress | None = None

    def answers(self, cases: Sequence[Case], *, error: bool = True) -> list[Answer]:
        """Return the answer of every case; equal cases are solved once."""
        jobs = [PressureJob(case, error=error) for case in cases]
        results = run_jobs(jobs, self.executor, self.cache_folder, self.progress)
        return [results[job] for job in jobs]
