"""Text files that microscopes write beside a picture: TESCAN, JEOL and Hitachi."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from stonepass.surface.pixel_size import hitachi_scan, jeol_scan, tescan_scan
from stonepass.surface.scan import NO_SCAN, Scan

__all__ = ["scan_beside"]

LARGEST = 1_000_000  # bytes, of a text file beside a picture
MARKS = (b"\xff\xfe", b"\xfe\xff")  # of UTF-16


def scan_beside(path: Path) -> Scan:
    """Read what stands in a text file beside a picture.

    ``NAME.hdr`` and ``NAME-tif.hdr`` are TESCAN's; ``NAME.txt`` is Hitachi's or JEOL's.
    """
    ending = path.suffix.lstrip(".")
    for beside in (path.with_suffix(".hdr"), path.with_name(f"{path.stem}-{ending}.hdr")):
        text = _text(beside)
        if text is not None:
            return tescan_scan(text, "TESCAN .hdr file")
    for beside in (path.with_suffix(".txt"), path.with_suffix(".TXT"), path.with_suffix(".Txt")):
        text = _text(beside)
        for mark, read in _WRITERS:
            if text is not None and mark in text:
                return read(text)
    return NO_SCAN


_WRITERS: tuple[tuple[str, Callable[[str], Scan]], ...] = (
    ("[SemImageFile]", hitachi_scan),
    ("$SM_MICRON_", jeol_scan),
    ("$CM_FULL_SIZE", jeol_scan),
)


def _text(path: Path) -> str | None:
    """Text of a file; None where there is none, or one too long."""
    if not path.is_file() or path.stat().st_size > LARGEST:
        return None
    raw = path.read_bytes()
    if raw.startswith(MARKS):
        return raw.decode("utf-16", errors="replace")
    return raw.decode("utf-8" if b"\xc2\xb5" in raw else "latin-1", errors="replace")
