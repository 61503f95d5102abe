"""The direct model: identities, convergence, a random grid, and the relaxed energy."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from unittest.mock import patch

import numpy as np
from cores import on_all_cores
from page import Check, Section

import stonepass as sp
from stonepass.fe.axisymmetric.problem import Resolution
from stonepass.materials.relaxed_energy import relaxed
from stonepass.model.accuracy import LEVELS
from stonepass.model.energy_balance import advance_force, opened_radius, strained_force
from stonepass.units import Pressure

SEED, GRID, REFERENCED = 20248, 100, 40
EXACT, REFINED_EXACT, CONVERGED, SOLVED, COVERED = 2e-3, 5e-4, 5e-3, 0.98, 0.95
TETHER = 0.1
SHARE = 0.5  # fraction of R_s − lumen by which the urine pressure opens the tube
BLUNT, EGG = sp.Shape(1.2, (0.95, 0.0, 0.0, 0.0, 0.05)), sp.Shape(1.3, (1.01, 0.12, 0.01, 0.04))
NAMES = {BLUNT: "blunt", EGG: "egg"}
MESHES = ("fast, coarser", "fast", "standard", "reference")
IDENTITY = (
    ("latex", 1.5, 1.2, sp.Load()),
    ("latex", 1.57, 1.1, sp.Load()),
    ("latex", 2.0, 1.3, sp.Load()),
    ("latex", 1.5, 1.2, sp.Load("5.4 kPa", "hydrostatic")),
    ("latex", 1.5, 1.2, sp.Load("5.4 kPa", "dead")),
    ("latex", 1.5, 1.2, sp.Load(prestretch=1.1)),
    ("latex", 1.5, 1.2, sp.Load(), sp.Shape(0.5)),
    ("latex", 1.5, 1.2, sp.Load(), sp.Shape(2.0)),
    ("latex", 1.5, 1.2, sp.Load(), BLUNT),
    ("latex", 1.5, 1.2, sp.Load(), EGG),
    ("ureter", 1.3, 1.1, sp.Load()),
    ("ureter", 1.3, 1.2, sp.Load()),
    ("ureter", 3.4, 1.1, sp.Load()),
    ("ureter", 1.3, 1.2, sp.Load(prestretch=1.05)),
    ("ureter", 1.3, 1.2, sp.Load(), sp.Shape(1.4)),
    ("ureter", 1.3, 1.2, sp.Load(), EGG),
)
NAMED = (("latex", 1.5, 1.2, 0.475), ("ureter", 1.3, 1.21, 0.5), ("ureter", 3.4, 1.11, 0.5))


@dataclass(frozen=True)
class Drawn:
    """Result of one case of the grid, and its errors compared with `reference` if solved."""

    text: str
    outcome: str
    cause: str
    microbuckled: bool
    seconds: float
    penetration: float
    errors: tuple[tuple[float, float], ...]  # true and stated: α, σ(π/2), P_ucr


def section() -> Section:
    rows = [(*row, sp.Shape())[:5] for row in IDENTITY]
    identity = on_all_cores("identity", identity_row, rows)
    friction = on_all_cores("energy with friction", friction_row, NAMED)
    meshes = on_all_cores("convergence", convergence_row, NAMED)
    kept = on_all_cores("kept stiffness", kept_row, NAMED[1:])
    jobs = [(case, k < REFERENCED) for k, case in enumerate(cases())]
    drawn: list[Drawn] = on_all_cores("push-through grid", draw, jobs)
    return Section(
        title="The push-through, solved directly",
        text=(
            "Without friction the force N on the held stone is [known](theory.md#identity): it is "
            "I(P) = ∫ π r_a² dp if the wall has the same axial stretch far from the stone on both "
            "sides, and follows from the two stretches otherwise. P is the pressure that opens the "
            "tube halfway from its lumen to R_s. The first table compares N with I, and with the "
            "exact force for the computed stretches, at default settings with held ends and L = 10 "
            "R_a. Its last column is for a weak axial tether instead of held ends, at the accuracy "
            "`reference`. With held ends, N/I − 1 is not an error but the effect of the strains of "
            "the two sides. With friction, N + D takes the place of N, where D is the energy that "
            "friction dissipates for a unit advance of the stone."
            f"\n\nThe random grid has {GRID} cases (seed {SEED}) with η 1.15–3.4, ξ 1.02–1.4 "
            "(latex) or 1.02–1.3 (ureter) and μ 0.05–0.8. The first "
            f"{REFERENCED} are compared with the accuracy `reference`."
        ),
        tables=[
            (
                "N without friction:",
                ("case", "held ends: N/I − 1", "held ends: N/exact − 1", "tether: N/I − 1"),
                [row[0] for row in identity],
            ),
            (
                "With friction, differences divided by I:",
                ("case", "held ends: N + D − exact", "tether: N + D − I"),
                [row[0] for row in friction],
            ),
            (
                "P_ucr in kPa on finer meshes and longer tubes:",
                ("case", *MESHES, "L = 20", "L = 40"),
                [row[0] for row in meshes],
            ),
            (
                "P_ucr in kPa if other fractions of the ground matrix remain in the [relaxed "
                "energy](theory.md#microbuckling-and-the-relaxed-energy):",
                ("case", "0.1", "0.2 (default)", "0.3", "stability margin"),
                [row[0] for row in kept],
            ),
            ("Random grid:", ("", "cases"), grid_rows(drawn)),
            ("Cases without a solution:", ("case", "reason"), failures(drawn)),
        ],
        checks=[
            at_most("held ends: N within {} of the exact force", EXACT, [r[1] for r in identity]),
            at_most("tether: N within {} of I", REFINED_EXACT, [r[2] for r in identity]),
            at_most("friction, held ends: N + D within {}", EXACT, [r[1] for r in friction]),
            at_most("friction, tether: N + D within {}", REFINED_EXACT, [r[2] for r in friction]),
            at_most("P_ucr: mesh converged to {}", CONVERGED, [r[1] for r in meshes]),
            at_most("P_ucr: length converged to {}", CONVERGED, [r[2] for r in meshes]),
            at_most("kept stiffness: P_ucr changes by less than {}", 2e-3, [r[1] for r in kept]),
            *grid_checks(drawn),
        ],
    )  # fmt: skip


def at_most(claim: str, bound: float, values: Sequence[float]) -> Check:
    worst = max(values)
    return Check(claim.format(f"{bound:.2%}"), f"{worst:.1e} at worst", worst <= bound)


def case_of(
    material: str,
    eta: float,
    xi: float,
    load: sp.Load | None = None,
    mu: float = 0.0,
    shape: sp.Shape | None = None,
) -> sp.Case:
    return sp.Case(
        sp.Stone(size_ratio=xi, friction=mu, shape=shape),
        sp.Ureter(wall_ratio=eta, material=material),
        load or sp.Load(),
        sp.PushThrough(),
    )


def half_open(case: sp.Case) -> float:
    """Return the pressure in Pa that opens the tube halfway from its lumen to R_s."""
    lumen = opened_radius(case, 0.0)
    assert lumen is not None
    target = lumen + SHARE * (case.size_ratio - lumen)
    low, high = 0.0, 1e6
    for _ in range(60):
        middle = (low + high) / 2.0
        radius = opened_radius(case, middle)
        low, high = (low, middle) if radius is None or radius > target else (middle, high)
    return low


def pushed(case: sp.Case, pressure: float, resolution: Resolution, tether: float = 0.0):
    state = sp.push_through(case, Pressure(pressure), resolution, tether=tether)
    assert isinstance(state, sp.PushedState), state
    return state


def identity_row(material: str, eta: float, xi: float, load: sp.Load, shape: sp.Shape):
    case = case_of(material, eta, xi, load, shape=shape)
    pressure = half_open(case)
    gained = advance_force(case, pressure)
    assert gained is not None
    held = pushed(case, pressure, LEVELS["standard"].resolution)
    exact = strained_force(case, pressure, held.upstream_stretch, held.downstream_stretch)
    tied = pushed(case, pressure, LEVELS["reference"].resolution, TETHER)
    to_gain, to_exact, tied_to_gain = (
        held.net_force / gained - 1.0,
        held.net_force / exact - 1.0,
        tied.net_force / gained - 1.0,
    )
    loads = f", {load.confining_pressure / 1e3:g} kPa {load.confinement}" * (
        load.confining_pressure > 0.0
    )
    loads += f", λ_z {load.prestretch:g}" * (load.prestretch != 1.0)
    loads += f", {NAMES.get(shape, f'aspect {shape.aspect:g}')}" * (shape != sp.Shape())
    cells = [
        f"{material}, η {eta:g}, ξ {xi:g}{loads}, {pressure / 1e3:.3g} kPa",
        *(f"{value:+.1e}" for value in (to_gain, to_exact, tied_to_gain)),
    ]
    return cells, abs(to_exact), abs(tied_to_gain)


def friction_row(material: str, eta: float, xi: float, mu: float):
    case = case_of(material, eta, xi, mu=mu)
    pressure = half_open(case)
    gained = advance_force(case, pressure)
    assert gained is not None
    held = pushed(case, pressure, LEVELS["standard"].resolution)
    exact = strained_force(case, pressure, held.upstream_stretch, held.downstream_stretch)
    tied = pushed(case, pressure, LEVELS["reference"].resolution, TETHER)
    errors = (
        (held.net_force + held.friction_work - exact) / gained,
        (tied.net_force + tied.friction_work - gained) / gained,
    )
    cells = [f"{material}, η {eta:g}, ξ {xi:g}, μ {mu:g}", *(f"{e:+.1e}" for e in errors)]
    return cells, *(abs(e) for e in errors)


def convergence_row(material: str, eta: float, xi: float, mu: float):
    case = case_of(material, eta, xi, mu=mu)
    fast = LEVELS["fast"]
    resolutions = (fast.companion, fast.resolution, LEVELS["standard"].resolution,
                   LEVELS["reference"].resolution)  # fmt: skip
    meshes = [critical(case, resolution) for resolution in resolutions]
    longer = [
        critical(replace(case, numerics=replace(case.numerics, half_length=L)), resolutions[2])
        for L in (20.0, 40.0)
    ]
    cells = [
        f"{material}, η {eta:g}, ξ {xi:g}, μ {mu:g}",
        *(f"{value / 1e3:.4f}" for value in (*meshes, *longer)),
    ]
    return cells, abs(meshes[2] / meshes[3] - 1.0), abs(meshes[2] / longer[1] - 1.0)


def kept_row(material: str, eta: float, xi: float, mu: float):
    case, found = case_of(material, eta, xi, mu=mu), []
    margin = 0.0
    for kept in (0.1, 0.2, 0.3):
        with patch("stonepass.model.states.loaded.relaxed", lambda law, k=kept: relaxed(law, k)):
            answer = sp.solve(case, LEVELS["fast"].resolution)
        assert answer.pressure is not None
        assert answer.contact is not None
        found.append(answer.pressure)
        margin = answer.contact.stability.margin
    cells = [
        f"{material}, η {eta:g}, ξ {xi:g}, μ {mu:g}",
        *(f"{value / 1e3:.4f}" for value in found),
        f"{margin:.1f}",
    ]
    return cells, (max(found) - min(found)) / found[1]


def critical(case: sp.Case, resolution: Resolution) -> float:
    answer = sp.solve(case, resolution)
    assert answer.pressure is not None, answer.message
    return answer.pressure


def draw(case: sp.Case, referenced: bool) -> Drawn:
    started = time.perf_counter()
    answer = sp.solve(case)
    seconds = time.perf_counter() - started
    state, error, errors = answer.contact, answer.error, []
    if referenced and state is not None and error is not None and answer.pressure is not None:
        fine = sp.solve(case, LEVELS["reference"].resolution)
        if fine.contact is not None and fine.pressure is not None:
            assert error.critical_pressure is not None
            equator = fine.contact.equator_contact_pressure
            errors = [
                (abs(state.contact_angle - fine.contact.contact_angle), error.contact_angle),
                (abs(state.equator_contact_pressure - equator), error.equator_contact_pressure),
                (abs(answer.pressure - fine.pressure), error.critical_pressure),
            ]
    return Drawn(
        text=f"{case.ureter.material.name}, η {case.wall_ratio:.3f}, ξ {case.size_ratio:.4f}, "
        f"μ {case.stone.friction:.2f}",
        outcome=answer.outcome.name,
        cause=answer.message.partition(": ")[2],
        microbuckled=state is not None and state.stability.margin <= 0.0,
        seconds=seconds,
        penetration=0.0 if state is None else state.solver.penetration,
        errors=tuple(errors),
    )


def grid_rows(drawn: Sequence[Drawn]) -> list[list[str]]:
    seconds = sorted(each.seconds for each in drawn)
    rows = [[f"`{name}`", str(sum(each.outcome == name for each in drawn))]
            for name in ("MOVES", "LEAKS", "NO_SOLUTION")]  # fmt: skip
    rows.append(["cases with microbuckling", str(sum(each.microbuckled for each in drawn))])
    passed = sum(each.penetration > 1e-6 for each in drawn)
    rows.append(["cases whose open wall penetrates the stone by more than 1e-6 R_s", str(passed)])
    rows.append(
        ["time in s, median and largest", f"{seconds[len(seconds) // 2]:.1f}, {seconds[-1]:.1f}"]
    )
    return rows


def failures(drawn: Sequence[Drawn]) -> list[list[str]]:
    lost = [[each.text, each.cause] for each in drawn if each.outcome == "NO_SOLUTION"]
    return lost or [["none", ""]]


def grid_checks(drawn: Sequence[Drawn]) -> list[Check]:
    solved = sum(each.outcome != "NO_SOLUTION" for each in drawn)
    checks = [
        Check(
            f"at least {SOLVED:.0%} of the grid is solved; the others state the reason",
            f"{solved} of {len(drawn)}",
            solved >= SOLVED * len(drawn)
            and all(each.cause for each in drawn if each.outcome == "NO_SOLUTION"),
        )
    ]
    measured = [each.errors for each in drawn if each.errors]
    for k, quantity in enumerate(("α", "σ(π/2)", "P_ucr")):
        covered = sum(errors[k][0] <= errors[k][1] for errors in measured)
        true, claimed = (np.array([errors[k][i] for errors in measured]) for i in (0, 1))
        checks.append(
            Check(
                f"at least {COVERED:.0%} of the errors of {quantity} are within the stated error",
                f"{covered} of {len(measured)}; median of true over stated error "
                f"{np.median(true / claimed):.2f}",
                covered >= COVERED * len(measured) > 0,
            )
        )
    return checks


def cases() -> list[sp.Case]:
    random, found = np.random.default_rng(SEED), []
    for k in range(GRID):
        material = ("latex", "ureter")[k % 2]
        eta = 1.0 + 10.0 ** random.uniform(np.log10(0.15), np.log10(2.4))
        top = {"latex": 0.4, "ureter": 0.3}[material]
        xi = 1.0 + 10.0 ** random.uniform(np.log10(0.02), np.log10(top))
        found.append(case_of(material, eta, xi, mu=random.uniform(0.05, 0.8)))
    return found
