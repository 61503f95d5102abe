"""Conversion of decimal commas, which some spreadsheets and testing machines write."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from stonepass.errors import BadInput

__all__ = ["with_decimal_points"]

_COMMA = re.compile(r"\s*[-+]?\d*,\d+([eE][-+]?\d+)?\s*", re.ASCII)
_GROUPED = re.compile(r"\s*[-+]?\d{1,3}(,\d{3})+\s*", re.ASCII)


def with_decimal_points(
    rows: Iterable[tuple[int, list[str]]], delimiter: str, name: str
) -> list[tuple[int, list[str]]]:
    """Replace decimal commas by points in a table whose cells are not separated by commas.

    Parameters
    ----------
    rows : iterable of (line, cells)
        The header and the rows below it, without comments.
    delimiter : str
        The character that separates the cells.
    name : str
        The name of the file for messages.

    Raises
    ------
    BadInput
        The commas could separate decimals or thousands: the table has decimal points too, or it has
        tabs and three digits follow every comma.
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
