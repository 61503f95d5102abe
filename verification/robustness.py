"""Does every case of a seeded random grid end in an answer?"""

from __future__ import annotations

import time
from collections import Counter

import numpy as np
from page import Check, Section

import stonepass as sp
from stonepass.materials.catalogue import material
from stonepass.materials.fung import Fung
from stonepass.model.seated import NoSeat, SeatedState

SEED = 20221
LATEX_CASES, URETER_CASES = 150, 80


def cases() -> list[sp.Case]:
    """Latex ξ 1.001–1.5, η 1.1–3.5; ureter G 0.001–0.03 MPa, ξ to 1.3, both walls."""
    random = np.random.default_rng(SEED)
    found = []
    for _ in range(LATEX_CASES):
        xi = 1.0 + 10.0 ** random.uniform(-3.0, np.log10(0.5))
        found.append(_case(xi, random.uniform(1.1, 3.5), material("latex")))
    ureter = material("ureter")
    assert isinstance(ureter.law, Fung)
    for k in range(URETER_CASES):
        G = 10.0 ** random.uniform(3.0, np.log10(3e4))
        law = Fung(ureter.law.C, ureter.law.a1111, ureter.law.a2222, ureter.law.a1122, G)
        wall = sp.Material("ureter", law, "", "", "", ureter.strain_range)
        xi = 1.0 + 10.0 ** random.uniform(-3.0, np.log10(0.3))
        found.append(_case(xi, (1.3, 3.4)[k % 2], wall))
    return found


def section() -> Section:
    started = time.process_time()
    grid = cases()
    states = [sp.seat(case) for case in grid]
    seconds = time.process_time() - started
    solved = [s for s in states if isinstance(s, SeatedState)]
    lost = Counter(s.reason for s in states if isinstance(s, NoSeat))
    sound = [s for s in solved if is_sound(s)]
    steps = sorted(s.solver.newton_steps for s in solved)
    failures = [[reason, str(count)] for reason, count in lost.most_common()] or [["none", "0"]]
    return Section(
        title="Robustness: random frictionless cases",
        text=(
            f"{LATEX_CASES} latex cases (ξ 1.001–1.5, η 1.1–3.5) and {URETER_CASES} ureter cases "
            f"(G 0.001–0.03 MPa, ξ 1.001–1.3, η 1.3 and 3.4), seed {SEED}, solved directly, "
            f"without load stepping: {seconds / len(grid):.2f} s of one core per case, "
            f"{steps[len(steps) // 2]} Newton steps in the median, {steps[-1]} at most."
        ),
        tables=[("Without a solution:", ("reason", "cases"), failures)],
        checks=[
            Check("every case solved", f"{len(solved)} of {len(grid)}", len(solved) == len(grid)),
            Check(
                "every solved state is sound: finite, pressure ≥ 0, J > 0, volume to 1e-8",
                f"{len(sound)} of {len(solved)}",
                len(sound) == len(solved) > 0,
            ),
        ],
    )


def is_sound(state: SeatedState) -> bool:
    pressure, kept = state.contact_pressure, state.solver.volume
    return bool(
        np.all(np.isfinite(pressure))
        and pressure.min() >= 0.0
        and kept.smallest > 0.0
        and abs(kept.wall) <= 1e-8
        and 0.0 < state.contact_angle < np.pi / 2
        and np.all(np.diff(state.theta) > 0.0)
    )


def _case(xi: float, eta: float, wall: sp.Material) -> sp.Case:
    return sp.Case(
        sp.Stone(size_ratio=xi),
        sp.Ureter(wall_ratio=eta, material=wall),
        method=sp.Method(seating="frictionless"),
    )
