"""Random convex stones: seated, pushed through, and turned round."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from cores import on_all_cores
from page import Check, Section

import stonepass as sp
from stonepass.errors import BadInput
from stonepass.fe.axisymmetric.problem import Resolution
from stonepass.model.accuracy import LEVELS
from stonepass.model.energy_balance import advance_force, opening_pressure
from stonepass.model.states.loaded_state import PushedState
from stonepass.units import Pressure

SEED, GRID = 20249, 60
SOLVED, EXACT, MIRRORED, THROUGH, COVERED = 0.98, 5e-4, 1e-5, 1e-4, 0.95
TETHER, SHARE = 0.1, 0.6
POINTS = 61
LENGTHS = (0.55, 1.9)  # over the diameter; shapes close to 0.5 and 2 may be refused
LEAST_CURVATURE = 0.15  # g + g″: 1 on a spheroid


@dataclass(frozen=True)
class Drawn:
    """Results of one stone."""

    text: str
    outcomes: tuple[str, ...]  # frictionless, pressed, direct
    causes: tuple[str, ...]
    identity: float | None  # N/I − 1 without friction
    turned: float | None  # difference of the contact edges from those of the stone turned round
    through: float  # largest error of ρ of the shape fitted to its own points
    errors: tuple[tuple[float, float], ...]  # true and stated error of P_ucr, pressed and direct


def section() -> Section:
    drawn: list[Drawn] = on_all_cores("random shapes", draw, [(case,) for case in cases()])
    return Section(
        title="Stones that are not spheres",
        text=(
            f"{GRID} random convex stones (seed {SEED}) have lengths from {LENGTHS[0]} to "
            f"{LENGTHS[1]} diameters, outlines g of six terms and a curvature g + g″ of at least "
            f"{LEAST_CURVATURE}; half of them have mirror symmetry. Each is seated without "
            "friction, pressed in with friction, and pushed through. Without friction the force "
            "on the held stone must be I(P) whatever its shape (weak axial tether, mesh of "
            "`reference`). The seated state of the stone turned round must be the mirror image. A "
            "shape fitted to points of its own meridian must reproduce itself."
        ),
        tables=[
            ("Outcomes:", ("model", "`MOVES`", "`NO_SOLUTION`", "other"), outcome_rows(drawn)),
            ("Cases without a solution:", ("stone", "reason"), failures(drawn)),
        ],
        checks=checks(drawn),
    )


def draw(case: sp.Case) -> Drawn:
    answers = [
        sp.solve(replace(case, model=model))
        for model in (
            sp.SeatedBalance(seating="frictionless"),
            sp.SeatedBalance(),
            sp.PushThrough(),
        )
    ]
    shape = case.stone.shape
    return Drawn(
        text=f"{case.ureter.material.name}, η {case.wall_ratio:.3f}, ξ {case.size_ratio:.4f}, "
        f"μ {case.stone.friction:.2f}, aspect {shape.aspect:.2f}",
        outcomes=tuple(answer.outcome.name for answer in answers),
        causes=tuple(answer.message.partition(": ")[2] for answer in answers),
        identity=identity(case),
        turned=turned(case),
        through=through(shape),
        errors=tuple(error for answer in answers[1:] if (error := claimed(answer)) is not None),
    )


def identity(case: sp.Case) -> float | None:
    bare = replace(case.with_friction(0.0), model=sp.PushThrough())
    pressure = Pressure(SHARE * opening_pressure(bare))
    state = sp.push_through(bare, pressure, LEVELS["reference"].resolution, tether=TETHER)
    gained = advance_force(bare, pressure)
    if not isinstance(state, PushedState) or gained is None:
        return None
    return state.net_force / gained - 1.0


def turned(case: sp.Case) -> float | None:
    """Return the largest difference of the contact edges in rad, without friction."""
    smooth = sp.SeatedBalance(seating="frictionless")
    mirrored = sp.Stone(size_ratio=case.size_ratio, shape=case.stone.shape.turned())
    one = sp.seat(replace(case, model=smooth), Resolution())
    other = sp.seat(replace(case, stone=mirrored, model=smooth), Resolution())
    if not isinstance(one, sp.SeatedState) or not isinstance(other, sp.SeatedState):
        return None
    return max(
        abs(one.contact_angle + other.downstream_angle - np.pi),
        abs(one.downstream_angle + other.contact_angle - np.pi),
    )


def through(shape: sp.Shape) -> float:
    rho, z = shape.meridian(np.linspace(0.0, np.pi, POINTS))
    fine = np.linspace(0.0, np.pi, 4001)[1:-1]
    found = sp.shape_through(z, rho)
    there = np.interp(shape.meridian(fine)[1], *found.meridian(fine)[::-1])
    middle = np.abs(np.cos(fine)) < 0.9  # at the poles ρ has no slope in z
    return float(np.abs(there - shape.width(fine))[middle].max())


def claimed(answer: sp.Answer) -> tuple[float, float] | None:
    if answer.error is None or answer.pressure is None or answer.error.critical_pressure is None:
        return None
    fine = sp.solve(answer.case, LEVELS["reference"].resolution)
    if fine.pressure is None:
        return None
    return abs(answer.pressure - fine.pressure), answer.error.critical_pressure


def outcome_rows(drawn: Sequence[Drawn]) -> list[list[str]]:
    rows = []
    for k, name in enumerate(("frictionless", "pressed", "direct")):
        found = [each.outcomes[k] for each in drawn]
        moved, lost = found.count("MOVES"), found.count("NO_SOLUTION")
        rows.append([name, str(moved), str(lost), str(len(found) - moved - lost)])
    return rows


def failures(drawn: Sequence[Drawn]) -> list[list[str]]:
    lost = [
        [each.text, cause]
        for each in drawn
        for outcome, cause in zip(each.outcomes, each.causes, strict=True)
        if outcome == "NO_SOLUTION"
    ]
    return lost or [["none", ""]]


def checks(drawn: Sequence[Drawn]) -> list[Check]:
    asked = [outcome for each in drawn for outcome in each.outcomes]
    solved = len(asked) - asked.count("NO_SOLUTION")
    exact = [abs(each.identity) for each in drawn if each.identity is not None]
    mirrored = [each.turned for each in drawn if each.turned is not None]
    errors = [error for each in drawn for error in each.errors]
    covered = sum(true <= claim for true, claim in errors)
    return [
        Check(
            f"at least {SOLVED:.0%} solved",
            f"{solved} of {len(asked)}",
            solved >= SOLVED * len(asked),
        ),
        worst(f"N within {EXACT:.2%} of I(P)", exact, EXACT, len(drawn)),
        worst(f"turned round: mirror image to {MIRRORED:g} rad", mirrored, MIRRORED, len(drawn)),
        worst(
            f"fitted to its own points: the shape to {THROUGH:g} R_s",
            [each.through for each in drawn],
            THROUGH,
            len(drawn),
        ),
        Check(
            f"at least {COVERED:.0%} of the errors of P_ucr are within the stated error",
            f"{covered} of {len(errors)}",
            covered >= COVERED * len(errors) > 0,
        ),
    ]


def worst(claim: str, values: Sequence[float], bound: float, asked: int) -> Check:
    most = max(values)
    return Check(
        claim,
        f"{most:.1e} at worst, {len(values)} of {asked} stones",
        most <= bound and len(values) >= SOLVED * asked,
    )


def cases() -> list[sp.Case]:
    random = np.random.default_rng(SEED)
    found: list[sp.Case] = []
    while len(found) < GRID:
        material = ("latex", "ureter")[len(found) % 2]
        eta = 1.0 + 10.0 ** random.uniform(np.log10(0.15), np.log10(2.4))
        top = {"latex": 0.3, "ureter": 0.25}[material]
        xi = 1.0 + 10.0 ** random.uniform(np.log10(0.03), np.log10(top))
        shape = random_shape(random, symmetric=len(found) % 4 >= 2)
        found.append(
            sp.Case(
                sp.Stone(size_ratio=xi, friction=random.uniform(0.05, 0.7), shape=shape),
                sp.Ureter(wall_ratio=eta, material=material),
            )
        )
    return found


def random_shape(random: np.random.Generator, *, symmetric: bool) -> sp.Shape:
    """Return a random shape whose curvature is well above zero."""
    while True:
        c2, c3, c4, c5 = random.normal(0.0, (0.12, 0.05, 0.03, 0.015))
        if symmetric:
            c3 = c5 = 0.0
        # g(π/2) = c0 − c2 + c4 = 1, g′(π/2) = −c1 + 3 c3 − 5 c5 = 0.
        outline = np.array([1.0 + c2 - c4, 3.0 * c3 - 5.0 * c5, c2, c3, c4, c5])
        k, tau = np.arange(6), np.linspace(0.0, np.pi, 361)
        curvature = np.cos(tau[:, None] * k) @ (outline * (1.0 - k**2))
        if curvature.min() < LEAST_CURVATURE:
            continue
        try:
            shape = sp.Shape(random.uniform(0.5, 2.0), tuple(outline))
        except BadInput:
            continue
        if LENGTHS[0] < shape.length < LENGTHS[1]:
            return shape
