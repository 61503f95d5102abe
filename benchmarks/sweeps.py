"""Sweeps: their overhead, the gain of a second worker, and reading a million rows.

    python benchmarks/sweeps.py

Prints the rows and writes docs/data/sweep_benchmark.json.
"""

from __future__ import annotations

import datetime
import json
import os
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from busy_model import SECONDS, BusyWall
from measure import Row, machine, memory

import stonepass as sp
from stonepass.studies.sweeps.blocks import Block
from stonepass.studies.sweeps.case_rows import COLUMNS
from stonepass.studies.sweeps.ledger import add, new_ledger, opened
from stonepass.studies.sweeps.run import run_sweep
from stonepass.studies.sweeps.shards import schema_of, shard_name, shard_of, write_shard

CASES = 100  # of the sweeps that are timed
MILLION, SHARD = 1_000_000, 2000  # rows, and rows in each file: as many files as a sweep makes
SECTION = "sweeps"


def sweeps() -> Iterator[Row]:
    """All rows of this file."""
    yield from overhead()
    yield from second_worker()
    yield from a_million_rows()


def busy_plan(cases: int) -> sp.Sweep:
    """A plan whose cases take a stated time each."""
    wall = sp.Material("busy", BusyWall(0.1e6), "none", "none", "none", (1.0, 2.0))
    return sp.read_sweep(
        {
            "ureter": {"wall_ratio": 1.3, "material": wall},
            "method": {"model": "busy"},
            "vary": {"stone.size_ratio": {"low": 1.05, "high": 1.3}},
            "samples": {"count": cases},
        }
    )


def overhead() -> Iterator[Row]:
    """What a sweep takes beyond the cases themselves, in this process."""
    plan = busy_plan(CASES)
    with tempfile.TemporaryDirectory() as folder:  # the libraries are loaded
        run_sweep(busy_plan(2), Path(folder) / "s")
    with tempfile.TemporaryDirectory() as folder:
        clock, processor = time.perf_counter(), time.process_time()
        run_sweep(plan, Path(folder) / "s")
        clock, processor = time.perf_counter() - clock, time.process_time() - processor
        solved = sp.read_results(Path(folder) / "s").seconds
    what = f"overhead of a sweep, {CASES} cases of {SECONDS} s"
    yield Row(
        SECTION, f"{what}, processor", 100.0 * (processor / (CASES * SECONDS) - 1.0), "%", 5.0
    )
    yield Row(SECTION, f"{what}, clock beyond the blocks", 100.0 * (clock / solved - 1.0), "%", 5.0)


def second_worker() -> Iterator[Row]:
    """Cases a second with two processes over those with one, after the processes have begun."""
    one, two = (_rate(workers) for workers in (1, 2))
    what = f"two workers over one, {CASES} cases of {SECONDS} s"
    yield Row(SECTION, what, two / one, "×", 1.8, at_least=True)


def _rate(workers: int) -> float:
    """Cases a second from the first stored block to the last one."""
    moments: list[tuple[float, int]] = []
    with tempfile.TemporaryDirectory() as folder:
        run_sweep(
            busy_plan(CASES * workers),
            Path(folder) / "s",
            workers=workers,
            block_cases=5,
            tell=lambda now: moments.append((time.perf_counter(), now.finished)),
        )
    (began, first), (ended, last) = moments[2 * workers], moments[-1]
    return (last - first) / (ended - began)


def a_million_rows() -> Iterator[Row]:
    """Reading the files that the writer of sweeps makes."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        size = _write_rows(folder)
        for what, read in (
            ("all columns of 10⁶ rows, table of pyarrow", lambda found: found.table()),
            ("all columns of 10⁶ rows, pandas", lambda found: found.to_frame()),
            ("three columns of 10⁶ rows, pandas", lambda found: found.to_frame(
                ["size_ratio", "friction", "critical_pressure_kPa"])),
        ):  # fmt: skip
            seconds, processor = [], []
            for _ in range(3):
                started, used = time.perf_counter(), time.process_time()
                assert len(read(sp.read_results(folder))) == MILLION
                seconds.append(time.perf_counter() - started)
                processor.append(time.process_time() - used)
            yield Row(SECTION, what, min(seconds), "s", 1.0)
            yield Row(SECTION, f"{what}: processor time on all cores", min(processor), "s")
    yield Row(SECTION, "disk of a row, in files of 2000 rows", size / MILLION, "B")
    yield Row(SECTION, "largest memory of this process", memory(), "MB")


def _write_rows(folder: Path) -> int:
    """Write a million rows in blocks; return their size in bytes."""
    plan = sp.read_sweep(
        {
            "ureter": {"wall_ratio": 1.3},
            "vary": {"stone.size_ratio": {"low": 1.05, "high": 1.3},
                     "stone.friction": {"low": 0.1, "high": 0.5}},
            "samples": {"method": "latin-hypercube", "count": MILLION},
        }
    )  # fmt: skip
    random, total = np.random.default_rng(0), 0
    new_ledger(folder, plan, "benchmark")
    with opened(folder) as connection:
        connection.execute("PRAGMA synchronous = OFF")  # it is the reading that is timed
        for start in range(0, MILLION, SHARD):
            rows = [_row(start + k, random) for k in range(SHARD)]
            columns = schema_of(plan, rows)
            content = shard_of(rows, columns)
            counts = (("paper", "MOVES", SHARD),)
            block = Block(start, start + SHARD, content, tuple(columns.items()), counts, 1.0)
            write_shard(folder, shard_name(start, start + SHARD), content)
            add(connection, block)
            total += len(content)
    return total


def _row(index: int, random: np.random.Generator) -> dict[str, object]:
    row: dict[str, object] = {"index": index, "fingerprint": random.bytes(16).hex()}
    numbers = {name: random.random() for name, kind in COLUMNS.items() if kind == "double"}
    return row | numbers | {
        "friction": random.random(), "model": "paper", "outcome": "MOVES", "reason": None,
        "warnings": "", "closure_end_pressure_kPa": random.random(),
    }  # fmt: skip


def main() -> None:
    described, rows = machine(), []
    load = os.getloadavg()[0]
    for row in sweeps():
        rows.append(row.record())
        mark = {True: "met", False: "MISSED", None: ""}[row.met]
        print(f"{row.what:<70}{row.value:>9.2f} {row.unit:<3} {mark}", flush=True)
    found = {
        "date": datetime.datetime.now(datetime.UTC).date().isoformat(),
        "machine": described,
        "load_at_the_beginning": load,
        "rows": rows,
    }
    path = Path(__file__).resolve().parents[1] / "docs" / "data" / "sweep_benchmark.json"
    path.write_text(json.dumps(found, indent=2, ensure_ascii=False) + "\n", encoding="utf-8")
    print(f"load at the beginning {load:.1f} on {os.cpu_count()} cores", file=sys.stderr)


if __name__ == "__main__":
    main()
