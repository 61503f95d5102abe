"""The ledger of a sweep: an SQLite file that names the study, its finished blocks and its columns.

Each block is entered in one transaction, after its shard is on the disk. SQLite's rollback journal
is used and not its write-ahead log, because the log needs memory that all processes share, which
network file systems do not have, and because one transaction per second needs no log.
"""

from __future__ import annotations

import json
import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from stonepass.about import VERSION
from stonepass.errors import BadInput, StonepassError
from stonepass.studies.sweeps.blocks import Block
from stonepass.studies.sweeps.plan import Sweep
from stonepass.studies.sweeps.shards import digest_of, shard_name, sync_folder

__all__ = [
    "FORMAT",
    "LEDGER",
    "LOCK",
    "Entry",
    "Ledger",
    "add",
    "locked",
    "new_ledger",
    "opened",
    "read_ledger",
    "remove",
]

FORMAT = 1  # raised if a table of the ledger or the layout of the folder changes
LEDGER, LOCK = "ledger.sqlite", "lock.sqlite"
PATIENCE = 30.0  # time in s that a transaction waits for a reader
_TABLES = """
CREATE TABLE study (format INTEGER, version TEXT, solver TEXT, digest TEXT, plan TEXT);
CREATE TABLE blocks (start INTEGER PRIMARY KEY, stop INTEGER, shard TEXT, digest TEXT, size INTEGER,
    seconds REAL, counts TEXT);
CREATE TABLE columns (name TEXT PRIMARY KEY, type TEXT);
"""


@dataclass(frozen=True)
class Entry:
    """A finished block: its cases, its shard, and its outcomes.

    Attributes
    ----------
    start, stop : int
        Range of the cases; `stop` is excluded.
    shard : str
        Path of the shard in the folder of the results.
    digest : str
        SHA-256 digest of the shard.
    size : int
        Size of the shard in bytes.
    seconds : float
        Time in s in which the cases were solved.
    counts : tuple of (str, str, int)
        Number of rows by model and outcome.
    """

    start: int
    stop: int
    shard: str
    digest: str
    size: int
    seconds: float
    counts: tuple[tuple[str, str, int], ...]


@dataclass(frozen=True)
class Ledger:
    """The contents of a ledger, or an open ledger to which blocks are added.

    Attributes
    ----------
    folder : Path
        Folder of the results.
    version, solver, digest : str
        Version of stonepass, digest of its solver, and digest of the study.
    plan : dict
        Description of the study (see `Sweep.describe`).
    entries : tuple of Entry
        The finished blocks when the ledger was read, in the order of their cases.
    columns : dict of str to str
        Types of the columns by name when the ledger was read.
    """

    folder: Path
    version: str
    solver: str
    digest: str
    plan: dict[str, Any]
    entries: tuple[Entry, ...]
    columns: dict[str, str]

    @property
    def cases(self) -> int:
        """Number of cases of the study."""
        return int(self.plan["cases"])

    @property
    def finished(self) -> int:
        """Number of finished cases."""
        return sum(each.stop - each.start for each in self.entries)

    def gaps(self) -> list[tuple[int, int]]:
        """Return the ranges of cases that are not finished."""
        ends = [0, *(each.stop for each in self.entries)]
        starts = [*(each.start for each in self.entries), self.cases]
        return [pair for pair in zip(ends, starts, strict=True) if pair[0] < pair[1]]


def new_ledger(folder: Path, plan: Sweep, solver: str) -> None:
    """Write the ledger of a new study; it appears in one step.

    Parameters
    ----------
    folder : Path
        Folder of the results.
    plan : Sweep
        The plan of the study.
    solver : str
        Digest of the solver.
    """
    beside = folder / f"{LEDGER}.new"
    beside.unlink(missing_ok=True)
    with _connected(beside) as connection:
        connection.executescript(_TABLES)
        connection.execute(
            "INSERT INTO study VALUES (?, ?, ?, ?, ?)",
            (FORMAT, VERSION, solver, plan.digest, json.dumps(plan.describe(), ensure_ascii=False)),
        )
        connection.commit()
    beside.replace(folder / LEDGER)
    sync_folder(folder)


@contextmanager
def opened(folder: Path) -> Iterator[sqlite3.Connection]:
    """Yield a connection to the ledger for `add` and `remove`."""
    with _connected(folder / LEDGER) as connection:
        yield connection


@contextmanager
def _connected(path: Path) -> Iterator[sqlite3.Connection]:
    connection = sqlite3.connect(path, timeout=PATIENCE)
    try:
        connection.execute("PRAGMA synchronous = EXTRA")
        yield connection
    finally:
        connection.close()


def add(connection: sqlite3.Connection, block: Block) -> None:
    """Enter a block whose shard has been written."""
    name = shard_name(block.start, block.stop)
    with connection:
        connection.execute(
            "INSERT INTO blocks VALUES (?, ?, ?, ?, ?, ?, ?)",
            (block.start, block.stop, name, digest_of(block.content), len(block.content),
             block.seconds, json.dumps(block.counts)),
        )  # fmt: skip
        connection.executemany("INSERT OR IGNORE INTO columns VALUES (?, ?)", block.columns)


def remove(connection: sqlite3.Connection, entries: list[Entry]) -> None:
    """Remove blocks whose shards are missing or damaged."""
    with connection:
        connection.executemany(
            "DELETE FROM blocks WHERE start = ?", [(each.start,) for each in entries]
        )


def read_ledger(folder: Path) -> Ledger:
    """Read the ledger of a folder.

    Raises
    ------
    BadInput
        The folder has no ledger, the ledger cannot be read, or its format is another one.
    """
    path = folder / LEDGER
    if not path.is_file():
        raise BadInput("folder", folder, f"a folder of a sweep, which has a file {LEDGER}")
    try:
        with _connected(path) as connection:
            study = _study(connection, folder)
            blocks = connection.execute("SELECT * FROM blocks ORDER BY start").fetchall()
            columns = dict(connection.execute("SELECT name, type FROM columns").fetchall())
    except sqlite3.Error as problem:
        raise BadInput("ledger", path, f"a ledger that can be read ({problem})") from problem
    _, version, solver, digest, plan = study
    entries = tuple(map(_entry, blocks))
    return Ledger(folder, version, solver, digest, json.loads(plan), entries, columns)


def _entry(row: tuple[Any, ...]) -> Entry:
    start, stop, shard, digest, size, seconds, counts = row
    by_outcome = tuple((model, outcome, count) for model, outcome, count in json.loads(counts))
    return Entry(start, stop, shard, digest, size, seconds, by_outcome)


def _study(connection: sqlite3.Connection, folder: Path) -> Any:
    study = connection.execute("SELECT * FROM study").fetchone()
    if study[0] != FORMAT:
        raise BadInput(
            "folder", folder, f"of format {FORMAT}, which this version reads",
            f"it has format {study[0]} and was written by stonepass {study[1]}",
        )  # fmt: skip
    return study


@contextmanager
def locked(folder: Path) -> Iterator[None]:
    """Hold the lock of a folder, so that a single process writes to it.

    The lock is a transaction of an SQLite file. The system ends it with the process, even if the
    process is killed.

    Raises
    ------
    StonepassError
        Another process holds the lock.
    """
    connection = sqlite3.connect(folder / LOCK, timeout=0.0, isolation_level=None)
    try:
        _begin(connection, folder)
        yield
    finally:
        connection.close()


def _begin(connection: sqlite3.Connection, folder: Path) -> None:
    try:
        connection.execute("BEGIN EXCLUSIVE")
    except sqlite3.OperationalError as problem:
        if "locked" not in str(problem):
            raise
        raise StonepassError(
            f"another process is writing to '{folder}': wait until it has finished, or stop it."
        ) from problem
