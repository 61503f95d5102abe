"""Reader of micrographs in TIFF, PNG and JPEG files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import tifffile

from stonepass.array_types import Num
from stonepass.errors import BadInput
from stonepass.surface.border import without_border
from stonepass.surface.data_bar import find_bar
from stonepass.surface.decoded import Decoded
from stonepass.surface.file_name import short_name
from stonepass.surface.limits import SIDE, check_size, too_large
from stonepass.surface.pixel_size import (
    TESCAN_TAG,
    fei_scan,
    imagej_scan,
    ome_scan,
    tescan_scan,
    zeiss_scan,
)
from stonepass.surface.scan import Scan
from stonepass.surface.side_files import scan_beside
from stonepass.surface.surface_image import PixelArea, SurfaceImage

__all__ = ["JPEG", "PNG", "TIFF", "read_plain", "read_tiff"]

TIFF = (b"II*\0", b"MM\0*", b"II+\0", b"MM\0+")
PNG, JPEG = b"\x89PNG\r\n\x1a\n", b"\xff\xd8\xff"
ORIENTATION = 274  # tag of TIFF and EXIF
SUBFILE, OLD_SUBFILE = 254, 255  # tags with the kind of a page: NewSubfileType and SubfileType
REDUCED, MASK, OLD_REDUCED = 1, 4, 2  # two bits of NewSubfileType, and a value of SubfileType
RESOLUTION = (282, 283)  # tags with the pixels per unit, across and down
PAGES = 200  # largest number of pages that are examined
PLAIN = (1, 8, 32946)  # TIFF compressions that tifffile decodes without a codec: none, and deflate
WHITE_IS_ZERO, PALETTE = 0, 3  # photometric interpretations


def read_tiff(path: Path, area: PixelArea | None) -> SurfaceImage:
    """Read the largest page of a TIFF file that is not marked as a reduced image or a mask.

    Parameters
    ----------
    path : Path
        A TIFF file with 8 or 16 bits per sample.
    area : PixelArea or None
        The part that belongs to the surface, in pixels; None for the picture without its data bar
        and without borders.

    Raises
    ------
    BadInput
        The picture is too large, in colour, turned, or of another number of bits.
    """
    with tifffile.TiffFile(path) as file:
        index, notes = _page(file)
        page: Any = file.pages[index]
        bits, kind = page.bitspersample, int(page.photometric)
        _check_samples(path, page)
        tag = page.tags.get(ORIENTATION)
        _check_upright(path, 1 if tag is None else tag.value)
        scan = _scan_of_tiff(file, page, path)
        plain = int(page.compression) in PLAIN and kind in (0, 1, 2, 3) and page.imagedepth == 1
        decoded = _decoded_by_tifffile(page) if plain else _decoded(path, index)
    values = decoded.values
    if decoded.palette is None and values.dtype.itemsize * 8 != bits:
        shown = f"{short_name(path)}, whose {bits} bits are read as {values.dtype.itemsize * 8}"
        raise BadInput("image", shown, "saved without compression, as grey")
    # If white is zero, Pillow inverts pictures of 8 bits, but not those of 16 bits.
    if kind == WHITE_IS_ZERO and (plain or bits == 16):
        decoded = Decoded(np.iinfo(values.dtype).max - values)
    return _picture(path, decoded, scan, notes, area)


def _page(file: Any) -> tuple[int, list[str]]:
    """Return the index of the page to read, and notes about the choice."""
    count = len(file.pages)
    if count == 1:
        return 0, []
    pages = [file.pages[index] for index in range(min(count, PAGES))]
    whole = [index for index, page in enumerate(pages) if not _is_reduced(page)]
    sizes = {index: pages[index].imagewidth * pages[index].imagelength for index in whole or [0]}
    taken = max(sizes, key=lambda index: sizes[index])  # the first one of equal size
    if taken == 0:
        return 0, ["the first of several pages is read"]
    return taken, [f"page {taken + 1} of {count} is read, the largest that is no reduced image"]


def _is_reduced(page: Any) -> bool:
    """Return whether a page is marked as a reduced image or a mask."""
    new, old = (page.tags.get(code) for code in (SUBFILE, OLD_SUBFILE))
    value = 0 if new is None else int(new.value)
    return bool(value & (REDUCED | MASK)) or (old is not None and int(old.value) == OLD_REDUCED)


def _check_samples(path: Path, page: Any) -> None:
    bits, unsigned = page.bitspersample, int(page.sampleformat or 1) == 1
    if bits not in (8, 16) or not unsigned:
        shown = f"{short_name(path)} of {bits}{'' if unsigned else ' signed or floating'} bits"
        raise BadInput("image", shown, "of 8 or 16 bits per sample, unsigned")
    shape = (page.imagelength, page.imagewidth, page.samplesperpixel)
    check_size(short_name(path), shape, bits // 8)


def _decoded_by_tifffile(page: Any) -> Decoded:
    values = page.asarray()
    if values.ndim == 3 and int(page.planarconfig) == 2:
        values = np.moveaxis(values, 0, -1)
    if int(page.photometric) == PALETTE:
        return Decoded(values, (np.asarray(page.colormap).T >> 8).astype(np.uint8))
    return Decoded(values)


def _scan_of_tiff(file: Any, page: Any, path: Path) -> Scan:
    """Return the scan that the tags describe, or else a text file next to the picture."""
    if file.sem_metadata:
        return zeiss_scan(file.sem_metadata)
    if file.fei_metadata:
        return fei_scan(file.fei_metadata)
    tag = page.tags.get(TESCAN_TAG)
    if tag is not None:
        raw = tag.value
        text = raw if isinstance(raw, str) else bytes(raw).decode("latin-1")
        return tescan_scan(text.replace("\0", "\n"))
    beside = scan_beside(path)
    if beside.source:
        return beside
    if file.is_ome:
        return ome_scan(str(file.pages[0].description))
    if file.is_imagej:
        across, down = (page.tags.get(code) for code in RESOLUTION)
        per_unit = tuple(None if tag is None else tag.value for tag in (across, down))
        return imagej_scan(file.imagej_metadata or {}, (per_unit[0], per_unit[1]))
    return beside


def _check_upright(path: Path, orientation: Any) -> None:
    if orientation not in (0, 1):
        shown = f"{short_name(path)}, rotated or mirrored (orientation {orientation})"
        raise BadInput("image", shown, "stored upright", "rotate it and save it again")


def read_plain(path: Path, area: PixelArea | None) -> SurfaceImage:
    """Read a PNG or JPEG file.

    Parameters
    ----------
    path : Path
        A PNG file of 8 or 16 bits, or a JPEG file.
    area : PixelArea or None
        The part that belongs to the surface, in pixels; None for the picture without its data bar
        and without borders.

    Raises
    ------
    BadInput
        The picture is too large, in colour, turned, or of 16 bits with several channels.
    """
    with path.open("rb") as file:
        head = file.read(26)
    # Pillow reduces 16 bits per sample to 8 if there are several channels.
    if head.startswith(PNG) and len(head) == 26 and head[24] == 16 and head[25] != 0:
        shown = f"{short_name(path)} of 16 bits in colour or with alpha"
        raise BadInput("image", shown, "grey")
    return _picture(path, _decoded(path), scan_beside(path), [], area)


def _decoded(path: Path, page: int = 0) -> Decoded:
    """Decode a picture with Pillow."""
    from PIL import Image

    try:
        opened = Image.open(path, formats=("TIFF", "PNG", "JPEG"))
    except Image.DecompressionBombError as problem:
        raise too_large(short_name(path)) from problem
    with opened as image:
        if page:
            image.seek(page)
        _check_upright(path, image.getexif().get(ORIENTATION, 1))
        deep = image.mode.startswith("I;16")
        if not deep and image.mode not in ("I", "L", "LA", "P", "RGB", "RGBA"):
            shown = f"{short_name(path)} of mode {image.mode}"
            raise BadInput("image", shown, "grey, of 8 or 16 bit")
        samples = len(image.getbands())
        width = 2 if deep else 4 if image.mode == "I" else 1
        check_size(short_name(path), (image.height, image.width, samples), width)
        values = np.asarray(image)
        if image.mode != "P":
            return Decoded(_unsigned(path, values))
        palette = np.array(image.getpalette("RGB") or [], np.uint8).reshape(-1, 3)
        # Palette entries that are missing in the file are black.
        return Decoded(values, np.vstack([palette, np.zeros((256 - len(palette), 3), np.uint8)]))


def _unsigned(
    path: Path, values: Num[np.ndarray, "rows columns *samples"]
) -> Num[np.ndarray, "rows columns *samples"]:
    """Return the values as unsigned integers of 8 or 16 bits."""
    if values.dtype.kind == "u" and values.dtype.itemsize <= 2:
        return values
    low, high = (int(values.min()), int(values.max())) if values.size else (0, 0)
    if values.dtype.kind != "i" or low < 0 or high > 65535:
        shown = f"{short_name(path)} of type {values.dtype}"
        raise BadInput("image", shown, "of 8 or 16 bits per sample, unsigned")
    return values.astype(np.uint16)


def _picture(
    path: Path, decoded: Decoded, scan: Scan, notes: list[str], asked: PixelArea | None
) -> SurfaceImage:
    """Make the surface image from the grey channel, the pixel size and the area of the surface."""
    if decoded.has_alpha:
        notes.append("the last channel, alpha, is ignored")
    grey = decoded.grey()
    rows, columns = grey.shape
    whole = PixelArea(0, 0, columns, rows)
    area = _surface(grey, scan, notes) if asked is None else asked
    # An area that is not within the picture is refused by SurfaceImage.
    spot = decoded.coloured(area) if area.lies_in(whole) else None
    if spot is not None:
        part = decoded.grey_part(area)
        way = "--area leaves a coloured part out" if part is None else f"select {part.option}"
        remedy = f"column {spot[0]} of row {spot[1]} is coloured; {way}"
        raise BadInput("image", f"{short_name(path)} in colour", "grey", remedy)
    pixel, why = scan.pixel_for(columns)
    if why:
        notes.append(f"the pixel size in the file is not used: {why}")
    return SurfaceImage(
        grey,
        pixel,
        int(np.iinfo(grey.dtype).max),
        area,
        "" if pixel is None else scan.source,
        tuple(notes),
        why,
        None if area == whole or decoded.coloured(whole) is None else area,
    )


def _surface(grey: Num[np.ndarray, "rows columns"], scan: Scan, notes: list[str]) -> PixelArea:
    """Return the area without borders and without the data bar, which is declared or detected."""
    rows, columns = grey.shape
    bar = scan.rows_of_bar(columns, rows)
    declared = 0 < bar < rows - SIDE[0]
    if declared:
        notes.append(f"the lowest {bar} rows are the data bar and are left out")
        area = without_border(grey, PixelArea(0, 0, columns, rows - bar))
    else:
        area = _undeclared(grey)
    bottom = 0 if declared and area.bottom == rows - bar else rows - area.bottom
    counts = {"uppermost {} rows": area.top, "lowest {} rows": bottom,
              "first {} columns": area.left, "last {} columns": columns - area.right}  # fmt: skip
    for where, count in counts.items():
        if count:
            notes.append(
                f"the {where.format(count)} look like a data bar or a margin and are left out; "
                "--area selects any part"
            )
    return area


def _undeclared(grey: Num[np.ndarray, "rows columns"]) -> PixelArea:
    """Return the area without the data bars and borders that are detected."""
    rows, columns = grey.shape
    area = PixelArea(0, 0, columns, rows)
    while True:
        part = grey[area.top : area.bottom, area.left : area.right]
        top, bottom = find_bar(part)
        # A margin or a panel at the sides is found as a data bar of the transposed picture.
        left, right = find_bar(np.ascontiguousarray(part[top : len(part) - bottom].T))
        found = PixelArea(
            area.left + left, area.top + top, area.right - right, area.bottom - bottom
        )
        area = without_border(grey, found)
        if area == found:
            return area
        # A wide margin hides a bar beside it, which is sought again without the margin.
