"""Run the slow verification and write docs/verification.md; exit 1 where a claim fails.

python verification/run.py            everything
python verification/run.py refinement robustness
"""

from __future__ import annotations

import importlib
import platform
import sys
import time
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context
from pathlib import Path

import ngsolve
from page import Section

import stonepass

SECTIONS = (
    "far_field",
    "refinement",
    "accuracy",
    "half_length",
    "robustness",
    "pressed",
    "calibration",
)
PAGE = Path(__file__).parents[1] / "docs" / "verification.md"


def main(names: list[str]) -> int:
    unknown = [name for name in names if name not in SECTIONS]
    if unknown:
        print(f"no section {unknown[0]}; there are: {', '.join(SECTIONS)}", file=sys.stderr)
        return 2
    wanted, written, failed = names or SECTIONS, [], []
    with ProcessPoolExecutor(mp_context=get_context("spawn")) as pool:
        for name, section in zip(wanted, pool.map(run, wanted), strict=True):
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


def run(name: str) -> Section:
    started = time.perf_counter()
    section = importlib.import_module(name).section()
    print(f"{name}: {time.perf_counter() - started:.0f} s", file=sys.stderr)
    return section


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
