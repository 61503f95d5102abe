"""Accuracy of the default settings for other materials, walls and sizes."""

from __future__ import annotations

import numpy as np
from page import Check, Section

import stonepass as sp
from stonepass.fe.axisymmetric.problem import Resolution

REFERENCE = Resolution(order=6, closed=12, edge=0.004, growth=1.5)
CASES = (
    *(("latex", eta, xi) for eta in (1.1, 1.5, 2.0, 3.5) for xi in (1.001, 1.05, 1.2, 1.5)),
    *(("ureter", eta, xi) for eta in (1.3, 3.4) for xi in (1.001, 1.02, 1.1, 1.2, 1.3)),
    *(("ureter-soft-cross", eta, xi) for eta in (1.3, 3.4) for xi in (1.02, 1.2)),
)


def section() -> Section:
    rows, angles, pressures, criticals = [], [], [], []
    for material, eta, xi in CASES:
        case = sp.Case(
            sp.Stone(size_ratio=xi, friction=0.3),
            sp.Ureter(wall_ratio=eta, material=material),
            model=sp.SeatedBalance(seating="frictionless"),
        )
        default, reference = sp.solve(case), sp.solve(case, REFERENCE)
        assert default.contact is not None, (material, eta, xi, default.message)
        assert reference.contact is not None, (material, eta, xi, reference.message)
        assert default.pressure is not None
        assert reference.pressure is not None
        angle = np.degrees(abs(default.contact.contact_angle - reference.contact.contact_angle))
        equator = abs(
            default.contact.equator_contact_pressure / reference.contact.equator_contact_pressure
            - 1
        )
        critical = abs(default.pressure / reference.pressure - 1)
        angles.append(angle)
        pressures.append(equator)
        criticals.append(critical)
        alpha = np.degrees(default.contact.contact_angle)
        rows.append(
            [
                material,
                f"{eta:g}",
                f"{xi:g}",
                f"{alpha:.3f}",
                f"{angle:.4f}",
                f"{equator:.0e}",
                f"{critical:.0e}",
            ]
        )
    return Section(
        title="Accuracy of the default settings in other cases",
        text=(
            "The default settings are compared with elements of order 6 on a mesh that is five "
            "times finer at the contact edge. The last two columns are relative errors."
        ),
        tables=[("", ("material", "η", "ξ", "α₀ (°)", "error α₀ (°)", "σ(π/2)", "P_ucr"), rows)],
        checks=[
            Check("α₀ within 0.05°", f"{max(angles):.4f}°", max(angles) <= 0.05),
            Check("σ(π/2) within 0.2 %", f"{max(pressures):.1e}", max(pressures) <= 2e-3),
            Check(
                "P_ucr (friction 0.3) within 0.2 %", f"{max(criticals):.1e}", max(criticals) <= 2e-3
            ),
        ],
    )
