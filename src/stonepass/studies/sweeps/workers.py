"""Where the blocks of a sweep are solved: in this process, in its own pool, or in an executor."""

from __future__ import annotations

from collections.abc import Iterator
from concurrent.futures import BrokenExecutor, CancelledError, Executor, Future
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, field
from typing import Any, Protocol, runtime_checkable

from stonepass.errors import StonepassError
from stonepass.studies.executor import CORES, InProcessExecutor, executor_for, process_pool
from stonepass.studies.sweeps.blocks import Task, run_task
from stonepass.studies.sweeps.cluster import ClusterExecutor, client_of

__all__ = [
    "GivenWorkers",
    "PoolWorkers",
    "Workers",
    "connection_lost",
    "problem_of",
    "submit",
    "worker_died",
    "workers_of",
]


@runtime_checkable
class Workers(Protocol):
    """Workers that solve blocks.

    Attributes
    ----------
    count : int
        Number of tasks that run at the same time.
    """

    count: int

    @property
    def executor(self) -> Executor:
        """The executor that runs the tasks."""

    @property
    def connected(self) -> bool:
        """False if the connection to the workers is lost at present."""

    def renew(self) -> None:
        """Replace an executor that was broken by the end of one of its processes."""


@dataclass
class GivenWorkers:
    """The workers of an executor that the caller has made.

    Attributes
    ----------
    executor : concurrent.futures.Executor
        The executor.
    count : int
        Number of tasks that run at the same time.
    """

    executor: Executor
    count: int

    @property
    def connected(self) -> bool:
        """False if the workers are those of a cluster whose scheduler does not answer."""
        return bool(getattr(self.executor, "connected", True))

    def renew(self) -> None:
        """Raise an error, because the caller must make a new executor."""
        raise StonepassError(
            "the executor is broken, because one of its processes ended: the finished blocks are "
            "kept; make a new executor and go on with resume=True."
        )


@dataclass
class PoolWorkers:
    """A process pool that is replaced when one of its processes is killed.

    Attributes
    ----------
    count : int
        Number of processes, at least 2.
    """

    count: int
    _stack: ExitStack = field(default_factory=ExitStack)
    _executor: Executor | None = None

    @property
    def executor(self) -> Executor:
        """The present pool."""
        if self._executor is None:
            self._executor = self._stack.enter_context(process_pool(self.count))
        return self._executor

    @property
    def connected(self) -> bool:
        """True, because the processes are on this machine."""
        return True

    def renew(self) -> None:
        """Begin a new pool in the place of a broken one."""
        self._stack.close()
        self._executor = None

    @contextmanager
    def open(self) -> Iterator[PoolWorkers]:
        """Yield these workers; their processes end with the context."""
        with self._stack:
            yield self


@contextmanager
def workers_of(work: Any, executor: Executor | None, count: int | None) -> Iterator[Workers]:
    """Yield the workers that a caller of `sweep` has asked for.

    Parameters
    ----------
    work : object
        The work that is sent to the workers. It is done in this process if it cannot be pickled,
        which holds for a user's own function.
    executor : concurrent.futures.Executor or None
        The executor of the caller.
    count : int or None
        Number of workers: by default that of the executor if it is known, else the number of
        processors. Without an executor it is the number of processes, by default 1, which means
        this process.
    """
    alone = executor is None and count in (None, 1)
    if alone or not _can_be_sent(work):
        yield GivenWorkers(InProcessExecutor(), 1)
    elif isinstance(executor, ClusterExecutor):
        yield GivenWorkers(executor, count or executor.count)
    elif executor is not None and (client := client_of(executor)) is not None:
        on_cluster = ClusterExecutor(client)
        yield GivenWorkers(on_cluster, count or on_cluster.count)
    elif executor is not None:
        known = getattr(executor, "_max_workers", None)
        yield GivenWorkers(executor, count or (known if isinstance(known, int) else CORES))
    else:
        with PoolWorkers(count or CORES).open() as workers:
            yield workers


def _can_be_sent(work: Any) -> bool:
    anywhere = Executor()
    return executor_for(work, anywhere) is anywhere


def submit(workers: Workers, task: Task) -> Future[Any]:
    """Send a task; the future of an executor that is already broken has its error."""
    try:
        return workers.executor.submit(run_task, task)
    except BrokenExecutor as problem:
        future: Future[Any] = Future()
        future.set_exception(problem)
        return future


def problem_of(future: Future[Any]) -> BaseException | None:
    """Return the error of a finished future, be it that it was cancelled; None without an error."""
    return CancelledError() if future.cancelled() else future.exception()


def worker_died(problem: BaseException | None) -> bool:
    """Return True if a task failed because the process that ran it ended.

    Dask reports it by an error of its own, which is recognised without importing Dask.
    """
    return isinstance(problem, BrokenExecutor) or type(problem).__qualname__ == "KilledWorker"


def connection_lost(problem: BaseException | None) -> bool:
    """Return True if a task failed because the connection to the workers was lost."""
    return isinstance(problem, CancelledError | ConnectionError) or any(
        each.__qualname__ in ("CommClosedError", "FutureCancelledError")
        for each in type(problem).__mro__
    )
