"""Reader of surface images of unknown origin, in a process with limits of time and memory."""

from __future__ import annotations

from dataclasses import astuple
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from stonepass.errors import BadInput
from stonepass.sandbox.protocol import Text
from stonepass.sandbox.sandbox import MEMORY, SECONDS, Limits, parse_in_sandbox
from stonepass.surface.file_name import short_name
from stonepass.surface.limits import BODY, SIDE, check_file
from stonepass.surface.surface_image import PixelArea, SurfaceImage

__all__ = ["read_in_sandbox"]

TASK = "stonepass.surface.worker"
TYPES = {"uint8": 1, "uint16": 2, "float64": 8}  # bytes per value


def read_in_sandbox(
    path: str | Path,
    seconds: float = SECONDS,
    memory: int = MEMORY,
    area: PixelArea | None = None,
) -> SurfaceImage:
    """Read a picture in a child process with limits of time and memory.

    The result is that of `readers.read_surface_image`. The child process returns JSON and plain
    numbers, never a pickle, and both are checked.

    Parameters
    ----------
    path : str or Path
        A micrograph or a height map.
    seconds : float
        Processor time in s that reading may take after the process and its libraries have started.
    memory : int
        Largest amount of data of the process in bytes; it is enforced on Linux.
    area : PixelArea, optional
        The part of the picture that belongs to the surface, in pixels.

    Returns
    -------
    SurfaceImage

    Raises
    ------
    BadInput
        `read_surface_image` refuses the file, reading takes too long or too much memory, or the
        decoder crashes.

    References
    ----------
    docs/friction.md, "Which files it reads".
    """
    path = Path(path)
    check_file(path)
    limits = Limits(seconds, memory, body=BODY)
    request = {"path": str(path.resolve()), "area": None if area is None else astuple(area)}
    name = short_name(path)
    header, body = parse_in_sandbox(TASK, request, limits, "image", name)
    try:
        return _picture(header, body)
    except ValidationError as problem:
        allowed = f"readable within {memory // 1_000_000} MB and {seconds:g} s"
        raise BadInput("image", name, f"{allowed} (its reader sent invalid data)") from problem


def _picture(header: dict[str, Any], body: bytes) -> SurfaceImage:
    """Make the picture from the data of the child process, after checks of their consistency."""
    described = _Header.model_validate(header)
    rows, columns = described.shape
    if len(body) != rows * columns * TYPES[described.type]:
        raise BadInput("image", f"{len(body)} bytes", f"{rows} × {columns} values")
    values = np.frombuffer(body, np.dtype(described.type)).reshape(rows, columns)
    return SurfaceImage(
        values,
        described.pixel,
        described.full_scale,
        PixelArea(*described.area),
        described.pixel_source,
        described.notes,
        described.pixel_hint,
        None if described.grey is None else PixelArea(*described.grey),
    )


Side = Annotated[int, Field(ge=0, le=SIDE[1])]


class _Header(BaseModel):
    """The header that the child process sends before the values."""

    model_config = ConfigDict(extra="forbid")
    shape: tuple[Side, Side]
    type: Literal["uint8", "uint16", "float64"]
    pixel: tuple[float, float] | None = None
    full_scale: int = 255
    area: tuple[Side, Side, Side, Side] = (0, 0, 0, 0)
    pixel_source: Text = ""
    notes: Annotated[tuple[Text, ...], Field(max_length=10)] = ()
    pixel_hint: Text = ""
    grey: tuple[Side, Side, Side, Side] | None = None
