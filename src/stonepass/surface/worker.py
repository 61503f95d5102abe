"""The module that the sandbox runs in a child process to read a surface image."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import astuple
from pathlib import Path
from typing import Any

from stonepass.sandbox.worker import serve
from stonepass.surface.readers import load_libraries, read_surface_image
from stonepass.surface.surface_image import PixelArea

__all__ = ["parse"]


def parse(request: Mapping[str, Any]) -> tuple[dict[str, Any], memoryview]:
    """Read the picture of a request and return its header and its values."""
    asked = request.get("area")
    picture = read_surface_image(
        Path(request["path"]), None if asked is None else PixelArea(*asked)
    )
    header = {
        "shape": picture.values.shape,
        "type": picture.values.dtype.name,
        "pixel": picture.pixel,
        "full_scale": picture.full_scale,
        "area": astuple(picture.area),
        "pixel_source": picture.pixel_source,
        "notes": picture.notes,
        "pixel_hint": picture.pixel_hint,
        "grey": None if picture.grey is None else astuple(picture.grey),
    }
    return header, picture.values.data


if __name__ == "__main__":
    raise SystemExit(serve(lambda request: load_libraries(Path(request["path"])), parse))
