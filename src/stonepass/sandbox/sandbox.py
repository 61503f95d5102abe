"""Parsing of a file of unknown origin in a child process with limited memory and time.

A task is a module that calls `worker.serve`; the child process runs it with ``python -m``. To run a
parser in the sandbox, write such a module and pass its name to `parse_in_sandbox`. The sandbox
itself does not depend on the kind of file.
"""

from __future__ import annotations

import importlib.util
import json
import os
import signal
import subprocess
import sys
import threading
from collections.abc import Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from typing import Any

from pydantic import BaseModel, ConfigDict, ValidationError

from stonepass.errors import BadInput
from stonepass.sandbox.protocol import Refusal

__all__ = ["MEMORY", "SECONDS", "Limits", "parse_in_sandbox"]

SECONDS = 6.0  # default limit of the processor time in s
MEMORY = 1_000_000_000  # default limit of the data of the process in bytes, with its libraries
LONGEST_HEADER = 65_536  # largest size of a line of JSON in bytes
START = 30.0  # largest time in s for loading the libraries of the task
# Ratio of the limits of wall-clock time and processor time; it allows for a busy machine.
PATIENCE = 10.0
# Exit code of a process that has reached its limit of processor time; Windows has no such signal.
OUT_OF_TIME = (-signal.SIGXCPU,) if hasattr(signal, "SIGXCPU") else ()
LATE = "(reading it took longer)"
SIMPLER = "cut out the part that matters, or save it without compression"
BUSY = "try again when the machine is less busy, or cut out the part that matters"
LIMITS_PROCESSOR_TIME = importlib.util.find_spec("resource") is not None  # False on Windows


@dataclass(frozen=True)
class Limits:
    """Limits of the resources that a task may use.

    Attributes
    ----------
    seconds : float
        Processor time in s after the process and its libraries have started. The wall-clock time
        may be ten times as long. On Windows this is the limit of the wall-clock time.
    memory : int
        Data of the process in bytes; the limit is enforced on Linux.
    body : int
        Largest number of bytes that the task may send after its header.
    """

    seconds: float = SECONDS
    memory: int = MEMORY
    body: int = 0


class _Answer(BaseModel):
    """The line that a task sends back: an error, or the header of its result."""

    model_config = ConfigDict(extra="forbid")
    refused: Refusal | None = None
    header: dict[str, Any] | None = None


def parse_in_sandbox(
    task: str, request: Mapping[str, Any], limits: Limits, what: str, name: str
) -> tuple[dict[str, Any], bytes]:
    """Run a task in a child process and return the header and the body that it sends.

    Parameters
    ----------
    task : str
        Module to run, e.g. ``"stonepass.surface.worker"``; it calls `worker.serve`.
    request : mapping
        JSON-ready request to the task.
    limits : Limits
        Limits of time, memory and size of the result.
    what, name : str
        Kind and name of the file for messages, e.g. "image" and "crystals.tif".

    Returns
    -------
    header : dict
        JSON of the child process; the caller must check it against a schema.
    body : bytes
        Plain numbers, at most ``limits.body`` bytes.

    Raises
    ------
    BadInput
        The task refuses the file, parsing takes too long or needs too much memory, or the parser
        crashes.
    """
    patience = PATIENCE if LIMITS_PROCESSOR_TIME else 1.0
    asked = {"request": dict(request), "memory": limits.memory, "seconds": limits.seconds}
    # With -P nothing is imported from the current folder.
    command = [sys.executable, "-P", "-m", task]
    pipe = subprocess.PIPE
    with subprocess.Popen(
        command, stdin=pipe, stdout=pipe, stderr=subprocess.DEVNULL, env=_environment()
    ) as process:
        assert process.stdin is not None
        assert process.stdout is not None
        try:
            with suppress(BrokenPipeError):  # the exit code then gives the reason
                process.stdin.write(json.dumps(asked).encode() + b"\n")
                process.stdin.close()
            with _clock(process, START):
                process.stdout.readline(LONGEST_HEADER)  # the libraries have been loaded
            with _clock(process, limits.seconds * patience) as late:
                first = process.stdout.readline(LONGEST_HEADER)
                body = process.stdout.read(limits.body + 1)
                process.stdout.close()
                code = process.wait()
        finally:
            process.kill()
    if late.is_set():
        raise BadInput(what, name, f"read within {limits.seconds * patience:g} s {LATE}", BUSY)
    if code in OUT_OF_TIME:
        allowed = f"read within {limits.seconds:g} s of processor time {LATE}"
        raise BadInput(what, name, allowed, SIMPLER)
    allowed = f"readable within {limits.memory // 1_000_000} MB and {limits.seconds:g} s"
    if code != 0:
        how = f"signal {-code}" if code < 0 else f"exit {code}"
        raise BadInput(what, name, f"{allowed} (its reader ended with {how})", SIMPLER)
    try:
        answer = _Answer.model_validate_json(first)
    except (ValidationError, RecursionError) as problem:
        raise BadInput(what, name, f"{allowed} (its reader sent invalid data)") from problem
    if answer.refused is not None:
        raise BadInput(*answer.refused)
    if answer.header is None:
        raise BadInput(what, name, f"{allowed} (its reader sent invalid data)")
    return answer.header, body


@contextmanager
def _clock(process: subprocess.Popen[bytes], seconds: float) -> Iterator[threading.Event]:
    """Kill the process when the time is over; the event is set if that happened."""
    late = threading.Event()

    def stop() -> None:
        late.set()
        process.kill()

    timer = threading.Timer(seconds, stop)
    timer.start()
    try:
        yield late
    finally:
        timer.cancel()


def _environment() -> dict[str, str]:
    return os.environ | {
        "OPENBLAS_NUM_THREADS": "1",
        "OMP_NUM_THREADS": "1",
        "MPLBACKEND": "agg",
        "PYTHONDONTWRITEBYTECODE": "1",
    }
