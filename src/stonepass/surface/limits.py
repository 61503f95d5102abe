"""Limits on the size of pictures and height maps, checked from the header before decoding."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from stonepass.errors import BadInput
from stonepass.surface.file_name import short_name

__all__ = [
    "BODY",
    "DECODED",
    "MEMORY_REMEDY",
    "SIDE",
    "check_file",
    "check_points",
    "check_size",
    "check_unpacked",
    "too_large",
]

FILE = 200_000_000  # largest file in bytes
PIXELS = 40_000_000  # largest number of pixels of a picture
DECODED = 90_000_000  # largest size in bytes of all samples of a picture, or of an unpacked archive
POINTS = 20_000_000  # largest number of points of a height map, eight bytes each
BODY = max(DECODED, 8 * POINTS)  # largest size in bytes of the values that reading returns
SIDE = (16, 20_000)  # smallest and largest number of pixels along a side
SMALLER = "cut out the part that matters"
MEMORY_REMEDY = "cut out the part that matters, or save it in a simpler format"


def check_file(path: Path) -> None:
    """Refuse a path that is not a file, and a file that is empty or larger than 200 MB.

    Raises
    ------
    BadInput
        The file does not exist, is empty or is too large.
    """
    if not path.is_file():
        raise BadInput("image", str(path), "a file that exists", "check the path")
    size = path.stat().st_size
    if not 0 < size <= FILE:
        shown = f"{short_name(path)} of {size / 1e6:.3g} MB"
        raise BadInput("image", shown, f"of at most {FILE // 1_000_000} MB and not empty")


def check_size(name: str, shape: Sequence[int], sample_bytes: int) -> None:
    """Refuse a picture that is too large to decode, or too small.

    Parameters
    ----------
    name : str
        Name of the file, for the message.
    shape : sequence of int
        Numbers of rows, columns and, optionally, samples per pixel.
    sample_bytes : int
        Size of a sample in bytes.

    Raises
    ------
    BadInput
        The picture has more than 40 million pixels or 90 MB, or a side outside 16 to 20000 pixels.
    """
    rows, columns = (int(each) for each in shape[:2])
    samples = 1
    for each in shape[2:]:
        samples *= int(each)
    what = f"{name} of {columns} × {rows} pixels"
    large = rows * columns > PIXELS or rows * columns * samples * sample_bytes > DECODED
    _check_sides(what, rows, columns, large)
    if large:
        raise too_large(what)


def check_points(name: str, rows: int, columns: int) -> None:
    """Refuse a height map that is too large to read, or too small.

    Parameters
    ----------
    name : str
        Name of the file, for the message.
    rows, columns : int
        Numbers of points.

    Raises
    ------
    BadInput
        The map has more than 20 million points, or a side outside 16 to 20000 points.
    """
    what = f"{name} of {columns} × {rows} points"
    large = rows * columns > POINTS
    _check_sides(what, rows, columns, large)
    if large:
        allowed = f"a height map of at most {POINTS // 1_000_000} million points"
        raise BadInput("image", what, allowed, SMALLER)


def _check_sides(what: str, rows: int, columns: int, large: bool) -> None:
    low, high = SIDE
    if min(rows, columns) < low:
        raise BadInput("image", what, f"at least {low} × {low}")
    if not large and max(rows, columns) > high:
        raise BadInput("image", what, f"at most {high} pixels long", SMALLER)


def check_unpacked(name: str, size: int) -> None:
    """Refuse an archive that its directory states to be larger than 90 MB when unpacked.

    Parameters
    ----------
    name : str
        Name of the file, for the message.
    size : int
        Unpacked size of all members in bytes.

    Raises
    ------
    BadInput
        The size exceeds 90 MB.
    """
    if size > DECODED:
        allowed = f"of at most {DECODED // 1_000_000} MB unpacked"
        raise BadInput("image", f"{name} of {size / 1e6:.3g} MB unpacked", allowed, SMALLER)


def too_large(what: str) -> BadInput:
    """Return the error for a picture that is too large to decode; `what` describes the picture."""
    allowed = f"of at most {PIXELS // 1_000_000} million pixels and {DECODED // 1_000_000} MB"
    return BadInput("image", what, allowed, SMALLER)
