"""Reader of explicit points: columns of a CSV or parquet file, or arrays by key."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from stonepass.array_types import Float
from stonepass.errors import BadInput, require
from stonepass.io.column_names import unit_of
from stonepass.io.csv_file import Columns, read_table
from stonepass.io.optional_imports import library
from stonepass.io.text_file import existing
from stonepass.studies.sweeps.axes import Points
from stonepass.studies.sweeps.varied_input import VariedInput
from stonepass.units import unit_ratio

__all__ = ["EXTRA", "read_points_table"]

EXTRA = "studies"  # the extra of stonepass that installs pyarrow
DEGREES = np.pi / 180.0
LARGEST_FILE = 100_000_000  # largest size of a CSV file in bytes
MOST_ROWS = 1_000_000  # largest number of rows of a CSV file


def read_points_table(
    table: Mapping[str, Any], input_with: Callable[[str], VariedInput], folder: Path
) -> Points:
    """Return the points that the section ``points`` of a study describes.

    Parameters
    ----------
    table : mapping
        Either ``{"file": NAME}`` with the name of a CSV or parquet file, or an array (n) for each
        column. The name of a column is the key of an input, followed by ``_`` and the unit of its
        values if it has one, e.g. ``stone.size_ratio`` or ``load.confining_pressure_kPa``.
    input_with : callable
        Function that returns the input with a key.
    folder : Path
        Folder in which a relative path starts.

    Raises
    ------
    BadInput
        The file cannot be read, a name or a unit is unknown or missing, the columns differ in
        length, or a value is no finite number within the bounds of its input.
    """
    where, table = "'points'", _flat(table)
    if "file" in table:
        require(len(table) == 1, where, "a file with other keys", "the key 'file' alone")
        path = existing(folder / str(table["file"]))
        where, table = f"in {path.name}", _columns_of(path)
    require(len(table) > 0, where, "empty", "at least one column")
    lines = table.lines if isinstance(table, Columns) else None
    inputs, columns = [], []
    for name, values in table.items():
        given, factor = _input_of(name, where, input_with)
        inputs.append(given)
        columns.append(_checked(given, values, factor, _Place(where, name, lines)))
    lengths = {len(each) for each in columns}
    require(lengths != {0}, f"{where}, number of points", 0, "at least 1")
    require(len(lengths) == 1, f"{where}, numbers of values of the columns",
            ", ".join(map(str, sorted(lengths))), "equal")  # fmt: skip
    return Points(tuple(inputs), np.column_stack(columns))


def _columns_of(path: Path) -> Mapping[str, Any]:
    """Return the columns of a CSV or parquet file by name."""
    if path.suffix.lower() == ".csv":
        most = f"smaller than {LARGEST_FILE // 1_000_000} MB"
        require(path.stat().st_size <= LARGEST_FILE, "points", path, most, "write it as parquet")
        return read_table(path, LARGEST_FILE, MOST_ROWS)
    if path.suffix.lower() != ".parquet":
        raise BadInput("points", path, "a file whose name ends in .csv or .parquet")
    module = library("pyarrow.parquet", "read points", EXTRA)
    try:
        table = module.read_table(str(path))
    except (OSError, ValueError) as problem:  # ValueError is the base of the errors of pyarrow
        first = str(problem).splitlines()[0]
        raise BadInput("points", path, f"a readable parquet file ({first})") from problem
    names = [name.strip() for name in table.column_names]
    for name in names:
        require(names.count(name) == 1, f"in {path.name}, column '{name}'", "given several times",
                "given once")  # fmt: skip
    return {name: column.to_numpy() for name, column in zip(names, table.columns, strict=True)}


def _flat(table: Mapping[str, Any]) -> dict[str, Any]:
    """Return a table whose keys have dots; TOML makes tables of keys with dots without quotes."""
    found: dict[str, Any] = {}
    for key, value in table.items():
        if isinstance(value, Mapping):
            found |= {f"{key}.{rest}": each for rest, each in _flat(value).items()}
        else:
            found[key] = value
    return found


def _input_of(
    name: str, where: str, input_with: Callable[[str], VariedInput]
) -> tuple[VariedInput, float]:
    """Return the input of a column, and the factor by which its values are converted to SI."""
    unit = unit_of(name)
    try:
        given = input_with(name.removesuffix(f"_{unit}") if unit else name)
    except BadInput as problem:
        begin = "" if problem.argument.startswith("in ") else f"{where}, "
        raise problem.named(f"{begin}{problem.argument}") from problem
    if not given.numeric:
        raise BadInput(f"{where}, column '{name}'", "given", "an input whose values are numbers")
    if given.unit == unit:
        return given, 1.0
    factor = unit_ratio(unit, given.unit) if unit and given.unit else None
    if given.unit == "rad" and unit == "deg":
        factor = DEGREES
    if factor is None:
        allowed = (
            f"'{given.key}_{given.unit}', with the unit of its values"
            if given.unit
            else f"'{given.key}', whose values have no unit"
        )
        raise BadInput(f"{where}, column", name, allowed)
    return given, factor


@dataclass(frozen=True)
class _Place:
    """Position of a number for messages; `lines` are the rows of a file."""

    where: str
    name: str
    lines: tuple[int, ...] | None

    def __str__(self) -> str:
        return f"{self.where}, column '{self.name}'"

    def row(self, k: int) -> str:
        row = f"point {k + 1}" if self.lines is None else f"row {self.lines[k]}"
        return f"{self.where}, {row}, column '{self.name}'"


def _checked(
    given: VariedInput, values: Any, factor: float, place: _Place
) -> Float[np.ndarray, " n"]:
    """Return a column in SI units; its extreme values are checked against the declared bounds."""
    try:
        raw = np.asarray(values)
        texts = raw.dtype.kind == "O" and any(isinstance(each, str) for each in raw.flat)
        if texts or raw.dtype.kind in "bmMSU":  # truth values, durations, dates and texts
            raise TypeError
        numbers = np.asarray(raw, dtype=float)
    except (TypeError, ValueError, OverflowError):
        raise BadInput(str(place), "not numeric", "a column of numbers") from None
    require(numbers.ndim == 1, str(place), f"of {numbers.ndim} dimensions", "of one dimension")
    bad = np.flatnonzero(~np.isfinite(numbers))
    if len(bad):
        raise BadInput(place.row(int(bad[0])), float(numbers[bad[0]]), "a finite number")
    numbers = numbers * factor
    for extreme in {int(numbers.argmin()), int(numbers.argmax())} if len(numbers) else ():
        try:
            given.from_number(float(numbers[extreme]))
        except BadInput as problem:
            raise problem.named(place.row(extreme)) from problem
    return numbers
