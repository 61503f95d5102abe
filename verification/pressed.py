"""Seating with friction: convergence with the increments, no friction, and full stick."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from page import Check, Section

import stonepass as sp
from stonepass.fe.axisymmetric.problem import Resolution
from stonepass.model.accuracy import LEVELS

ACCURACY = (
    ("latex", 1.5, 1.2, 0.475),
    ("latex", 3.0, 1.4, 0.3),
    ("latex", 1.2, 1.05, 0.2),
    ("ureter", 1.3, 1.1, 0.5),
    ("ureter", 1.3, 1.28, 0.5),
    ("ureter", 3.4, 1.11, 0.5),
    ("ureter", 3.4, 1.25, 0.2),
)
INCREMENTS = (2, 4, 8, 16, 32, 64)
THREE = (("latex", 1.5, 1.2, 0.475), ("ureter", 1.3, 1.21, 0.5), ("ureter", 3.4, 1.11, 0.5))


def section() -> Section:
    increments, increment_checks = increment_table()
    accuracy, accuracy_checks = accuracy_table()
    limits, limit_checks = limit_table()
    return Section(
        title="Seating with friction",
        text=(
            "The arc is pressed radially into the wall, and points of the wall stick or slip. The "
            "default is 8 increments. The section *Robustness* has random cases."
        ),
        tables=[
            (
                "P_ucr in kPa for different numbers of increments:",
                ("material η/ξ/μ", *(str(n) for n in INCREMENTS)),
                increments,
            ),
            (
                "The default settings compared with the accuracy `reference`, which has 32 "
                "increments, twice the columns of elements on the path, and order 5 on a finer "
                "fitted mesh. The last two columns are relative errors:",
                ("material η/ξ/μ", "α₀ (°)", "error α₀ (°)", "P_ucr", "σ(π/2)"),
                accuracy,
            ),
            (
                "From no friction to full stick (latex, η 1.5, ξ 1.2; σ in kPa, energy over R_a³):",
                ("μ during seating", "α₀ (°)", "σ(π/2)", "slipping fraction", "dissipated (Pa)"),
                limits,
            ),
        ],
        checks=[*increment_checks, *accuracy_checks, *limit_checks],
    )


def increment_table() -> tuple[list[list[str]], list[Check]]:
    rows, checks = [], []
    for material, eta, xi, mu in THREE:
        case = sp.Case(
            sp.Stone(size_ratio=xi, friction=mu), sp.Ureter(wall_ratio=eta, material=material)
        )
        pressures = [with_increments(case, n) for n in INCREMENTS]
        rows.append([f"{material} {eta:g}/{xi:g}/{mu:g}", *(f"{p / 1e3:.4f}" for p in pressures)])
        spread = max(abs(p / pressures[-1] - 1.0) for p in pressures[2:])
        checks.append(
            Check(
                f"{material} η {eta:g}: P_ucr with 8 or more increments within 0.3 % of 64",
                f"{spread:.2%}",
                spread <= 3e-3,
            )
        )
    return rows, checks


def accuracy_table() -> tuple[list[list[str]], list[Check]]:
    rows, angles, pressures, equators = [], [], [], []
    for material, eta, xi, mu in ACCURACY:
        case = sp.Case(
            sp.Stone(size_ratio=xi, friction=mu), sp.Ureter(wall_ratio=eta, material=material)
        )
        default, fine = sp.solve(case), sp.solve(case, LEVELS["reference"].resolution)
        angles.append(np.degrees(abs(default.contact.contact_angle - fine.contact.contact_angle)))
        pressures.append(abs(default.pressure / fine.pressure - 1.0))
        sigma = [a.contact.equator_contact_pressure for a in (default, fine)]
        equators.append(abs(sigma[0] / sigma[1] - 1.0))
        alpha = np.degrees(default.contact.contact_angle)
        rows.append([f"{material} {eta:g}/{xi:g}/{mu:g}", f"{alpha:.3f}"])
        rows[-1] += [f"{angles[-1]:.4f}", f"{pressures[-1]:.1e}", f"{equators[-1]:.1e}"]
    return rows, [
        Check("α₀ within 0.05°", f"{max(angles):.4f}°", max(angles) <= 0.05),
        Check("σ(π/2) within 4 %", f"{max(equators):.2%}", max(equators) <= 0.04),
        Check("P_ucr within 0.3 %", f"{max(pressures):.2%}", max(pressures) <= 3e-3),
    ]


def with_increments(case: sp.Case, count: int) -> float:
    return sp.solve(case, replace(Resolution(), increments=count)).pressure


def limit_table() -> tuple[list[list[str]], list[Check]]:
    rows, states = [], {}
    for mu in (0.0, 0.001, 0.01, 0.1, 0.3, 0.475, 1.0, 2.0):
        case = sp.Case(
            sp.Stone(size_ratio=1.2),
            sp.Ureter(wall_ratio=1.5, material="latex"),
            model=sp.SeatedBalance(seating_friction=mu),
        )
        state = states[mu] = sp.seat(case)
        cone = mu * state.contact_pressure
        slipping = np.abs(state.friction_traction) >= 0.999 * cone if mu else np.ones(1)
        rows.append(
            [
                f"{mu:g}",
                f"{np.degrees(state.contact_angle):.4f}",
                f"{state.equator_contact_pressure / 1e3:.3f}",
                f"{slipping.mean():.0%}",
                f"{state.solver.dissipated:.3g}",
            ]
        )
    small = abs(states[0.001].contact_angle - states[0.0].contact_angle)
    one, two = (states[mu] for mu in (1.0, 2.0))
    theta = np.linspace(max(one.theta[0], two.theta[0]), np.pi / 2, 400)
    change = two.pressure_at(theta) - one.pressure_at(theta)
    large = float(np.sqrt((change**2).mean()) / one.peak_contact_pressure)
    return rows, [
        Check(
            "α₀ tends to that of the frictionless state as μ → 0 (μ = 0.001)",
            f"{np.degrees(small):.4f}°",
            np.degrees(small) < 0.01,
        ),
        Check(
            "σ(θ) tends to that of full stick as μ grows (rms change from μ = 1 to 2)",
            f"{large:.2%}",
            large < 0.01,
        ),
    ]
