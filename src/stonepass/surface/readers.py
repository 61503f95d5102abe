"""Reader of micrographs (TIFF, PNG, JPEG) and of height maps of surface instruments.

Sizes are checked from the header before anything is decoded. Files of unknown origin should be read
by `sandboxed.read_in_sandbox`, which works in a separate process with limits of time and memory.
"""

from __future__ import annotations

import logging
import warnings
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from importlib import import_module
from pathlib import Path

from stonepass.errors import BadInput, StonepassError
from stonepass.surface.file_name import said_of, short_name
from stonepass.surface.height_maps import HEIGHT_MAPS, read_height_map
from stonepass.surface.limits import MEMORY_REMEDY, check_file
from stonepass.surface.pictures import JPEG, PNG, TIFF, read_plain, read_tiff
from stonepass.surface.surface_image import PixelArea, SurfaceImage

__all__ = ["load_libraries", "read_surface_image"]


def read_surface_image(path: str | Path, area: PixelArea | None = None) -> SurfaceImage:
    """Read a micrograph or a height map.

    Grey pictures that were saved in colour or with a palette are accepted, and an alpha channel is
    ignored. If a TIFF file has several pages, the largest one that is not marked as a reduced image
    is read. A data bar is left out if the file declares it, or if the lowest or uppermost rows look
    like one; borders of one single grey are left out at all sides.

    Parameters
    ----------
    path : str or Path
        A TIFF, PNG or JPEG file with 8 or 16 bits per sample, or a height map.
    area : PixelArea, optional
        The part of the picture that belongs to the surface, in pixels. Only this part must be grey.
        By default it is the whole picture without a data bar and without borders.

    Returns
    -------
    SurfaceImage

    Raises
    ------
    BadInput
        The file does not exist, is damaged, too large or of an unknown kind; it is in colour, has
        another number of bits or no heights; the area is not within the picture; or a library is
        not installed.

    References
    ----------
    docs/friction.md, "Which files it reads".
    """
    path = Path(path)
    check_file(path)
    reader = _reader(path)
    try:
        with _quiet():
            return reader(path, area)
    except StonepassError:
        raise
    except Exception as problem:  # a decoder may raise any exception for a damaged file
        shortage = _memory_error(problem)
        if shortage is not None:
            allowed = "readable within the limit of memory"
            raise BadInput("image", short_name(path), allowed, MEMORY_REMEDY) from shortage
        allowed = f"an undamaged file of a kind that can be read ({said_of(path, problem)})"
        raise BadInput("image", short_name(path), allowed) from problem


def _memory_error(problem: BaseException | None) -> MemoryError | None:
    """Return the MemoryError that caused the exception of a decoder, or None."""
    while problem is not None and not isinstance(problem, MemoryError):
        problem = problem.__cause__ or problem.__context__
    return problem


def _reader(path: Path) -> Callable[[Path, PixelArea | None], SurfaceImage]:
    """Return the function that reads this kind of file."""
    with path.open("rb") as file:
        head = file.read(16)
    if path.suffix.lower() in HEIGHT_MAPS:
        return read_height_map
    if head[:4] in TIFF:
        return read_tiff
    if head.startswith((PNG, JPEG)):
        return read_plain
    allowed = "a TIFF, PNG or JPEG file, or a height map (" + ", ".join(HEIGHT_MAPS) + ")"
    raise BadInput("image", short_name(path), allowed)


def load_libraries(path: Path) -> None:
    """Import the libraries that a file with this name may need, if they are installed."""
    heights = path.suffix.lower() in HEIGHT_MAPS
    names = ("SurfaceTopography.IO", "defusedxml.ElementTree")
    for name in names if heights else ("tifffile", "PIL.Image"):
        with _quiet(), suppress(ImportError):
            import_module(name)


@contextmanager
def _quiet() -> Iterator[None]:
    """Suppress warnings and log messages of the decoders while a file is read."""
    before = logging.root.manager.disable
    logging.disable(logging.CRITICAL)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            yield
    finally:
        logging.disable(before)
