"""Where the table begins in a file, and what separates its cells.

Spreadsheets and testing machines write commas, semicolons or tabs between cells. Machines also
write lines about the test before the table, and a row of units under its header.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Collection, Sequence

from stonepass.errors import BadInput
from stonepass.io.column_names import is_unit, unit_of

__all__ = ["NUMBER", "layout_of", "without_units"]

NUMBER = re.compile(r"\s*[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?\s*", re.ASCII)
DELIMITERS = (",", ";", "\t")
LONGEST_PREAMBLE = 200  # lines
NO_UNIT = ("", "-", "–", "mm/mm", "m/m")  # under the name of a ratio
_DECLARED = re.compile(r"sep=(.)\s*", re.IGNORECASE)  # first line of a file made for Excel

Row = tuple[int, list[str]]  # number of the line, and its cells


def layout_of(lines: Sequence[str], required: Collection[str]) -> tuple[str, int]:
    """Return what separates the cells, and how many lines stand before the header.

    The header is the first line that has all required names. Where no line has them it is the line
    before the first row of numbers, so that a refusal can tell which of its names are not known,
    else the first line. Empty lines and those that begin with ``#`` do not count.
    """
    declared = _DECLARED.fullmatch(lines[0]) if lines else None
    candidates = (declared[1],) if declared and declared[1] in DELIMITERS else DELIMITERS
    shown = [
        (number, line)
        for number, line in enumerate(lines[:LONGEST_PREAMBLE])
        if line.strip() and not line.lstrip().startswith("#") and (number or not declared)
    ]
    for number, line in shown:
        for delimiter in candidates:
            if set(required) <= set(_cells(line, delimiter)):
                return delimiter, number
    for k, (_, line) in enumerate(shown):
        for delimiter in candidates:
            header = _header_above(shown[:k], delimiter) if _all_numbers(line, delimiter) else None
            if header is not None:
                return delimiter, header
    number, line = shown[0] if shown else (0, "")
    return next((each for each in candidates if each in line), candidates[0]), number


def _header_above(above: Sequence[tuple[int, str]], delimiter: str) -> int | None:
    """Number of the line of names above a row of numbers, past a row of units."""
    for number, line in reversed(above[-2:]):
        cells = _cells(line, delimiter)
        if len(cells) < 2 or any(map(NUMBER.fullmatch, cells)):
            return None
        if not _are_units(cells):
            return number
    return None


def without_units(rows: list[Row], name: str) -> list[Row]:
    """Leave out a row of units under the header, once they are those of the columns' names.

    Parameters
    ----------
    rows : list of (line, cells)
        The header and the rows under it.
    name : str
        The name of the file, for refusals.

    Raises
    ------
    BadInput
        A unit is another than the name of its column says.
    """
    if len(rows) < 2 or len(rows[1][1]) != len(rows[0][1]):
        return rows
    (_, header), (line, cells) = rows[:2]
    if not _are_units(cells):
        return rows
    for column, cell in zip(header, cells, strict=True):
        given, wanted = _bare(cell), unit_of(column.strip())
        if given != wanted and not (given in NO_UNIT and not wanted) and given:
            raise BadInput(
                f"in {name}, row {line}, the unit of column '{column.strip()}'",
                given,
                wanted or "none, as the column is a ratio",
                "convert the values, or name the column by its unit if it may have that one",
            )
    return [rows[0], *rows[2:]]


def _cells(line: str, delimiter: str) -> list[str]:
    try:
        return [cell.strip() for cell in next(csv.reader([line], delimiter=delimiter), [])]
    except csv.Error:
        return []


def _all_numbers(line: str, delimiter: str) -> bool:
    cells = _cells(line if delimiter == "," else line.replace(",", "."), delimiter)
    return len(cells) > 1 and all(NUMBER.fullmatch(cell) for cell in cells if cell)


def _are_units(cells: Sequence[str]) -> bool:
    """Whether every cell is a unit or says that there is none, and one at least is a unit."""
    units = [_bare(cell) for cell in cells]
    real = [each == "%" or is_unit(each) for each in units]
    return any(real) and all(
        is_one or each in NO_UNIT for is_one, each in zip(real, units, strict=True)
    )


def _bare(cell: str) -> str:
    """A unit without the brackets that machines write round it."""
    return cell.strip().strip("()[]").strip()
