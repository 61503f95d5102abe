"""Effect of the length of the tube if its ends are held."""

from __future__ import annotations

import numpy as np
from page import Check, Section

import stonepass as sp

LENGTHS = (6.0, 8.0, 10.0, 12.0, 16.0, 24.0, 40.0, 80.0)
CASES = (("latex", 1.5, 1.2), ("ureter", 1.3, 1.2), ("ureter", 3.4, 1.1))


def section() -> Section:
    rows, checks = [], []
    for material, eta, xi in CASES:
        sigma = np.array([equator(material, eta, xi, L) for L in LENGTHS])
        rows.append([f"{material} {eta:g}/{xi:g}", *(f"{s / 1e3:.3f}" for s in sigma)])
        eight_to_twelve = abs(sigma[3] / sigma[1] - 1.0)
        # σ = σ_∞ + a/L: predict L = 24 from L = 12 and 16.
        slope = (sigma[3] - sigma[4]) / (1 / LENGTHS[3] - 1 / LENGTHS[4])
        predicted = sigma[4] + slope * (1 / LENGTHS[5] - 1 / LENGTHS[4])
        missed = abs(predicted / sigma[5] - 1.0)
        checks += [
            Check(
                f"{material} η {eta:g}: σ(π/2) changes by less than 1 % from L = 8 to 12",
                f"{eight_to_twelve:.2%}",
                eight_to_twelve < 0.01,
            ),
            Check(
                f"{material} η {eta:g}: σ(π/2) varies as 1/L (L = 24 from 12 and 16 to 0.05 %)",
                f"{missed:.1e}",
                missed < 5e-4,
            ),
        ]
    return Section(
        title="Half-length of the tube",
        text=(
            "The table gives σ(π/2) in kPa for half-lengths L in units of R_a. The ends are held "
            "(u_z = 0), so that the bulge over the stone stretches the whole tube slightly. The "
            "effect is of order 1/L and not confined to a boundary layer at the ends. L is "
            "therefore an input."
        ),
        tables=[("", ("case η/ξ", *(f"L = {L:g}" for L in LENGTHS)), rows)],
        checks=checks,
    )


def equator(material: str, eta: float, xi: float, half_length: float) -> float:
    case = sp.Case(
        sp.Stone(size_ratio=xi),
        sp.Ureter(wall_ratio=eta, material=material),
        model=sp.SeatedBalance(seating="frictionless"),
        numerics=sp.Numerics(half_length=half_length),
    )
    return sp.seat(case).equator_contact_pressure
