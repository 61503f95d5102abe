"""Convergence of the seated state with the mesh, and the error of the default settings."""

from __future__ import annotations

import itertools

import numpy as np
from page import Check, Section

import stonepass as sp
from stonepass.fe.axisymmetric.problem import Resolution
from stonepass.model.states.seated_state import SeatedState

LIMIT = Resolution(order=6, closed=16, edge=0.002, growth=1.4)
LADDER = (
    ("coarse", Resolution(order=3, closed=5, edge=0.1, growth=2.5)),
    ("", Resolution(order=4, closed=6, edge=0.05, growth=2.0)),
    ("**default**", Resolution()),
    ("", Resolution().refined(1.5)),
    ("", Resolution().refined(2.0)),
    ("", Resolution(order=5, closed=14, edge=0.005, growth=1.5)),
    ("limit", LIMIT),
)


def section() -> Section:
    case = sp.Case(
        sp.Stone(size_ratio=1.2, friction=0.475),
        sp.Ureter(wall_ratio=1.5, material="latex"),
        model=sp.SeatedBalance(seating="frictionless"),
    )
    states = [sp.seat(case, resolution) for _, resolution in LADDER]
    limit = states[-1]
    rows = [
        [
            name,
            str(resolution.order),
            str(state.solver.dofs),
            f"{np.degrees(state.contact_angle):.5f}",
            f"{np.degrees(state.contact_angle - limit.contact_angle):+.5f}",
            f"{state.equator_contact_pressure / 1e3:.4f}",
            f"{relative(state, limit):+.1e}",
            f"{equator_mismatch(state):.1e}",
            f"{abs(state.solver.volume.wall):.0e}",
            f"{state.solver.volume.rms:.1e}",
        ]
        for (name, resolution), state in zip(LADDER, states, strict=True)
    ]
    default = states[[name for name, _ in LADDER].index("**default**")]
    angle = np.degrees(abs(default.contact_angle - limit.contact_angle))
    rms = [state.solver.volume.rms for state in states]
    worst_volume = max(abs(state.solver.volume.wall) for state in states)
    errors = [abs(s.contact_angle - limit.contact_angle) for s in states[:-1]]
    return Section(
        title="Mesh refinement: latex, η = 1.5, ξ = 1.2, frictionless, L = 10 R_a",
        text=(
            "The contact edge is a grid line and an unknown. The contact angle therefore converges "
            "with the size of the elements next to the edge, and does not jump by one node "
            "spacing. *Difference* is the difference from the last row, the limit. *Mismatch* "
            "compares the multiplier with −σ_rr of the wall at the equator: the first comes from "
            "the contact constraint, the second from the displacements and the pressure, so that "
            "the solver does not impose their agreement."
        ),
        tables=[
            (
                "",
                (
                    "", "order", "unknowns", "α₀ (°)", "difference (°)", "σ(π/2) (kPa)",
                    "relative difference", "mismatch", "change of wall volume", "rms(J−1)",
                ),
                rows,
            )
        ],
        checks=[
            Check("default settings: α₀ within 0.05° of the limit", f"{angle:.4f}°", angle <= 0.05),
            Check(
                "default settings: σ(π/2) within 0.2 % of the limit",
                f"{abs(relative(default, limit)):.1e}",
                abs(relative(default, limit)) <= 2e-3,
            ),
            Check(
                "default settings: multiplier and −σ_rr agree to 0.2 %",
                f"{equator_mismatch(default):.1e}",
                equator_mismatch(default) <= 2e-3,
            ),
            Check(
                "the wall volume is constant to 1e-8 on every mesh",
                f"{worst_volume:.0e}",
                worst_volume <= 1e-8,
            ),
            Check(
                "default settings: rms(J−1) ≤ 2e-4",
                f"{default.solver.volume.rms:.1e}",
                default.solver.volume.rms <= 2e-4,
            ),
            Check(
                "rms(J−1) decreases with every refinement",
                " > ".join(f"{value:.0e}" for value in rms),
                all(b < a for a, b in itertools.pairwise(rms)),
            ),
            Check(
                "the error of α₀ decreases with every refinement",
                " > ".join(f"{np.degrees(error):.4f}°" for error in errors),
                all(b < a for a, b in itertools.pairwise(errors)),
            ),
        ],
    )  # fmt: skip


def relative(state: SeatedState, limit: SeatedState) -> float:
    return state.equator_contact_pressure / limit.equator_contact_pressure - 1.0


def equator_mismatch(state: SeatedState) -> float:
    """Return the relative difference of the multiplier and −σ_rr at R = R_a, Z = 0."""
    wall = state.wall
    assert wall is not None
    at = np.argmin(np.abs(wall.R - 1.0) + np.abs(wall.Z))
    assert wall.R.flat[at] == 1.0
    assert wall.Z.flat[at] == 0.0
    return abs(-wall.stress_rr.flat[at] / state.equator_contact_pressure - 1.0)
