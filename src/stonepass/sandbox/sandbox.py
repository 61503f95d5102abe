"""Parsing of a file of unknown origin in a child process with limited memory and time.

A task is a module that `python -m` runs and that calls `worker.serve`. Whoever needs a parser
contained writes such a module and names it here; the sandbox knows nothing of what is parsed.
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

__all__ = ["MEMORY", "SECONDS", "Limits", "parse_in_child"]

SECONDS = 6.0  # of processor time that reading a file may take
MEMORY = 1_000_000_000  # bytes of data that the process may use, its libraries included
LONGEST_HEADER = 65_536  # bytes
START = 30.0  # s that the libraries of the task may take to load
# Wall-clock time over the allowed processor time: a busy machine is no fault of the file.
PATIENCE = 10.0
# Exit code of a process that has spent its processor time; Windows has no such signal.
OUT_OF_TIME = (-signal.SIGXCPU,) if hasattr(signal, "SIGXCPU") else ()
SIMPLER = "cut out the part that matters, or save it without compression"
BUSY = "try again when the machine is less busy, or cut out the part that matters"
LIMITS_PROCESSOR_TIME = importlib.util.find_spec("resource") is not None  # not on Windows


@dataclass(frozen=True)
class Limits:
    """What a task may cost.

    Attributes
    ----------
    seconds : float
        Processor time in s, once the process and its libraries have started. Ten times as much may
        pass on the clock. Where the system has no limit of processor time the clock alone counts.
    memory : int
        Bytes of data, enforced on Linux.
    body : int
        Bytes that the task may send after its header.
    """

    seconds: float = SECONDS
    memory: int = MEMORY
    body: int = 0


class _Answer(BaseModel):
    """The first line that a task sends back: a refusal, or the task's own header."""

    model_config = ConfigDict(extra="forbid")
    refused: Refusal | None = None
    header: dict[str, Any] | None = None


def parse_in_child(
    task: str, request: Mapping[str, Any], limits: Limits, what: str, name: str
) -> tuple[dict[str, Any], bytes]:
    """Run a task in a child process and return the header and the body that it sends.

    Parameters
    ----------
    task : str
        Module to run, e.g. ``"stonepass.surface.worker"``; it calls `worker.serve`.
    request : mapping
        What the task is asked, JSON-ready.
    limits : Limits
    what, name : str
        Kind and name of the file, for refusals, e.g. "image" and "crystals.tif".

    Returns
    -------
    header : dict
        JSON from the child; the caller must check it against a schema before it is used.
    body : bytes
        Plain numbers, at most ``limits.body`` bytes.

    Raises
    ------
    BadInput
        What the task itself refuses, and files that take too long, need too much memory or make
        their parser crash.
    """
    patience = PATIENCE if LIMITS_PROCESSOR_TIME else 1.0
    asked = {"request": dict(request), "memory": limits.memory, "seconds": limits.seconds}
    # -P: nothing is imported from the folder that this runs in.
    command = [sys.executable, "-P", "-m", task]
    pipe = subprocess.PIPE
    with subprocess.Popen(
        command, stdin=pipe, stdout=pipe, stderr=subprocess.DEVNULL, env=_environment()
    ) as process:
        assert process.stdin is not None
        assert process.stdout is not None
        try:
            with suppress(BrokenPipeError):  # the exit code then says why
                process.stdin.write(json.dumps(asked).encode() + b"\n")
                process.stdin.close()
            with _clock(process, START):
                process.stdout.readline(LONGEST_HEADER)  # its libraries are loaded
            with _clock(process, limits.seconds * patience) as late:
                first = process.stdout.readline(LONGEST_HEADER)
                body = process.stdout.read(limits.body + 1)
                process.stdout.close()
                code = process.wait()
        finally:
            process.kill()
    if late.is_set():
        raise BadInput(what, name, f"readable in {limits.seconds * patience:g} s", BUSY)
    if code in OUT_OF_TIME:
        allowed = f"readable in {limits.seconds:g} s of processor time"
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
    """Kill the process after some seconds; the event says whether that was so."""
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
