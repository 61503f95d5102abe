"""The least-squares plane of a surface, which describes the tilt of the specimen."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from stonepass.array_types import Float, Num
from stonepass.surface.surface_image import SurfaceImage

__all__ = ["Plane", "fit_plane"]

ROWS = 512  # number of rows that are processed at a time, to limit the memory


@dataclass(frozen=True)
class Plane:
    """The plane offset + across · column + down · row over the pixels of a picture.

    Attributes
    ----------
    offset : float
        Value at the centre of pixel (0, 0): a grey level, or a height in m.
    across, down : float
        Change of the value per column and per row.

    References
    ----------
    docs/friction.md, "What is done".
    """

    offset: float
    across: float
    down: float

    def at(
        self, columns: Num[np.ndarray, "*places"], rows: Num[np.ndarray, "*places"] | float
    ) -> Float[np.ndarray, "*places"]:
        """Return the values of the plane, grey levels or heights in m.

        Parameters
        ----------
        columns, rows : array or float
            Coordinates in pixels that broadcast against each other.
        """
        return self.offset + self.across * columns + self.down * rows

    def tilt(self, pixel: tuple[float, float], scale: float) -> float:
        """Return the angle in rad between this plane and the plane of the picture.

        Parameters
        ----------
        pixel : (float, float)
            Width and height of a pixel in m.
        scale : float
            Height in m per unit of the values: m per grey level, or 1 for heights.

        References
        ----------
        docs/friction.md, "What is done".
        """
        return math.atan(scale * math.hypot(self.across / pixel[0], self.down / pixel[1]))


def fit_plane(picture: SurfaceImage) -> Plane:
    """Fit a plane to the area of a picture by least squares; missing heights are left out."""
    area = picture.area
    middle = 0.5 * (area.left + area.right - 1), 0.5 * (area.top + area.bottom - 1)
    squares, products = np.zeros((3, 3)), np.zeros(3)
    columns = np.arange(area.left, area.right) - middle[0]
    for start in range(area.top, area.bottom, ROWS):
        stop = min(start + ROWS, area.bottom)
        values = picture.values[start:stop, area.left : area.right].astype(float)
        known = np.isfinite(values)
        values[~known] = 0.0
        rows = np.arange(start, stop) - middle[1]
        in_row, in_column = known.sum(axis=1), known.sum(axis=0)
        cross = float(rows @ (known @ columns))
        by_column, by_row = float(in_column @ columns), float(in_row @ rows)
        squares += [
            [in_row.sum(), by_column, by_row],
            [by_column, in_column @ columns**2, cross],
            [by_row, cross, in_row @ rows**2],
        ]
        products += [values.sum(), values.sum(axis=0) @ columns, values.sum(axis=1) @ rows]
    size = np.array([1.0, area.right - area.left, area.bottom - area.top])
    scaled, *_ = np.linalg.lstsq(squares / np.outer(size, size), products / size, rcond=None)
    mean, across, down = (float(each) for each in scaled / size)
    return Plane(mean - across * middle[0] - down * middle[1], across, down)
