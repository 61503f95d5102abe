"""Talking to a terminal: JSON, tables and warnings out, progress on stderr."""

from __future__ import annotations

import json
import sys
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from stonepass.cli.encoding import encodes_everything
from stonepass.io.text_file import check_writable

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table

__all__ = ["FIGURES", "counting", "print_json", "show", "warn", "working", "writable"]

FIGURES = (".svg", ".png", ".pdf")
WIDEST = 1000  # characters, more than any table has
PLAIN_INTERVAL = 2.0  # seconds between lines where stderr is not a terminal


@lru_cache
def _console(*, stderr: bool = False) -> Console:
    """Return the console of stdout or stderr; a command that prints JSON alone needs none."""
    from rich.console import Console

    return Console(stderr=stderr, highlight=False, soft_wrap=False)


def _on_terminal() -> bool:
    return sys.stderr.isatty()


def print_json(record: Any) -> None:
    """Write one JSON document to stdout; NaN would be a fault and raises."""
    escaped = not encodes_everything(sys.stdout)  # JSON has its own way to write characters
    document = json.dumps(record, indent=2, ensure_ascii=escaped, allow_nan=False)
    sys.stdout.write(document + "\n")


def show(*parts: Any) -> None:
    """Print tables and sentences for a person."""
    for part in parts:
        if isinstance(part, str):
            _console().print(part, soft_wrap=True, markup=False)
        else:
            _console().print(_never_cut(part), crop=False)


def _never_cut(table: Table) -> Table:
    """Let a table be wider than a narrow terminal rather than cut a number or a word.

    Columns that are flush right hold numbers, which never wrap; other cells and the headers wrap
    between words.
    """
    from rich.cells import cell_len
    from rich.measure import Measurement
    from rich.text import Text

    texts = [
        [Text.from_markup(str(cell)).plain for cell in (column.header, *column.cells)]
        for column in table.columns
    ]
    natural = [max(map(cell_len, column)) for column in texts]
    console = _console()
    widest = console.options.update(width=WIDEST)
    borders = Measurement.get(console, widest, table).maximum - sum(natural)
    if sum(natural) + borders <= console.width:
        return table
    widths = []
    for column, (header, *cells) in zip(table.columns, texts, strict=True):
        numbers = column.justify == "right"
        words = [word for text in cells for word in ([text] if numbers else text.split())]
        widths.append(max(map(cell_len, [*header.split(), *words]), default=0))
    room = max(0, console.width - borders - sum(widths))
    for k in sorted(range(len(widths)), key=natural.__getitem__):  # short columns stay in one line
        more = min(room, natural[k] - widths[k])
        widths[k], room = widths[k] + more, room - more
    for column, width in zip(table.columns, widths, strict=True):
        column.width = width
    table.width = sum(widths) + borders
    return table


def warn(warnings: Iterable[object]) -> None:
    """Print warnings on stderr: sentences, or cautions that have one."""
    for sentence in map(str, warnings):
        if _on_terminal():
            line = f"warning: {sentence}"
            _console(stderr=True).print(line, style="yellow", soft_wrap=True, markup=False)
        else:
            print(f"warning: {sentence}", file=sys.stderr)


@contextmanager
def working(what: str) -> Iterator[None]:
    """Say what is being done: a spinner on a terminal, else one line after a second."""
    if _on_terminal():
        with _console(stderr=True).status(what):
            yield
        return
    line = threading.Timer(1.0, print, (f"{what} …",), {"file": sys.stderr, "flush": True})
    line.start()
    try:
        yield
    finally:
        line.cancel()


def writable(path: Path | None, endings: tuple[str, ...]) -> None:
    """Refuse an output file that could not be written, before the work is done."""
    if path is not None:
        check_writable(path, endings)


@contextmanager
def counting(what: str) -> Iterator[Callable[[int, int], None]]:
    """Yield a function that is told (done, all): a bar on a terminal, else a line now and then."""
    if _on_terminal():
        from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn

        columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn())
        with Progress(*columns, console=_console(stderr=True), transient=True) as bar:
            task = bar.add_task(what, total=None)
            yield lambda done, total: bar.update(task, completed=done, total=total)
        return
    last = time.monotonic()

    def line(done: int, total: int) -> None:
        nonlocal last
        if time.monotonic() - last >= PLAIN_INTERVAL:
            last = time.monotonic()
            print(f"{what}: {done} of {total}", file=sys.stderr, flush=True)

    yield line
