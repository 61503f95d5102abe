"""Tables of numbers from outside: CSV files, refused in one sentence that says where."""

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

LARGEST_FILE = 10_000_000  # bytes
MOST_ROWS = 100_000  # empty ones too


class Columns(dict[str, Float[np.ndarray, " rows"]]):
    """Columns by name; `lines` has the line of the file that each row stands in."""

    def __init__(
        self, lines: tuple[int, ...], columns: Mapping[str, Float[np.ndarray, " rows"]]
    ) -> None:
        super().__init__(columns)
        self.lines = lines

    def place(self, row: int, column: str) -> str:
        """Where a cell stands, in words."""
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

    The header is the first line with all required names; what a machine writes before it is left
    out, and so is a row of units under it. Empty lines, lines that begin with ``#`` and columns
    without a name and without any cell are left out too; rows count as an editor's lines do. Cells
    may be separated by commas, semicolons or tabs (`table_header`).

    Parameters
    ----------
    path : Path
    required, optional : sequence of str
        Names of columns.
    bounds : mapping
        Least and largest number allowed in a column.
    words : mapping
        Words allowed in a column that has no numbers; they are returned as indices into this list.
    distinct : bool
        Whether a row that is there twice is a mistake, as in an outline. A measurement may be
        repeated.

    Raises
    ------
    BadInput
        Naming the file, and row and column where one is at fault: a missing file, one larger than
        10 MB, of more than 100 000 rows or not of text, a column that is missing, unknown (with the
        nearest known one) or there twice, a row of another length, one that is there twice where
        rows must be distinct, a cell that is no finite number or out of bounds or none of the
        words, no rows at all.
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
    """Line number and cells of the header and of every row under it that says something."""
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
    """Leave out the cells behind the last name of the header if all are empty."""
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
            raise BadInput(f"in {path.name}, row {line}", f"the same as row {same}",
                           "there once", "leave one of them out")  # fmt: skip


@dataclass(frozen=True)
class _Cells:
    """What the cells of a table may say."""

    path: Path
    header: list[str]
    bounds: Mapping[str, tuple[float, float]]
    words: Mapping[str, Sequence[str]]

    def numbers(self, line: int, cells: list[str]) -> list[float]:
        """The numbers of one row."""
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
    """Write rows as CSV; a number that does not exist (None) is an empty cell.

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
