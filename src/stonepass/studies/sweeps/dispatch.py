"""Distribution of the cases of a sweep over workers, in blocks whose size follows their cost.

A block takes about two seconds: a worker returns what it has finished by then, and the remaining
cases are sent again. If a worker process ends, the blocks that were under way are sent again, one
at a time, so that the next failure names its block; such a block is halved until a single case is
left. A case that ends its process twice while it is the only one under way gets a row that says so.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable, Iterator
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Future, wait
from dataclasses import dataclass, field
from typing import Any

from stonepass.errors import StonepassError
from stonepass.studies.sweeps.blocks import Block, Task, lost_block
from stonepass.studies.sweeps.plan import Sweep
from stonepass.studies.sweeps.workers import (
    Workers,
    connection_lost,
    problem_of,
    submit,
    worker_died,
)

__all__ = ["BLOCK_SECONDS", "LARGEST_BLOCK", "least_block", "solved_blocks"]

BLOCK_SECONDS = 2.0  # time in s that a block takes
LARGEST_BLOCK = 20_000  # largest number of cases in a block
MOST_SHARDS, ENOUGH = 500, 2000  # see `least_block`
QUEUED = 2  # blocks that are under way for each worker, so that none waits for the next one
DEATHS = 2  # ends of its process after which a case is given up

LOOK, SILENCE = 5.0, 30.0  # time in s between two looks at the connection, and until it is lost
LOST = (
    "the connection to the workers was lost: the finished blocks are kept, and the same study goes "
    "on when it is resumed."
)

Span = tuple[int, int]


def least_block(cases: int) -> int:
    """Return the smallest number of cases in a block of a study, apart from the last ones.

    A million cases have 500 blocks at most, because opening a file takes as long as reading a
    thousand rows. Larger studies have blocks of 2000 cases and more.
    """
    return max(1, min(cases // MOST_SHARDS, ENOUGH))


@dataclass
class _Queue:
    """The spans of cases that are still to be sent."""

    spans: deque[Span]
    size: int
    suspects: deque[tuple[Span, int]] = field(default_factory=deque)  # with the ends of processes

    @property
    def left(self) -> int:
        return sum(stop - start for start, stop in self.spans)

    def take(self, size: int) -> Span:
        """Return the next span of at most `size` cases."""
        start, stop = self.spans.popleft()
        end = min(stop, start + size)
        if end < stop:
            self.spans.appendleft((end, stop))
        return start, end

    def suspect(self, span: Span, alone: bool, deaths: int) -> int | None:
        """Put a span whose process ended aside; return the index of a case that is given up."""
        start, stop = span
        if not alone:
            self.suspects.append((span, 0))
        elif stop - start > 1:
            middle = (start + stop) // 2
            self.suspects.extendleft([((middle, stop), 0), ((start, middle), 0)])
        elif deaths + 1 < DEATHS:
            self.suspects.appendleft((span, deaths + 1))
        else:
            return start
        return None


@dataclass(frozen=True)
class _Sent:
    """A span that is under way; `alone` if no other one was sent with it."""

    span: Span
    alone: bool = False
    deaths: int = 0


def solved_blocks(
    plan: Sweep,
    gaps: list[Span],
    workers: Workers,
    solver: str,
    block_cases: int | None = None,
) -> Iterator[Block]:
    """Solve the cases in some gaps and yield their blocks as they are finished.

    Parameters
    ----------
    plan : Sweep
        The plan.
    gaps : list of (int, int)
        Ranges of cases; the second index is excluded.
    workers : Workers
        Where the blocks are solved.
    solver : str
        Digest of the solver that the results must come from.
    block_cases : int, optional
        Number of cases in every block except the last; by default it follows from their cost.

    Raises
    ------
    StonepassError
        The workers cannot be reached, or have another version of the solver.
    """
    queue = _Queue(deque(gaps), block_cases or least_block(plan.cases))
    pending: dict[Future[Any], _Sent] = {}
    send = _sender(plan, workers, solver, block_cases)
    try:
        while queue.spans or queue.suspects or pending:
            _fill(queue, pending, workers, send)
            done = _next_done(pending, workers)
            lost = [each for each in done if worker_died(problem_of(each))]
            for future in done:
                sent = pending.pop(future)
                if future in lost:
                    given_up = queue.suspect(sent.span, sent.alone, sent.deaths)
                    if given_up is not None:
                        yield lost_block(plan, given_up)
                    continue
                block = _result(future)
                if block.stop < sent.span[1]:
                    queue.spans.appendleft((block.stop, sent.span[1]))
                if block_cases is None:
                    queue.size = _next_size(block, queue, workers, plan)
                yield block
            if any(isinstance(problem_of(each), BrokenExecutor) for each in lost):
                _renewed(queue, pending, workers)
    finally:
        for future in pending:
            future.cancel()


def _next_done(pending: dict[Future[Any], _Sent], workers: Workers) -> set[Future[Any]]:
    """Wait for the next results; workers that cannot be reached for some time are given up."""
    silent = 0.0
    while True:
        done, _ = wait(pending, timeout=LOOK, return_when=FIRST_COMPLETED)
        if done:
            return done
        silent = 0.0 if workers.connected else silent + LOOK
        if silent >= SILENCE:
            raise StonepassError(LOST)


def _sender(
    plan: Sweep, workers: Workers, solver: str, block_cases: int | None
) -> Callable[[Span], Future[Any]]:
    """Return the function that sends a span of cases."""
    seconds = BLOCK_SECONDS if block_cases is None else float("inf")
    least = block_cases or least_block(plan.cases)

    def send(span: Span) -> Future[Any]:
        return submit(workers, Task(plan.part(*span), *span, solver, seconds, least))

    return send


def _fill(
    queue: _Queue,
    pending: dict[Future[Any], _Sent],
    workers: Workers,
    send: Callable[[Span], Future[Any]],
) -> None:
    """Send blocks until enough are under way; a suspect is sent when nothing else is."""
    if queue.suspects:
        if not pending:
            span, deaths = queue.suspects.popleft()
            pending[send(span)] = _Sent(span, True, deaths)
        return
    while queue.spans and len(pending) < QUEUED * workers.count:
        span = queue.take(queue.size)
        future = send(span)
        pending[future] = _Sent(span)
        if future.done():  # the executor runs in this process; the block is passed on
            return


def _renewed(queue: _Queue, pending: dict[Future[Any], _Sent], workers: Workers) -> None:
    """Put aside all blocks of a broken pool that are not finished, and begin a new pool."""
    workers.renew()
    for future, sent in list(pending.items()):
        if not future.done() or worker_died(problem_of(future)):
            queue.suspect(sent.span, False, 0)
            del pending[future]


def _result(future: Future[Any]) -> Block:
    problem = problem_of(future)
    if connection_lost(problem):
        raise StonepassError(LOST) from problem
    block: Block = future.result()
    return block


def _next_size(block: Block, queue: _Queue, workers: Workers, plan: Sweep) -> int:
    """Return the number of cases that take the time of a block, down to a quarter at the end."""
    cost = block.seconds / (block.stop - block.start)
    fitting = LARGEST_BLOCK if cost * LARGEST_BLOCK < BLOCK_SECONDS else int(BLOCK_SECONDS / cost)
    shared = -(-queue.left // (QUEUED * workers.count))
    return max(least_block(plan.cases), min(fitting, max(shared, fitting // 4)), 1)
