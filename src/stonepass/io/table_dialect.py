"""The cell separator and the decimal mark of a table are read from the table itself.

Spreadsheets and testing machines write tables with commas, semicolons or tabs between cells, and
with decimal commas where cells are not separated by commas.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from stonepass.errors import BadInput

__all__ = ["delimiter_of", "with_decimal_points"]

DELIMITERS = (",", ";", "\t")
_DECLARED = re.compile(r"sep=(.)\s*", re.IGNORECASE)  # first line of a file made for Excel
_COMMA = re.compile(r"\s*[-+]?\d*,\d+([eE][-+]?\d+)?\s*", re.ASCII)
_GROUPED = re.compile(r"\s*[-+]?\d{1,3}(,\d{3})+\s*", re.ASCII)


def delimiter_of(text: str) -> tuple[str, int]:
    """Return what separates the cells, and how many lines declare it instead of being data.

    A line ``sep=;`` declares it. Otherwise the header tells, whose names have none of `DELIMITERS`
    in them: semicolons or tabs where they stand in it without a comma, else commas.
    """
    lines = text.splitlines()
    first = lines[0] if lines else ""
    if (declared := _DECLARED.fullmatch(first)) is not None and declared[1] in DELIMITERS:
        return declared[1], 1
    header = next(
        (line for line in lines if line.strip() and not line.lstrip().startswith("#")), ""
    )
    if "," not in header:
        for each in (";", "\t"):
            if each in header:
                return each, 0
    return ",", 0


def with_decimal_points(
    rows: Iterable[tuple[int, list[str]]], delimiter: str, name: str
) -> list[tuple[int, list[str]]]:
    """Turn decimal commas into points where cells are not separated by commas.

    Parameters
    ----------
    rows : iterable of (line, cells)
        The header and the rows under it, without comments.
    delimiter : str
        The character that separates the cells.
    name : str
        The name of the file, for refusals.

    Raises
    ------
    BadInput
        Commas that may separate decimals or thousands: beside decimal points, or in a table with
        tabs where three digits follow every comma.
    """
    found = list(rows)
    if delimiter == ",":
        return found
    commas = [(line, cell) for line, cells in found for cell in cells if _COMMA.fullmatch(cell)]
    if not commas:
        return found
    points = any("." in cell for _, cells in found for cell in cells)
    thousands = delimiter == "\t" and all(_GROUPED.fullmatch(cell) for _, cell in commas)
    if points or thousands:
        line, cell = commas[0]
        raise BadInput(f"in {name}, row {line}", cell.strip(), "a number with a decimal point",
                       "a comma may separate thousands here")  # fmt: skip
    return [(line, _converted(cells)) for line, cells in found]


def _converted(cells: Sequence[str]) -> list[str]:
    return [cell.replace(",", ".") if _COMMA.fullmatch(cell) else cell for cell in cells]
