"""A micrograph or a height map: grey levels or heights, and the size of a pixel."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Num
from stonepass.errors import BadInput, require

__all__ = ["PIXEL", "PixelArea", "SurfaceImage", "possible_pixel", "read_area"]

PIXEL = (1e-11, 1e-3)  # smallest and largest side of a pixel in m
OBLONG = 10.0  # largest ratio of the sides of a pixel
SAME = 0.01  # relative difference up to which two pixel sizes agree
MICRO = 1e6  # µm per m
DIGITS = 9  # the numbers of an area have fewer characters
# Largest grey level by the type of the values; 0 for heights.
FULL_SCALES = {"uint8": 255, "uint16": 65535, "float64": 0}


@dataclass(frozen=True)
class PixelArea:
    """A rectangle of pixels.

    Attributes
    ----------
    left, right : int
        First column, and the column after the last one.
    top, bottom : int
        First row, and the row after the last one.
    """

    left: int
    top: int
    right: int
    bottom: int

    def __str__(self) -> str:
        """Return the text ``left, top, right, bottom``."""
        return f"{self.left}, {self.top}, {self.right}, {self.bottom}"

    @property
    def option(self) -> str:
        """The command-line option that selects this area."""
        return f"--area {self.left},{self.top},{self.right},{self.bottom}"

    def lies_in(self, other: PixelArea) -> bool:
        """Return whether this area lies within another one."""
        return (
            other.left <= self.left
            and other.top <= self.top
            and self.right <= other.right
            and self.bottom <= other.bottom
        )


def read_area(text: str, name: str = "area") -> PixelArea:
    """Read an area from a text such as ``0,0,640,440``: left, top, right, bottom in pixels.

    Parameters
    ----------
    text : str
    name : str
        Name of the input in messages.

    Raises
    ------
    BadInput
        The text is not four whole numbers.
    """
    parts = text.split(",")
    whole = all(part.strip().isdecimal() and len(part) < DIGITS for part in parts)
    if len(parts) != 4 or not whole:
        raise BadInput(name, text, "four whole numbers LEFT,TOP,RIGHT,BOTTOM in pixels")
    return PixelArea(*(int(part) for part in parts))


@array_dataclass
@dataclass(frozen=True)
class SurfaceImage:
    """Grey levels of a micrograph or heights of a height map.

    Attributes
    ----------
    values : array (rows, columns)
        Grey levels (uint8 or uint16), or heights in m (float64, NaN where one is missing). The
        first row is the top of the picture.
    pixel : (float, float) or None
        Width and height of a pixel in m, 1e-11 to 1e-3; None if the file does not contain them.
    full_scale : int
        Largest possible grey level, 255 or 65535; 0 for heights.
    area : PixelArea
        The part that belongs to the surface, without a data bar, in pixels.
    pixel_source : str
        Origin of the pixel size, e.g. "FEI tag"; empty if it is unknown.
    notes : tuple of str
        Remarks of the reader, e.g. about parts that were left out.
    pixel_hint : str
        Reason why a pixel size in the file was not used, and what to do; otherwise empty.
    grey : PixelArea or None
        The part whose pixels are all grey, which `area` must lie in; None for the whole picture.

    Raises
    ------
    BadInput
        The area is not within the picture or smaller than 2 × 2 pixels, or the sides of a pixel are
        out of bounds or differ by more than a factor of ten.

    References
    ----------
    docs/friction.md, "Which files it reads".
    """

    values: Num[np.ndarray, "rows columns"]
    pixel: tuple[float, float] | None
    full_scale: int
    area: PixelArea
    pixel_source: str = ""
    notes: tuple[str, ...] = ()
    pixel_hint: str = ""
    grey: PixelArea | None = None

    def __post_init__(self) -> None:
        rows, columns = self.values.shape
        kind = self.values.dtype.name
        require(
            FULL_SCALES.get(kind) == self.full_scale, "type of the picture", kind,
            "uint8, uint16, or float64 for heights"
        )  # fmt: skip
        area = self.area
        across = 0 <= area.left <= area.right - 2 <= columns - 2
        down = 0 <= area.top <= area.bottom - 2 <= rows - 2
        shown = str(area)
        allowed = f"left, top, right, bottom within 0, 0, {columns}, {rows}"
        require(across and down, "area", shown, allowed)
        within = self.grey is None or area.lies_in(self.grey)
        require(within, "area", shown, f"within {self.grey}, the part without colours")
        if self.pixel is not None and not possible_pixel(self.pixel):
            shown = " × ".join(f"{side:g} m" for side in self.pixel)
            allowed = f"from 1e-11 m to 1e-3 m, with sides that differ at most {OBLONG:g}-fold"
            raise BadInput("pixel size", shown, allowed)

    @property
    def has_heights(self) -> bool:
        """True if the values are heights instead of grey levels."""
        return self.full_scale == 0

    @property
    def surface(self) -> Num[np.ndarray, "rows columns"]:
        """Values of the area, an array (rows, columns)."""
        area = self.area
        return self.values[area.top : area.bottom, area.left : area.right]

    def with_pixel(self, size: float) -> SurfaceImage:
        """Return the picture with square pixels of the given size in m.

        A pixel size in the file of a picture is replaced; a note tells it if it differs by more
        than 1 %.

        Raises
        ------
        BadInput
            The image is a height map that has a pixel size, or the given one is out of bounds.
        """
        notes = self.notes
        if self.pixel is not None:
            had = " × ".join(f"{side * MICRO:.4g} µm" for side in self.pixel)
            if self.has_heights:
                remedy = f"the height map has its own, {had}"
                raise BadInput("pixel size", f"{size * MICRO:.4g} µm", "left out", remedy)
            if any(abs(side - size) > SAME * size for side in self.pixel):
                source = self.pixel_source or "picture"
                notes += (f"the {source} says {had} per pixel, which is not used",)
        return replace(self, pixel=(float(size), float(size)), pixel_source="as given", notes=notes)

    def with_area(self, left: int, top: int, right: int, bottom: int) -> SurfaceImage:
        """Return the picture with another area of the surface.

        Parameters
        ----------
        left, top, right, bottom : int
            Bounds of the area in pixels of the whole picture (see `PixelArea`).
        """
        return replace(self, area=PixelArea(left, top, right, bottom))


def possible_pixel(pixel: tuple[float, float]) -> bool:
    """Return whether a pixel can have these sides in m."""
    low, high = PIXEL
    return all(low <= side <= high for side in pixel) and max(pixel) <= OBLONG * min(pixel)
