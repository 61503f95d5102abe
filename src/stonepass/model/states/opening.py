"""The opening curve of a stone from loaded states, to which the series of Eqs 13–14 is fitted."""

from __future__ import annotations

import numpy as np

from stonepass.model.accuracy import LEVELS
from stonepass.model.energy_balance import opened_radius, opening_pressure
from stonepass.model.numerics import Numerics
from stonepass.model.opening_curve import OpeningCurve
from stonepass.model.problem import Problem
from stonepass.model.states.loaded import solve_loaded
from stonepass.model.states.loaded_state import PushedState
from stonepass.units import Pressure

__all__ = ["solve_opening_curve"]

STATES = 13  # number of loaded states
LAST = 0.95  # last urine pressure, as a fraction of the pressure that opens the tube to R_s


def solve_opening_curve(case: Problem, numerics: Numerics) -> OpeningCurve | None:
    """Compute the opened angle α and the radius r_a/R_a for increasing urine pressures.

    The loaded states are solved without friction, from P_u = 0 up to 95 % of the pressure that
    opens the tube to R_s. Without friction the first state is the seated state, at which the series
    begins. States with α above 90° are left out.

    Parameters
    ----------
    case : Problem
    numerics : Numerics
        Supplies the length of the tube; the states are solved at the accuracy ``fast``.

    Returns
    -------
    OpeningCurve or None
        None if no states are found.
    """
    bare = case.with_friction(0.0)
    rising = LAST * opening_pressure(case) * np.linspace(0.0, 1.0, STATES)
    pressures = [Pressure(float(p)) for p in rising]
    states = solve_loaded(bare, numerics, pressures, LEVELS["fast"].resolution)
    kept = [s for s in states if isinstance(s, PushedState) and s.contact_angle <= np.pi / 2]
    radii = [opened_radius(case, state.urine_pressure) for state in kept]
    found = [(s.contact_angle, r) for s, r in zip(kept, radii, strict=True) if r is not None]
    if not found:
        return None
    alpha, radius = zip(*found, strict=True)
    return OpeningCurve(alpha, radius)
