"""Tables that fit the terminal: words wrap, numbers are never cut."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table

__all__ = ["fitted"]

WIDEST = 1000  # characters, more than any table has


def fitted(table: Table, console: Console) -> Table:
    """Return the table as it fits the console, without cutting a number or a word.

    Columns that are flush right hold numbers, which never wrap; the other cells and the headers
    wrap between words. A table that is still too wide is turned into a list, in which every cell
    has a line of its own with the header of its column before it.
    """
    from rich.measure import Measurement

    texts = _texts(table)
    natural = [max(map(len, column)) for column in texts]
    widest = console.options.update(width=WIDEST)
    borders = Measurement.get(console, widest, table).maximum - sum(natural)
    if sum(natural) + borders <= console.width:
        return table
    widths = [
        _narrowest(column, numbers=each.justify == "right")
        for each, column in zip(table.columns, texts, strict=True)
    ]
    if sum(widths) + borders > console.width:
        return _as_list(table, texts)
    room = console.width - borders - sum(widths)
    for k in sorted(range(len(widths)), key=natural.__getitem__):  # short columns stay in one line
        more = min(room, natural[k] - widths[k])
        widths[k], room = widths[k] + more, room - more
    for column, width in zip(table.columns, widths, strict=True):
        column.width = width
    table.width = sum(widths) + borders
    return table


def _texts(table: Table) -> list[list[str]]:
    """Return header and cells of every column without their markup."""
    from rich.text import Text

    return [
        [
            cell.plain if isinstance(cell, Text) else Text.from_markup(str(cell)).plain
            for cell in (column.header, *column.cells)
        ]
        for column in table.columns
    ]


def _narrowest(column: list[str], *, numbers: bool) -> int:
    """Return the width below which a number or a word would be cut."""
    header, *cells = column
    words = [word for text in cells for word in ([text] if numbers else text.split())]
    return max(map(len, [*header.split(), *words]), default=0)


def _as_list(table: Table, texts: list[list[str]]) -> Table:
    """Return one line for each cell: rows are apart, and each begins with its first cell."""
    from rich.markup import escape
    from rich.table import Table

    made = Table(box=None, show_header=False, title=table.title, title_justify="left", padding=0)
    made.add_column(overflow="fold")
    headers = [column[0] for column in texts]
    for row in zip(*(column[1:] for column in texts), strict=True):
        first = f"{headers[0]} {row[0]}" if table.columns[0].justify == "right" else row[0]
        made.add_row(f"[bold]{escape(first)}[/bold]" if first else "")
        for header, cell in zip(headers[1:], row[1:], strict=True):
            if cell:
                made.add_row(escape(f"  {cell}" if not header else f"  {header}: {cell}"))
    return made
