"""Text files that microscopes of TESCAN, JEOL and Hitachi write next to a picture."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from stonepass.surface.pixel_size import hitachi_scan, jeol_scan, tescan_scan
from stonepass.surface.scan import NO_SCAN, Scan

__all__ = ["scan_beside"]

LARGEST = 1_000_000  # largest size of a text file in bytes
MARKS = (b"\xff\xfe", b"\xfe\xff")  # byte order marks of UTF-16


def scan_beside(path: Path) -> Scan:
    """Read the scan from a text file next to a picture; without one the scan is empty.

    TESCAN writes ``NAME.hdr`` or ``NAME-tif.hdr``, Hitachi and JEOL write ``NAME.txt``.
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
    """Return the text of a file; None if it does not exist or is too large."""
    if not path.is_file() or path.stat().st_size > LARGEST:
        return None
    raw = path.read_bytes()
    if raw.startswith(MARKS):
        return raw.decode("utf-16", errors="replace")
    return raw.decode("utf-8" if b"\xc2\xb5" in raw else "latin-1", errors="replace")
