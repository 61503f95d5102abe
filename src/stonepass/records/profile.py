"""The pressure on the stone as a function of the angle, as CSV."""

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
    """Write the pressure on the stone as CSV, for angles from 0 to 180° in steps of 0.1°.

    The edges of the contact are additional rows. The pressure is the contact pressure; in a loaded
    state it is the urine pressure upstream of the contact. The first column is the angle θ at the
    centre of a sphere, or the parametric angle of any other shape. Two columns have the position on
    the stone in units of its radius, z downstream and r from the axis.

    Parameters
    ----------
    state : ContactState
        Seated or loaded state; pressures are written in kPa.
    shape : Shape
        Shape of the stone.
    path : Path
        File to write.

    Raises
    ------
    BadInput
        The file cannot be written.
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
        "z_over_radius": z + 0.0,  # adding 0 turns -0 into 0
        "r_over_radius": np.maximum(r, 0.0),
    }
    rows = zip(*(column.tolist() for column in columns.values()), strict=True)
    write_csv(path, columns, rows)
