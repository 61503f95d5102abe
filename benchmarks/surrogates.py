"""Benchmark of the surrogates: load, many evaluations, and the surface of Fig. 8b.

    python benchmarks/surrogates.py

Prints a table. The surface of 13 × 13 cases is computed three times in one run: by finite elements
case by case, by a surrogate that is built for it alone, both from an empty cache, and by the
surrogate of the package. Times are clock times; say with the result how busy the machine was.
"""

from __future__ import annotations

import os
import statistics
import subprocess
import sys
import time
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

import stonepass as sp
from stonepass.model.case import Case
from stonepass.studies.executor import CORES
from stonepass.studies.surrogates.store import shipped_surrogates

COUNT = 1_000_000  # evaluations
SIZES, WALLS = np.linspace(1.01, 1.3, 13), np.linspace(1.3, 3.4, 13)  # the ranges of Fig. 8b
FRICTION = 0.5
EFFORT = 0.1  # of the surrogate that is built for the surface alone
LOAD = "import stonepass as sp, time; t = time.perf_counter(); {}; print(time.perf_counter() - t)"


def main() -> None:
    rows = [*loaded(), *evaluated(), *surface()]
    print(f"{CORES} cores, load average before {os.getloadavg()[0]:.1f}")
    for what, value, unit, target in rows:
        print(f"{what:<66} {value:>9.3g} {unit:<5} {target}")


def loaded() -> list[tuple[str, float, str, str]]:
    """Time to load a surrogate in a fresh process, with and without the imports it needs."""
    first = "f = sp.load_surrogate; f('ureter')"
    again = "f = sp.load_surrogate; f('latex'); t = time.perf_counter(); f('ureter')"
    return [
        ("load, with the imports of a fresh process", in_process(LOAD.format(first)), "s", ""),
        ("load, after the imports", in_process(LOAD.format(again)), "s", "≤ 0.3"),
    ]


def in_process(code: str) -> float:
    times = [
        float(subprocess.run([sys.executable, "-c", code], capture_output=True, check=True).stdout)
        for _ in range(5)
    ]
    return statistics.median(times)


def evaluated() -> list[tuple[str, float, str, str]]:
    """Time of a million evaluations of each surrogate over its whole box."""
    rng = np.random.default_rng(0)
    size, wall, friction = rng.uniform([0.95, 1.1, 0.0], [1.6, 4.0, 1.0], (COUNT, 3)).T
    rows = []
    loads = rng.uniform(0.0, 2e3, COUNT)
    for name, model in shipped_surrogates():
        surrogate = sp.load_surrogate(name, model)
        for load, what in ((0.0, ""), (loads, ", loaded")):
            if load is loads and surrogate.case.load.confining_pressure == 0.0:
                continue
            clock, processor = [], []
            for _ in range(3):
                start, used = time.perf_counter(), time.process_time()
                surrogate.evaluate(size_ratio=size, wall_ratio=wall, friction=friction,
                                   confining_pressure=load)  # fmt: skip
                clock.append(time.perf_counter() - start)
                processor.append(time.process_time() - used)
            text = f"10⁶ evaluations, {name}, {model}{what}"
            rows.append((text, statistics.median(clock), "s", "≤ 2"))
            rows.append((f"{text}, processor time", statistics.median(processor), "s", ""))
    return rows


def surface() -> list[tuple[str, float, str, str]]:
    """The surface of Fig. 8b by three ways, with their differences from the finite elements."""
    wall, size = (each.ravel() for each in np.meshgrid(WALLS, SIZES))
    with TemporaryDirectory() as folder, sp.process_pool(CORES) as pool:
        start = time.perf_counter()
        cases = [
            Case(sp.Stone(size_ratio=x, friction=FRICTION), sp.Ureter(wall_ratio=e),
                 numerics=sp.Numerics("fast"))
            for x, e in zip(size.tolist(), wall.tolist(), strict=True)
        ]  # fmt: skip
        answers = sp.JobSolver(pool, Path(folder) / "one").answers(cases, error=False)
        by_case = time.perf_counter() - start
        start = time.perf_counter()
        box = sp.Box(1.3, (WALLS[0], WALLS[-1]), (0.45, 0.55))
        solver = sp.JobSolver(pool, Path(folder) / "other")
        built = sp.build_surrogate(cases[0], box, solver, EFFORT)
        own = built.evaluate(size_ratio=size, wall_ratio=wall, friction=FRICTION)
        by_own = time.perf_counter() - start
    shipped = sp.load_surrogate("ureter")
    start = time.perf_counter()
    found = shipped.evaluate(size_ratio=size, wall_ratio=wall, friction=FRICTION)
    by_shipped = time.perf_counter() - start
    true = np.array([np.nan if each.pressure is None else each.pressure for each in answers])

    def off(pressure: np.ndarray) -> float:
        apart = np.abs(np.ma.filled(pressure, np.nan) - true)
        return 100.0 * float(np.nanmax(np.where(apart > 10.0, apart / true, 0.0)))

    return [
        ("Fig. 8b, 13 × 13, case by case (fast), cold", by_case, "s", ""),
        ("Fig. 8b by a surrogate built for it, cold", by_own, "s", "≤ 60"),
        ("    its largest difference from case by case", off(own.pressure), "%", ""),
        ("Fig. 8b by the surrogate of the package", by_shipped, "s", "≤ 0.1"),
        ("    its largest difference from case by case (fast)", off(found.pressure), "%", ""),
    ]


if __name__ == "__main__":
    main()
