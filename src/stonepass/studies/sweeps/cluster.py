"""The connection of a sweep to a Dask cluster.

The executor of a Dask client leaves a future pending for ever if the result of its task was lost
with the worker and the task then fails when it is computed again. Sweeps therefore send their tasks
through an executor of their own, which passes on every end of a task.
"""

from __future__ import annotations

import logging
import socket
from collections.abc import Callable, Iterator
from concurrent.futures import Executor, Future
from contextlib import contextmanager
from typing import Any
from urllib.parse import urlsplit

from stonepass.errors import BadInput, require
from stonepass.io.optional_imports import library

__all__ = ["EXTRA", "ClusterExecutor", "client_of", "cluster"]

EXTRA = "cluster"  # the extra of stonepass that installs Dask
CLOSING = 2.0  # time in s in which the connection is closed
PATIENCE = 10.0  # time in s in which the scheduler must answer
ANSWERING = "the address of a scheduler that answers, e.g. tcp://10.0.0.1:8786"
STARTED_BY = "start it with 'dask scheduler', which prints its address"


class ClusterExecutor(Executor):
    """An executor that runs each call on a worker of a Dask cluster.

    Parameters
    ----------
    client : distributed.Client
        The client of the cluster.
    """

    def __init__(self, client: Any) -> None:
        self.client = client

    @property
    def count(self) -> int:
        """Number of calls that run at the same time."""
        return sum(self.client.nthreads().values())

    @property
    def connected(self) -> bool:
        """True unless the connection to the scheduler was lost; Dask tries to connect again."""
        return bool(self.client.status == "running")

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Send a call and return a future with its result or its error."""
        sent, future = self.client.submit(fn, *args, pure=False, **kwargs), Future[Any]()
        # A task that was released is not begun; to cancel it would wait for the scheduler.
        future.add_done_callback(lambda _: sent.release())
        self.client.loop.add_callback(_pass_on, self.client, sent, future)
        return future


async def _pass_on(client: Any, sent: Any, future: Future[Any]) -> None:
    """Wait for a task of Dask, and give its end to a future."""
    try:
        (result,) = await client.gather([sent], asynchronous=True)
    except BaseException as problem:
        if future.set_running_or_notify_cancel():
            future.set_exception(problem)
    else:
        if future.set_running_or_notify_cancel():
            future.set_result(result)


def client_of(executor: Executor) -> Any | None:
    """Return the Dask client of an executor from ``Client.get_executor()``; None for any other."""
    if type(executor).__module__.partition(".")[0] != "distributed":
        return None
    return getattr(executor, "_client", None)


def _silence() -> None:
    """Silence the logs of Dask until the process ends.

    A lost connection is told by one sentence; Dask logs tracebacks of it until after its client was
    closed.
    """
    for name in ("asyncio", *logging.root.manager.loggerDict):
        if name.partition(".")[0] in ("asyncio", "distributed", "tornado"):
            logging.getLogger(name).setLevel(logging.CRITICAL + 1)


def _check_address(address: str) -> None:
    """Refuse an address without a port, or with an unknown host, for which Dask would wait long."""
    parts = urlsplit(address if "://" in address else f"tcp://{address}")
    try:
        known = parts.port is not None and bool(socket.getaddrinfo(parts.hostname, parts.port))
    except (OSError, ValueError, UnicodeError):
        known = False
    require(known, "--scheduler", address, ANSWERING, STARTED_BY)


@contextmanager
def cluster(address: str) -> Iterator[ClusterExecutor]:
    """Yield an executor that runs calls on the workers of a Dask scheduler.

    The command line uses this function; it silences the logs of Dask.

    Parameters
    ----------
    address : str
        Address of the scheduler, e.g. ``tcp://10.0.0.1:8786``.

    Raises
    ------
    BadInput
        Dask is not installed, no scheduler answers at the address, or it has no workers.
    """
    distributed = library("distributed", "run on a cluster", EXTRA)
    _check_address(address)
    _silence()
    try:
        client = distributed.Client(address, timeout=PATIENCE, set_as_default=False)
    except (OSError, ValueError) as problem:
        raise BadInput("--scheduler", address, ANSWERING, STARTED_BY) from problem
    try:
        executor = ClusterExecutor(client)
        require(executor.count > 0, "--scheduler", address, "a scheduler with workers",
                f"start some with 'dask worker {address} --nthreads 1'")  # fmt: skip
        yield executor
    finally:
        client.close(timeout=CLOSING)
