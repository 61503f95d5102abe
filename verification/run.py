"""Run the slow verification and write docs/verification.md; exit 1 where a claim fails.

python verification/run.py            everything
python verification/run.py refinement robustness
"""

from __future__ import annotations

import importlib
import platform
import sys
import time
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import ngsolve
from page import Section

import stonepass

SIDE_BY_SIDE = ("far_field", "refinement", "accuracy", "half_length", "pressed", "calibration")
ON_ALL_CORES = ("error_estimates", "smoothness", "robustness")  # each has its own workers
SECTIONS = (*SIDE_BY_SIDE, *ON_ALL_CORES)
PAGE = Path(__file__).parents[1] / "docs" / "verification.md"


def main(names: list[str]) -> int:
    unknown = [name for name in names if name not in SECTIONS]
    if unknown:
        print(f"no section {unknown[0]}; there are: {', '.join(SECTIONS)}", file=sys.stderr)
        return 2
    wanted, written, failed = names or SECTIONS, [], []
    for name, section in zip(wanted, sections(wanted), strict=True):
        written.append(section.markdown())
        failed += [f"{name}: {check.claim}" for check in section.checks if not check.holds]
    head = (
        "# Verification\n\nWritten by `make verify`; every number below was measured by that run "
        f"(stonepass {stonepass.__version__}, NGSolve {ngsolve.__version__}, "
        f"Python {platform.python_version()})."
    )
    text = "\n\n".join([head, *written]) + "\n"
    if names:
        print(text)
    else:
        PAGE.write_text(text, encoding="utf-8")
    for line in failed:
        print(f"FAILS: {line}", file=sys.stderr)
    return 1 if failed else 0


def sections(names: Sequence[str]) -> list[Section]:
    """Run the sections of one process side by side, then the others one by one."""
    small = [name for name in names if name in SIDE_BY_SIDE]
    with ProcessPoolExecutor(mp_context=get_context("spawn")) as pool:
        found = dict(zip(small, pool.map(run, small), strict=True))
    found |= {name: run(name) for name in names if name in ON_ALL_CORES}
    return [found[name] for name in names]


def run(name: str) -> Section:
    started = time.perf_counter()
    section = importlib.import_module(name).section()
    print(f"{name}: {time.perf_counter() - started:.0f} s", file=sys.stderr)
    return section


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
