"""A micrograph or a height map: rows of numbers, and what a pixel measures."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Num
from stonepass.errors import BadInput, require

__all__ = ["PIXEL", "Area", "SurfaceImage", "possible_pixel"]

PIXEL = (1e-11, 1e-3)  # m
OBLONG = 10.0  # largest ratio of a pixel's sides
FULL_SCALES = {"uint8": 255, "uint16": 65535, "float64": 0}


@dataclass(frozen=True)
class Area:
    """A rectangle of pixels: columns `left` to before `right`, rows `top` to before `bottom`."""

    left: int
    top: int
    right: int
    bottom: int

    def __str__(self) -> str:
        """``left, top, right, bottom``."""
        return f"{self.left}, {self.top}, {self.right}, {self.bottom}"

    @property
    def option(self) -> str:
        """The command's option that asks for this area."""
        return f"--area {self.left},{self.top},{self.right},{self.bottom}"

    def lies_in(self, other: Area) -> bool:
        """Whether it lies within another area."""
        return (
            other.left <= self.left
            and other.top <= self.top
            and self.right <= other.right
            and self.bottom <= other.bottom
        )


@array_dataclass
@dataclass(frozen=True)
class SurfaceImage:
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
    pixel_source : str
        Who says how large a pixel is.
    notes : tuple of str
        What was left out, and how the file was read.
    pixel_hint : str
        Where `pixel` is None although the file says something of it: what it says and what to do.
    grey : Area or None
        The part whose pixels are known to be grey; the area must lie within it. None: everywhere.

    Raises
    ------
    BadInput
        An area that is not within the picture or smaller than 2 × 2 pixels, or a pixel that is not
        from 1e-11 to 1e-3 m and at most ten times as long as wide.
    """

    values: Num[np.ndarray, "rows columns"]
    pixel: tuple[float, float] | None
    full_scale: int
    area: Area
    pixel_source: str = ""
    notes: tuple[str, ...] = ()
    pixel_hint: str = ""
    grey: Area | None = None

    def __post_init__(self) -> None:
        rows, columns = self.values.shape
        kind = self.values.dtype.name
        require(
            FULL_SCALES.get(kind) == self.full_scale, "picture", kind, "of 8 or 16 bit, or heights"
        )
        area = self.area
        across = 0 <= area.left <= area.right - 2 <= columns - 2
        down = 0 <= area.top <= area.bottom - 2 <= rows - 2
        shown = str(area)
        allowed = f"left, top, right, bottom within 0, 0, {columns}, {rows}"
        require(across and down, "area", shown, allowed)
        within = self.grey is None or area.lies_in(self.grey)
        require(within, "area", shown, f"within {self.grey}, the part that is known to be grey")
        if self.pixel is not None and not possible_pixel(self.pixel):
            shown = " × ".join(f"{side:g} m" for side in self.pixel)
            raise BadInput("pixel", shown, "1e-11 m to 1e-3 m, and not oblong by more than ten")

    @property
    def has_heights(self) -> bool:
        """Whether the numbers are heights, not grey values."""
        return self.full_scale == 0

    @property
    def surface(self) -> Num[np.ndarray, "rows columns"]:
        """The numbers of the area."""
        area = self.area
        return self.values[area.top : area.bottom, area.left : area.right]

    def with_pixel(self, size: float) -> SurfaceImage:
        """Return the picture with square pixels of `size` in m, whatever the file says."""
        return replace(self, pixel=(float(size), float(size)), pixel_source="as given")

    def with_area(self, left: int, top: int, right: int, bottom: int) -> SurfaceImage:
        """Return the picture cut to an area, in pixels of the whole picture."""
        return replace(self, area=Area(left, top, right, bottom))


def possible_pixel(pixel: tuple[float, float]) -> bool:
    """Whether a pixel may have these sides in m."""
    low, high = PIXEL
    return all(low <= side <= high for side in pixel) and max(pixel) <= OBLONG * min(pixel)
