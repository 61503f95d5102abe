"""Reader of opening curves from CSV files and from tables of a case file."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from stonepass.errors import BadInput, refuse_unknown
from stonepass.io.csv_file import read_columns
from stonepass.model.opening_curve import RADIUS, OpeningCurve

__all__ = ["find_opening_curve", "opening_curve_table", "read_opening_curve"]


BOUNDS = {"alpha_deg": (1e-3, 90.0), "radius_ratio": RADIUS}
RADIANS = "alpha_rad"  # key of a table whose angles are not exact in degrees


def find_opening_curve(value: Any, folder: Path | None = None) -> OpeningCurve:
    """Return the opening curve that a value of the command line or of a case file describes.

    Parameters
    ----------
    value : OpeningCurve, str, Path or dict
        The name of a CSV file, a table with the lists ``alpha_deg`` (or ``alpha_rad``) and
        ``radius_ratio``, or an opening curve.
    folder : Path, optional
        Folder in which a relative path starts; by default the current one.

    Raises
    ------
    BadInput
        The file cannot be read, the table has other keys, or the values are no opening curve.
    """
    if isinstance(value, OpeningCurve):
        return value
    if isinstance(value, dict):
        for key in value:
            if key not in (*BOUNDS, RADIANS):
                refuse_unknown("key of the opening curve", key, list(BOUNDS))
        if RADIANS in value and "alpha_deg" in value:
            both = "alpha_deg and alpha_rad"
            raise BadInput("keys of the opening curve", both, "one of alpha_deg and alpha_rad")
        try:
            radius = np.array(value["radius_ratio"], dtype=float)
            if RADIANS in value:
                alpha = np.array(value[RADIANS], dtype=float)
            else:
                alpha = np.radians(np.array(value["alpha_deg"], dtype=float))
            return OpeningCurve(tuple(alpha.tolist()), tuple(radius.tolist()))
        except BadInput:  # the check of the curve itself gives a better message
            raise
        except (KeyError, TypeError, ValueError, OverflowError) as problem:
            allowed = "a table of two lists of numbers, " + " and ".join(BOUNDS)
            raise BadInput("opening_curve", value, allowed) from problem
    if not isinstance(value, str | Path):
        raise BadInput("opening_curve", value, "the name of a CSV file or a table")
    return read_opening_curve(Path(value) if folder is None else folder / value)


def opening_curve_table(curve: OpeningCurve) -> dict[str, Any]:
    """Return the table of a case file that describes an opening curve.

    The angles are in degrees if the same angles are read from them, otherwise in radians.
    """
    alpha, radius = curve.arrays
    degrees = np.degrees(alpha)
    exact = bool((np.radians(degrees) == alpha).all())
    angles = {"alpha_deg": degrees.tolist()} if exact else {RADIANS: alpha.tolist()}
    return angles | {"radius_ratio": radius.tolist()}


def read_opening_curve(path: str | Path) -> OpeningCurve:
    """Read an opening curve from a CSV file.

    Parameters
    ----------
    path : str or Path
        CSV file with the columns ``alpha_deg`` (angle up to which the wall has opened, in degrees)
        and ``radius_ratio`` (r_a/R_a of the tube upstream).

    Raises
    ------
    BadInput
        The file cannot be read, or the values are no opening curve. The message names the file, the
        row and the column.
    """
    path = Path(path)
    columns = read_columns(path, tuple(BOUNDS), bounds=BOUNDS, distinct=True)
    alpha, radius = np.radians(columns["alpha_deg"]), columns["radius_ratio"]
    return OpeningCurve(tuple(alpha.tolist()), tuple(radius.tolist()), str(path))
