"""Where the work of a study runs: any `concurrent.futures.Executor`, and how work is sent to it.

A command makes one executor (`process_pool`) and passes it to every study it runs. Its processes
end with the process that started them, however that one ends: each holds the reading end of a pipe
and ends when nobody holds the writing end any more.
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
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ProcessPoolExecutor, wait
from contextlib import contextmanager, suppress
from multiprocessing.connection import Connection
from multiprocessing.context import SpawnContext, SpawnProcess
from typing import Any, TextIO, TypeVar

from stonepass.errors import CacheWarning
from stonepass.io.text_file import WRITING

__all__ = ["CORES", "InProcessExecutor", "executor_for", "process_pool", "stream"]

CORES = os.cpu_count() or 1
BLOCK_SECONDS = 1.0  # a block of items stops after the item that ends beyond this time
LARGEST_BLOCK = 256  # items
IN_FLIGHT = 64  # blocks that were sent and have not returned
GRACE = 1.0  # s that a process has to end by itself once the work is given up

Item = TypeVar("Item")
Result = TypeVar("Result")


# Results of the first items of a block, the seconds they took, and the warnings they gave.
_Block = tuple[list[Result], float, list[warnings.WarningMessage]]


class InProcessExecutor(Executor):
    """Runs each call in this process, at the time it is submitted."""

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Call `fn` and return a future that is done."""
        future: Future[Any] = Future()
        try:
            future.set_result(fn(*args, **kwargs))
        except Exception as problem:
            future.set_exception(problem)
        return future


@contextmanager
def process_pool(workers: int) -> Iterator[Executor]:
    """Yield an executor that lives as long as the context.

    Parameters
    ----------
    workers : int
        Number of processes, at least 1; with 1 the work runs in this process. New processes are
        started with the method "spawn", so that a script that asks for them must guard its entry
        point with ``if __name__ == "__main__"``. They end within about a second when the context is
        left by an exception, such as the one that Ctrl-C raises, or when this process is killed.
    """
    if workers == 1:
        yield InProcessExecutor()
        return
    context = _RecordingContext()
    reading, writing = context.Pipe(duplex=False)
    pool = ProcessPoolExecutor(workers, context, _begin_worker, (reading,))
    try:
        yield pool
        pool.shutdown()
    except BaseException:
        pool.shutdown(wait=False, cancel_futures=True)
        writing.close()
        context.end_processes()
        raise
    finally:
        writing.close()
        reading.close()


class _Worker(SpawnProcess):
    """A process that Ctrl-C in a terminal does not reach: whoever started it decides."""

    def start(self) -> None:
        """Start it with SIGINT blocked, which a new process inherits."""
        with _interrupts_blocked():
            super().start()


class _RecordingContext(SpawnContext):
    """Starts processes and knows which, so that they can be ended."""

    def __init__(self) -> None:
        super().__init__()
        self.started: list[_Worker] = []

    def Process(self, *args: Any, **settings: Any) -> _Worker:  # type: ignore[override]
        """Return a new process, not yet started."""
        process = _Worker(*args, **settings)
        self.started.append(process)
        return process

    def end_processes(self) -> None:
        """Wait for the processes to end, and kill those that do not within the grace."""
        last = time.monotonic() + GRACE
        for process in self.started:
            process.join(max(0.0, last - time.monotonic()))
        for process in self.started:
            if process.is_alive():
                process.kill()


@contextmanager
def _interrupts_blocked() -> Iterator[None]:
    """Hold back SIGINT in this thread; an interrupt that comes meanwhile is delivered after."""
    if not hasattr(signal, "pthread_sigmask"):  # Windows
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


_noted: list[warnings.WarningMessage] = []  # warnings of this worker that were not sent home yet


def _begin_worker(parent: Connection) -> None:
    """Prepare a process of the pool: it leaves Ctrl-C to its parent, and ends with it."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=_end_with, args=(parent,), daemon=True).start()
    warnings.showwarning = _note


def _end_with(parent: Connection) -> None:
    """End this process once the other end of the pipe is closed, but not amid writing a file."""
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
    # The text alone, since what else a library's warning holds may not travel.
    plain = category.__module__ in ("builtins", CacheWarning.__module__)
    kind = category if plain else UserWarning
    _noted.append(warnings.WarningMessage(str(message), kind, filename, lineno))


def executor_for(work: Any, executor: Executor | None) -> Executor:
    """Return the executor, or one of this process for work that cannot be sent to another.

    A user's own function cannot be sent. Without an executor the work runs in this process too.
    """
    if executor is None or isinstance(executor, InProcessExecutor):
        return InProcessExecutor()
    try:
        pickle.dumps(work)
    except Exception:  # a user's law may hold anything, and pickle raises many kinds
        return InProcessExecutor()
    return executor


def stream(
    executor: Executor, work: Callable[[Item], Result], items: Sequence[Item]
) -> Iterator[tuple[int, Result]]:
    """Apply `work` to every item and yield (index, result) in the order in which results arrive.

    Items are sent in blocks that take about `BLOCK_SECONDS`, so that short items do not pay for
    the transport one by one. A block that takes longer returns early, and its remaining items are
    sent again. At most `IN_FLIGHT` blocks are under way at a time, so that neither their futures
    nor their results pile up.

    Parameters
    ----------
    executor : concurrent.futures.Executor
    work : callable
        Takes one item. Results must not depend on which items share a block.
    items : sequence

    Raises
    ------
    Exception
        What `work` raises; blocks that have not begun are then cancelled.
    """
    waiting = deque(enumerate(items))
    pending: dict[Future[_Block[Result]], list[tuple[int, Item]]] = {}
    size = 1
    try:
        while waiting or pending:
            while waiting and len(pending) < IN_FLIGHT:
                block = [waiting.popleft() for _ in range(min(size, len(waiting)))]
                future = executor.submit(_run_block, work, [item for _, item in block])
                pending[future] = block
                if future.done():  # it ran in this process; its results are passed on first
                    break
            done, _ = wait(pending, return_when=FIRST_COMPLETED)
            for future in done:
                block = pending.pop(future)
                results, seconds, noted = future.result()
                for each in noted:
                    warnings.warn_explicit(each.message, each.category, each.filename, each.lineno)
                waiting.extendleft(reversed(block[len(results) :]))
                size = _block_size(len(results), seconds)
                for (index, _), result in zip(block, results, strict=False):
                    yield index, result
    finally:
        for future in pending:
            future.cancel()


def _block_size(count: int, seconds: float) -> int:
    """Return how many items take `BLOCK_SECONDS` where `count` items took `seconds`."""
    if seconds * LARGEST_BLOCK <= BLOCK_SECONDS * count:
        return LARGEST_BLOCK
    return max(1, int(BLOCK_SECONDS * count / seconds))


def _run_block(work: Callable[[Item], Result], items: Sequence[Item]) -> _Block[Result]:
    """Return the results of the first items, as many as the time allows."""
    started = time.perf_counter()
    results = []
    for item in items:
        results.append(work(item))
        if time.perf_counter() - started >= BLOCK_SECONDS:
            break
    noted = _noted.copy()
    _noted.clear()
    return results, time.perf_counter() - started, noted
