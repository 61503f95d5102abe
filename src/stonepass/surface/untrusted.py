"""A surface image of unknown origin, read in a process with limits of time and memory."""

from __future__ import annotations

from dataclasses import astuple
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from stonepass.errors import BadInput
from stonepass.sandbox.protocol import Text
from stonepass.sandbox.sandbox import MEMORY, SECONDS, Limits, parse_in_child
from stonepass.surface.file_name import short_name
from stonepass.surface.limits import BODY, SIDE, check_file
from stonepass.surface.surface_image import Area, SurfaceImage

__all__ = ["read_untrusted"]

TASK = "stonepass.surface.worker"
TYPES = {"uint8": 1, "uint16": 2, "float64": 8}  # bytes of a number


def read_untrusted(
    path: str | Path,
    seconds: float = SECONDS,
    memory: int = MEMORY,
    area: Area | None = None,
) -> SurfaceImage:
    """Read a picture as `readers.read_surface_image` does, in a child process that may be stopped.

    Parameters
    ----------
    path : Path
    seconds : float
        Time that reading may take, once the process and its libraries have started.
    memory : int
        Bytes of data it may use; enforced on Linux.
    area : Area, optional
        The part that is surface, as in `read_surface_image`.

    Raises
    ------
    BadInput
        What `read_surface_image` refuses, and files that take too long, need too much memory or
        make their decoder crash. What the child sends back is JSON and plain numbers, never a
        pickle.
    """
    path = Path(path)
    check_file(path)
    limits = Limits(seconds, memory, body=BODY)
    request = {"path": str(path.resolve()), "area": None if area is None else astuple(area)}
    name = short_name(path)
    header, body = parse_in_child(TASK, request, limits, "image", name)
    try:
        return _picture(header, body)
    except ValidationError as problem:
        allowed = f"readable within {memory // 1_000_000} MB and {seconds:g} s"
        raise BadInput("image", name, f"{allowed} (its reader made no sense)") from problem


def _picture(header: dict[str, Any], body: bytes) -> SurfaceImage:
    """The picture that the child describes, believed only as far as it fits together."""
    described = _Header.model_validate(header)
    rows, columns = described.shape
    if len(body) != rows * columns * TYPES[described.type]:
        raise BadInput("image", f"{len(body)} bytes", f"{rows} × {columns} numbers")
    values = np.frombuffer(body, np.dtype(described.type)).reshape(rows, columns)
    return SurfaceImage(
        values,
        described.pixel,
        described.full_scale,
        Area(*described.area),
        described.pixel_source,
        described.notes,
        described.pixel_hint,
        None if described.grey is None else Area(*described.grey),
    )


Side = Annotated[int, Field(ge=0, le=SIDE[1])]


class _Header(BaseModel):
    """What the child writes before the numbers; `SurfaceImage` checks the rest."""

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
