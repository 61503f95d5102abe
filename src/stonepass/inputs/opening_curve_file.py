"""Files of opening curves: opened angles and radii as CSV."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from stonepass.io.csv_file import read_columns
from stonepass.model.opening_curve import RADIUS, OpeningCurve

__all__ = ["read_opening_curve"]


def read_opening_curve(path: Path) -> OpeningCurve:
    """Read pairs from a CSV file with the columns ``alpha_deg`` and ``radius_ratio``.

    Raises
    ------
    BadInput
        Naming the file, and row and column where one is at fault.
    """
    bounds = {"alpha_deg": (1e-3, 90.0), "radius_ratio": RADIUS}
    columns = read_columns(path, tuple(bounds), bounds=bounds)
    alpha, radius = np.radians(columns["alpha_deg"]), columns["radius_ratio"]
    return OpeningCurve(tuple(alpha.tolist()), tuple(radius.tolist()), str(path))
