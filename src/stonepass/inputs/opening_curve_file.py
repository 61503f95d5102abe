"""Opening curves from outside: opened angles and radii as CSV, or a table of a case file."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from stonepass.errors import BadInput, refuse_unknown
from stonepass.io.csv_file import read_columns
from stonepass.model.opening_curve import RADIUS, OpeningCurve

__all__ = ["find_opening_curve", "opening_curve_table", "read_opening_curve"]


BOUNDS = {"alpha_deg": (1e-3, 90.0), "radius_ratio": RADIUS}


def find_opening_curve(value: Any, folder: Path | None = None) -> OpeningCurve:
    """An opening curve as a case file has it: the name of a CSV file, or a table of its columns.

    Raises
    ------
    BadInput
        A file that cannot be read, a table with other keys, or no opening curve.
    """
    if isinstance(value, OpeningCurve):
        return value
    if isinstance(value, dict):
        for key in value:
            if key not in BOUNDS:
                refuse_unknown("key of the opening curve", key, list(BOUNDS))
        try:
            alpha, radius = (np.array(value[name], dtype=float) for name in BOUNDS)
            return OpeningCurve(tuple(np.radians(alpha).tolist()), tuple(radius.tolist()))
        except BadInput:  # of the curve itself, which says more
            raise
        except (KeyError, TypeError, ValueError) as problem:
            allowed = "a table of two lists of numbers, " + " and ".join(BOUNDS)
            raise BadInput("opening_curve", value, allowed) from problem
    if not isinstance(value, str | Path):
        raise BadInput("opening_curve", value, "the name of a CSV file or a table")
    return read_opening_curve(Path(value) if folder is None else folder / value)


def opening_curve_table(curve: OpeningCurve) -> dict[str, Any]:
    """The table of a case file that describes an opening curve; `find_opening_curve` reads it."""
    alpha, radius = curve.arrays
    return {"alpha_deg": np.degrees(alpha).tolist(), "radius_ratio": radius.tolist()}


def read_opening_curve(path: str | Path) -> OpeningCurve:
    """Read an opening curve from a CSV file with the columns ``alpha_deg`` and ``radius_ratio``.

    Raises
    ------
    BadInput
        Naming the file, and row and column where one is at fault.
    """
    path = Path(path)
    columns = read_columns(path, tuple(BOUNDS), bounds=BOUNDS, distinct=True)
    alpha, radius = np.radians(columns["alpha_deg"]), columns["radius_ratio"]
    return OpeningCurve(tuple(alpha.tolist()), tuple(radius.tolist()), str(path))
