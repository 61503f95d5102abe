"""Reader and writer of CSV files with columns of numbers; errors name the row and the column."""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from typing import Any

import numpy as np

from stonepass.array_types import Float
from stonepass.errors import BadInput, refuse_unknown, require
from stonepass.io.column_names import refuse_column
from stonepass.io.table_dialect import with_decimal_points
from stonepass.io.table_header import (
    NUMBER,
    Row,
    cells_of,
    layout_of,
    with_header,
    without_units,
)
from stonepass.io.text_file import read_text, write_file

__all__ = ["Columns", "read_columns", "read_table", "write_csv"]

LARGEST_FILE = 10_000_000  # largest size of a file in bytes
MOST_ROWS = 100_000  # largest number of rows, including empty ones
MINUS = "\N{MINUS SIGN}"  # some programs write it instead of the hyphen
OTHER_SEPARATORS = ("|", "\N{BROKEN BAR}", " ")
DECIMAL_COMMAS = "if the commas are decimal commas, separate the cells by semicolons"


class Columns(dict[str, Float[np.ndarray, " rows"]]):
    """Columns of numbers by name; `lines` has the line number in the file of each row."""

    def __init__(
        self, lines: tuple[int, ...], columns: Mapping[str, Float[np.ndarray, " rows"]]
    ) -> None:
        super().__init__(columns)
        self.lines = lines

    def place(self, row: int, column: str) -> str:
        """Return the position of a cell for a message, e.g. ``row 3, column 'xi'``.

        Parameters
        ----------
        row : int
            Index of the row, starting at 0.
        column : str
            Name of the column.
        """
        return f"row {self.lines[row]}, column '{column}'"


def read_columns(
    path: Path,
    required: Sequence[str],
    optional: Sequence[str] = (),
    bounds: Mapping[str, tuple[float, float]] | None = None,
    words: Mapping[str, Sequence[str]] | None = None,
    *,
    distinct: bool = False,
) -> Columns:
    """Read columns of numbers by the names in the header, in any order.

    The header is the first line with all required names. Lines before it and a row of units below
    it are ignored, as are empty lines, lines that begin with ``#``, and empty columns. Cells may be
    separated by commas, semicolons or tabs (see `table_header`).
    Rows in messages have the line numbers of an editor.

    Parameters
    ----------
    path : Path
        A CSV file of at most 10 MB and 100 000 rows.
    required, optional : sequence of str
        Names of the columns that the file must have and of those that it may have.
    bounds : mapping of str to (float, float)
        Smallest and largest number in a column.
    words : mapping of str to sequence of str
        Words in a column without numbers. They are returned as indices into the sequence.
    distinct : bool
        True if two equal rows are refused. Measurements may be repeated, but the points of an
        outline may not.

    Returns
    -------
    Columns
        Arrays by column name, each with one number per row.

    Raises
    ------
    BadInput
        The file does not exist, is too large or is no text; it has no rows; a column is missing,
        unknown (the message names the nearest known one) or given twice; a row has another length
        or is repeated; a cell is no finite number, out of bounds, or none of the words.
    """
    rows = _rows(path, required)
    if not rows:
        raise BadInput("file", path, f"a table with the columns {', '.join(required)}")
    header = rows[0][1]
    _check_header(path, header, required, optional)
    if len(rows) == 1:
        raise BadInput("file", path, "a table with at least one row under its header")
    found = _columns(rows, _Cells(path, header, bounds or {}, words or {}))
    if distinct:
        _check_repeated(path, found)
    return found


def read_table(path: Path, largest: int, most_rows: int) -> Columns:
    """Read all columns of numbers of a table, whatever their names are.

    Parameters
    ----------
    path : Path
        A CSV file, see `read_columns`.
    largest : int
        Largest size of the file in bytes.
    most_rows : int
        Largest number of rows.

    Raises
    ------
    BadInput
        The file cannot be read, see `read_columns`.
    """
    rows = _rows(path, (), largest, most_rows)
    if len(rows) < 2:
        raise BadInput("file", path, "a table with names and at least one row below them")
    header = rows[0][1]
    _check_names(path, header)
    return _columns(rows, _Cells(path, header, {}, {}))


def _columns(rows: Sequence[Row], cells: _Cells) -> Columns:
    values = [cells.numbers(line, row) for line, row in rows[1:]]
    lines = tuple(line for line, _ in rows[1:])
    return Columns(lines, dict(zip(cells.header, np.array(values).T, strict=True)))


def _rows(
    path: Path,
    required: Sequence[str],
    largest: int = LARGEST_FILE,
    most_rows: int = MOST_ROWS,
) -> list[Row]:
    """Return the line number and the cells of the header and of every row that is not empty."""
    text = read_text(path, largest, "a CSV file of text", other_encodings=True)
    lines = with_header(list(io.StringIO(text, newline="")))
    delimiter, before = layout_of([line.rstrip("\r\n") for line in lines], required)
    reader = csv.reader(iter(lines[before:]), delimiter=delimiter, strict=True)
    try:
        rows = [(reader.line_num + before, cells) for cells in islice(reader, most_rows + 1)]
    except csv.Error as problem:
        where = f"in {path.name}, row {reader.line_num + before}"
        raise BadInput(where, str(problem), "a row of a CSV file") from problem
    require(len(rows) <= most_rows, f"number of rows of {path.name}", f"more than {most_rows}",
            "fewer")  # fmt: skip
    kept = [
        (line, [cell.strip().replace(MINUS, "-") for cell in cells])
        for line, cells in rows
        if any(cell.strip() for cell in cells) and not cells[0].lstrip().startswith("#")
    ]
    above = (before, cells_of(lines[before - 1], delimiter)) if before else None
    table = without_units(_without_empty_columns(kept), path.name, above)
    return with_decimal_points(table, path.name)


def _without_empty_columns(rows: list[Row]) -> list[Row]:
    """Remove columns that have neither a name nor a value."""
    if not rows:
        return rows
    width = max(len(cells) for _, cells in rows)
    used = [any(cells[k] for _, cells in rows if k < len(cells)) for k in range(width)]
    if all(used):
        return rows
    return [
        (line, [cell for cell, kept in zip(cells, used, strict=False) if kept])
        for line, cells in rows
    ]


def _check_header(
    path: Path, header: list[str], required: Sequence[str], optional: Sequence[str]
) -> None:
    known = [*required, *optional]
    for separator in OTHER_SEPARATORS if len(header) == 1 else ():
        if not {name.strip() for name in header[0].split(separator)[1:]}.isdisjoint(known):
            raise BadInput(f"in {path.name}, the separator of the cells", f"'{separator}'",
                           "a comma, a semicolon or a tab")  # fmt: skip
    for name in header:
        if name and name not in known:
            refuse_column(f"in {path.name}, column", name, known, header)
    _check_names(path, header)
    for name in required:
        if name not in header:
            raise BadInput(f"in {path.name}, column '{name}'", "missing", "given")


def _check_names(path: Path, header: Sequence[str]) -> None:
    for number, name in enumerate(header, 1):
        if not name:
            raise BadInput(f"in {path.name}, the name of column {number}", "empty", "given",
                           "delete this column or give it a name")  # fmt: skip
        if header.count(name) > 1:
            raise BadInput(f"in {path.name}, column", name, "given once")


def _check_repeated(path: Path, found: Columns) -> None:
    first: dict[tuple[float, ...], int] = {}
    for line, numbers in zip(found.lines, np.array(list(found.values())).T, strict=True):
        same = first.setdefault(tuple(numbers), line)
        if same != line:
            raise BadInput(f"in {path.name}, row {line}", f"equal to row {same}",
                           "different from all other rows", "leave one of them out")  # fmt: skip


@dataclass(frozen=True)
class _Cells:
    """Conversion of the cells of a table to numbers, with checks."""

    path: Path
    header: list[str]
    bounds: Mapping[str, tuple[float, float]]
    words: Mapping[str, Sequence[str]]

    def numbers(self, line: int, cells: list[str]) -> list[float]:
        """Return the numbers of one row."""
        if len(cells) != len(self.header):
            raise BadInput(
                f"in {self.path.name}, row {line}",
                f"{len(cells)} cells",
                f"{len(self.header)}, as in the header",
                DECIMAL_COMMAS if len(cells) == 2 * len(self.header) else "",
            )
        return [self._number(line, *pair) for pair in zip(self.header, cells, strict=True)]

    def _number(self, line: int, name: str, cell: str) -> float:
        if name in self.words:
            known = list(self.words[name])
            if cell not in known:
                refuse_unknown(self._where(line, name), cell, known)
            return float(known.index(cell))
        value = float(cell) if NUMBER.fullmatch(cell) else math.nan
        low, high = self.bounds.get(name, (-math.inf, math.inf))
        if not (math.isfinite(value) and low <= value <= high):
            within = f" from {low:g} to {high:g}" if name in self.bounds else ""
            raise BadInput(self._where(line, name), cell, f"a number{within}")
        return value

    def _where(self, line: int, name: str) -> str:
        return f"in {self.path.name}, row {line}, column '{name}'"


def write_csv(path: Path, header: Iterable[str], rows: Iterable[Iterable[Any]]) -> None:
    """Write a table as CSV.

    Parameters
    ----------
    path : Path
        File to write.
    header : iterable of str
        Names of the columns.
    rows : iterable of iterables
        Cells of each row. None is written as an empty cell, and a list of texts as one cell.

    Raises
    ------
    BadInput
        The file cannot be written.
    """
    text = io.StringIO(newline="")
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(header)
    writer.writerows([_cell(value) for value in row] for row in rows)
    write_file(path, text.getvalue())


def _cell(value: Any) -> str:
    if value is None:
        return ""
    if isinstance(value, list):
        return "; ".join(value)
    return f"{value:.10g}" if isinstance(value, float) else str(value)
