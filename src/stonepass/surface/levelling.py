"""The least-squares plane of a surface: the tilt of a specimen, or of the greys of a picture."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from stonepass.array_types import Float, Num
from stonepass.surface.surface_image import SurfaceImage

__all__ = ["Plane", "fit_plane"]

ROWS = 512  # looked at together


@dataclass(frozen=True)
class Plane:
    """offset + across · column + down · row, in the numbers of a picture: grey values, or m."""

    offset: float
    across: float
    down: float

    def at(
        self, columns: Num[np.ndarray, "*places"], rows: Num[np.ndarray, "*places"] | float
    ) -> Float[np.ndarray, "*places"]:
        """Numbers of the plane at places of the picture in pixels."""
        return self.offset + self.across * columns + self.down * rows

    def tilt(self, pixel: tuple[float, float], scale: float) -> float:
        """Angle in rad between the plane and the picture's, with `scale` m for each number."""
        return math.atan(scale * math.hypot(self.across / pixel[0], self.down / pixel[1]))


def fit_plane(picture: SurfaceImage) -> Plane:
    """Fit a plane to the picture's area by least squares; places without a height do not count."""
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
