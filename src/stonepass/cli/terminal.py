"""Output of the commands: results on stdout; progress, notes and warnings on stderr."""

from __future__ import annotations

import json
import sys
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

__all__ = [
    "FIGURES",
    "announce",
    "counting",
    "duration",
    "note",
    "print_json",
    "remembered",
    "show",
    "warn",
    "working",
    "writable",
    "wrote",
]

FIGURES = (".svg", ".png", ".pdf")
PLAIN_INTERVAL = 10.0  # seconds at least between two lines where stderr is no terminal
PLAIN_LINES = 4  # parts of the work; each of them has at most one such line
LONG = 1.0  # seconds of work whose duration is shown


@lru_cache
def _console(*, stderr: bool = False) -> Console:
    """Return the console of stdout or stderr; it is loaded only if it is needed."""
    from rich.console import Console

    return Console(stderr=stderr, highlight=False, soft_wrap=False)


def _on_terminal() -> bool:
    return sys.stderr.isatty()


def print_json(record: Any) -> None:
    """Write one JSON document to stdout; a number that is not finite raises `ValueError`."""
    escaped = not encodes_everything(sys.stdout)  # JSON has its own way to write characters
    document = json.dumps(record, indent=2, ensure_ascii=escaped, allow_nan=False)
    sys.stdout.write(document + "\n")


def show(*parts: Any) -> None:
    """Print tables and sentences on stdout."""
    from stonepass.cli.narrow import fitted

    for part in parts:
        if isinstance(part, str):
            _console().print(part, soft_wrap=True, markup=False)
        else:
            _console().print(fitted(part, _console()), crop=False)


def warn(warnings: Iterable[object]) -> None:
    """Print warnings on stderr: sentences, or cautions, whose text is a sentence."""
    for sentence in map(str, warnings):
        if _on_terminal():
            line = f"warning: {sentence}"
            _console(stderr=True).print(line, style="yellow", soft_wrap=True, markup=False)
        else:
            print(f"warning: {sentence}", file=sys.stderr)


def note(sentence: str) -> None:
    """Print a line about the run itself on stderr."""
    print(sentence, file=sys.stderr, flush=True)


def wrote(*paths: Path | None) -> None:
    """Name the files that were written; None stands for a file that was not asked for."""
    for path in paths:
        if path is not None:
            note(f"wrote {path}")


def announce(what: str, seconds: float, *, remembers: bool = True) -> None:
    """Print before a long command what it does and about how long that takes.

    Parameters
    ----------
    what : str
        The work, e.g. ``"fitting the friction of 10 points"``.
    seconds : float
        Estimate with an empty cache.
    remembers : bool
        Whether solved states are kept, so that the command takes seconds when it is repeated.
    """
    note(f"{what}: about {duration(seconds)}{' the first time' if remembers else ''}")


def duration(seconds: float) -> str:
    """Write a duration in words: ``0.8 s``, ``25 s``, ``4 min``, ``2 h``."""
    if seconds < 10.0:
        return f"{max(seconds, 0.1):.1f} s"
    if seconds < 100.0:
        return f"{seconds:.0f} s"
    return f"{seconds / 60.0:.0f} min" if seconds < 5400.0 else f"{seconds / 3600.0:.0f} h"


def remembered(seconds: float, elapsed: float) -> None:
    """Print a note if an answer was read from the cache folder.

    Parameters
    ----------
    seconds : float
        Time that the finite elements took when the states of the answer were solved.
    elapsed : float
        Time that the answer took now. It is the longer one if the states were solved now.
    """
    if elapsed < seconds:
        saved = duration(seconds - elapsed)
        note(f"read from the cache, which saved {saved}; --no-cache solves it again")


@contextmanager
def working(what: str) -> Iterator[Callable[[str], None]]:
    """Show on a terminal what is being done and for how long; nothing elsewhere.

    Yields
    ------
    callable
        Takes a text that is shown after `what`, such as the step that has begun.
    """
    if not _on_terminal():
        yield lambda _: None
        return
    from rich.progress import Progress, SpinnerColumn, TextColumn, TimeElapsedColumn

    columns = (SpinnerColumn(), TextColumn("{task.description}"), TimeElapsedColumn())
    began = time.monotonic()
    with Progress(*columns, console=_console(stderr=True), transient=True) as bar:
        task = bar.add_task(what, total=None)
        yield lambda step: bar.update(task, description=f"{what}: {step}")
    _tell_duration(what, time.monotonic() - began)


def writable(path: Path | None, endings: tuple[str, ...]) -> None:
    """Refuse an output file that cannot be written, before the work begins."""
    if path is not None:
        check_writable(path, endings)


@contextmanager
def counting(what: str) -> Iterator[Callable[[int, int], None]]:
    """Yield a function that is called with (done, all) and shows the progress.

    On a terminal it draws a bar with the remaining time; elsewhere it prints a few lines, and none
    if the work is short.
    """
    if not _on_terminal():
        yield _few_lines(what)
        return
    from rich.progress import (
        BarColumn,
        MofNCompleteColumn,
        Progress,
        TextColumn,
        TimeElapsedColumn,
        TimeRemainingColumn,
    )

    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(),
               TimeElapsedColumn(), TextColumn("remaining"), TimeRemainingColumn())  # fmt: skip
    began = time.monotonic()
    with Progress(*columns, console=_console(stderr=True), transient=True) as bar:
        task = bar.add_task(what, total=None)
        yield lambda done, total: bar.update(task, completed=done, total=total)
    _tell_duration(what, time.monotonic() - began)


def _few_lines(what: str) -> Callable[[int, int], None]:
    """Return a progress function for output that is no terminal.

    If the work has several stages, each of which counts from 1, every stage has its own lines.
    """
    last, quarter, before = time.monotonic(), 0, 0

    def line(done: int, total: int) -> None:
        nonlocal last, quarter, before
        now, part = time.monotonic(), PLAIN_LINES * done // total
        if done < before:
            quarter = 0
        before = done
        if part > quarter and done < total and now - last >= PLAIN_INTERVAL:
            last, quarter = now, part
            note(f"{what}: {done} of {total}")

    return line


def _tell_duration(what: str, seconds: float) -> None:
    if seconds >= LONG:
        _console(stderr=True).print(f"{what}: {duration(seconds)}", style="dim", markup=False)
