"""A grid of difficult cases, each of which must end in a sound answer or a physical reason."""

from __future__ import annotations

import itertools
import time
from collections import Counter
from dataclasses import dataclass

import numpy as np
from cores import on_all_cores
from page import Check, Section

import stonepass as sp
from stonepass.errors import Outcome
from stonepass.materials.catalogue import material
from stonepass.materials.fung import Fung
from stonepass.model.far_field import lumen_ratio
from stonepass.model.states.stability import axisymmetric_buckling, far_field_hint

SEED, FAMILIES, SIZES = 20244, 200, 3
TOP = {"latex": 0.6, "ureter": 0.35}  # largest ξ − 1
SMALLEST = 5e-4
BALANCE, THIN, BALANCE_PRESSED = 0.02, 1.15, 0.01
# Rounding may make the dissipation negative by this fraction of the work of the contact pressure.
TAKEN = 1e-6
FLAWS = (
    "gap ≥ 0",
    "pressure ≥ 0",
    "complementarity",
    "wall volume constant to 1e-8",
    "J > 0",
    f"axial balance to {BALANCE:.0%}, pressed with η ≥ {THIN} to {BALANCE_PRESSED:.0%}",
    "friction within the friction cone",
    "friction dissipates energy",
)


@dataclass(frozen=True)
class Row:
    """Result of one case: `flaws` are the checks it fails, `cause` is why it has no state."""

    family: int
    law: str
    outcome: str
    pressure: float | None
    closure_end: float | None
    at_edge: bool
    cause: str
    unstable_tube: bool
    estimated: bool
    uncertain_edge: bool
    flaws: tuple[str, ...]
    tube: str
    case: str
    seconds: float


def section() -> Section:
    started = time.perf_counter()
    grid = list(enumerate(families(SEED, FAMILIES)))
    rows = list(itertools.chain.from_iterable(on_all_cores("robustness", run_family, grid)))
    elapsed = time.perf_counter() - started
    seconds = sorted(row.seconds for row in rows)
    tables = [
        (
            "Outcomes:",
            ("law", "cases", "`MOVES`", "`BEYOND_CLOSURE`", "tube unstable", "failed"),
            [outcome_row(rows, law) for law in TOP],
        ),
        ("Tubes that are unstable without a stone:", ("tube", "cases"), unstable_tubes(rows)),
        ("Other cases without a solution:", ("case", "reason"), failures(rows)),
    ]  # fmt: skip
    return Section(
        title="Robustness: a hard random grid",
        text=(
            f"{len(rows)} cases (seed {SEED}) form {FAMILIES} families, each with one tube, one "
            f"load, one friction coefficient and {SIZES} sizes. ξ is 1.0005–1.6 for latex and "
            "1.0005–1.35 for both stable readings of the ureter constants, with G of 5–100 kPa; η "
            "is 1.05–4, the friction coefficient 0–1 and L 6–40 R_a, with all seatings. P_out is "
            "zero in two families of five, otherwise 0–10 kPa, dead or hydrostatic. One family in "
            "three has a pre-stretch of up to 1.2, and its sizes are relative to its lumen. "
            f"The run took {elapsed / 60.0:.0f} minutes, and a case "
            f"{seconds[len(seconds) // 2]:.1f} s in the median and {seconds[-1]:.0f} s at most, "
            "error estimate included. A confining pressure can make a tube unstable even without a "
            "stone: waves along the tube, or shear bands in its wall, then lower its energy, so "
            "that no stable seated state exists. Cases without a solution whose tube alone is "
            "unstable in one of these ways are counted separately."
        ),
        tables=tables,
        checks=checks(rows),
    )


def checks(rows: list[Row]) -> list[Check]:
    found = [Check("at least 500 cases", str(len(rows)), len(rows) >= 500)]
    for law, share in (("latex", 0.998), ("ureter", 0.99)):
        asked = [row for row in rows if row.law == law and not row.unstable_tube]
        solved = [row for row in asked if not failed(row)]
        found.append(
            Check(
                f"{law}: at least {share:.1%} of the cases with a stable tube are solved",
                f"{len(solved)} of {len(asked)}",
                len(solved) >= share * len(asked) > 0,
            )
        )
    seated = [row for row in rows if row.outcome in ("MOVES", "BEYOND_CLOSURE")]
    for flaw in FLAWS:
        bad = [row for row in seated if flaw in row.flaws]
        shown = f"{len(seated) - len(bad)} of {len(seated)}"
        found.append(Check(flaw, "; ".join([shown, *(r.case for r in bad)]), not bad))
    pairs = monotone_pairs(rows)
    wrong = [b.case for a, b in pairs if b.pressure <= a.pressure]
    found.append(
        Check(
            "P_ucr increases with ξ among the `MOVES` of a family",
            "; ".join([f"{len(pairs) - len(wrong)} of {len(pairs)} pairs", *wrong]),
            len(pairs) > 100 and not wrong,
        )
    )
    moving = [row for row in seated if row.outcome == "MOVES"]
    beyond = [row.case for row in moving if row.pressure > row.closure_end * (1.0 + 1e-9)]
    found.append(
        Check(
            "P_ucr does not exceed the pressure at which the closure ends",
            "; ".join([f"{len(moving) - len(beyond)} of {len(moving)}", *beyond]),
            len(moving) > 100 and not beyond,
        )
    )
    named = [row for row in rows if row.outcome == "NO_SOLUTION"]
    found.append(
        Check(
            "every case without a solution states the reason",
            str(len(named)),
            all(row.cause for row in named),
        )
    )
    estimated = sum(row.estimated for row in seated)
    found.append(
        Check(
            "at least 99 % of the answers with a seated state have an error estimate",
            f"{estimated} of {len(seated)}",
            estimated >= 0.99 * len(seated),
        )
    )
    return found


def run_family(number: int, family: list[sp.Case]) -> list[Row]:
    return [run_case(number, case) for case in family]


def run_case(number: int, case: sp.Case) -> Row:
    started = time.perf_counter()
    answer = sp.solve(case)
    seconds = time.perf_counter() - started
    state, no_solution = answer.contact, answer.outcome is Outcome.NO_SOLUTION
    return Row(
        family=number,
        law="latex" if case.ureter.material.name == "latex" else "ureter",
        outcome=answer.outcome.name,
        pressure=answer.pressure,
        closure_end=answer.detail.closure_end_pressure if answer.detail else None,
        at_edge=any(each.code == "moves_at_contact_angle" for each in answer.warnings),
        cause=answer.message.partition(": ")[2] if no_solution else "",
        unstable_tube=no_solution and unstable_without_stone(case),
        estimated=answer.error is not None,
        uncertain_edge=state is not None and state.contact_angle_uncertainty > 0.0,
        flaws=() if state is None else tuple(flaws(state)),
        tube=describe(case, size=False),
        case=describe(case),
        seconds=seconds,
    )


def unstable_without_stone(case: sp.Case) -> bool:
    """Return whether the tube under its load buckles or loses its ellipticity without a stone."""
    buckles = bool(axisymmetric_buckling(case, case.numerics.half_length))
    return buckles or bool(far_field_hint(case))


def flaws(state: sp.SeatedState) -> list[str]:
    """Return the names of the checks that a solved state fails.

    The gap is computed from the deformed wall, and the contact pressure is −σ_nn of the stress in
    the wall. Neither uses the contact force of the solver.
    """
    wall, solver, case = state.wall, state.solver, state.case
    lumen = lumen_ratio(case.wall_ratio, case.ureter.material.law, case.load)
    assert wall is not None
    assert lumen is not None
    inner = wall.R == 1.0
    r, z = wall.r[inner] / case.size_ratio, wall.z[inner] / case.size_ratio
    gap = np.hypot(r, z) - 1.0
    closed = z < np.cos(state.contact_angle) * (1.0 - 1e-9)
    radial = wall.stress_rr[inner] * r + wall.stress_rz[inner] * z
    axial = wall.stress_rz[inner] * r + wall.stress_zz[inner] * z
    pressure = -(radial * r + axial * z)[closed]
    work = state.equator_contact_pressure * (case.size_ratio - lumen)
    strict = case.model.seating == "pressed" and case.wall_ratio >= THIN
    balance = BALANCE_PRESSED if strict else BALANCE
    held = (
        gap.min() > -1e-6,
        pressure.min() >= 0.0,
        # The gap is zero where there is pressure; elsewhere the pressure is zero by construction.
        np.abs(gap[closed]).max() < 1e-6 or state.contact_angle_uncertainty > 0.0,
        abs(solver.volume.wall) <= 1e-8,
        solver.volume.smallest > 0.0,
        solver.axial_balance <= balance,
        solver.cone_excess <= 1e-8,
        solver.dissipated >= -TAKEN * work,
    )
    return [name for name, holds in zip(FLAWS, held, strict=True) if not holds]


def failed(row: Row) -> bool:
    return row.outcome == "NO_SOLUTION" and not row.unstable_tube


def monotone_pairs(rows: list[Row]) -> list[tuple[Row, Row]]:
    """Return neighbours in ξ of one family that both move, and not at the seated angle."""
    pairs = []
    for _, members in itertools.groupby(rows, key=lambda row: row.family):
        moving = [row for row in members if row.outcome == "MOVES" and not row.at_edge]
        pairs += [pair for pair in itertools.pairwise(moving) if pair[1].pressure != 0.0]
    return pairs


def outcome_row(rows: list[Row], law: str) -> list[str]:
    mine = [row for row in rows if row.law == law]
    count = Counter(row.outcome for row in mine)
    unstable = sum(row.unstable_tube for row in mine)
    numbers = (len(mine), count["MOVES"], count["BEYOND_CLOSURE"], unstable, sum(map(failed, mine)))
    return [law, *map(str, numbers)]


def unstable_tubes(rows: list[Row]) -> list[list[str]]:
    count = Counter(row.tube for row in rows if row.unstable_tube)
    return [[tube, str(number)] for tube, number in count.items()] or [["none", "0"]]


def failures(rows: list[Row]) -> list[list[str]]:
    return [[row.case, row.cause] for row in rows if failed(row)] or [["none", ""]]


def families(seed: int, count: int) -> list[list[sp.Case]]:
    """Return families of cases that differ in the size of the stone; every second one is latex.

    The sizes of a family increase; ξ/ξ_lumen − 1 is log-uniform. Every third family has a
    pre-stretch of up to 1.2, so that some stones are smaller than the unloaded lumen. The
    pre-stretch has a random generator of its own, so that it does not change the other draws.
    """
    random, of_stretch = np.random.default_rng(seed), np.random.default_rng([seed, 1])
    found = []
    for k in range(count):
        law = ("latex", "ureter")[k % 2]
        eta = 1.0 + 10.0 ** random.uniform(np.log10(0.05), np.log10(3.0))
        low, high = np.log10(SMALLEST), np.log10(TOP[law])
        sizes = np.sort(1.0 + 10.0 ** random.uniform(low, high, SIZES))
        wall = material("latex") if law == "latex" else ureter(random)
        friction = random.uniform(0.0, 1.0)
        outside = random.uniform(0.0, 10.0) * (random.uniform() < 0.6)
        confinement = ("dead", "hydrostatic")[int(random.integers(2))]
        half_length = 6.0 * (40.0 / 6.0) ** random.uniform()
        seating = ("pressed", "pressed", "growing", "frictionless")[int(random.integers(4))]
        prestretch = float(of_stretch.uniform(1.0, 1.2)) if k % 3 == 0 else 1.0
        load = sp.Load(f"{outside} kPa", confinement, prestretch)
        if prestretch > 1.0 and (lumen := lumen_ratio(eta, wall.law, load)) is not None:
            sizes = sizes * lumen
        found.append(
            [
                sp.Case(
                    sp.Stone(size_ratio=float(xi), friction=friction),
                    sp.Ureter(wall_ratio=eta, material=wall),
                    load,
                    sp.SeatedBalance(seating=seating),
                    sp.Numerics(half_length=half_length),
                )
                for xi in sizes
            ]
        )
    return found


def ureter(random: np.random.Generator) -> sp.Material:
    base = material(("ureter", "ureter-soft-cross")[int(random.integers(2))])
    law = base.law
    assert isinstance(law, Fung)
    G = 10.0 ** random.uniform(np.log10(5e3), 5.0)
    own = Fung(law.C, law.a1111, law.a2222, law.a1122, G)
    return sp.Material(base.name, own, "", "", "", base.strain_range)


def describe(case: sp.Case, *, size: bool = True) -> str:
    law = case.ureter.material.law
    ground = f", G {law.G / 1e3:.0f} kPa" if isinstance(law, Fung) else ""
    load = case.load
    outside = f", {load.confining_pressure / 1e3:.1f} kPa {load.confinement}"
    outside = outside if load.confining_pressure else ""
    outside += f", λ_z {load.prestretch:.3f}" if load.prestretch != 1.0 else ""
    ratio = f", ξ {case.size_ratio:.4f}" if size else ""
    return (
        f"{case.ureter.material.name}{ground}, η {case.wall_ratio:.3f}{ratio}, "
        f"μ {case.stone.friction:.2f}{outside}, "
        f"L {case.numerics.half_length:.0f}, {case.model.seating}"
    )
