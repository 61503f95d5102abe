"""A sweep is run: its blocks are solved, stored as they are finished, and resumed after a stop."""

from __future__ import annotations

import sqlite3
from collections.abc import Callable, Iterator, Mapping
from concurrent.futures import Executor
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from stonepass.errors import BadInput, StonepassError, require
from stonepass.io.folder import require_writable
from stonepass.io.optional_imports import library
from stonepass.studies.jobs import Progress
from stonepass.studies.progress import reported
from stonepass.studies.sweeps.advice import DAYS, estimated, refuse_long
from stonepass.studies.sweeps.blocks import this_solver
from stonepass.studies.sweeps.case_rows import FAULTS, answered
from stonepass.studies.sweeps.dispatch import solved_blocks
from stonepass.studies.sweeps.ledger import (
    LEDGER,
    LOCK,
    Ledger,
    add,
    locked,
    new_ledger,
    opened,
    read_ledger,
    remove,
)
from stonepass.studies.sweeps.plan import Sweep
from stonepass.studies.sweeps.points_file import EXTRA
from stonepass.studies.sweeps.recovery import sound
from stonepass.studies.sweeps.results import SweepResults, read_results
from stonepass.studies.sweeps.shards import FOLDER, READ, shard_name, write_shard
from stonepass.studies.sweeps.sweep_file import read_sweep
from stonepass.studies.sweeps.workers import workers_of

__all__ = ["Standing", "SweepWords", "run_sweep", "sweep"]

# Beginnings of the names of the files that a sweep has in its folder.
OWN = (LEDGER, LOCK, FOLDER)


@dataclass(frozen=True)
class Standing:
    """How far a sweep is.

    Attributes
    ----------
    finished, cases : int
        Number of finished cases, including those of earlier runs, and number of all cases.
    unanswered : int
        Number of finished cases without an answer, including the faults.
    faults : int
        Number of finished cases in which the program or a worker process failed.
    """

    finished: int
    cases: int
    unanswered: int = 0
    faults: int = 0

    def plus(self, counts: tuple[tuple[str, str, int], ...], cases: int) -> Standing:
        """Return the standing after another block; `counts` are its rows by model and outcome."""
        lost = sum(n for _, outcome, n in counts if not answered(outcome))
        faults = sum(n for _, outcome, n in counts if outcome in FAULTS)
        return Standing(
            self.finished + cases, self.cases, self.unanswered + lost, self.faults + faults
        )


@dataclass(frozen=True)
class SweepWords:
    """The names of the arguments in messages, which are options on the command line."""

    folder: str = "folder"
    resume: str = "resume=True"
    max_days: str = "max_days ="


def sweep(
    study: str | Path | Mapping[str, Any] | Sweep,
    folder: str | Path,
    *,
    executor: Executor | None = None,
    workers: int | None = None,
    resume: bool = False,
    max_days: float = DAYS,
    block_cases: int | None = None,
    progress: bool | Progress = True,
) -> SweepResults:
    """Solve all cases of a study and store their results in a folder.

    Every case has one row, with its inputs, and with its answer or the reason why it has none. The
    results are written in blocks as they are finished. A study that was stopped, by whatever
    means, goes on with ``resume=True``; its results are then equal to those of an uninterrupted
    study.

    Parameters
    ----------
    study : str, Path, mapping or Sweep
        A study file, a dictionary of the same structure, or a plan.
    folder : str or Path
        Folder of the results, which is made if necessary.
    executor : concurrent.futures.Executor, optional
        Where the cases are solved, e.g. the executor of a Dask client; by default in this process
        or in `workers` processes.
    workers : int, optional
        Number of cases that are solved at the same time. Without an executor it is the number of
        processes, by default 1, which means this process.
    resume : bool
        True to go on with the study in the folder. A new study begins in a folder without results.
    max_days : float
        Longest expected duration in days that is accepted. The duration is measured by solving
        eight cases if there are 2000 cases or more.
    block_cases : int, optional
        Number of cases in each block. By default a block takes about two seconds.
    progress : bool or callable
        True shows a progress bar in a terminal and in a notebook. A function is called with
        (finished cases, all cases) after each block.

    Returns
    -------
    SweepResults
        The results, which are read from the folder when they are needed.

    Raises
    ------
    BadInput
        The study or an argument is invalid, the folder contains another study or cannot be written,
        or it has results and `resume` is False.
    StonepassError
        The sweep would take too long, another process writes to the folder, or the disk is full;
        the finished blocks are kept.

    References
    ----------
    docs/howto/sweep.md.

    Examples
    --------
    >>> import tempfile
    >>> import stonepass as sp
    >>> study = {
    ...     "ureter": {"wall_ratio": 1.3},
    ...     "method": {"model": "beam", "secant_stretch": 1.2},
    ...     "vary": {"stone.size_ratio": [1.05, 1.1], "stone.friction": [0.1, 0.3]},
    ... }
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     found = sp.sweep(study, folder)
    ...     found.to_frame().critical_pressure_kPa.round(1).tolist()
    [1.0, 2.8, 1.9, 5.3]
    """
    plan = study if isinstance(study, Sweep) else read_sweep(study)
    with reported(progress, "cases") as told:

        def tell(now: Standing) -> None:
            if told is not None:
                told(now.finished, now.cases)

        run_sweep(plan, Path(folder), executor=executor, workers=workers, resume=resume,
                  max_days=max_days, block_cases=block_cases, tell=tell)  # fmt: skip
    return read_results(folder)


def run_sweep(
    plan: Sweep,
    folder: Path,
    *,
    executor: Executor | None = None,
    workers: int | None = None,
    resume: bool = False,
    max_days: float = DAYS,
    block_cases: int | None = None,
    tell: Callable[[Standing], None] = lambda _: None,
    words: SweepWords | None = None,
) -> Standing:
    """Solve and store the cases of a plan that are not finished; see `sweep` for the parameters.

    Parameters
    ----------
    plan, folder, executor, workers, resume, max_days, block_cases
        As for `sweep`.
    tell : callable
        Function that is called with the standing before the first and after each block.
    words : SweepWords, optional
        Names of the arguments in messages; by default those of Python.

    Returns
    -------
    Standing
        The standing at the end.
    """
    words = words or SweepWords()
    for name, value in (("workers", workers), ("block_cases", block_cases)):
        require(value is None or value >= 1, name, value, "a whole number, at least 1")
    for name in ("pyarrow", "pandas"):
        library(name, READ, EXTRA)
    _refuse_foreign(folder, resume, words)
    require_writable(folder, words.folder)
    with _disk_errors(folder, words), locked(folder), workers_of(plan, executor, workers) as team:
        ledger = _present(folder, plan, words)
        standing = _begun(ledger, plan)
        estimate = estimated(plan, plan.cases - standing.finished, team)
        if estimate is not None:
            refuse_long(estimate, max_days, words.max_days)
        if ledger is None:
            new_ledger(folder, plan, this_solver())
            ledger = read_ledger(folder)
        tell(standing)
        with opened(folder) as connection:
            for block in solved_blocks(plan, ledger.gaps(), team, ledger.solver, block_cases):
                # The ledger names a shard only after it is on the disk.
                write_shard(folder, shard_name(block.start, block.stop), block.content)
                add(connection, block)
                standing = standing.plus(block.counts, block.stop - block.start)
                tell(standing)
    return standing


def _begun(ledger: Ledger | None, plan: Sweep) -> Standing:
    """Return the standing at the beginning of a run."""
    standing = Standing(0, plan.cases)
    for each in ledger.entries if ledger is not None else ():
        standing = standing.plus(each.counts, each.stop - each.start)
    return standing


def _refuse_foreign(folder: Path, resume: bool, words: SweepWords) -> None:
    """Refuse a folder with results unless they are to be resumed, before anything is written."""
    there = (folder / LEDGER).exists()
    if there and not resume and read_ledger(folder).entries:
        raise BadInput(words.folder, folder, "a folder without results",
                       f"give {words.resume} to go on with the study in it")  # fmt: skip
    if not there and folder.is_dir() and _has_other_files(folder):
        raise BadInput(words.folder, folder, "an empty folder or one with results of a sweep")


def _has_other_files(folder: Path) -> bool:
    return any(not each.name.startswith(OWN) for each in folder.iterdir())


def _present(folder: Path, plan: Sweep, words: SweepWords) -> Ledger | None:
    """Return the ledger of a folder without damaged blocks; None if there is no finished block.

    Raises
    ------
    BadInput
        The folder contains another study, or results of another solver.
    """
    ledger = read_ledger(folder) if (folder / LEDGER).exists() else None
    if ledger is None or not ledger.entries:
        return None
    if ledger.digest != plan.digest:
        raise BadInput(words.folder, folder, "the folder of this study",
                       "it has the results of another one; choose another folder")  # fmt: skip
    if ledger.solver != this_solver():
        raise BadInput(
            words.folder, folder, "the folder of results of this version",
            f"they are from stonepass {ledger.version} with another solver or other numerical "
            "libraries, and the numbers of two versions are not mixed; choose another folder",
        )  # fmt: skip
    kept, damaged = sound(ledger)
    with opened(folder) as connection:
        remove(connection, damaged)
    return kept


@contextmanager
def _disk_errors(folder: Path, words: SweepWords) -> Iterator[None]:
    """Turn an error of the disk into one sentence; what was stored before is complete."""
    try:
        yield
    except sqlite3.Error as problem:
        raise _not_written(folder, str(problem), words) from problem
    except OSError as problem:
        raise _not_written(folder, problem.strerror or str(problem), words) from problem


def _not_written(folder: Path, why: str, words: SweepWords) -> StonepassError:
    return StonepassError(
        f"the folder '{folder}' could not be written ({why}): the finished blocks are kept; make "
        f"room and go on with {words.resume}."
    )
