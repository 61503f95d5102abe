"""The pressure on the stone over the angle as CSV."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np

from stonepass.io.csv_file import write_csv
from stonepass.model.contact_state import ContactState
from stonepass.model.shape import Shape

__all__ = ["write_profile"]

STEP = 0.1  # degrees


def write_profile(state: ContactState, shape: Shape, path: Path) -> None:
    """Write the pressure on the stone as CSV, θ from 0 to 180° in steps of 0.1°.

    The edges of the contact are rows too. Seated, it is the contact pressure; loaded, the urine
    pressure stands before the contact. θ is the angle at the centre of a sphere, and the parametric
    angle of every other shape, whose column is called so; the place on the stone, over its radius,
    stands beside it (z downstream, r from the axis).
    """
    first = math.degrees(state.contact_angle)
    last = math.degrees(state.downstream_angle)
    grid = np.linspace(0.0, 180.0, round(180.0 / STEP) + 1)
    theta = np.unique(np.concatenate([grid, [first, last]]))
    pressure = state.pressure_at(np.radians(theta)) / 1e3
    r, z = shape.meridian(np.radians(theta))
    columns = {
        "theta_deg" if shape.spherical else "parametric_angle_deg": theta,
        "contact_pressure_kPa": pressure,
        "z_over_radius": z + 0.0,  # no -0
        "r_over_radius": np.maximum(r, 0.0),
    }
    rows = zip(*(column.tolist() for column in columns.values()), strict=True)
    write_csv(path, columns, rows)
