"""Seconds of processor and of the clock, of a call in this process and of a whole command."""

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
    """One number; `target` is the most it may be, or with `at_least` the least."""

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
    """Seconds of processor, seconds of the clock, largest memory in MB of a whole command."""

    cpu: float
    wall: float
    memory: float
    output: str
    code: int


def cpu_seconds(call: Callable[[], object], repeats: int = 7) -> float:
    """Median of several calls after one to warm up, this process's processor time."""
    call()
    seconds = []
    for _ in range(repeats):
        started = time.process_time()
        call()
        seconds.append(time.process_time() - started)
    return statistics.median(seconds)


# A small process that runs a command and reports on it: a child's largest memory counts from before
# it became itself, when it was still a copy of its parent, and this one is large.
LAUNCHER = """
import json, resource, subprocess, sys, time
started = time.perf_counter()
done = subprocess.run(sys.argv[1:], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
used = resource.getrusage(resource.RUSAGE_CHILDREN)
json.dump([used.ru_utime + used.ru_stime, time.perf_counter() - started, used.ru_maxrss / 1024.0,
           done.stdout, done.returncode], sys.stdout)
"""


def spend(command: list[str], folder: Path | None = None) -> Spent:
    """Run a command on one thread; what it took is its own alone."""
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
    """Runs decks of CalculiX in a folder, and keeps beside each deck what its run took.

    Attributes
    ----------
    folder : Path
        Decks and results.
    resume : bool
        Take the run of a deck that an interrupted benchmark left in the folder, if the deck is the
        same apart from its comments.
    resumed : int
        How many runs were taken.
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
    """The command line, cold; the run of the median clock time."""
    runs = [spend([sys.executable, "-m", "stonepass", *arguments]) for _ in range(repeats)]
    return sorted(runs, key=lambda run: run.wall)[repeats // 2]


def memory() -> float:
    """Largest memory of this process so far in MB."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0


def machine() -> dict[str, str]:
    """What the numbers were measured on."""
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
    """Version of CalculiX; None where it is not installed."""
    try:
        found = subprocess.run(["ccx", "-v"], capture_output=True, text=True, check=False)
    except FileNotFoundError:
        return None
    words = found.stdout.split()
    return words[-1] if words else "unknown"
