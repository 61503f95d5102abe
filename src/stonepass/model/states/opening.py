"""The opening curve of one stone from loaded states, to which Eqs 13–14 are fitted."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from stonepass.model.accuracy import LEVELS
from stonepass.model.case import Case
from stonepass.model.closure import Series, fit_series
from stonepass.model.energy_balance import opened_radius, opening_pressure
from stonepass.model.opening_curve import OpeningCurve
from stonepass.model.states.loaded import PushedState, push_along
from stonepass.units import Pressure

__all__ = ["series_through", "solve_opening_curve"]

PAIRS = 13
LAST = 0.95  # of the pressure that opens the tube to R_s


def solve_opening_curve(case: Case) -> OpeningCurve | None:
    """α and r_a/R_a of frictionless direct states with rising P_u, from P_u = 0 on, α up to 90°.

    Without friction, because the series begins at the seated stone, as the wall opens then. None
    where no such states are found.
    """
    direct = replace(case.method.by("direct"), closure="linear", pairs=None, wetted=False)
    bare = replace(case.with_friction(0.0), method=direct)
    rising = LAST * opening_pressure(case) * np.linspace(0.0, 1.0, PAIRS)
    states = push_along(bare, [Pressure(float(p)) for p in rising], LEVELS["fast"].resolution)
    kept = [s for s in states if isinstance(s, PushedState) and s.contact_angle <= np.pi / 2]
    radii = [opened_radius(case, state.urine_pressure) for state in kept]
    found = [(s.contact_angle, r) for s, r in zip(kept, radii, strict=True) if r is not None]
    if not found:
        return None
    alpha, radius = zip(*found, strict=True)
    return OpeningCurve(alpha, radius)


def series_through(case: Case, pairs: OpeningCurve, order: int) -> Series | None:
    """Fit the series to pairs whose first is the seated stone; None where there are too few."""
    alpha, radius = pairs.arrays
    if len(alpha) <= order:
        return None
    first, *widths = case.stone.shape.width(alpha)
    start = float(radius[0])
    return fit_series(np.array(widths), radius[1:], float(first), case.size_ratio, order, start)
