"""Blocks of cases: what a worker is sent, and what it returns."""

from __future__ import annotations

import time
from collections import Counter
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from stonepass.errors import StonepassError
from stonepass.studies.solution_cache import default_folder
from stonepass.studies.source_digest import solver_digest
from stonepass.studies.sweeps.case_rows import Row, lost_row, solved_row
from stonepass.studies.sweeps.plan import Sweep
from stonepass.studies.sweeps.shards import schema_of, shard_of

__all__ = ["Block", "Task", "case_seconds", "lost_block", "this_solver"]


@dataclass(frozen=True)
class Task:
    """A range of cases that is sent to a worker.

    Attributes
    ----------
    plan : Sweep
        The plan, or the part of it that the cases need.
    start, stop : int
        Range of indices; `stop` is excluded.
    solver : str
        Digest of the solver that the results must come from.
    seconds : float
        Time in s after which the worker returns the cases it has finished.
    least : int
        Number of cases that it finishes in any case.
    """

    plan: Sweep
    start: int
    stop: int
    solver: str
    seconds: float
    least: int

    def run(self) -> Block:
        """Solve the cases, or as many first ones as the time allows.

        Raises
        ------
        StonepassError
            The solver of this process is another one.
        """
        if this_solver() != self.solver:
            raise StonepassError(
                "a worker has another version of stonepass or of its numerical libraries than the "
                "process that sends the cases: install the same versions on all machines."
            )
        started = time.perf_counter()
        rows: list[Row] = []
        for inputs in self.plan.block(self.start, self.stop):
            rows.append(solved_row(inputs))
            if len(rows) >= self.least and time.perf_counter() - started >= self.seconds:
                break
        return _packed(self.plan, rows, time.perf_counter() - started)


@dataclass(frozen=True)
class Block:
    """The results of a range of cases.

    Attributes
    ----------
    start, stop : int
        Range of indices; `stop` is excluded.
    content : bytes
        The parquet file of its rows.
    columns : tuple of (str, str)
        Names and types of its columns.
    counts : tuple of (str, str, int)
        Number of rows by model and outcome.
    seconds : float
        Time in s in which the cases were solved.
    """

    start: int
    stop: int
    content: bytes
    columns: tuple[tuple[str, str], ...]
    counts: tuple[tuple[str, str, int], ...]
    seconds: float


def lost_block(plan: Sweep, index: int) -> Block:
    """Return the block of a case that ended the process which solved it."""
    return _packed(plan, [lost_row(plan.case(index))], 0.0)


def case_seconds(plan: Sweep, indices: list[int], most: float) -> list[float]:
    """Measure the times in s that some cases take.

    Parameters
    ----------
    plan : Sweep
        The plan.
    indices : list of int
        The cases. The first one is solved twice, because the libraries are loaded with it.
    most : float
        Time in s after which no further case is begun.
    """
    begun, found = time.perf_counter(), []
    for inputs in map(plan.case, [indices[0], *indices]):
        started = time.perf_counter()
        solved_row(inputs)
        found.append(time.perf_counter() - started)
        if len(found) > 1 and time.perf_counter() - begun > most:
            break
    return found[1:]


@lru_cache(maxsize=1)
def this_solver() -> str:
    """Return the digest of the solver of this process."""
    return solver_digest(default_folder() / "sources")


def _packed(plan: Sweep, rows: list[Row], seconds: float) -> Block:
    columns = schema_of(plan, rows)
    counts = Counter((row["model"], row["outcome"]) for row in rows)
    return Block(
        start=rows[0]["index"],
        stop=rows[-1]["index"] + 1,
        content=shard_of(rows, columns),
        columns=tuple(columns.items()),
        counts=tuple((*key, count) for key, count in sorted(counts.items())),
        seconds=seconds,
    )


def run_task(task: Task) -> Any:
    """Run a task; a function of its own, because executors are sent functions."""
    return task.run()
