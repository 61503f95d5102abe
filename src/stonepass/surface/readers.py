"""Files to surface images: TIFF, PNG and JPEG of 8 or 16 bit, and maps of surface instruments.

Sizes are checked from the header before anything is decoded. Use `untrusted.read_untrusted` for a
file of unknown origin: it reads in a process of its own, with limits.
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
from stonepass.surface.surface_image import Area, SurfaceImage

__all__ = ["load_libraries", "read_surface_image"]


def read_surface_image(path: str | Path, area: Area | None = None) -> SurfaceImage:
    """Read a micrograph or a height map.

    Grey pictures saved as colour are grey; a palette or an opaque alpha channel is no matter. Of
    several pages the largest is taken that is not marked as a reduced image. A data bar is left
    out where the file says so, or where the lowest or uppermost rows look like one.

    Parameters
    ----------
    path : Path
    area : Area, optional
        The part that is surface, which alone must be grey; the whole picture but for a data bar by
        default.

    Raises
    ------
    BadInput
        No such file, an unknown kind, one that is damaged or too large, colour, bits other than 8
        or 16, a file without a map of heights, an area that is not within the picture, or a library
        that is not installed.
    """
    path = Path(path)
    check_file(path)
    reader = _reader(path)
    try:
        with _quiet():
            return reader(path, area)
    except StonepassError:
        raise
    except Exception as problem:  # a decoder may raise anything at all over a damaged file
        shortage = _memory_error(problem)
        if shortage is not None:
            allowed = "readable in the memory it may take"
            raise BadInput("image", short_name(path), allowed, MEMORY_REMEDY) from shortage
        allowed = f"undamaged and of a kind that can be read ({said_of(path, problem)})"
        raise BadInput("image", short_name(path), allowed) from problem


def _memory_error(problem: BaseException | None) -> MemoryError | None:
    """The lack of memory behind what a decoder raised; None where there was none."""
    while problem is not None and not isinstance(problem, MemoryError):
        problem = problem.__cause__ or problem.__context__
    return problem


def _reader(path: Path) -> Callable[[Path, Area | None], SurfaceImage]:
    """Who reads this file."""
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
    """Load what a file of this name may need, as far as it is installed."""
    heights = path.suffix.lower() in HEIGHT_MAPS
    names = ("SurfaceTopography.IO", "defusedxml.ElementTree")
    for name in names if heights else ("tifffile", "PIL.Image"):
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
