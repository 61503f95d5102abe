"""A file of unknown origin, read in a process of its own with limits of time and memory."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Annotated, Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from stonepass.errors import BadInput
from stonepass.imaging.limits import DECODED, MEMORY, SECONDS, SIDE, check_file
from stonepass.imaging.picture import Area, Picture

__all__ = ["read_untrusted"]

TYPES = {"uint8": 1, "uint16": 2, "float64": 8}  # bytes of a number
LONGEST_HEADER = 65_536
LARGEST_BODY = DECODED + 1
START = 30.0  # s, for the libraries to load


def read_untrusted(path: str | Path, seconds: float = SECONDS, memory: int = MEMORY) -> Picture:
    """Read a picture as `readers.read_picture` does, in a child process that may be stopped.

    Parameters
    ----------
    path : Path
    seconds : float
        It may take, once the process and its libraries have started.
    memory : int
        Bytes of data it may use; enforced on Linux.

    Raises
    ------
    BadInput
        What `read_picture` refuses, and files that take too long, need too much memory or make
        their decoder crash. What the child sends back is JSON and plain numbers, never a pickle.
    """
    path = Path(path)
    check_file(path)
    asked = json.dumps({"path": str(path.resolve()), "memory": memory, "seconds": seconds})
    # -P: nothing is imported from the folder that this runs in.
    command = [sys.executable, "-P", "-m", "stonepass.imaging.child"]
    pipe = subprocess.PIPE
    with subprocess.Popen(
        command, stdin=pipe, stdout=pipe, stderr=subprocess.DEVNULL, env=_environment()
    ) as process:
        assert process.stdin is not None
        assert process.stdout is not None
        try:
            with suppress(BrokenPipeError):  # then its end says why
                process.stdin.write(asked.encode() + b"\n")
                process.stdin.close()
            with _clock(process, START):
                process.stdout.readline(LONGEST_HEADER)  # its libraries are loaded
            with _clock(process, seconds) as late:
                header = process.stdout.readline(LONGEST_HEADER)
                body = process.stdout.read(LARGEST_BODY)
                process.stdout.close()
                code = process.wait()
        finally:
            process.kill()
    if late.is_set():
        raise BadInput("image", path.name, f"readable in {seconds:g} s")
    allowed = f"readable within {memory // 1_000_000} MB and {seconds:g} s"
    if code != 0:
        how = f"signal {-code}" if code < 0 else f"exit {code}"
        raise BadInput("image", path.name, f"{allowed} (its reader ended with {how})")
    try:
        return _picture(header, body)
    except (ValidationError, RecursionError) as problem:
        raise BadInput("image", path.name, f"{allowed} (its reader made no sense)") from problem


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


def _picture(header: bytes, body: bytes) -> Picture:
    """What the child tells of, believed only as far as it fits together."""
    told = _Told.model_validate_json(header)
    if told.refused is not None:
        raise BadInput(*told.refused)
    rows, columns = told.shape
    if len(body) != rows * columns * TYPES[told.type]:
        raise BadInput("image", f"{len(body)} bytes", f"{rows} × {columns} numbers")
    values = np.frombuffer(body, np.dtype(told.type)).reshape(rows, columns)
    return Picture(
        values, told.pixel, told.full_scale, Area(*told.area), told.pixel_source, told.notes
    )


Side = Annotated[int, Field(ge=0, le=SIDE[1])]
Text = Annotated[str, Field(max_length=500)]


class _Told(BaseModel):
    """The line that the child writes before the numbers; `Picture` checks the rest."""

    model_config = ConfigDict(extra="forbid")
    refused: tuple[Text, Text, Text, Text] | None = None
    shape: tuple[Side, Side] = (0, 0)
    type: Literal["uint8", "uint16", "float64"] = "uint8"
    pixel: tuple[float, float] | None = None
    full_scale: int = 255
    area: tuple[Side, Side, Side, Side] = (0, 0, 0, 0)
    pixel_source: Text = ""
    notes: Annotated[tuple[Text, ...], Field(max_length=10)] = ()
