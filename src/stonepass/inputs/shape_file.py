"""Shapes from outside: points of a stone's meridian as CSV, or a table of a case file."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from stonepass.array_types import Float
from stonepass.errors import BadInput, refuse_unknown
from stonepass.fe.axisymmetric.profile import ROUND
from stonepass.io.csv_file import read_columns
from stonepass.model.shape import Shape
from stonepass.model.shape_fit import shape_through

__all__ = ["find_shape", "read_shape", "shape_table"]

FAR = 1e9  # in the unit of the points


def find_shape(value: Any, folder: Path | None = None) -> Shape:
    """A shape as a case file has it: the name of a CSV file, or a table that describes it.

    The table has ``aspect`` and ``outline`` (see `Shape`), or points ``z`` and ``rho``.

    Raises
    ------
    BadInput
        A file that cannot be read, a table with other keys, or no shape.
    """
    if isinstance(value, Shape):
        return value
    if isinstance(value, dict):
        return _of_table(value)
    if not isinstance(value, str | Path):
        raise BadInput("shape", value, "the name of a CSV file or a table")
    return read_shape(Path(value) if folder is None else folder / value)


def shape_table(shape: Shape) -> dict[str, Any]:
    """The table of a case file that describes a shape; `find_shape` reads it back."""
    table: dict[str, Any] = {"aspect": shape.aspect, "outline": list(shape.outline)}
    return table | ({"deviation": shape.deviation} if shape.deviation else {})


def _of_table(table: dict[str, Any]) -> Shape:
    if set(table) == {"z", "rho"}:
        return shape_through(_numbers(table, "z"), _numbers(table, "rho"))
    known = ["aspect", "outline", "deviation", "z", "rho"]
    for key in table:
        if key not in known[:3]:
            refuse_unknown("key of the shape", key, known)
    aspect, deviation = table.get("aspect", 1.0), table.get("deviation", 0.0)
    for name, number in (("aspect", aspect), ("deviation", deviation)):
        if isinstance(number, bool) or not isinstance(number, int | float):
            raise BadInput(f"'{name}' of the shape", number, "a number")
    outline = _numbers(table, "outline") if "outline" in table else ROUND
    return Shape(float(aspect), tuple(float(c) for c in outline), float(deviation))


def _numbers(table: dict[str, Any], name: str) -> Float[np.ndarray, " n"]:
    try:
        found = np.asarray(table[name], dtype=float)
    except (TypeError, ValueError) as problem:
        raise BadInput(f"'{name}' of the shape", table[name], "a list of numbers") from problem
    if found.ndim != 1:
        raise BadInput(f"'{name}' of the shape", table[name], "a list of numbers")
    return found


def read_shape(path: str | Path) -> Shape:
    """Read a shape from a CSV file with the columns ``z`` and ``rho`` (see `shape_through`).

    Raises
    ------
    BadInput
        Naming the file, and row and column where one is at fault.
    """
    path = Path(path)
    columns = read_columns(
        path, ("z", "rho"), bounds={"z": (-FAR, FAR), "rho": (0.0, FAR)}, distinct=True
    )
    try:
        found = shape_through(columns["z"], columns["rho"], columns.place)
    except BadInput as problem:
        raise problem.within(path.name) from problem
    return replace(found, reference=str(path))
