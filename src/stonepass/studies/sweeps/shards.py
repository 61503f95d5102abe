"""Shards, the files of a sweep's results: one parquet file for each block of cases.

A shard is written under a temporary name, brought to the disk, renamed in one step, and entered in
the ledger only then. A file that the ledger does not name is never read.
"""

from __future__ import annotations

import hashlib
import os
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

from stonepass.io.optional_imports import library
from stonepass.io.text_file import WRITING
from stonepass.studies.sweeps.case_rows import COLUMNS, Row
from stonepass.studies.sweeps.plan import Sweep
from stonepass.studies.sweeps.points_file import EXTRA

__all__ = [
    "FOLDER",
    "READ",
    "arrow_type",
    "digest_of",
    "schema_of",
    "shard_name",
    "shard_of",
    "sync_folder",
    "write_shard",
]

FOLDER = "shards"
TEMPORARY = ".new"  # ending of a file that is being written
NUMBERS = "list<double>"
READ = "store results of sweeps"


def arrow_type(name: str) -> Any:
    """Return the type of pyarrow for the name of a type in the ledger."""
    pyarrow = library("pyarrow", READ, EXTRA)
    if name == NUMBERS:
        return pyarrow.list_(pyarrow.float64())
    return pyarrow.type_for_alias(name)


def schema_of(plan: Sweep, rows: Sequence[Row]) -> dict[str, str]:
    """Return the columns of some rows with their types, in the order of the table.

    The quantities that only some models have come last, sorted by name. A quantity that is null in
    all rows has no column.
    """
    first = {"index": "int64", "fingerprint": "string"}
    common = first | {each.column: each.type for each in plan.inputs}
    common |= {name: kind for name, kind in COLUMNS.items() if name not in common}
    own: dict[str, str] = {}
    for row in rows:
        for name in row.keys() - common.keys():
            if row[name] is not None:
                own[name] = NUMBERS if isinstance(row[name], list) else "double"
    return common | dict(sorted(own.items()))


def shard_of(rows: Sequence[Row], columns: dict[str, str]) -> bytes:
    """Return the parquet file of some rows; equal rows give equal bytes."""
    pyarrow, parquet = (library(name, READ, EXTRA) for name in ("pyarrow", "pyarrow.parquet"))
    arrays = [
        pyarrow.array([row.get(name) for row in rows], arrow_type(kind))
        for name, kind in columns.items()
    ]
    table = pyarrow.Table.from_arrays(arrays, names=list(columns))
    sink = pyarrow.BufferOutputStream()
    texts = [name for name, kind in columns.items() if kind == "string" and name != "fingerprint"]
    parquet.write_table(
        table, sink, compression="zstd", use_dictionary=texts, write_statistics=False
    )
    return bytes(sink.getvalue().to_pybytes())


def shard_name(start: int, stop: int) -> str:
    """Return the path of the shard of the cases `start` to `stop` in the folder of the results.

    A million cases share a sub-folder, so that no folder has very many files.
    """
    return f"{FOLDER}/{start // 1_000_000:06d}/{start:012d}-{stop:012d}.parquet"


def digest_of(content: bytes) -> str:
    """Return the SHA-256 digest of a shard in hexadecimal digits."""
    return hashlib.sha256(content).hexdigest()


def write_shard(folder: Path, name: str, content: bytes) -> None:
    """Write a shard so that it is on the disk and complete before it has its name.

    Parameters
    ----------
    folder : Path
        Folder of the results.
    name : str
        Path of the shard within it.
    content : bytes
        The parquet file.

    Raises
    ------
    OSError
        The file cannot be written; nothing of it is left.
    """
    path = folder / name
    beside = path.with_name(path.name + TEMPORARY)
    with WRITING:
        new = not path.parent.exists()
        path.parent.mkdir(parents=True, exist_ok=True)
        if new:
            sync_folder(path.parent.parent)
        try:
            with beside.open("wb") as file:
                file.write(content)
                file.flush()
                os.fsync(file.fileno())
            beside.replace(path)
        except BaseException:
            with suppress(OSError):
                beside.unlink(missing_ok=True)
            raise
        sync_folder(path.parent)


def sync_folder(folder: Path) -> None:
    """Bring the names in a folder to the disk, where the system can do so."""
    try:
        handle = os.open(folder, os.O_RDONLY)
    except OSError:  # Windows opens no folders; it writes their entries by itself
        return
    try:
        os.fsync(handle)
    except OSError:  # some network file systems refuse it for folders
        pass
    finally:
        os.close(handle)
