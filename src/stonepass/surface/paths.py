"""Straight paths over a picture, and the profiles along them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from stonepass.array_types import Float
from stonepass.caution import Caution, caution
from stonepass.errors import BadInput, require
from stonepass.surface.surface_image import SurfaceImage

__all__ = ["Profiles", "StraightPath", "evenly_spaced", "profiles_along", "read_path"]

COUNT = (1, 100)
UNEVEN = 0.01  # of the shortest length, by which paths may differ in silence


@dataclass(frozen=True)
class StraightPath:
    """A straight line from (x0, y0) to (x1, y1) in pixels.

    x counts columns to the right and y rows downwards; (0, 0) is the centre of the first pixel.
    """

    x0: float
    y0: float
    x1: float
    y1: float

    def length(self, pixel: tuple[float, float]) -> float:
        """Length in m."""
        return math.hypot((self.x1 - self.x0) * pixel[0], (self.y1 - self.y0) * pixel[1])


@dataclass(frozen=True)
class Profiles:
    """Numbers along paths, each from its start, at the same distances.

    Attributes
    ----------
    distance : array (n)
        From the start of each path, in m.
    values : array (paths, n)
        Grey values or heights.
    warnings : tuple of Caution
    """

    distance: Float[np.ndarray, " n"]
    values: Float[np.ndarray, "paths n"]
    warnings: tuple[Caution, ...] = ()


def read_path(text: str) -> StraightPath:
    """Read ``x0,y0,x1,y1``."""
    parts = text.split(",")
    try:
        numbers = [float(part) for part in parts]
    except ValueError:
        numbers = []
    if len(numbers) != 4 or not all(math.isfinite(number) for number in numbers):
        raise BadInput("path", text, "four numbers x0,y0,x1,y1 in pixels")
    return StraightPath(*numbers)


def evenly_spaced(picture: SurfaceImage, count: int) -> list[StraightPath]:
    """Horizontal paths across the whole area, along rows evenly spaced."""
    low, high = COUNT
    area = picture.area
    height = area.bottom - area.top
    high = min(high, height)
    require(low <= count <= high, "paths", count, f"a whole number from {low} to {high}")
    rows = [area.top + round(height * (k + 0.5) / count - 0.5) for k in range(count)]
    return [StraightPath(area.left, row, area.right - 1.0, row) for row in rows]


def profiles_along(picture: SurfaceImage, paths: Sequence[StraightPath]) -> Profiles:
    """Sample a picture along paths, bilinearly, about a pixel apart.

    Paths longer than the shortest one are cut to its length, so that they can be averaged.

    Raises
    ------
    BadInput
        No pixel size; no path; one that leaves the picture's area, is shorter than two pixels, or
        meets heights that are missing.
    """
    from scipy.ndimage import map_coordinates  # half a second, after a file is known to be good

    pixel = picture.pixel
    if pixel is None:
        raise BadInput("pixel size", "missing", "given as --pixel", "the file does not say it")
    low, high = COUNT
    require(low <= len(paths) <= high, "paths", len(paths), f"{low} to {high} of them")
    for path in paths:
        _check(picture, path)
    lengths = [path.length(pixel) for path in paths]
    shortest = min(lengths)
    across = min(math.hypot(path.x1 - path.x0, path.y1 - path.y0) for path in paths)
    count = 1 + math.floor(across + 1e-9)
    distance = np.linspace(0.0, shortest, count)
    rows = []
    for path, length in zip(paths, lengths, strict=True):
        share = distance / length
        x, y = path.x0 + share * (path.x1 - path.x0), path.y0 + share * (path.y1 - path.y0)
        values = map_coordinates(picture.values, [y, x], np.float64, order=1, mode="nearest")
        if not np.all(np.isfinite(values)):
            raise BadInput("path", _shown(path), "clear of places without a height",
                           "choose other paths")  # fmt: skip
        rows.append(values)
    uneven = max(lengths) > (1.0 + UNEVEN) * shortest
    told = caution("uneven_paths", ratio=max(lengths) / shortest)
    return Profiles(distance, np.array(rows), (told,) if uneven else ())


def _check(picture: SurfaceImage, path: StraightPath) -> None:
    area = picture.area
    for x, y in ((path.x0, path.y0), (path.x1, path.y1)):
        if not (area.left <= x <= area.right - 1 and area.top <= y <= area.bottom - 1):
            allowed = (
                f"within columns {area.left} to {area.right - 1} and rows {area.top} to "
                f"{area.bottom - 1}"
            )
            raise BadInput("path", _shown(path), allowed)
    if math.hypot(path.x1 - path.x0, path.y1 - path.y0) < 2.0:
        raise BadInput("path", _shown(path), "at least two pixels long")


def _shown(path: StraightPath) -> str:
    return f"{path.x0:g},{path.y0:g},{path.x1:g},{path.y1:g}"
