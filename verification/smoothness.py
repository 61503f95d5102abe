"""Smoothness of contact angle and critical pressure as functions of size and wall ratio."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from cores import on_all_cores
from page import Check, Section
from robustness import describe, families

import stonepass as sp
from stonepass.array_types import Float
from stonepass.fe.axisymmetric.problem import Resolution
from stonepass.model.far_field import lumen_ratio

SEED, RANDOM_LINES = 20246, 14
POINTS, DEGREE = 13, 3
SMOOTH = 0.01
PRESSURE_STEP, ANGLE_STEP = 1e-4, 1e-3  # of P_ucr; degrees of α₀
STEP = 0.01  # between neighbours, as a fraction of ξ − lumen or η − 1
NAMED = (
    ("latex", 1.5, 1.2, 0.475, "frictionless"),
    ("latex", 1.5, 1.2, 0.475, "pressed"),
    ("ureter", 1.3, 1.21, 0.5, "frictionless"),
    ("ureter", 1.3, 1.21, 0.5, "pressed"),
    ("ureter", 3.4, 1.11, 0.5, "pressed"),
    ("ureter", 3.4, 1.11, 0.5, "growing"),
)
VARIABLES = ("ξ", "η")


@dataclass(frozen=True)
class Line:
    """Neighbouring solves along ξ or η: the largest deviation of each slope from a smooth one.

    The steps are these deviations times the interval: relative for P_ucr, in degrees for α₀.
    `kinked` says that some state has no smooth contact edge, as in a wall that has lost its
    stability; the answer reports this.
    """

    case: sp.Case
    variable: str
    pressure: float
    angle: float
    pressure_step: float
    angle_step: float
    kinked: bool


def section() -> Section:
    jobs = [(case, variable) for case in cases() for variable in VARIABLES]
    lines = on_all_cores("smoothness", line, jobs)
    rows = [
        [describe(along_xi.case), *(cell for pair in along(along_xi, along_eta) for cell in pair)]
        for along_xi, along_eta in zip(lines[::2], lines[1::2], strict=True)
    ]
    smooth = [each for each in lines if not each.kinked]
    enough = len(smooth) > len(NAMED) + RANDOM_LINES
    slope = max(each.pressure for each in smooth if each.variable == "ξ")
    pressure, angle = (
        max(getattr(each, f"{k}_step") for each in smooth) for k in ("pressure", "angle")
    )
    checks = [
        Check(
            f"dP_ucr/dξ from neighbouring solves is smooth to {SMOOTH:.0%}",
            f"{slope:.2%} at worst",
            enough and slope <= SMOOTH,
        ),
        Check(
            f"P_ucr has no relative step above {PRESSURE_STEP:.0e}, along ξ and η",
            f"{pressure:.0e} at worst, {len(smooth)} lines",
            enough and pressure <= PRESSURE_STEP,
        ),
        Check(
            f"α₀ has no step above {ANGLE_STEP}°, along ξ and η",
            f"{angle:.4f}° at worst, {len(smooth)} lines",
            enough and angle <= ANGLE_STEP,
        ),
    ]
    return Section(
        title="Smoothness",
        text=(
            f"Each line has {POINTS} neighbouring solves at default settings. The distance of "
            f"neighbours is {STEP:.0%} of ξ − ξ_lumen, where ξ_lumen is the lumen under load "
            f"divided by the inner diameter, or {STEP:.0%} of η − 1. A step of P_ucr by one "
            "ten-thousandth then shows as 1 % of its slope. The table compares the slopes between "
            f"neighbours with those of a polynomial of degree {DEGREE} through all points and "
            "gives the largest deviation, divided by the mean slope. If the mean slope is smaller "
            "than a tenth of the mean of the quantity (P_ucr or π/2 − α₀) divided by ξ − ξ_lumen "
            "or η − 1, the deviation is divided by the latter. Along η a slope can nearly vanish, "
            "so that the steps are checked there: the same deviations times the distance of "
            "neighbours. The deviations that remain come from the increments of the path, and from "
            "the number of element rows, which changes with the wall. The element next to the "
            "contact edge spans 2 % of the contact. There are six named cases and "
            f"{RANDOM_LINES} cases drawn as in the section *Robustness* (seed {SEED}). *No smooth "
            "edge* means that a state has no smooth contact edge, as in a wall that has lost its "
            "stability."
        ),
        tables=[
            ("", ("case", "dP_ucr/dξ", "dα₀/dξ", "dP_ucr/dη", "dα₀/dη"), rows),
        ],
        checks=checks,
    )


def along(*lines: Line) -> list[tuple[str, str]]:
    return [
        ("no smooth edge",) * 2 if each.kinked else (f"{each.pressure:.2%}", f"{each.angle:.2%}")
        for each in lines
    ]


def line(case: sp.Case, variable: str) -> Line:
    share = STEP * np.arange(-(POINTS // 2), POINTS // 2 + 1)
    answers = [sp.solve(moved(case, variable, each)) for each in share]
    angle = np.array([a.contact.contact_angle for a in answers if a.contact is not None])
    pressure = np.array([a.pressure for a in answers if a.pressure is not None])
    kinked = any(
        a.contact.contact_angle_uncertainty > 0.0 for a in answers if a.contact is not None
    )
    if not len(angle) == len(pressure) == POINTS:
        return Line(case, variable, *([np.inf] * 4), kinked)
    open_angle = np.degrees(np.pi / 2 - angle)  # vanishes with the stretch, as P_ucr does
    steps = [float(rough(share, values).max()) for values in (pressure, open_angle)]
    slopes = [
        step / STEP / slope_scale(share, values)
        for step, values in zip(steps, (pressure, open_angle), strict=True)
    ]
    return Line(case, variable, *slopes, steps[0] / abs(pressure.mean()), steps[1], kinked)


def moved(case: sp.Case, variable: str, share: float) -> sp.Case:
    """Return the case with ξ − lumen, or η − 1 at the same ξ, larger by a fraction of itself."""
    if variable == "ξ":
        lumen = lumen_ratio(case.wall_ratio, case.ureter.material.law, case.load)
        assert lumen is not None
        return case.with_size_ratio(lumen + (case.size_ratio - lumen) * (1.0 + share))
    eta = 1.0 + (case.wall_ratio - 1.0) * (1.0 + share)
    return replace(case, ureter=sp.Ureter(wall_ratio=eta, material=case.ureter.material))


def rough(
    share: Float[np.ndarray, " n"], values: Float[np.ndarray, " n"]
) -> Float[np.ndarray, " m"]:
    """Return the deviations of the differences of neighbours from those of a smooth curve."""
    smooth = np.polynomial.Polynomial.fit(share, values, DEGREE)(share)
    return np.abs(np.diff(values) - np.diff(smooth))


def slope_scale(share: Float[np.ndarray, " n"], values: Float[np.ndarray, " n"]) -> float:
    """Return the mean slope, or a tenth of the mean value if that is larger."""
    mean = abs(values[-1] - values[0]) / (share[-1] - share[0])
    return float(max(mean, 0.1 * abs(values.mean())))


def cases() -> Sequence[sp.Case]:
    """Return the named cases and random cases that have a critical pressure."""
    found = [
        sp.Case(
            sp.Stone(size_ratio=xi, friction=mu),
            sp.Ureter(wall_ratio=eta, material=material),
            model=sp.SeatedBalance(seating=seating),
        )
        for material, eta, xi, mu, seating in NAMED
    ]
    drawn = families(SEED, 10 * RANDOM_LINES)
    for k, family in enumerate(drawn):
        if len(found) == len(NAMED) + RANDOM_LINES:
            return found
        case = family[k % len(family)]
        ends = [sp.solve(moved(case, "ξ", share), Resolution()).pressure for share in (-0.1, 0.1)]
        if all(ends):
            found.append(case)
    raise AssertionError("too few random cases move")
