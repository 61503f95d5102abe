"""Conversion of decimal commas, which some spreadsheets and testing machines write."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence

from stonepass.errors import BadInput
from stonepass.io.table_header import Row

__all__ = ["with_decimal_points"]

_COMMA = re.compile(r"\s*[-+]?\d*,\d+([eE][-+]?\d+)?\s*", re.ASCII)
# A number whose commas may separate thousands; "0,500" is none, because it would begin with 0.
_GROUPED = re.compile(r"\s*[-+]?[1-9]\d{0,2}(,\d{3})+\s*", re.ASCII)


def with_decimal_points(rows: Iterable[Row], name: str) -> list[Row]:
    """Replace decimal commas by points.

    Parameters
    ----------
    rows : iterable of (line, cells)
        The header and the rows below it, without comments. If commas separate the cells, a cell
        with a comma stood in quotes.
    name : str
        The name of the file for messages.

    Raises
    ------
    BadInput
        The commas could separate decimals or thousands: the table has decimal points too, or three
        digits follow every comma.
    """
    found = list(rows)
    numbers = found[1:]
    commas = [
        (line, cell)
        for line, cells in numbers
        for cell in cells
        if "," in cell and _COMMA.fullmatch(cell)
    ]
    if not commas:
        return found
    points = any("." in cell for _, cells in numbers for cell in cells)
    if points or all(_GROUPED.fullmatch(cell) for _, cell in commas):
        line, cell = commas[0]
        raise BadInput(f"in {name}, row {line}", cell.strip(), "a number with a decimal point",
                       "a comma may separate thousands here")  # fmt: skip
    return [(line, _converted(cells)) for line, cells in found]


def _converted(cells: Sequence[str]) -> list[str]:
    return [cell.replace(",", ".") if _COMMA.fullmatch(cell) else cell for cell in cells]
