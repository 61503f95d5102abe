"""Executors of the work of a study, and the transfer of work to them.

Studies accept any `concurrent.futures.Executor`. A command makes one executor (`process_pool`) and
passes it to every study it runs. The processes of the pool end when the process that started them
ends, even if it is killed: each of them waits at the reading end of a pipe whose writing end only
the parent process holds open.
"""

from __future__ import annotations

import os
import pickle
import signal
import threading
import time
import warnings
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import (
    FIRST_COMPLETED,
    BrokenExecutor,
    Executor,
    Future,
    ProcessPoolExecutor,
    wait,
)
from contextlib import contextmanager, suppress
from multiprocessing import connection
from multiprocessing.context import SpawnContext, SpawnProcess
from typing import Any, TextIO, TypeVar

from stonepass.errors import CacheWarning, StonepassError
from stonepass.io.text_file import WRITING

__all__ = ["CORES", "KILLED", "InProcessExecutor", "executor_for", "process_pool", "stream"]

CORES = os.cpu_count() or 1  # number of processors
BATCH_SECONDS = 1.0  # time in s after which a batch ends; its remaining items are sent again
LARGEST_BATCH = 256  # largest number of items in a batch
IN_FLIGHT = 64  # largest number of batches that were sent and have not returned
KILLED = (
    "a worker process was killed, which the system does when memory runs out: use fewer workers, "
    "or close other programs."
)
GRACE = 1.0  # time in s that a process has to end by itself after the work was cancelled

Item = TypeVar("Item")
Result = TypeVar("Result")


# Results of the first items of a batch, their duration in s, and the warnings they raised.
_Batch = tuple[list[Result], float, list[warnings.WarningMessage]]


class InProcessExecutor(Executor):
    """An executor that runs each call in this process when it is submitted."""

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Call `fn` and return a finished future."""
        future: Future[Any] = Future()
        try:
            future.set_result(fn(*args, **kwargs))
        except Exception as problem:
            future.set_exception(problem)
        return future


@contextmanager
def process_pool(workers: int) -> Iterator[Executor]:
    """Yield an executor that exists as long as the context.

    New processes are started with the method "spawn", so that a script must guard its entry point
    with ``if __name__ == "__main__"``. The processes end within about a second if an exception
    leaves the context, such as the one that Ctrl-C raises, or if this process is killed.

    Parameters
    ----------
    workers : int
        Number of processes, at least 1. With 1 the work runs in this process.
    """
    if workers == 1:
        yield InProcessExecutor()
        return
    context = _RecordingContext()
    reading, writing = context.Pipe(duplex=False)
    pool = ProcessPoolExecutor(workers, context, _begin_worker, (reading,))
    try:
        yield pool
        _shut_down(pool, context)
    except BaseException:
        pool.shutdown(wait=False, cancel_futures=True)
        writing.close()
        context.end_processes()
        raise
    finally:
        writing.close()
        reading.close()


class _Worker(SpawnProcess):
    """A process that ignores Ctrl-C in a terminal; its parent process decides when it ends."""

    def start(self) -> None:
        """Start the process with SIGINT blocked; a new process inherits the blocked signals."""
        with _interrupts_blocked():
            super().start()


class _RecordingContext(SpawnContext):
    """A context that records its processes, so that they can be ended."""

    def __init__(self) -> None:
        super().__init__()
        self._made: list[_Worker] = []

    @property
    def started(self) -> list[_Worker]:
        """The processes whose start did not fail."""
        return [each for each in self._made if each.pid is not None]

    def Process(self, *args: Any, **settings: Any) -> _Worker:  # type: ignore[override]
        """Return a new process that has not been started."""
        process = _Worker(*args, **settings)
        self._made.append(process)
        return process

    def join_processes(self) -> None:
        """Wait for the processes to end; if one of them was killed, kill the others."""
        running = self.started
        while running:
            connection.wait([each.sentinel for each in running])
            running = [each for each in running if each.is_alive()]
            if self.broken:
                for each in running:
                    each.kill()

    @property
    def broken(self) -> bool:
        """True if a process was killed, or ended with an error."""
        return any(each.exitcode not in (None, 0) for each in self.started)

    def end_processes(self) -> None:
        """Wait up to `GRACE` seconds for the processes to end, and kill the others."""
        last = time.monotonic() + GRACE
        for process in self.started:
            process.join(max(0.0, last - time.monotonic()))
        for process in self.started:
            if process.is_alive():
                process.kill()


def _shut_down(pool: Executor, context: _RecordingContext) -> None:
    """Let the processes finish their work and end.

    A pool whose process was killed is broken, and up to Python 3.11 its shutdown can wait for ever
    for another process: one that was just starting is not told to end, and one that waits for a
    lock which the killed process held cannot read that it should. The others are therefore killed.
    """
    closing = threading.Thread(target=pool.shutdown, daemon=True)
    closing.start()
    context.join_processes()
    closing.join()


@contextmanager
def _interrupts_blocked() -> Iterator[None]:
    """Block SIGINT in this thread; an interrupt during the context is delivered after it."""
    if not hasattr(signal, "pthread_sigmask"):  # Windows
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


# Warnings in this worker process that have not been sent to the parent process yet.
_noted: list[warnings.WarningMessage] = []


def _begin_worker(parent: connection.Connection) -> None:
    """Prepare a process of the pool: it ignores Ctrl-C, and ends when its parent process ends."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with, args=(parent,), daemon=True).start()
    warnings.showwarning = _note


def _end_with(parent: connection.Connection) -> None:
    """End this process once the other end of the pipe is closed, but not while it writes a file."""
    with suppress(EOFError, OSError):
        parent.recv_bytes()
    WRITING.acquire(timeout=GRACE)
    os._exit(1)


def _note(
    message: Warning | str,
    category: type[Warning],
    filename: str,
    lineno: int,
    file: TextIO | None = None,
    line: str | None = None,
) -> None:
    # Only the text is kept, because a warning object of a library may not be picklable.
    plain = category.__module__ in ("builtins", CacheWarning.__module__)
    kind = category if plain else UserWarning
    _noted.append(warnings.WarningMessage(str(message), kind, filename, lineno))


def executor_for(work: Any, executor: Executor | None) -> Executor:
    """Return the executor that can run some work.

    Parameters
    ----------
    work : object
        The work. It can be sent to other processes if it can be pickled, which is impossible for a
        user's own function.
    executor : concurrent.futures.Executor or None
        The preferred executor; None for this process.

    Returns
    -------
    concurrent.futures.Executor
        The given executor, or one of this process.
    """
    if executor is None or isinstance(executor, InProcessExecutor):
        return InProcessExecutor()
    try:
        pickle.dumps(work)
    except Exception:  # a user's law may hold any object, and pickle raises many kinds of errors
        return InProcessExecutor()
    return executor


def stream(
    executor: Executor, work: Callable[[Item], Result], items: Sequence[Item]
) -> Iterator[tuple[int, Result]]:
    """Apply a function to every item and yield (index, result) in the order of completion.

    Items are sent in batches that take about 1 s, so that the cost of the transfer is small. A
    batch that takes longer returns early, and its remaining items are sent again. At most 64
    batches are in progress at a time, which limits the memory.

    Parameters
    ----------
    executor : concurrent.futures.Executor
        Where the function runs.
    work : callable
        Function of one item. Its result must not depend on the other items of a batch.
    items : sequence
        Arguments of the function.

    Raises
    ------
    StonepassError
        A process of the executor was killed.
    Exception
        An error of `work` is passed on; batches that have not begun are then cancelled.
    """
    waiting = deque(enumerate(items))
    pending: dict[Future[_Batch[Result]], list[tuple[int, Item]]] = {}
    size = 1
    try:
        while waiting or pending:
            while waiting and len(pending) < IN_FLIGHT:
                batch = [waiting.popleft() for _ in range(min(size, len(waiting)))]
                future = executor.submit(_run_batch, work, [item for _, item in batch])
                pending[future] = batch
                if future.done():  # the executor runs in this process; the results are passed on
                    break
            done, _ = wait(pending, return_when=FIRST_COMPLETED)
            for future in done:
                batch = pending.pop(future)
                results, seconds, noted = future.result()
                for each in noted:
                    warnings.warn_explicit(each.message, each.category, each.filename, each.lineno)
                waiting.extendleft(reversed(batch[len(results) :]))
                size = _batch_size(len(results), seconds)
                for (index, _), result in zip(batch, results, strict=False):
                    yield index, result
    except BrokenExecutor as problem:
        raise StonepassError(KILLED) from problem
    finally:
        for future in pending:
            future.cancel()


def _batch_size(count: int, seconds: float) -> int:
    """Return how many items take 1 s if `count` items took `seconds`."""
    if seconds * LARGEST_BATCH <= BATCH_SECONDS * count:
        return LARGEST_BATCH
    return max(1, int(BATCH_SECONDS * count / seconds))


def _run_batch(work: Callable[[Item], Result], items: Sequence[Item]) -> _Batch[Result]:
    """Return the results of as many first items as the time for a batch allows."""
    started = time.perf_counter()
    results = []
    for item in items:
        results.append(work(item))
        if time.perf_counter() - started >= BATCH_SECONDS:
            break
    noted = _noted.copy()
    _noted.clear()
    return results, time.perf_counter() - started, noted
