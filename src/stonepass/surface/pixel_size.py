"""The size of a pixel, as microscopes write it into their files.

Zeiss keeps two sizes: *Image Pixel Size* is of the picture as stored; *Pixel Size* is of the screen
and the same only where the picture is 1024 pixels wide. FEI gives *PixelWidth* and *PixelHeight* of
the scan, TESCAN *PixelSizeX* and *PixelSizeY*, in its own tag or in a text file beside the picture.
The resolution that every TIFF, PNG or JPEG may carry is of print, and is never taken.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from stonepass.errors import BadInput
from stonepass.units import length

__all__ = ["TESCAN_TAG", "Scan", "fei_scan", "tescan_scan", "tescan_text_beside", "zeiss_scan"]

TESCAN_TAG = 50431
SCREEN_WIDTH = 1024  # pixels, of the Zeiss screen
LARGEST_TEXT = 1_000_000  # bytes, of a text file beside a picture

# Width and height of a pixel in m, and rows under the picture that are no surface.
Scan = tuple[tuple[float, float], int]


def zeiss_scan(tags: Mapping[str, Any], columns: int) -> Scan | None:
    """Read the tags that tifffile gives as ``sem_metadata``."""
    stored = tags.get("dp_image_store")  # the resolution that the picture was stored with
    if isinstance(stored, tuple) and len(stored) >= 2:
        width = re.match(r"\s*(\d{1,6})\s*\*", str(stored[1]))
        if width and int(width.group(1)) != columns:
            return None  # it was made larger or smaller since
    names = ["ap_image_pixel_size", *(["ap_pixel_size"] if columns == SCREEN_WIDTH else [])]
    for name in names:
        entry = tags.get(name)
        if isinstance(entry, tuple) and len(entry) == 3:
            size = _metres(f"{entry[1]} {entry[2]}")
            if size is not None:
                return (size, size), 0
    return None


def fei_scan(tags: Mapping[str, Any], shape: tuple[int, int]) -> Scan | None:
    """Read the tags that tifffile gives as ``fei_metadata``, of a picture of rows and columns."""
    scan, image = (tags.get(name) for name in ("Scan", "Image"))
    if not isinstance(scan, Mapping) or not isinstance(image, Mapping):
        return None
    pixel = _pair(scan.get("PixelWidth"), scan.get("PixelHeight"))
    across, down = image.get("ResolutionX"), image.get("ResolutionY")
    rows, columns = shape
    # Of another size than it was scanned with, its pixels are of another size too.
    if pixel is None or across != columns or not isinstance(down, int) or not 0 < down <= rows:
        return None
    return pixel, rows - down


def tescan_scan(text: str) -> Scan | None:
    """Read the lines ``PixelSizeX=…``, ``PixelSizeY=…`` and ``ImageStripSize=…``."""
    found = {
        name: match.group(1)
        for name in ("PixelSizeX", "PixelSizeY", "ImageStripSize", "ViewFieldsCountX")
        if (match := re.search(rf"^{name}[ \t]*=[ \t]*([-+.\deE]{{1,40}})[ \t]*\r?$", text, re.M))
    }
    pixel = _pair(found.get("PixelSizeX"), found.get("PixelSizeY"))
    side_by_side = found.get("ViewFieldsCountX", "1") != "1"  # pictures of several detectors
    if pixel is None or side_by_side:
        return None
    strip = found.get("ImageStripSize", "0")
    return pixel, int(strip) if strip.isdecimal() else 0


def tescan_text_beside(path: Path) -> str | None:
    """Text of the file that TESCAN writes beside a picture, ``NAME.hdr`` or ``NAME-tif.hdr``."""
    ending = path.suffix.lstrip(".")
    for beside in (path.with_suffix(".hdr"), path.with_name(f"{path.stem}-{ending}.hdr")):
        if beside.is_file() and beside.stat().st_size <= LARGEST_TEXT:
            return beside.read_text(encoding="latin-1")
    return None


def _metres(text: str) -> float | None:
    try:
        return _positive(float(length(text)))
    except BadInput:
        return None


def _pair(width: Any, height: Any) -> tuple[float, float] | None:
    """Two numbers in m; the height is the width where it is missing."""
    across = _positive(width)
    down = across if height is None else _positive(height)
    return None if across is None or down is None else (across, down)


def _positive(value: Any) -> float | None:
    try:
        number = float(value)
    except (TypeError, ValueError):
        return None
    return number if math.isfinite(number) and number > 0.0 else None
