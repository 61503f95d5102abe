"""Where many cases run: in this process, or in a pool of others."""

from __future__ import annotations

import pickle
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, Future, ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing import get_context
from typing import Any

__all__ = ["can_travel", "executor"]


class _Here(Executor):
    """Runs every call at once, in this process."""

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Call and return a future that is done."""
        future: Future[Any] = Future()
        try:
            future.set_result(fn(*args, **kwargs))
        except Exception as problem:
            future.set_exception(problem)
        return future


@contextmanager
def executor(workers: int) -> Iterator[Executor]:
    """Yield an executor of `workers` processes; 1 is this process.

    New processes start clean (spawn), so a script that asks for them must guard its entry point.
    """
    if workers == 1:
        yield _Here()
        return
    with ProcessPoolExecutor(workers, mp_context=get_context("spawn")) as pool:
        yield pool


def can_travel(work: Any) -> bool:
    """Whether something can be sent to another process; a user's own function cannot."""
    try:
        pickle.dumps(work)
    except Exception:  # whatever a user's law holds
        return False
    return True
