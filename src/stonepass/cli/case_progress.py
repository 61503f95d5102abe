"""The progress of a sweep: finished cases, cases without an answer, rate, and time left."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

from stonepass.cli.terminal import duration, note

if TYPE_CHECKING:
    from stonepass.studies.sweeps.run import Standing

__all__ = ["counting_cases", "standing_line"]

INTERVAL = 10.0  # time in s between two lines where standard error is no terminal


@contextmanager
def counting_cases() -> Iterator[Callable[[Standing], None]]:
    """Yield a function that is called with the standing of a sweep and shows it.

    On a terminal it draws a bar; elsewhere it prints a line every ten seconds.
    """
    began, first = time.monotonic(), -1

    def line(now: Standing) -> str:
        nonlocal first
        first = now.finished if first < 0 else first
        return standing_line(now, now.finished - first, time.monotonic() - began)

    if not sys.stderr.isatty():
        yield _lines(line)
        return
    from rich.console import Console
    from rich.progress import BarColumn, Progress, TextColumn

    columns = (BarColumn(), TextColumn("{task.description}"))
    with Progress(*columns, console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("cases", total=None)
        yield lambda now: bar.update(
            task, completed=now.finished, total=now.cases, description=line(now)
        )


def standing_line(now: Standing, solved: int, seconds: float) -> str:
    """Return the standing in one line.

    Parameters
    ----------
    now : Standing
        The standing.
    solved : int
        Number of cases that this run has solved.
    seconds : float
        Time in s since it began.
    """
    parts = [f"{now.finished} of {now.cases} cases"]
    if now.unanswered:
        parts.append(f"{now.unanswered} without an answer")
    if now.faults:
        parts.append(f"{now.faults} of them errors of the program")
    if solved and seconds > 0.0:
        parts.append(f"{solved / seconds:.3g} a second")
        if now.finished < now.cases:
            parts.append(f"{duration((now.cases - now.finished) * seconds / solved)} left")
    return ", ".join(parts)


def _lines(line: Callable[[Standing], str]) -> Callable[[Standing], None]:
    """Return a function that prints a line every ten seconds, and none if the work is short."""
    last = time.monotonic()

    def tell(now: Standing) -> None:
        nonlocal last
        text = line(now)
        if time.monotonic() - last >= INTERVAL and now.finished < now.cases:
            last = time.monotonic()
            note(text)

    return tell
