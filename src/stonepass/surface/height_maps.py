"""Reader of the height maps of surface instruments, based on the library SurfaceTopography."""

from __future__ import annotations

from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np

from stonepass.array_types import Float
from stonepass.errors import BadInput
from stonepass.io.optional_imports import library
from stonepass.surface.file_name import short_name
from stonepass.surface.height_containers import mended_sur, mended_x3p
from stonepass.surface.limits import check_points
from stonepass.surface.surface_image import PixelArea, SurfaceImage

__all__ = ["HEIGHT_MAPS", "read_height_map"]

# Reader of SurfaceTopography for each file name extension.
HEIGHT_MAPS = {
    ".al3d": "al3d", ".bcr": "bcr", ".bcrf": "bcr", ".datx": "datx", ".ezd": "ezd", ".frt": "frt",
    ".gwy": "gwy", ".ibw": "ibw", ".jpk": "jpk", ".lext": "lext", ".mdt": "mdt", ".mnt": "mnt",
    ".nid": "ezd", ".oir": "oir", ".opd": "opd", ".opdx": "opdx", ".os3d": "os3d", ".plu": "plu",
    ".plux": "plux", ".poir": "poir", ".sdf": "sdf", ".spm": "di", ".sur": "sur", ".tmd": "tmd",
    ".vk3": "vk", ".vk4": "vk", ".vk6": "vk", ".vk7": "vk", ".x3p": "x3p", ".zmg": "zmg",
    ".zon": "zon",
}  # fmt: skip
# Conversions before reading: each returns a converted copy, or None if the file needs none.
MENDED = {".sur": mended_sur, ".x3p": mended_x3p}
READ, EXTRA = "read this file", "imaging"
SHOWN = 5  # largest number of channels named in an error message


def read_height_map(path: Path, area: PixelArea | None) -> SurfaceImage:
    """Read the default channel of a file, or else its first channel that is a map of heights.

    Parameters
    ----------
    path : Path
        File with one of the extensions in `HEIGHT_MAPS`.
    area : PixelArea or None
        The part that belongs to the surface, in pixels; None for the whole map.

    Raises
    ------
    BadInput
        The file has no map of heights or no unit of length, it is larger than 20 million points, or
        SurfaceTopography is not installed.
    """
    reading = library("SurfaceTopography.IO", READ, EXTRA)
    ending = path.suffix.lower()
    stream: BytesIO | None = MENDED[ending](path) if ending in MENDED else None
    opened = str(path) if stream is None else stream
    try:
        with reading.open_topography(opened, format=HEIGHT_MAPS[ending]) as reader:
            channels = list(reader.channels)
            default = reader.default_channel.index if channels else 0
            index = _channel_of_heights(path, channels, default)
            columns, rows = (int(count) for count in channels[index].nb_grid_pts)
            check_points(short_name(path), rows, columns)
            topography = reader.topography(channel_index=index)
            sizes, metre = topography.physical_sizes, _metre(topography.unit)
            if metre is None:
                raise _without_unit(path)
            values = _values(topography.heights(), metre)
    except ValueError as problem:  # of the library, for a unit such as "a.u."
        if "unknown unit" in str(problem).lower():
            raise _without_unit(path) from problem
        raise
    pixel = (float(sizes[0]) * metre / columns, float(sizes[1]) * metre / rows)
    whole = PixelArea(0, 0, columns, rows)
    return SurfaceImage(values, pixel, 0, whole if area is None else area, "height map")


def _without_unit(path: Path) -> BadInput:
    shown = f"{short_name(path)} without a unit of length"
    return BadInput("image", shown, "a height map with a unit of length")


def _channel_of_heights(path: Path, channels: list[Any], default: int) -> int:
    """Return the index of the channel to read."""
    order = sorted(range(len(channels)), key=lambda index: (index != default, index))
    maps = [index for index in order if len(channels[index].nb_grid_pts) == 2]
    if channels and not maps:
        raise BadInput("image", f"{short_name(path)} with a single line", "a map of heights")
    for index in maps:
        if channels[index].unit is None or _metre(channels[index].unit) is not None:
            return index
    named = [f"{channels[index].name} in {channels[index].unit}" for index in maps[:SHOWN]]
    shown = f"{short_name(path)} without a channel of heights"
    remedy = "export the topography itself, whose unit is a length"
    allowed = "a map of heights" + (f" (it has {', '.join(named)})" if named else "")
    raise BadInput("image", shown, allowed, remedy)


def _metre(unit: Any) -> float | None:
    """Return one unit in m; None if it is not a unit of length."""
    conversion = library("SurfaceTopography.Support.UnitConversion", READ, EXTRA)
    if not isinstance(unit, str) or not conversion.is_length_unit(unit):
        return None
    return float(conversion.get_unit_conversion_factor(unit, "m"))


def _values(heights: Any, metre: float) -> Float[np.ndarray, "rows columns"]:
    """Return heights (rows, columns) in m; NaN where one is missing.

    The library's array is (columns, rows). It is copied only once, to limit the memory.
    """
    values = np.array(np.ma.getdata(heights).T, dtype=float, order="C")
    mask = np.ma.getmask(heights)
    if mask is not np.ma.nomask:
        values[mask.T] = np.nan
    values *= metre
    values[np.isinf(values)] = np.nan
    return values
