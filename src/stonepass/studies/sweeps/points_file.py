"""Reader of explicit points: columns of a CSV or parquet file, or arrays by key."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np

from stonepass.array_types import Float
from stonepass.errors import BadInput, require
from stonepass.io.column_names import unit_of
from stonepass.io.optional_imports import library
from stonepass.io.table_header import LONGEST_PREAMBLE, layout_of
from stonepass.io.text_file import existing
from stonepass.studies.sweeps.axes import Points
from stonepass.studies.sweeps.varied_input import VariedInput
from stonepass.units import unit_ratio

__all__ = ["EXTRA", "read_points_table"]

EXTRA = "studies"  # the extra of stonepass that installs pyarrow
DEGREES = np.pi / 180.0


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
    where = "'points'"
    if "file" in table:
        require(len(table) == 1, where, "a file with other keys", "the key 'file' alone")
        path = existing(folder / str(table["file"]))
        where, table = f"in {path.name}", _columns_of(path)
    require(len(table) > 0, where, "empty", "at least one column")
    inputs, columns = [], []
    for name, values in table.items():
        given, factor = _input_of(name, where, input_with)
        inputs.append(given)
        columns.append(_checked(given, values, factor, f"{where}, column '{name}'"))
    lengths = {len(each) for each in columns}
    require(lengths != {0}, f"{where}, number of points", 0, "at least 1")
    require(len(lengths) == 1, f"{where}, numbers of values of the columns",
            ", ".join(map(str, sorted(lengths))), "equal")  # fmt: skip
    return Points(tuple(inputs), np.column_stack(columns))


def _columns_of(path: Path) -> dict[str, Any]:
    """Return the columns of a CSV or parquet file by name."""
    reader = {".csv": "csv", ".parquet": "parquet"}.get(path.suffix.lower())
    if reader is None:
        raise BadInput("points", path, "a file whose name ends in .csv or .parquet")
    module = library(f"pyarrow.{reader}", "read points", EXTRA)
    try:
        table = _read_csv(module, path) if reader == "csv" else module.read_table(str(path))
        names = [name.strip() for name in table.column_names]
    except (OSError, ValueError) as problem:  # ValueError is the base of the errors of pyarrow
        first = str(problem).splitlines()[0]
        raise BadInput("points", path, f"a readable {reader} file ({first})") from problem
    for name in names:
        require(names.count(name) == 1, f"in {path.name}, column '{name}'", "given several times",
                "given once")  # fmt: skip
    return {name: column.to_numpy() for name, column in zip(names, table.columns, strict=True)}


def _read_csv(module: Any, path: Path) -> Any:
    """Read a table whose cells are separated by commas, semicolons or tabs (see `layout_of`).

    If semicolons or tabs separate the cells and the first row has a comma, commas are decimal
    points.
    """
    with path.open(encoding="utf-8-sig") as file:
        lines = [line.rstrip("\r\n") for line in islice(file, LONGEST_PREAMBLE)]
    delimiter, start = layout_of(lines, ())
    first = "".join(lines[start + 1 : start + 2])
    decimal = "," if delimiter != "," and "," in first else "."
    return module.read_csv(
        str(path),
        read_options=module.ReadOptions(skip_rows=start),
        parse_options=module.ParseOptions(delimiter=delimiter),
        convert_options=module.ConvertOptions(decimal_point=decimal),
    )


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
        allowed = f"'{given.key}_{given.unit}'" if given.unit else f"'{given.key}'"
        raise BadInput(f"{where}, column", name, f"{allowed}, with the unit of its values")
    return given, factor


def _checked(given: VariedInput, values: Any, factor: float, where: str) -> Float[np.ndarray, " n"]:
    """Return a column in SI units; its extreme values are checked against the declared bounds."""
    try:
        if np.asarray(values).dtype.kind in "bmM":  # truth values, durations and dates
            raise TypeError
        numbers = np.asarray(values, dtype=float)
    except (TypeError, ValueError, OverflowError):
        raise BadInput(where, "not numeric", "a column of numbers") from None
    require(numbers.ndim == 1, where, f"of {numbers.ndim} dimensions", "of one dimension")
    bad = np.flatnonzero(~np.isfinite(numbers))
    if len(bad):
        value = float(numbers[bad[0]])
        raise BadInput(f"{where}, point {bad[0] + 1}", value, "a finite number")
    numbers = numbers * factor
    for extreme in {float(numbers.min()), float(numbers.max())} if len(numbers) else ():
        try:
            given.from_number(extreme)
        except BadInput as problem:
            raise problem.named(where) from problem
    return numbers
