"""The pressure on the stone over the angle as CSV."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from stonepass.io.csv_file import write_csv
from stonepass.model.contact_state import ContactState

__all__ = ["write_profile"]

STEP = 0.1  # degrees


def write_profile(state: ContactState, path: Path) -> None:
    """Write the pressure on the stone as CSV, θ from 0 to 180° in steps of 0.1°.

    The edges of the contact are rows too. Seated, it is the contact pressure; loaded, the urine
    pressure stands before the contact.
    """
    first = math.degrees(state.contact_angle)
    last = math.degrees(state.downstream_angle)
    grid = np.linspace(0.0, 180.0, round(180.0 / STEP) + 1)
    theta = np.unique(np.concatenate([grid, [first, last]]))
    pressure = state.pressure_at(np.radians(theta)) / 1e3
    rows = zip(theta.tolist(), pressure.tolist(), strict=True)
    write_csv(path, ("theta_deg", "contact_pressure_kPa"), rows)
