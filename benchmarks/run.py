"""Timings against their targets, one thread: python benchmarks/run.py [--json]

In-process rows are the median of several solves after one warm-up ("after import"); process rows
are whole commands from a cold interpreter, the median again. These machines are noisy: a missed
target is reported, not raised.
"""

from __future__ import annotations

import json
import os
import platform
import resource
import statistics
import subprocess
import sys
import time
from collections.abc import Callable

REPEATS = 7


def main() -> None:
    os.environ["OPENBLAS_NUM_THREADS"] = "1"
    rows = [*in_process(), *processes()]
    if "--json" in sys.argv:
        print(json.dumps({"machine": machine(), "rows": rows}, indent=2))
        return
    print(machine())
    print(f"{'what':<58}{'median':>9}{'target':>9}   ")
    for row in rows:
        mark = "ok" if row["value"] <= row["target"] else "MISSED"
        unit = row["unit"]
        print(f"{row['what']:<58}{row['value']:>7.2f} {unit}{row['target']:>7g} {unit}   {mark}")


def machine() -> str:
    import ngsolve

    return (
        f"{platform.processor() or platform.machine()}, {os.cpu_count()} cores, "
        f"Python {platform.python_version()}, NGSolve {ngsolve.__version__}"
    )


def in_process() -> list[dict]:
    import stonepass as sp

    def solve(
        seating: str,
        material: str,
        eta: float,
        xi: float,
        friction: float = 0.5,
        model: str = "paper",
    ) -> Callable[[], object]:
        case = sp.Case(
            sp.Stone(size_ratio=xi, friction=friction),
            sp.Ureter(wall_ratio=eta, material=material),
            method=sp.Method(seating=seating, model=model),
        )
        return lambda: sp.solve(case)

    def direct(*case: object) -> Callable[[], object]:
        return solve("pressed", *case, "direct")  # type: ignore[arg-type]

    cases = [
        ("frictionless latex, η 1.5, ξ 1.2", solve("frictionless", "latex", 1.5, 1.2), 0.3),
        ("pressed latex, η 1.5, ξ 1.2, μ 0.475", solve("pressed", "latex", 1.5, 1.2, 0.475), 1.2),
        ("pressed ureter, η 1.3, ξ 1.212", solve("pressed", "ureter", 1.3, 1.212), 4.0),
        ("pressed ureter, η 3.4, ξ 1.109", solve("pressed", "ureter", 3.4, 1.109), 4.0),
        ("direct latex, η 1.5, ξ 1.2, μ 0.475", direct("latex", 1.5, 1.2, 0.475), 2.0),
        ("direct ureter, η 1.3, ξ 1.212", direct("ureter", 1.3, 1.212, 0.5), 6.0),
        ("direct ureter, η 3.4, ξ 1.109", direct("ureter", 3.4, 1.109, 0.5), 6.0),
    ]
    rows = [row(f"{what} (after import)", timed(call), target) for what, call, target in cases]
    return [*rows, *curves()]


def curves() -> list[dict]:
    """P_ucr(ξ) at 31 sizes, errors estimated, in this process."""
    import stonepass as sp
    from stonepass.studies.curve import curve

    rows = []
    for material, eta, top in (("latex", 1.5, 1.5), ("ureter", 1.3, 1.3)):
        case = sp.Case(
            sp.Stone(size_ratio=top),
            sp.Ureter(wall_ratio=eta, material=material),
            method=sp.Method(seating="frictionless"),
        )
        sizes = [1.0 + (top - 1.0) * k / 30 for k in range(31)]
        seconds = timed(lambda case=case, sizes=sizes: curve(case, sizes), repeats=3)
        rows.append(row(f"curve of 31 sizes, frictionless {material}, η {eta}", seconds, 8.0))
    return rows


def processes() -> list[dict]:
    command = [sys.executable, "-m", "stonepass"]
    latex = ["pressure", "--xi", "1.2", "--eta", "1.5", "--material", "latex"]
    ureter = ["pressure", "--stone", "4.2mm", "--inner", "3.5mm", "--outer", "4.54mm"]
    smooth = ["--seating", "frictionless"]
    rows = [
        row(
            "stonepass pressure, frictionless latex", timed(process(command + latex + smooth)), 2.5
        ),
        row(
            "stonepass pressure, frictionless ureter", timed(process(command + ureter + smooth)), 4
        ),
        row("stonepass pressure, pressed latex", timed(process(command + latex)), 2.5),
        row("stonepass pressure, pressed ureter", timed(process(command + ureter)), 4.0),
        row("stonepass --help (process)", timed(process([*command, "--help"])), 0.4),
    ]
    peak = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024.0
    return [*rows, {"what": "peak memory of these processes", "value": peak, "target": 300.0,
                    "unit": "MB"}]  # fmt: skip


def process(command: list[str]) -> Callable[[], object]:
    null = subprocess.DEVNULL
    return lambda: subprocess.run(command, check=True, stdout=null, stderr=null)


def timed(call: Callable[[], object], repeats: int = REPEATS) -> float:
    call()
    seconds = []
    for _ in range(repeats):
        started = time.perf_counter()
        call()
        seconds.append(time.perf_counter() - started)
    return statistics.median(seconds)


def row(what: str, value: float, target: float) -> dict:
    return {"what": what, "value": value, "target": target, "unit": "s "}


if __name__ == "__main__":
    main()
