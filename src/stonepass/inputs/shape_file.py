"""Files of shapes: points of a stone's meridian as CSV."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from stonepass.errors import BadInput
from stonepass.io.csv_file import read_columns
from stonepass.model.shape import Shape
from stonepass.model.shape_fit import shape_through

__all__ = ["read_shape"]

FAR = 1e9  # in the unit of the points


def read_shape(path: str | Path) -> Shape:
    """Read a shape from a CSV file with the columns ``z`` and ``rho`` (see `shape_through`).

    Raises
    ------
    BadInput
        Naming the file, and row and column where one is at fault.
    """
    path = Path(path)
    columns = read_columns(path, ("z", "rho"), bounds={"z": (-FAR, FAR), "rho": (0.0, FAR)})
    try:
        found = shape_through(columns["z"], columns["rho"], columns.place)
    except BadInput as problem:
        raise problem.within(path.name) from problem
    return replace(found, reference=str(path))
