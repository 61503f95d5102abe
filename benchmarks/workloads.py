"""Times of seated states over unknowns, and of curves, surfaces, answers and commands."""

from __future__ import annotations

import os
import sys
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from cases import tube
from measure import Row, cpu_seconds, memory, stonepass

import stonepass as sp
from stonepass.fe.axisymmetric.problem import Resolution
from stonepass.model.case_states import seat
from stonepass.model.states.seated_state import NoSeat
from stonepass.paper.fig8 import SIZES, WALLS
from stonepass.paper.inputs import ureter_case
from stonepass.studies.case_solver import JobSolver
from stonepass.studies.curve import Curve
from stonepass.studies.executor import process_pool
from stonepass.studies.study import run_study

REFINEMENTS = (0.5, 0.7, 1.0, 1.5, 2.0, 3.0, 4.0)
LARGEST_EXPONENT = 1.3


@dataclass(frozen=True)
class Scaling:
    """Unknowns and processor times in s of several meshes, and the fitted exponent."""

    what: str
    dofs: tuple[int, ...]
    seconds: tuple[float, ...]
    exponent: float


def scalings() -> Iterator[Scaling]:
    """Yield times of seated states on finer and finer meshes with the same increments."""
    for kind, material, eta, xi in (
        ("frictionless", "latex", 1.5, 1.2),
        ("pressed", "latex", 1.5, 1.2),
        ("pressed", "ureter", 1.3, 1.21),
    ):
        case = tube(kind, material, eta, xi)
        dofs, seconds = [], []
        for factor in REFINEMENTS:
            fine = replace(Resolution().refined(factor), increments=Resolution().increments)
            state = seat(case, fine)
            if isinstance(state, NoSeat):
                raise SystemExit(f"no seat at refinement {factor}: {state.reason}")
            dofs.append(state.solver.dofs)
            repeats = 5 if factor <= 1.0 else 1
            seconds.append(cpu_seconds(lambda case=case, fine=fine: seat(case, fine), repeats))
            print(f"  {kind} {material}: {dofs[-1]} unknowns, {seconds[-1]:.2f} s", file=sys.stderr)
        slope = float(np.polyfit(np.log(dofs), np.log(seconds), 1)[0])
        yield Scaling(f"{kind} {material}, η {eta}, ξ {xi}", tuple(dofs), tuple(seconds), slope)


def single() -> Iterator[Row]:
    """Yield processor times of one answer after import, error estimate included."""
    ureter, latex = ("pressed", "ureter"), ("pressed", "latex", 1.5, 1.2, 0.475)
    for what, target, case in (
        ("frictionless latex, η 1.5, ξ 1.2", 0.3, tube("frictionless", "latex", 1.5, 1.2)),
        ("pressed latex, η 1.5, ξ 1.2, μ 0.475", 1.2, tube(*latex)),
        ("pressed ureter, η 1.3, ξ 1.212", 4.0, tube(*ureter, 1.3, 1.212)),
        ("pressed ureter, η 3.4, ξ 1.109", 4.0, tube(*ureter, 3.4, 1.109)),
        ("direct latex, η 1.5, ξ 1.2, μ 0.475", 2.0, tube(*latex, "direct")),
        ("direct ureter, η 1.3, ξ 1.212", 6.0, tube(*ureter, 1.3, 1.212, model="direct")),
        ("direct ureter, η 3.4, ξ 1.109", 6.0, tube(*ureter, 3.4, 1.109, model="direct")),
    ):
        yield Row("one answer", what, cpu_seconds(lambda case=case: sp.solve(case)), "s", target)


def many(workers: int) -> Iterator[Row]:
    """Yield elapsed times of curves in this process, and of the surface of Fig. 8b in a pool."""
    for kind, material, eta, top, target in (
        ("frictionless", "latex", 1.5, 1.5, 8.0),
        ("frictionless", "ureter", 1.3, 1.3, 8.0),
        ("pressed", "ureter", 1.3, 1.3, None),
    ):
        case = tube(kind, material, eta, top)
        sizes = np.linspace(1.0, top, 31).tolist()
        seconds = _clock(lambda case=case, sizes=sizes: run_study(Curve(case, sizes)))
        yield Row("many", f"P_ucr of 31 sizes, {kind} {material}, η {eta}", seconds, "s", target)
    cases = [ureter_case(eta, xi) for eta in WALLS for xi in SIZES]
    with process_pool(workers) as pool:
        solver = JobSolver(pool)
        seconds = _clock(lambda: solver.answers(cases, error=False))
    what = (
        f"surface of Fig. 8b, {len(WALLS)} × {len(SIZES)} with friction, accuracy standard, "
        f"no error estimate, {workers} processes"
    )
    yield Row("many", what, seconds, "s", 120.0)


def commands() -> Iterator[Row]:
    """Yield elapsed times of whole commands in new processes, and their largest memory."""
    latex = ("--xi", "1.2", "--eta", "1.5", "--material", "latex", "--no-cache")
    ureter = ("--stone", "4.2mm", "--inner", "3.5mm", "--outer", "4.54mm", "--no-cache")
    smooth = ("--seating", "frictionless")
    largest = 0.0
    for what, target, arguments in (
        ("--help", 0.4, ("--help",)),
        ("pressure, frictionless latex", 2.5, ("pressure", *latex, *smooth)),
        ("pressure, pressed latex", 2.5, ("pressure", *latex)),
        ("pressure, frictionless ureter", 4.0, ("pressure", *ureter, *smooth)),
        ("pressure, pressed ureter", 4.0, ("pressure", *ureter)),
        ("pressure, direct ureter", 8.0, ("pressure", *ureter, "--model", "direct")),
    ):
        spent = stonepass(*arguments)
        if spent.code:
            raise SystemExit(f"stonepass {what} failed: {spent.output}")
        largest = max(largest, spent.memory)
        yield Row("cold commands", f"stonepass {what}", spent.wall, "s", target)
    yield Row("memory", "largest memory of these commands", largest, "MB", 300.0)
    yield Row("memory", "memory of the process of this benchmark, all meshes", memory(), "MB")


def processes() -> int:
    """Return two, for which the target is stated, or one on a machine with one core."""
    return min(2, os.cpu_count() or 1)


def _clock(call: Callable[[], object]) -> float:
    started = time.perf_counter()
    call()
    return time.perf_counter() - started
