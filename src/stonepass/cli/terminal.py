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

__all__ = ["FIGURES", "counting", "print_json", "show", "warn", "working", "writable"]

FIGURES = (".svg", ".png", ".pdf")
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
        sentence = isinstance(part, str)
        _console().print(part, soft_wrap=sentence, markup=not sentence)


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
