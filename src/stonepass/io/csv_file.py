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
from stonepass.io.table_header import NUMBER, layout_of, without_units
from stonepass.io.text_file import read_text, write_file

__all__ = ["Columns", "read_columns", "write_csv"]

LARGEST_FILE = 10_000_000  # largest size of a file in bytes
MOST_ROWS = 100_000  # largest number of rows, including empty ones


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
    it are ignored, as are empty lines, lines that begin with ``#``, and empty columns to the right
    of the last name. Cells may be separated by commas, semicolons or tabs (see `table_header`).
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
    header = [name.strip() for name in rows[0][1]]
    _check_header(path, header, required, optional)
    if len(rows) == 1:
        raise BadInput("file", path, "a table with at least one row under its header")
    cells = _Cells(path, header, bounds or {}, words or {})
    values = [cells.numbers(line, row) for line, row in rows[1:]]
    lines = tuple(line for line, _ in rows[1:])
    if distinct:
        _check_repeated(path, lines, values)
    return Columns(lines, dict(zip(header, np.array(values).T, strict=True)))


def _rows(path: Path, required: Sequence[str]) -> list[tuple[int, list[str]]]:
    """Return the line number and the cells of the header and of every row that is not empty."""
    text = read_text(path, LARGEST_FILE, "a CSV file of text", other_encodings=True)
    lines = list(io.StringIO(text, newline=""))
    delimiter, before = layout_of([line.rstrip("\r\n") for line in lines], required)
    reader = csv.reader(iter(lines[before:]), delimiter=delimiter, strict=True)
    try:
        rows = [(reader.line_num + before, cells) for cells in islice(reader, MOST_ROWS + 1)]
    except csv.Error as problem:
        where = f"in {path.name}, row {reader.line_num + before}"
        raise BadInput(where, str(problem), "a row of a CSV file") from problem
    require(len(rows) <= MOST_ROWS, f"number of rows of {path.name}", f"more than {MOST_ROWS}",
            "fewer")  # fmt: skip
    kept = [
        (line, cells)
        for line, cells in rows
        if any(cell.strip() for cell in cells) and not cells[0].lstrip().startswith("#")
    ]
    table = without_units(_without_empty_columns(kept), path.name)
    return with_decimal_points(table, delimiter, path.name)


def _without_empty_columns(rows: list[tuple[int, list[str]]]) -> list[tuple[int, list[str]]]:
    """Remove the cells after the last name of the header if all of them are empty."""
    if not rows:
        return rows
    header = [cell.strip() for cell in rows[0][1]]
    width = len(header)
    while width and not header[width - 1]:
        width -= 1
    empty = all(not cell.strip() for _, cells in rows for cell in cells[width:])
    return [(line, cells[:width]) for line, cells in rows] if width and empty else rows


def _check_header(
    path: Path, header: list[str], required: Sequence[str], optional: Sequence[str]
) -> None:
    known = [*required, *optional]
    for name in header:
        if name not in known:
            refuse_column(f"in {path.name}, column", name, known, header)
    for name in known:
        if header.count(name) > 1:
            raise BadInput(f"in {path.name}, column", name, "given once")
    for name in required:
        if name not in header:
            raise BadInput(f"in {path.name}, column '{name}'", "missing", "given")


def _check_repeated(path: Path, lines: Sequence[int], rows: Sequence[Sequence[float]]) -> None:
    first: dict[tuple[float, ...], int] = {}
    for line, numbers in zip(lines, rows, strict=True):
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
            allowed = f"{len(self.header)}, as in the header"
            raise BadInput(f"in {self.path.name}, row {line}", f"{len(cells)} cells", allowed)
        return [self._number(line, *pair) for pair in zip(self.header, cells, strict=True)]

    def _number(self, line: int, name: str, cell: str) -> float:
        where = f"in {self.path.name}, row {line}, column '{name}'"
        if name in self.words:
            known = list(self.words[name])
            if cell.strip() not in known:
                refuse_unknown(where, cell.strip(), known)
            return float(known.index(cell.strip()))
        value = float(cell) if NUMBER.fullmatch(cell) else math.nan
        low, high = self.bounds.get(name, (-math.inf, math.inf))
        if not (math.isfinite(value) and low <= value <= high):
            within = f" from {low:g} to {high:g}" if name in self.bounds else ""
            raise BadInput(where, cell, f"a number{within}")
        return value


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
