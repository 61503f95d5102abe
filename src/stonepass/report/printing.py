"""Tables and sentences of a result as plain text, and as HTML of a notebook."""

from __future__ import annotations

import io
from collections.abc import Sequence
from html import escape
from typing import Any

from rich.console import Console
from rich.table import Table
from rich.text import Text

__all__ = ["Part", "as_html", "as_text"]

WIDTH = 100  # characters of a printed table

Part = Table | str


def as_text(parts: Sequence[Part], warnings: Sequence[object]) -> str:
    """Return tables, sentences and warnings as plain text."""
    written = io.StringIO()
    console = Console(file=written, width=WIDTH, highlight=False, no_color=True)
    for part in (*parts, *(f"warning: {each}" for each in warnings)):
        if isinstance(part, str):
            console.print(part, markup=False, soft_wrap=True)
        else:
            console.print(part)
    return "\n".join(line.rstrip() for line in written.getvalue().splitlines())


def as_html(parts: Sequence[Part], warnings: Sequence[object]) -> str:
    """Return tables, sentences and warnings as one HTML element."""
    shown = "".join(
        f"<p>{escape(part)}</p>" if isinstance(part, str) else _table(part) for part in parts
    )
    listed = "".join(f"<li>{escape(str(each))}</li>" for each in warnings)
    return f"<div>{shown}{f'<p>Warnings</p><ul>{listed}</ul>' if listed else ''}</div>"


def _table(table: Table) -> str:
    """Return a table of rich as one of HTML, with the same alignment of its columns."""
    caption = f"<caption>{_plain(table.title)}</caption>" if table.title else ""
    columns = table.columns
    head = "".join(_cell("th", column.header, column.justify) for column in columns)
    rows = zip(*(list(column.cells) for column in columns), strict=True)
    body = "".join(
        "<tr>"
        + "".join(_cell("td", cell, each.justify) for cell, each in zip(row, columns, strict=True))
        + "</tr>"
        for row in rows
    )
    return f"<table>{caption}<thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def _cell(tag: str, content: Any, justify: str) -> str:
    return f'<{tag} style="text-align: {justify}">{_plain(content)}</{tag}>'


def _plain(content: Any) -> str:
    """Return the text of a cell without the markup of rich, safe in HTML."""
    return escape(Text.from_markup(str(content)).plain)
