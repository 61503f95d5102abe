"""Detection of the header of a table in a text file, and of the separator of its cells.

Spreadsheets and testing machines separate cells by commas, semicolons or tabs. Testing machines
also write lines about the test before the table, and a row of units below the header.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Collection, Sequence

from stonepass.errors import BadInput
from stonepass.io.column_names import is_unit, same_unit, unit_of

__all__ = ["NUMBER", "Row", "cells_of", "layout_of", "with_header", "without_units"]

NUMBER = re.compile(r"\s*[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?\s*", re.ASCII)
DELIMITERS = (",", ";", "\t")
LONGEST_PREAMBLE = 200  # largest number of lines before the header
NO_UNIT = ("", "-", "–", "1", "mm/mm", "m/m")  # cells in a row of units below dimensionless columns
# Words in the names of columns that have no unit.
DIMENSIONLESS = ("stretch", "ratio", "friction", "stiffness", "xi", "eta")
_DECLARED = re.compile(r"sep=(.)\s*", re.IGNORECASE)  # first line of a file that Excel reads

Row = tuple[int, list[str]]  # number of the line, and its cells


def layout_of(lines: Sequence[str], required: Collection[str]) -> tuple[str, int]:
    """Return the separator of the cells, and the number of lines before the header.

    The header is the first line with all required names, if possible one with a number below a
    required name, since such a name may also occur in the lines before the table. If there is no
    line with all required names, it is the line of names above the first row of numbers, so that an
    error can name its unknown columns, or else the first line. Empty lines and lines that begin
    with ``#`` are ignored.

    Parameters
    ----------
    lines : sequence of str
        Lines of the file.
    required : collection of str
        Names of the columns that the table must have; empty if any names will do.
    """
    declared = _DECLARED.fullmatch(lines[0]) if lines else None
    candidates = (declared[1],) if declared and declared[1] in DELIMITERS else DELIMITERS
    shown = [
        (number, line)
        for number, line in enumerate(lines[:LONGEST_PREAMBLE])
        if line.strip() and not _is_comment(line) and (number or not declared)
    ]
    named = [
        (delimiter, k)
        for k, (_, line) in enumerate(shown if required else ())
        for delimiter in candidates
        if set(required) <= set(cells_of(line, delimiter))
    ]
    if named:
        lines_shown = [line for _, line in shown]
        with_rows = (each for each in named if _has_rows(lines_shown, *each, required))
        delimiter, k = next(with_rows, named[0])
        return delimiter, shown[k][0]
    for k, (_, line) in enumerate(shown):
        for delimiter in candidates:
            header = _header_above(shown[:k], delimiter) if _all_numbers(line, delimiter) else None
            if header is not None:
                return delimiter, header
    number, line = shown[0] if shown else (0, "")
    return next((each for each in candidates if each in line), candidates[0]), number


def _has_rows(lines: Sequence[str], delimiter: str, k: int, required: Collection[str]) -> bool:
    """Return whether the row below line k, or below its row of units, has a number in its place."""
    names = cells_of(lines[k], delimiter)
    for line in lines[k + 1 : k + 3]:
        cells = cells_of(line if delimiter == "," else line.replace(",", "."), delimiter)
        if _are_units(cells):
            continue
        pairs = zip(names, cells, strict=False)
        return any(name in required and bool(NUMBER.fullmatch(cell)) for name, cell in pairs)
    return False


def _header_above(above: Sequence[tuple[int, str]], delimiter: str) -> int | None:
    """Return the index of the line of names above a row of numbers; a row of units is skipped."""
    for number, line in reversed(above[-2:]):
        cells = cells_of(line, delimiter)
        if len(cells) < 2 or any(map(NUMBER.fullmatch, cells)):
            return None
        if not _are_units(cells):
            return number
    return None


def with_header(lines: Sequence[str]) -> list[str]:
    """Return the lines of a file; a header that stands in a comment loses its ``#``.

    The header may stand in the last comment before the first row, if this is a row of numbers and
    the comment has as many cells, none of which is a number. NumPy writes such files.

    Parameters
    ----------
    lines : sequence of str
        Lines of the file.
    """
    found = list(lines)
    filled = [number for number, line in enumerate(found[:LONGEST_PREAMBLE]) if line.strip()]
    first = next((k for k, n in enumerate(filled) if not _is_comment(found[n])), 0)
    if first:
        above, row = filled[first - 1], found[filled[first]]
        text = found[above].lstrip().removeprefix("#").lstrip()
        if any(_all_numbers(row, each) and _are_names(text, row, each) for each in DELIMITERS):
            found[above] = text
    return found


def _is_comment(line: str) -> bool:
    return line.lstrip().startswith("#")


def _are_names(line: str, row: str, delimiter: str) -> bool:
    """Return whether a line has as many cells as a row of numbers, none of which is a number."""
    names = cells_of(line, delimiter)
    return len(names) == len(cells_of(row, delimiter)) and not any(map(NUMBER.fullmatch, names))


def without_units(rows: list[Row], name: str, above: Row | None = None) -> list[Row]:
    """Remove a row of units below the header, after a check against the units in the column names.

    Parameters
    ----------
    rows : list of (line, cells)
        The header and the rows below it.
    name : str
        The name of the file for messages.
    above : (line, cells), optional
        The row above the header, which may have the units too.

    Raises
    ------
    BadInput
        A unit differs from the unit in the name of its column.
    """
    header = rows[0][1] if rows else []
    for row in (above, *rows[1:2]):
        if row is not None and len(row[1]) == len(header) and _are_units(row[1]):
            _check_units(header, row, name)
    below = len(rows) > 1 and len(rows[1][1]) == len(header) and _are_units(rows[1][1])
    return [rows[0], *rows[2:]] if below else rows


def _check_units(header: Sequence[str], units: Row, name: str) -> None:
    line, cells = units
    for column, cell in zip(header, cells, strict=True):
        given, wanted = _bare(cell), unit_of(column)
        if given in NO_UNIT and (not wanted or not given):
            continue
        if not wanted and not any(word in column for word in DIMENSIONLESS):
            continue  # no column of ours; its name is refused later
        if not wanted or not same_unit(given, wanted):
            raise BadInput(
                f"in {name}, row {line}, the unit of column '{column}'",
                given,
                wanted or "empty, since the column is dimensionless",
                f"convert the values{' to ' + wanted if wanted else ''}, and change this row",
            )


def cells_of(line: str, delimiter: str) -> list[str]:
    """Return the cells of a line without blanks; none for a line that is no row of a CSV file."""
    try:
        return [cell.strip() for cell in next(csv.reader([line], delimiter=delimiter), [])]
    except csv.Error:
        return []


def _all_numbers(line: str, delimiter: str) -> bool:
    cells = cells_of(line if delimiter == "," else line.replace(",", "."), delimiter)
    return len(cells) > 1 and all(NUMBER.fullmatch(cell) for cell in cells if cell)


def _are_units(cells: Sequence[str]) -> bool:
    """Return whether all cells are units or signs for "no unit", and at least one is a unit."""
    units = [_bare(cell) for cell in cells]
    real = [each == "%" or is_unit(each) for each in units]
    return any(real) and all(
        is_one or each in NO_UNIT for is_one, each in zip(real, units, strict=True)
    )


def _bare(cell: str) -> str:
    """Return a unit without brackets, with plain exponents."""
    return cell.strip().strip("()[]").strip().replace("²", "2")
