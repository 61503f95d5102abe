"""Files to pictures: TIFF, PNG and JPEG of 8 or 16 bit, and height maps of surface instruments.

Sizes are checked from the header before anything is decoded. Use `untrusted.read_untrusted` for a
file of unknown origin: it reads in a process of its own, with limits.
"""

from __future__ import annotations

import logging
import warnings
import zipfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np

from stonepass.array_types import Num
from stonepass.errors import BadInput, StonepassError
from stonepass.io.optional_imports import library
from stonepass.surface.limits import SIDE, check_file, check_size, check_unpacked, too_large
from stonepass.surface.pixel_size import (
    TESCAN_TAG,
    Scan,
    fei_scan,
    tescan_scan,
    tescan_text_beside,
    zeiss_scan,
)
from stonepass.surface.surface_image import Area, SurfaceImage, possible_pixel
from stonepass.units import length

__all__ = ["HEIGHT_MAPS", "load_libraries", "read_surface_image"]

# Ending of the name to the reader of SurfaceTopography.
HEIGHT_MAPS = {
    ".al3d": "al3d", ".bcr": "bcr", ".bcrf": "bcr", ".datx": "datx", ".ezd": "ezd", ".frt": "frt",
    ".gwy": "gwy", ".ibw": "ibw", ".jpk": "jpk", ".lext": "lext", ".mdt": "mdt", ".mnt": "mnt",
    ".nid": "ezd", ".oir": "oir", ".opd": "opd", ".opdx": "opdx", ".os3d": "os3d", ".plu": "plu",
    ".plux": "plux", ".poir": "poir", ".sdf": "sdf", ".spm": "di", ".sur": "sur", ".tmd": "tmd",
    ".vk3": "vk", ".vk4": "vk", ".vk6": "vk", ".vk7": "vk", ".x3p": "x3p", ".zmg": "zmg",
    ".zon": "zon",
}  # fmt: skip
TIFF = (b"II*\0", b"MM\0*", b"II+\0", b"MM\0+")
PNG, JPEG = b"\x89PNG\r\n\x1a\n", b"\xff\xd8\xff"
COLOURED = 2  # grey levels of 255 by which channels may differ in a grey picture
ROWS = 512  # compared at a time
ORIENTATION = 274  # tag of TIFF and EXIF
PLAIN = (1, 8, 32946)  # compressions of TIFF that need no codec: none, and deflate
READ, EXTRA = "read this file", "imaging"


def read_surface_image(path: str | Path) -> SurfaceImage:
    """Read a micrograph or a height map.

    Grey pictures saved as colour are grey; a palette or an opaque alpha channel is no matter. Of
    several pages the first is taken.

    Raises
    ------
    BadInput
        No such file, an unknown kind, one that is damaged or too large, colour, bits other than 8
        or 16, numbers that are not finite, or a library that is not installed.
    """
    path = Path(path)
    check_file(path)
    with path.open("rb") as file:
        head = file.read(16)
    reader: Callable[[Path], SurfaceImage]
    if path.suffix.lower() in HEIGHT_MAPS:
        reader = _heights
    elif head[:4] in TIFF:
        reader = _tiff
    elif head.startswith((PNG, JPEG)):
        reader = _plain
    else:
        allowed = "a TIFF, PNG or JPEG file, or a height map (" + ", ".join(HEIGHT_MAPS) + ")"
        raise BadInput("image", path.name, allowed)
    try:
        with _quiet():
            return reader(path)
    except StonepassError:
        raise
    except MemoryError as problem:
        raise BadInput("image", path.name, "readable in the memory it may take") from problem
    except Exception as problem:  # a decoder may raise anything at all over a damaged file
        said = " ".join(f"{type(problem).__name__}: {problem}".split())[:120]
        allowed = f"undamaged and of a kind that can be read ({said})"
        raise BadInput("image", path.name, allowed) from problem


def load_libraries(path: Path) -> None:
    """Load what a file of this name may need, as far as it is installed."""
    heights = path.suffix.lower() in HEIGHT_MAPS
    for name in ("SurfaceTopography.IO",) if heights else ("tifffile", "PIL.Image"):
        with _quiet(), suppress(ImportError):
            import_module(name)


@contextmanager
def _quiet() -> Iterator[None]:
    """Decoders warn and log about files that they then refuse, or read all the same."""
    before = logging.root.manager.disable
    logging.disable(logging.CRITICAL)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            yield
    finally:
        logging.disable(before)


def _tiff(path: Path) -> SurfaceImage:
    tifffile = library("tifffile", READ, EXTRA)
    with tifffile.TiffFile(path) as file:
        page = file.pages[0]
        shape = (page.imagelength, page.imagewidth, page.samplesperpixel)
        bits = page.bitspersample
        if bits not in (8, 16) or int(page.sampleformat or 1) != 1:
            unsigned = int(page.sampleformat or 1) == 1
            shown = f"{path.name} of {bits}{'' if unsigned else ' signed or floating'} bits"
            raise BadInput("image", shown, "of 8 or 16 bits a sample")
        check_size(path.name, shape, bits // 8)
        tag = page.tags.get(ORIENTATION)
        _check_upright(path, 1 if tag is None else tag.value)
        scan, source = _scan_of_tiff(file, page, path)
        notes = ["the first of several pages is taken"] if len(file.pages) > 1 else []
        kind = int(page.photometric)
        plain = int(page.compression) in PLAIN and kind in (0, 1, 2, 3) and page.imagedepth == 1
        values = page.asarray() if plain else _decoded(path)
        if plain and values.ndim == 3 and int(page.planarconfig) == 2:
            values = np.moveaxis(values, 0, -1)
        if plain and kind == 3:
            values = (np.moveaxis(np.asarray(page.colormap)[:, values], 0, -1) >> 8).astype(
                np.uint8
            )
        if plain and kind == 0:  # white is zero
            values = np.iinfo(values.dtype).max - values
    if kind != 3 and values.dtype.itemsize * 8 != bits:
        shown = f"{path.name}, whose {bits} bits are read as {values.dtype.itemsize * 8}"
        raise BadInput("image", shown, "saved without compression, as grey")
    return _grey(path, values, scan, source, notes)


def _check_upright(path: Path, orientation: Any) -> None:
    if orientation not in (0, 1):
        shown = f"{path.name}, stored turned or mirrored (orientation {orientation})"
        raise BadInput("image", shown, "stored upright", "turn it and save it again")


def _scan_of_tiff(file: Any, page: Any, path: Path) -> tuple[Scan | None, str]:
    """Pixel size and data bar, and whose."""
    if file.sem_metadata:
        return zeiss_scan(file.sem_metadata, page.imagewidth), "Zeiss tag"
    if file.fei_metadata:
        return fei_scan(file.fei_metadata, (page.imagelength, page.imagewidth)), "FEI tag"
    tag = page.tags.get(TESCAN_TAG)
    if tag is not None:
        raw = tag.value
        text = raw if isinstance(raw, str) else bytes(raw).decode("latin-1")
        return tescan_scan(text.replace("\0", "\n")), "TESCAN tag"
    return _scan_beside(path)


def _scan_beside(path: Path) -> tuple[Scan | None, str]:
    text = tescan_text_beside(path)
    return (None, "") if text is None else (tescan_scan(text), "TESCAN .hdr file")


def _plain(path: Path) -> SurfaceImage:
    """PNG and JPEG."""
    with path.open("rb") as file:
        head = file.read(26)
    # Pillow cuts 16 bits of colour or with alpha to 8.
    if head.startswith(PNG) and len(head) == 26 and head[24] == 16 and head[25] != 0:
        raise BadInput("image", f"{path.name} of 16 bits in colour or with alpha", "grey")
    return _grey(path, _decoded(path), *_scan_beside(path), [])


def _decoded(path: Path) -> Num[np.ndarray, "..."]:
    """Decode with Pillow."""
    from PIL import Image

    try:
        opened = Image.open(path, formats=("TIFF", "PNG", "JPEG"))
    except Image.DecompressionBombError as problem:
        raise too_large(path.name) from problem
    with opened as image:
        _check_upright(path, image.getexif().get(ORIENTATION, 1))
        if image.mode == "P":
            check_size(path.name, (image.height, image.width, 3), 1)
            return np.asarray(image.convert("RGB"))
        deep = image.mode.startswith("I;16")
        if not deep and image.mode not in ("I", "L", "LA", "RGB", "RGBA"):
            raise BadInput("image", f"{path.name} of mode {image.mode}", "grey, of 8 or 16 bit")
        samples = len(image.getbands())
        width = 2 if deep else 4 if image.mode == "I" else 1
        check_size(path.name, (image.height, image.width, samples), width)
        return np.asarray(image)


def _grey(
    path: Path,
    values: Num[np.ndarray, "..."],
    scan: Scan | None,
    source: str,
    notes: list[str],
) -> SurfaceImage:
    """One channel of grey; an equal one for each colour counts as one."""
    if values.dtype.kind != "u" or values.dtype.itemsize > 2:
        low, high = (int(values.min()), int(values.max())) if values.size else (0, 0)
        if values.dtype.kind != "i" or low < 0 or high > 65535:
            allowed = "of 8 or 16 bits a sample"
            raise BadInput("image", f"{path.name} of type {values.dtype}", allowed)
        values = values.astype(np.uint16)
    full = int(np.iinfo(values.dtype).max)
    if values.ndim == 3:
        if values.shape[2] in (2, 4):
            notes.append("the last channel, alpha, is left out")
        colours = values[..., :3] if values.shape[2] >= 3 else values[..., :1]
        for start in range(0, len(colours), ROWS):
            some = colours[start : start + ROWS].astype(np.int32)
            if np.ptp(some, axis=2).max() > COLOURED * (full // 255):
                raise BadInput("image", f"{path.name} in colour", "grey")
        values = colours[..., 0]
    values = np.ascontiguousarray(values, values.dtype.newbyteorder("="))
    rows, columns = values.shape
    pixel, bar = (None, 0) if scan is None else scan
    if pixel is not None and not possible_pixel(pixel):
        notes.append(f"pixel size of the {source} is impossible and not taken")
        pixel, bar = None, 0
    if 0 < bar < rows - SIDE[0]:
        notes.append(f"the lowest {bar} rows are the data bar and left out")
    else:
        bar = 0
    area = Area(0, 0, columns, rows - bar)
    return SurfaceImage(values, pixel, full, area, "" if pixel is None else source, tuple(notes))


def _heights(path: Path) -> SurfaceImage:
    if zipfile.is_zipfile(path):
        with zipfile.ZipFile(path) as packed:
            check_unpacked(path.name, sum(part.file_size for part in packed.infolist()))
    reading = library("SurfaceTopography.IO", READ, EXTRA)
    reader = reading.open_topography(str(path), format=HEIGHT_MAPS[path.suffix.lower()])
    with reader:
        channel = reader.default_channel
        if len(channel.nb_grid_pts) != 2:
            raise BadInput("image", f"{path.name}, a line", "a map of heights")
        columns, rows = (int(count) for count in channel.nb_grid_pts)
        check_size(path.name, (rows, columns), 8)
        topography = channel.topography()
        heights = np.ma.asarray(topography.heights())
        sizes, unit = topography.physical_sizes, topography.unit
    if unit is None:
        raise BadInput("image", f"{path.name} without a unit", "a map with a unit of length")
    metre = float(length(f"1 {unit}", "unit of the height map"))
    values = np.ma.filled(heights.astype(float), np.nan).T * metre
    pixel = (float(sizes[0]) * metre / columns, float(sizes[1]) * metre / rows)
    area = Area(0, 0, columns, rows)
    return SurfaceImage(np.ascontiguousarray(values), pixel, 0, area, "height map")
