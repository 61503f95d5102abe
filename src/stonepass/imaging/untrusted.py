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
from typing import Any

import numpy as np

from stonepass.errors import BadInput
from stonepass.imaging.limits import DECODED, MEMORY, PIXELS, SECONDS, check_file
from stonepass.imaging.picture import Area, Picture

__all__ = ["read_untrusted"]

TYPES = {"uint8": 1, "uint16": 2, "float64": 8}  # bytes of a number
LONGEST_HEADER = 65_536
LARGEST_BODY = DECODED + 1
START = 30.0  # s, for the libraries to load


def read_untrusted(path: Path, seconds: float = SECONDS, memory: int = MEMORY) -> Picture:
    """Read a picture as `readers.read_picture` does, in a child process that may be stopped.

    Parameters
    ----------
    path : Path
    seconds : float
        It may take, once the process and its libraries have started.
    memory : int
        Bytes of data it may use; not enforced on Windows.

    Raises
    ------
    BadInput
        What `read_picture` refuses, and files that take too long, need too much memory or make
        their decoder crash. What the child sends back is JSON and plain numbers, never a pickle.
    """
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
        with suppress(BrokenPipeError):  # then its end says why
            process.stdin.write(asked.encode() + b"\n")
            process.stdin.close()
        with _clock(process, START):
            process.stdout.readline()  # its libraries are loaded
        with _clock(process, seconds) as late:
            header = process.stdout.readline(LONGEST_HEADER)
            body = process.stdout.read(LARGEST_BODY)
            code = process.wait()
    if late.is_set():
        raise BadInput("image", path.name, f"readable in {seconds:g} s")
    if code != 0 or not header.endswith(b"\n"):
        how = f"signal {-code}" if code < 0 else f"exit {code}"
        allowed = f"readable within {memory // 1_000_000} MB and {seconds:g} s"
        raise BadInput("image", path.name, f"{allowed} (its reader ended with {how})")
    told = json.loads(header)
    if "refused" in told:
        raise BadInput(*told["refused"])
    return _picture(told, body)


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


def _picture(told: dict[str, Any], body: bytes) -> Picture:
    rows, columns = (int(each) for each in told["shape"])
    size = TYPES[told["type"]]
    assert rows * columns <= PIXELS, "as the child was told"
    assert len(body) == rows * columns * size, "as the child says"
    values = np.frombuffer(body, np.dtype(told["type"])).reshape(rows, columns)
    pixel = None if told["pixel"] is None else (float(told["pixel"][0]), float(told["pixel"][1]))
    area = Area(*(int(each) for each in told["area"]))
    notes = tuple(str(note) for note in told["notes"])
    return Picture(values, pixel, int(told["full_scale"]), area, notes)
