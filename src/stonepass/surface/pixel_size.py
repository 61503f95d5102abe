"""The size of a pixel, as microscopes and microscopists' software write it into their files.

Zeiss keeps two sizes: *Image Pixel Size* is of the picture as stored; *Pixel Size* is of the screen
and the same only where the picture is 1024 pixels wide. FEI gives *PixelWidth* and *PixelHeight* of
the scan, TESCAN *PixelSizeX* and *PixelSizeY*. ImageJ writes a unit and pixels per unit, OME-TIFF
*PhysicalSizeX*. JEOL and Hitachi write a text file beside the picture: the length of the micron
bar, in pixels and in µm, or *PixelSize* in nm.

The resolution that every TIFF, PNG or JPEG may carry is of print, and is never taken.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from html import unescape
from typing import Any

from stonepass.errors import BadInput
from stonepass.surface.scan import Pixel, Scan
from stonepass.units import length

__all__ = [
    "TESCAN_TAG",
    "fei_scan",
    "hitachi_scan",
    "imagej_scan",
    "jeol_scan",
    "ome_scan",
    "tescan_scan",
    "zeiss_scan",
]

TESCAN_TAG = 50431
SCREEN_WIDTH = 1024  # pixels, of the Zeiss screen
NANO, MICRO = 1e-9, 1e-6  # m
MICROMETRES = ("um", "micron", "microns", "micrometer", "micrometre", "\\u00b5m", "\\u03bcm")
PRINT_UNITS = ("inch", "inches", "in", "cm")  # what ImageJ makes of a resolution for print


def zeiss_scan(tags: Mapping[str, Any]) -> Scan:
    """Read the tags that tifffile gives as ``sem_metadata``."""
    stored = tags.get("dp_image_store")  # the resolution that the picture was stored with
    width = None
    if isinstance(stored, tuple) and len(stored) >= 2:
        found = re.match(r"\s*(\d{1,6})\s*\*", str(stored[1]))
        width = int(found.group(1)) if found else None
    for name, columns in (("ap_image_pixel_size", width), ("ap_pixel_size", SCREEN_WIDTH)):
        entry = tags.get(name)
        if isinstance(entry, tuple) and len(entry) == 3:
            size = _metres(f"{entry[1]} {entry[2]}")
            if size is not None:
                return Scan("Zeiss tag", (size, size), columns)
    return Scan("Zeiss tag")


def fei_scan(tags: Mapping[str, Any]) -> Scan:
    """Read the tags that tifffile gives as ``fei_metadata``."""
    scan, image = (tags.get(name) for name in ("Scan", "Image"))
    scan, image = (part if isinstance(part, Mapping) else {} for part in (scan, image))
    pixel = _pair(scan.get("PixelWidth"), scan.get("PixelHeight"))
    columns, rows = (_count(image.get(name)) for name in ("ResolutionX", "ResolutionY"))
    if columns is None or rows is None:  # whether it was resized is not known
        return Scan("FEI tag")
    return Scan("FEI tag", pixel, columns, rows)


def tescan_scan(text: str, source: str = "TESCAN tag") -> Scan:
    """Read the lines ``PixelSizeX=…``, ``PixelSizeY=…`` and ``ImageStripSize=…``."""
    names = ("PixelSizeX", "PixelSizeY", "ImageStripSize", "ViewFieldsCountX")
    found = _assignments(text, names)
    if found.get("ViewFieldsCountX", "1") != "1":  # pictures of several detectors, side by side
        return Scan(source)
    pixel = _pair(found.get("PixelSizeX"), found.get("PixelSizeY"))
    return Scan(source, pixel, bar=_count(found.get("ImageStripSize")) or 0)


def jeol_scan(text: str) -> Scan:
    """Read the lines ``$CM_FULL_SIZE``, ``$$SM_MICRON_BAR`` and ``$$SM_MICRON_MARKER``."""
    source = "JEOL text file"
    found = dict(re.findall(r"^[ \t]*\$+([A-Z_]{1,40})[ \t]+([^\r\n]{1,80})", text, re.M))
    size = re.match(r"(\d{1,6})[ \t,x]+(\d{1,6})\s*$", found.get("CM_FULL_SIZE", ""))
    columns, rows = (int(size.group(1)), int(size.group(2))) if size else (None, None)
    bar, marker = _positive(found.get("SM_MICRON_BAR")), found.get("SM_MICRON_MARKER", "")
    long = _metres(marker.strip())
    if bar is None or long is None:
        return Scan(source, None, columns, rows)
    return Scan(source, (long / bar, long / bar), columns, rows)


def hitachi_scan(text: str) -> Scan:
    """Read the lines ``PixelSize=…`` (nm) and ``DataSize=…x…`` below ``[SemImageFile]``."""
    found = _assignments(text, ("PixelSize",))
    size = re.search(r"^[ \t]*DataSize[ \t]*=[ \t]*(\d{1,6})[ \t]*[x*][ \t]*\d", text, re.M)
    nanometres = _positive(found.get("PixelSize"))
    pixel = None if nanometres is None else (nanometres * NANO, nanometres * NANO)
    return Scan("Hitachi text file", pixel, int(size.group(1)) if size else None)


def imagej_scan(tags: Mapping[str, Any], per_unit: tuple[Any, Any]) -> Scan:
    """Read the unit of ImageJ's description and the pixels per unit of the resolution tags.

    Parameters
    ----------
    tags : mapping
        The metadata that tifffile gives as ``imagej_metadata``.
    per_unit : tuple
        Values of *XResolution* and *YResolution*, each a number or a fraction of two integers.
    """
    source = "ImageJ description"
    unit = str(tags.get("unit", "")).strip().lower().replace("µ", "u").replace("μ", "u")
    across, down = (_ratio(each) for each in per_unit)
    if across is None or unit in ("", "pixel", "pixels"):
        return Scan(source)
    if unit in PRINT_UNITS:
        return Scan(source, doubt=f"the {source} gives the size of a pixel in {unit}, as for print")
    metre = MICRO if unit in MICROMETRES else _metres(f"1 {unit}")
    if metre is None:
        return Scan(source)
    return Scan(source, (metre / across, metre / (across if down is None else down)))


def ome_scan(text: str) -> Scan:
    """Read *PhysicalSizeX* and *PhysicalSizeY* of the first *Pixels* element of OME-XML."""
    source = "OME description"
    element = re.search(r"<(?:\w{1,20}:)?Pixels\s([^>]{1,5000})>", text)
    if element is None:
        return Scan(source)
    attributes = re.findall(r"\b(\w{1,40})\s*=\s*[\"']([^\"']{0,100})[\"']", element.group(1))
    found = {name: unescape(value) for name, value in attributes}
    sides = [
        _metres(f"{found.get(name, '')} {found.get(name + 'Unit', 'um')}".replace("µ", "u"))
        for name in ("PhysicalSizeX", "PhysicalSizeY")
    ]
    across, down = sides
    pixel: Pixel | None = None if across is None else (across, across if down is None else down)
    return Scan(source, pixel, _count(found.get("SizeX")))


def _assignments(text: str, names: tuple[str, ...]) -> dict[str, str]:
    """Numbers of the lines ``name=number``."""
    return {
        name: match.group(1)
        for name in names
        if (match := re.search(rf"^{name}[ \t]*=[ \t]*([-+.\deE]{{1,40}})[ \t]*\r?$", text, re.M))
    }


def _metres(text: str) -> float | None:
    try:
        return _positive(float(length(text)))
    except BadInput:
        return None


def _pair(width: Any, height: Any) -> Pixel | None:
    """Two numbers in m; the height is the width where it is missing."""
    across = _positive(width)
    down = across if height is None else _positive(height)
    return None if across is None or down is None else (across, down)


def _ratio(value: Any) -> float | None:
    """A number, or a fraction of two."""
    if isinstance(value, tuple) and len(value) == 2:
        above, below = (_positive(each) for each in value)
        return None if above is None or below is None else above / below
    return _positive(value)


def _count(value: Any) -> int | None:
    """A positive whole number of at most six digits."""
    text = str(value)
    return int(text) if text.isdecimal() and len(text) <= 6 and int(text) > 0 else None


def _positive(value: Any) -> float | None:
    try:
        number = float(value)
    except (TypeError, ValueError, OverflowError):
        return None
    return number if math.isfinite(number) and number > 0.0 else None
