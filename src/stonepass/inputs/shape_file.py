"""Reader of shapes from the points of a meridian in a CSV file, or from tables of a case file."""

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

FAR = 1e9  # largest coordinate of a point, in the unit of the file


def find_shape(value: Any, folder: Path | None = None) -> Shape:
    """Return the shape that a value of the command line or of a case file describes.

    Parameters
    ----------
    value : Shape, str, Path or dict
        The name of a CSV file, a table with ``aspect``, ``outline`` and ``deviation`` (see `Shape`;
        all are optional), a table with the lists of points ``z`` and ``rho``, or a shape.
    folder : Path, optional
        Folder in which a relative path starts; by default the current one.

    Raises
    ------
    BadInput
        The file cannot be read, the table has other keys, or the values describe no shape.
    """
    if isinstance(value, Shape):
        return value
    if isinstance(value, dict):
        return _of_table(value)
    if not isinstance(value, str | Path):
        raise BadInput("shape", value, "the name of a CSV file or a table")
    return read_shape(Path(value) if folder is None else folder / value)


def shape_table(shape: Shape) -> dict[str, Any]:
    """Return the table of a case file that describes a shape; `find_shape` reads it."""
    table: dict[str, Any] = {"aspect": shape.aspect, "outline": list(shape.outline)}
    return table | ({"deviation": shape.deviation} if shape.deviation else {})


def _of_table(table: dict[str, Any]) -> Shape:
    if set(table) == {"z", "rho"}:
        return shape_through(_numbers(table, "z"), _numbers(table, "rho"))
    known = ["aspect", "outline", "deviation", "z", "rho"]
    for key in table:
        if key not in known:
            refuse_unknown("key of the shape", key, known)
    if points := sorted({"z", "rho"} & set(table)):
        allowed = "a table with both 'z' and 'rho' and no other key, or with neither"
        raise BadInput("shape of the stone", f"a table with {' and '.join(points)}", allowed)
    aspect, deviation = _number(table, "aspect", 1.0), _number(table, "deviation", 0.0)
    outline = _numbers(table, "outline") if "outline" in table else ROUND
    return Shape(aspect, tuple(float(c) for c in outline), deviation)


def _number(table: dict[str, Any], name: str, default: float) -> float:
    number = table.get(name, default)
    if isinstance(number, bool) or not isinstance(number, int | float):
        raise BadInput(f"'{name}' of the shape", number, "a number")
    try:
        return float(number)
    except OverflowError as problem:
        raise BadInput(f"'{name}' of the shape", number, "a number") from problem


def _numbers(table: dict[str, Any], name: str) -> Float[np.ndarray, " n"]:
    try:
        found = np.asarray(table[name], dtype=float)
    except (TypeError, ValueError, OverflowError) as problem:
        raise BadInput(f"'{name}' of the shape", table[name], "a list of numbers") from problem
    if found.ndim != 1:
        raise BadInput(f"'{name}' of the shape", table[name], "a list of numbers")
    return found


def read_shape(path: str | Path) -> Shape:
    """Read the shape of a stone from a CSV file.

    Parameters
    ----------
    path : str or Path
        CSV file with the points of a meridian from pole to pole, in any unit of length: ``z`` along
        the axis and ``rho`` from the axis (see `shape_through`).

    Raises
    ------
    BadInput
        The file cannot be read, or the points are no convex meridian. The message names the file,
        the row and the column.

    References
    ----------
    docs/theory.md, "Stones that are not spheres".
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
