"""A worker process seen from the server: it is started when needed, and killed when it must end."""

from __future__ import annotations

import asyncio
import json
import os
import signal
import sys
from asyncio.subprocess import DEVNULL, PIPE, Process
from collections.abc import Callable, Mapping
from contextlib import suppress
from typing import Any

__all__ = ["WorkerEnded", "WorkerProcess"]

COMMAND = (sys.executable, "-P", "-m", "stonepass.web.jobs.worker")  # -P: nothing of this folder
GRACE = 1.0  # time in s that a process has to end after it has closed its output
LONGEST = 2**26  # bytes of a message
ONE_THREAD = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")


class WorkerEnded(Exception):
    """The process ended before it had an answer.

    Attributes
    ----------
    code : int or None
        The exit code; minus the number of the signal that ended the process.
    """

    def __init__(self, code: int | None) -> None:
        super().__init__(code)
        self.code = code

    @property
    def how(self) -> str:
        """The exit code or the signal, in words."""
        if self.code is not None and self.code < 0:
            return f"signal {-self.code}"
        return f"exit code {self.code}"

    @property
    def lacked_memory(self) -> bool:
        """True if the process ended itself.

        It catches all errors but those that it lacks the memory to tell. OpenBLAS ends a process
        with the exit code 1 if it gets no memory.
        """
        return self.code == 1


class WorkerProcess:
    """One worker process, which is replaced by a new one after it has ended.

    The process gets no secret of the server, neither in its arguments nor in its environment.
    """

    def __init__(self) -> None:
        self._process: Process | None = None

    @property
    def pid(self) -> int | None:
        """Number of the running process, or None."""
        running = self._process is not None and self._process.returncode is None
        return self._process.pid if running and self._process is not None else None

    async def run(
        self, request: Mapping[str, Any], tell: Callable[[dict[str, Any]], None]
    ) -> dict[str, Any]:
        """Send a request and return the last message about it.

        Parameters
        ----------
        request : mapping
            JSON-ready request, see `worker`.
        tell : callable
            Receives the progress.

        Raises
        ------
        WorkerEnded
            The process ended during the job.
        """
        process = await self._started()
        assert process.stdin is not None
        assert process.stdout is not None
        try:
            process.stdin.write(json.dumps(request).encode() + b"\n")
            await process.stdin.drain()
            while line := await process.stdout.readline():
                message: dict[str, Any] = json.loads(line)
                if "progress" not in message:
                    return message
                tell(message["progress"])
        except (ConnectionError, ValueError):  # the pipe is closed, or a message is cut off
            pass
        with suppress(TimeoutError):  # the exit code says why
            await asyncio.wait_for(process.wait(), GRACE)
        await self.end()
        raise WorkerEnded(process.returncode)

    async def end(self) -> None:
        """Kill the process and all processes that it has started."""
        process, self._process = self._process, None
        if process is None:
            return
        with suppress(ProcessLookupError):
            if hasattr(os, "killpg"):
                os.killpg(process.pid, signal.SIGKILL)
            else:  # Windows
                process.kill()
        await process.wait()

    async def _started(self) -> Process:
        if self.pid is None:
            await self.end()
            self._process = await asyncio.create_subprocess_exec(
                *COMMAND,
                stdin=PIPE,
                stdout=PIPE,
                stderr=DEVNULL,
                env=_environment(),
                limit=LONGEST,
                start_new_session=True,  # Ctrl-C in the terminal of the server does not reach it
            )
        assert self._process is not None
        return self._process


def _environment() -> dict[str, str]:
    kept = {key: value for key, value in os.environ.items() if key != "STONEPASS_TOKEN"}
    return kept | dict.fromkeys(ONE_THREAD, "1") | {"MPLBACKEND": "agg"}
