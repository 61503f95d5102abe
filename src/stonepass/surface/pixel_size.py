"""Readers of the pixel size that microscopes and image software write into their files.

Zeiss writes two sizes: *Image Pixel Size* applies to the stored picture, *Pixel Size* to the
screen. Both agree only for a picture that is 1024 pixels wide. FEI writes *PixelWidth* and
*PixelHeight* of the scan, TESCAN *PixelSizeX* and *PixelSizeY*. ImageJ writes a unit and the pixels
per unit, OME-TIFF *PhysicalSizeX*. JEOL and Hitachi write a text file next to the picture, with the
length of the micron bar in pixels and in µm, or with *PixelSize* in nm.

Any TIFF, PNG or JPEG file may also contain a resolution for printing. It is never used, since it
does not describe the specimen.
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
SCREEN_WIDTH = 1024  # width of the Zeiss screen in pixels
NANO, MICRO = 1e-9, 1e-6  # m
MICROMETRES = ("um", "micron", "microns", "micrometer", "micrometre", "\\u00b5m", "\\u03bcm")
PRINT_UNITS = ("inch", "inches", "in", "cm")  # units that ImageJ derives from a print resolution


def zeiss_scan(tags: Mapping[str, Any]) -> Scan:
    """Read the scan from the Zeiss tags, which tifffile returns as ``sem_metadata``."""
    stored = tags.get("dp_image_store")  # size of the stored picture, e.g. "1024 * 768"
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
    """Read the scan from the FEI tags, which tifffile returns as ``fei_metadata``."""
    scan, image = (tags.get(name) for name in ("Scan", "Image"))
    scan, image = (part if isinstance(part, Mapping) else {} for part in (scan, image))
    pixel = _pair(scan.get("PixelWidth"), scan.get("PixelHeight"))
    columns, rows = (_count(image.get(name)) for name in ("ResolutionX", "ResolutionY"))
    if columns is None or rows is None:  # it is unknown whether the picture was resized
        return Scan("FEI tag")
    return Scan("FEI tag", pixel, columns, rows)


def tescan_scan(text: str, source: str = "TESCAN tag") -> Scan:
    """Read the scan from a TESCAN text.

    Parameters
    ----------
    text : str
        Text with the lines ``PixelSizeX=…``, ``PixelSizeY=…`` (in m) and ``ImageStripSize=…`` (the
        height of the data bar in pixels).
    source : str
        Where the text comes from, for messages.
    """
    names = ("PixelSizeX", "PixelSizeY", "ImageStripSize", "ViewFieldsCountX")
    found = _assignments(text, names)
    if found.get("ViewFieldsCountX", "1") != "1":  # images of several detectors side by side
        return Scan(source)
    pixel = _pair(found.get("PixelSizeX"), found.get("PixelSizeY"))
    return Scan(source, pixel, bar=_count(found.get("ImageStripSize")) or 0)


def jeol_scan(text: str) -> Scan:
    """Read the scan from a JEOL text file.

    It has the lines ``$CM_FULL_SIZE`` (size in pixels), ``$$SM_MICRON_BAR`` (length of the bar in
    pixels) and ``$$SM_MICRON_MARKER`` (length of the bar with a unit).
    """
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
    """Read the scan from a Hitachi text file.

    It has the lines ``PixelSize=…`` (in nm) and ``DataSize=…x…`` (in pixels) below
    ``[SemImageFile]``.
    """
    found = _assignments(text, ("PixelSize",))
    size = re.search(r"^[ \t]*DataSize[ \t]*=[ \t]*(\d{1,6})[ \t]*[x*][ \t]*\d", text, re.M)
    nanometres = _positive(found.get("PixelSize"))
    pixel = None if nanometres is None else (nanometres * NANO, nanometres * NANO)
    return Scan("Hitachi text file", pixel, int(size.group(1)) if size else None)


def imagej_scan(tags: Mapping[str, Any], per_unit: tuple[Any, Any]) -> Scan:
    """Read the scan from a TIFF file of ImageJ.

    Parameters
    ----------
    tags : mapping
        The metadata that tifffile returns as ``imagej_metadata``; ``unit`` is the unit of length.
    per_unit : tuple
        Pixels per unit across and down, from the tags *XResolution* and *YResolution*. Each is a
        number or a fraction of two integers.
    """
    source = "ImageJ description"
    unit = str(tags.get("unit", "")).strip().lower().replace("µ", "u").replace("μ", "u")
    across, down = (_ratio(each) for each in per_unit)
    if across is None or unit in ("", "pixel", "pixels"):
        return Scan(source)
    if unit in PRINT_UNITS:
        return Scan(source, doubt=f"the {source} gives it in {unit}, a unit of print resolutions")
    metre = MICRO if unit in MICROMETRES else _metres(f"1 {unit}")
    if metre is None:
        return Scan(source)
    return Scan(source, (metre / across, metre / (across if down is None else down)))


def ome_scan(text: str) -> Scan:
    """Read the scan from *PhysicalSizeX* and *PhysicalSizeY* of the first *Pixels* of OME-XML."""
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
    """Return the numbers, as text, of the lines ``name=number``."""
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
    """Return width and height in m; a missing height is equal to the width."""
    across = _positive(width)
    down = across if height is None else _positive(height)
    return None if across is None or down is None else (across, down)


def _ratio(value: Any) -> float | None:
    """Return a positive number that is given as a number or as a fraction (a, b)."""
    if isinstance(value, tuple) and len(value) == 2:
        above, below = (_positive(each) for each in value)
        return None if above is None or below is None else above / below
    return _positive(value)


def _count(value: Any) -> int | None:
    """Return a positive whole number of at most six digits, or None."""
    text = str(value)
    return int(text) if text.isdecimal() and len(text) <= 6 and int(text) > 0 else None


def _positive(value: Any) -> float | None:
    try:
        number = float(value)
    except (TypeError, ValueError, OverflowError):
        return None
    return number if math.isfinite(number) and number > 0.0 else None
