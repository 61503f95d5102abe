"""Where the work of a study runs: any `concurrent.futures.Executor`, and how work is sent to it.

A command makes one executor (`process_pool`) and passes it to every study it runs.
"""

from __future__ import annotations

import os
import pickle
import time
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ProcessPoolExecutor, wait
from contextlib import contextmanager
from multiprocessing import get_context
from typing import Any, TypeVar

__all__ = ["CORES", "InProcessExecutor", "executor_for", "process_pool", "stream"]

CORES = os.cpu_count() or 1
BLOCK_SECONDS = 1.0  # a block of items stops after the item that ends beyond this time
LARGEST_BLOCK = 256  # items
IN_FLIGHT = 64  # blocks that were sent and have not returned

Item = TypeVar("Item")
Result = TypeVar("Result")


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
        point with ``if __name__ == "__main__"``.
    """
    if workers == 1:
        yield InProcessExecutor()
        return
    with ProcessPoolExecutor(workers, mp_context=get_context("spawn")) as pool:
        yield pool


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
    pending: dict[Future[tuple[list[Result], float]], list[tuple[int, Item]]] = {}
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
                results, seconds = future.result()
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


def _run_block(work: Callable[[Item], Result], items: Sequence[Item]) -> tuple[list[Result], float]:
    """Return the results of the first items, as many as the time allows, and the time."""
    started = time.perf_counter()
    results = []
    for item in items:
        results.append(work(item))
        if time.perf_counter() - started >= BLOCK_SECONDS:
            break
    return results, time.perf_counter() - started
