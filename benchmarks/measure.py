"""Processor time and elapsed time of a call in this process and of a whole command."""

from __future__ import annotations

import hashlib
import json
import os
import platform
import resource
import statistics
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

ONE_THREAD = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}


@dataclass(frozen=True)
class Row:
    """One measured number; `target` is its largest value, or its smallest with `at_least`."""

    section: str
    what: str
    value: float
    unit: str
    target: float | None = None
    at_least: bool = False

    @property
    def met(self) -> bool | None:
        if self.target is None:
            return None
        return self.value >= self.target if self.at_least else self.value <= self.target

    def record(self) -> dict[str, Any]:
        return {**asdict(self), "met": self.met}


@dataclass(frozen=True)
class Spent:
    """Processor time and elapsed time in s, and largest memory in MB, of a whole command."""

    cpu: float
    wall: float
    memory: float
    output: str
    code: int


def cpu_seconds(call: Callable[[], object], repeats: int = 7) -> float:
    """Return the median processor time of several calls, after one call that is not counted."""
    call()
    seconds = []
    for _ in range(repeats):
        started = time.process_time()
        call()
        seconds.append(time.process_time() - started)
    return statistics.median(seconds)


# A small process runs the command and reports on it. The largest memory of a child includes the
# moment at which it is still a copy of its parent, and this process is large.
LAUNCHER = """
import json, resource, subprocess, sys, time
started = time.perf_counter()
done = subprocess.run(sys.argv[1:], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
used = resource.getrusage(resource.RUSAGE_CHILDREN)
json.dump([used.ru_utime + used.ru_stime, time.perf_counter() - started, used.ru_maxrss / 1024.0,
           done.stdout, done.returncode], sys.stdout)
"""


def spend(command: list[str], folder: Path | None = None) -> Spent:
    """Run a command on one thread and measure that command only."""
    launched = subprocess.run(
        [sys.executable, "-S", "-c", LAUNCHER, *command],
        cwd=folder,
        env=os.environ | ONE_THREAD,
        capture_output=True,
        text=True,
        check=True,
    )
    return Spent(*json.loads(launched.stdout))


@dataclass
class Decks:
    """Runs decks of CalculiX in a folder, and stores the measurements beside each deck.

    Attributes
    ----------
    folder : Path
        Decks and results.
    resume : bool
        Take the run of a deck that an interrupted benchmark left in the folder, if the deck is the
        same apart from its comments.
    resumed : int
        Number of runs that were taken from the folder.
    """

    folder: Path
    resume: bool = False
    resumed: int = 0

    def run(self, job: str, deck: str, seconds: float | None = None) -> Spent:
        """Run a deck on one thread, for `seconds` of the clock at most."""
        self.folder.mkdir(parents=True, exist_ok=True)
        kept = self.folder / f"{job}.json"
        same = "\n".join(line for line in deck.splitlines() if not line.startswith("**"))
        digest = hashlib.sha256(same.encode()).hexdigest()
        if self.resume and kept.exists():
            before = json.loads(kept.read_text(encoding="utf-8"))
            if before.pop("deck") == digest:
                self.resumed += 1
                return Spent(**before)
        (self.folder / f"{job}.inp").write_text(deck, encoding="utf-8")
        limit = [] if seconds is None else ["timeout", f"{seconds:g}"]
        spent = spend([*limit, "ccx", job], self.folder)
        record = json.dumps(asdict(spent) | {"deck": digest})
        kept.write_text(record, encoding="utf-8")
        return spent


def stonepass(*arguments: str, repeats: int = 3) -> Spent:
    """Run a command several times in new processes; return the run of median elapsed time."""
    runs = [spend([sys.executable, "-m", "stonepass", *arguments]) for _ in range(repeats)]
    return sorted(runs, key=lambda run: run.wall)[repeats // 2]


def memory() -> float:
    """Return the largest memory of this process so far in MB."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0


def machine() -> dict[str, str]:
    """Return the machine and the versions with which the numbers were measured."""
    import ngsolve
    import numpy

    from stonepass.about import VERSION

    return {
        "processor": _processor(),
        "cores": str(os.cpu_count()),
        "system": f"{platform.system()} {platform.release()}",
        "python": platform.python_version(),
        "numpy": numpy.__version__,
        "ngsolve": ngsolve.__version__,
        "stonepass": VERSION,
        "calculix": calculix() or "not installed",
    }


def _processor() -> str:
    try:
        lines = Path("/proc/cpuinfo").read_text(encoding="utf-8").splitlines()
    except OSError:
        lines = []
    named = [line.partition(":")[2].strip() for line in lines if line.startswith("model name")]
    return named[0] if named else platform.processor() or platform.machine()


def calculix() -> str | None:
    """Return the version of CalculiX, or None if it is not installed."""
    try:
        found = subprocess.run(["ccx", "-v"], capture_output=True, text=True, check=False)
    except FileNotFoundError:
        return None
    words = found.stdout.split()
    return words[-1] if words else "unknown"
