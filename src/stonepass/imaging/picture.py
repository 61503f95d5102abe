"""A micrograph or a height map: rows of numbers, and what a pixel measures."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Num

from stonepass.errors import BadInput, require

__all__ = ["Area", "Picture"]

PIXEL = (1e-11, 1e-3)  # m


@dataclass(frozen=True)
class Area:
    """A rectangle of pixels: columns `left` to before `right`, rows `top` to before `bottom`."""

    left: int
    top: int
    right: int
    bottom: int


@dataclass(frozen=True)
class Picture:
    """Grey values or heights, row by row from the top.

    Attributes
    ----------
    values : array (rows, columns)
        Grey values (8 or 16 bit), or heights in m where `full_scale` is 0.
    pixel : tuple of float or None
        Width and height of a pixel in m; None where the file does not say.
    full_scale : int
        Largest grey value that the file could hold, 255 or 65535; 0 for heights.
    area : Area
        What belongs to the surface; the data bar under a micrograph does not.
    notes : tuple of str
        What was found in the file and how it was read.
    """

    values: Num[np.ndarray, "rows columns"]
    pixel: tuple[float, float] | None
    full_scale: int
    area: Area
    notes: tuple[str, ...] = ()

    @property
    def has_heights(self) -> bool:
        """Whether the numbers are heights, not grey values."""
        return self.full_scale == 0

    @property
    def surface(self) -> Num[np.ndarray, "rows columns"]:
        """The numbers of the area."""
        area = self.area
        return self.values[area.top : area.bottom, area.left : area.right]

    def with_pixel(self, size: float) -> Picture:
        """Return the picture with square pixels of `size` in m, whatever the file says."""
        low, high = PIXEL
        require(low <= size <= high, "pixel", f"{size:g} m", f"from {low:g} m to {high:g} m")
        return replace(self, pixel=(float(size), float(size)))

    def with_area(self, left: int, top: int, right: int, bottom: int) -> Picture:
        """Return the picture cut to an area, in pixels of the whole picture.

        Raises
        ------
        BadInput
            Where it reaches out of the picture or holds fewer than 2 × 2 pixels.
        """
        rows, columns = self.values.shape
        if not (0 <= left <= right - 2 <= columns - 2 and 0 <= top <= bottom - 2 <= rows - 2):
            allowed = f"left, top, right, bottom within 0, 0, {columns}, {rows}"
            raise BadInput("area", f"{left}, {top}, {right}, {bottom}", allowed)
        return replace(self, area=Area(left, top, right, bottom))
