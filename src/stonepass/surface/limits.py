"""What a picture may cost: checked from its header, before a pixel is decoded."""

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

FILE = 200_000_000  # bytes
PIXELS = 40_000_000
DECODED = 90_000_000  # bytes, of all samples of all pixels
POINTS = 20_000_000  # of a height map, eight bytes each
BODY = max(DECODED, 8 * POINTS)  # bytes of the numbers that reading may return
SIDE = (16, 20_000)  # pixels
SMALLER = "cut out the part that matters"
MEMORY_REMEDY = "cut out the part that matters, or save it in a simpler format"


def check_file(path: Path) -> None:
    """Refuse what is no file, empty, or larger than 200 MB."""
    if not path.is_file():
        raise BadInput("image", str(path), "a file that exists", "check the path")
    size = path.stat().st_size
    if not 0 < size <= FILE:
        shown = f"{short_name(path)} of {size / 1e6:.3g} MB"
        raise BadInput("image", shown, f"of at most {FILE // 1_000_000} MB and not empty")


def check_size(name: str, shape: Sequence[int], sample_bytes: int) -> None:
    """Refuse a picture (rows, columns[, samples]) that is too large to decode, or too small."""
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
    """Refuse a height map that is too large to read, or too small."""
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
    """Refuse an archive whose parts are too large together, by what its directory says in bytes."""
    if size > DECODED:
        allowed = f"of at most {DECODED // 1_000_000} MB unpacked"
        raise BadInput("image", f"{name} of {size / 1e6:.3g} MB unpacked", allowed, SMALLER)


def too_large(what: str) -> BadInput:
    """The refusal of a picture that is too large to decode."""
    allowed = f"of at most {PIXELS // 1_000_000} million pixels and {DECODED // 1_000_000} MB"
    return BadInput("image", what, allowed, SMALLER)
