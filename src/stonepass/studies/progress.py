"""Progress bars of studies that are started from Python, in a terminal or in a notebook."""

from __future__ import annotations

import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from importlib import import_module
from typing import Any

from stonepass.studies.jobs import Progress

__all__ = ["reported"]

DELAY = 1.0  # time in s after which a bar is shown


@contextmanager
def reported(progress: bool | Progress, what: str) -> Iterator[Progress | None]:
    """Yield the function that a study calls with (done, all) after each job, or None.

    Parameters
    ----------
    progress : bool or callable
        A function is yielded as it is. True yields a function that shows a bar after one second, if
        standard error is a terminal or the code runs in a notebook.
    what : str
        Name of the items that are counted, e.g. ``"size ratios"``.
    """
    if callable(progress):
        yield progress
    elif progress and _in_notebook():
        with _notebook_bar(what) as told:
            yield told
    elif progress and sys.stderr.isatty():
        with _terminal_bar(what) as told:
            yield told
    else:
        yield None


def _in_notebook() -> bool:
    """Return whether this code runs in a Jupyter kernel."""
    ipython = sys.modules.get("IPython")
    return ipython is not None and hasattr(ipython.get_ipython(), "kernel")


@contextmanager
def _terminal_bar(what: str) -> Iterator[Progress]:
    rich, console = import_module("rich.progress"), import_module("rich.console")
    columns = (rich.TextColumn("{task.description}"), rich.BarColumn(), rich.MofNCompleteColumn(),
               rich.TimeRemainingColumn())  # fmt: skip
    bar = rich.Progress(*columns, console=console.Console(stderr=True), transient=True)
    task, started, shown = bar.add_task(what, total=None), time.monotonic(), False

    def told(done: int, total: int) -> None:
        nonlocal shown
        bar.update(task, completed=done, total=total)
        if not shown and time.monotonic() - started > DELAY:
            bar.start()
            shown = True

    try:
        yield told
    finally:
        bar.stop()


class _Line:
    """A line of text with a bar that a notebook displays."""

    def __init__(self, what: str, done: int, total: int) -> None:
        self.text = f"{what}: {done} of {total}"
        self.bar = f'<progress value="{done}" max="{total}"></progress>'

    def __repr__(self) -> str:
        return self.text

    def _repr_html_(self) -> str:
        return f"{self.bar} {self.text}"


@contextmanager
def _notebook_bar(what: str) -> Iterator[Progress]:
    """Show a single display that is updated in place, without widgets."""
    display: Any = import_module("IPython.display").display
    handle, started = None, time.monotonic()

    def told(done: int, total: int) -> None:
        nonlocal handle
        if handle is not None:
            handle.update(_Line(what, done, total))
        elif time.monotonic() - started > DELAY:
            handle = display(_Line(what, done, total), display_id=True)

    yield told
