"""Run the slow verification and renew its sections of docs/verification.md; exit 1 on a failure.

python verification/run.py            everything
python verification/run.py refinement robustness
"""

from __future__ import annotations

import importlib
import os
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from concurrent.futures import as_completed
from datetime import date
from pathlib import Path

import ngsolve as ng
from page import Section, renewed

import stonepass
from stonepass.studies.executor import CORES, process_pool

SIDE_BY_SIDE = ("far_field", "refinement", "accuracy", "half_length", "pressed", "calibration")
# Each of these sections has its own pool of processes.
ON_ALL_CORES = (
    "error_estimates",
    "smoothness",
    "robustness",
    "push_through",
    "shapes",
    "paper",
    "micrograph",
    "tables",
    "laboratory",
    "surrogates",
    "calculix",
)
SECTIONS = (*SIDE_BY_SIDE, *ON_ALL_CORES)
ROOT = Path(__file__).parents[1]
PAGE = ROOT / "docs" / "verification.md"


def main(names: list[str]) -> int:
    unknown = [name for name in names if name not in SECTIONS]
    if unknown:
        print(f"no section {unknown[0]}; there are: {', '.join(SECTIONS)}", file=sys.stderr)
        return 2
    code, failed = revision(), []
    for name, section, seconds in sections(names or SECTIONS):
        print(f"{name}: {seconds:.0f} s", file=sys.stderr, flush=True)
        stamp = (
            f"*{date.today()}, code {code}, NGSolve {ng.__version__}; {seconds:.0f} s, "
            f"{os.cpu_count()} cores: `python verification/run.py {name}`*"
        )
        page = PAGE.read_text(encoding="utf-8") if PAGE.exists() else ""
        # The page is written after each section, so that they are kept if a later one fails.
        PAGE.write_text(
            renewed(page, name, f"{section.markdown()}\n\n{stamp}", SECTIONS), encoding="utf-8"
        )
        wrong = [f"{name}: {check.claim}" for check in section.checks if not check.holds]
        for line in wrong:
            print(f"FAILS: {line}", file=sys.stderr, flush=True)
        failed += wrong
    return 1 if failed else 0


def sections(names: Sequence[str]) -> Iterator[tuple[str, Section, float]]:
    """Run the sections that use one process concurrently, then the others one after another."""
    with process_pool(CORES) as pool:
        runs = [pool.submit(run, name) for name in names if name in SIDE_BY_SIDE]
        for finished in as_completed(runs):
            yield finished.result()
    for name in names:
        if name in ON_ALL_CORES:
            yield run(name)


def run(name: str) -> tuple[str, Section, float]:
    started = time.perf_counter()
    section = importlib.import_module(name).section()
    return name, section, time.perf_counter() - started


def revision() -> str:
    """Return version and commit of the code; `+` says that the code differs from the commit."""
    try:
        commit = git("rev-parse", "--short", "HEAD")
        changed = git("status", "--porcelain", "--", "src", "verification")
    except (OSError, subprocess.CalledProcessError):  # no checkout
        return stonepass.__version__
    return f"{stonepass.__version__} ({commit}{'+' if changed else ''})"


def git(*words: str) -> str:
    done = subprocess.run(["git", *words], cwd=ROOT, capture_output=True, text=True, check=True)
    return done.stdout.strip()


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
