"""From grey values to heights: checks of a picture's greys, and which of them are black and white.

The darkest grey is taken as the lowest place and the brightest as the highest; between them lies
the known height range.
"""

from __future__ import annotations

import numpy as np

from stonepass.array_types import Float, Num
from stonepass.caution import Caution, caution
from stonepass.errors import require
from stonepass.surface.data_bar import drawn_rows
from stonepass.surface.levelling import Plane
from stonepass.surface.surface_image import SurfaceImage

__all__ = ["SCALINGS", "Greys", "check_surface", "grey_ranges", "to_heights"]

ROWS = 512  # looked at together
LEVELS = 16  # least number of grey levels of a picture that is not flat
SATURATED = 0.25  # of the pixels at the ends of the greys, at which heights are cut off
TELL_SATURATED = 0.1  # more than the tops and bottoms of a smooth surface take
GAP = 0.1  # of the greys, empty beside the brightest or darkest: what writing leaves
DRAWN_ROWS = 0.01  # of the rows, mainly of one grey: a bar, or a part that is missing
SMOOTHED = 5  # pixels along each side, over which grey is averaged before its range is taken
PERCENTILES = (0.1, 99.9)
SCALINGS = ("smoothed range", "range", "percentiles")

# Greys of height nought and of the whole height range.
Greys = tuple[float, float]


def check_surface(picture: SurfaceImage) -> list[Caution]:
    """Refuse a picture that is flat or cut off; warn of what looks like no surface.

    Raises
    ------
    BadInput
        A height map without heights or flat; fewer than 16 grey levels; more than a quarter of the
        pixels at the darkest and brightest grey.
    """
    values = picture.surface
    if picture.has_heights:
        lowest, highest = (least.reduce(values, axis=None) for least in (np.fmin, np.fmax))
        require(highest > lowest, "height map", "flat or empty", "of a rough surface")
        return []
    counts = np.zeros(picture.full_scale + 1, int)
    for start in range(0, len(values), ROWS):  # each number becomes eight bytes here
        counts += np.bincount(values[start : start + ROWS].ravel(), minlength=len(counts))
    greys = np.flatnonzero(counts)
    low, high = int(greys[0]), int(greys[-1])
    shown = f"flat, with greys from {low} to {high}"
    require(high - low >= LEVELS, "picture", shown, f"of at least {LEVELS} grey levels")
    ends = float(counts[low] + counts[high]) / values.size
    allowed = f"less than {SATURATED:.0%} of it"
    require(ends < SATURATED, "darkest or brightest grey", f"{ends:.0%} of the picture", allowed,
            "take one that is not saturated")  # fmt: skip
    told = []
    if ends > TELL_SATURATED:
        told.append(caution("saturated_greys", fraction=ends))
    gaps = np.diff(greys) > GAP * (high - low)
    if gaps[0] or gaps[-1]:
        told.append(caution("isolated_grey"))
    drawn = float(np.mean(drawn_rows(values)))
    if drawn > DRAWN_ROWS:
        told.append(caution("plain_rows", fraction=drawn))
    return told


def grey_ranges(picture: SurfaceImage, plane: Plane | None = None) -> list[tuple[str, Greys]]:
    """Greys of height nought and of the whole height range, by each of `SCALINGS`.

    Single pixels reach further than the surface does, by their noise; their mean over a few does so
    less.

    Parameters
    ----------
    picture : SurfaceImage
        A grey picture.
    plane : Plane, optional
        Subtracted from the greys first.
    """
    from scipy.ndimage import uniform_filter

    values: Num[np.ndarray, "rows columns"] = picture.surface
    if plane is not None:
        values = _less(picture, plane)
    smoothed = uniform_filter(values, SMOOTHED, np.float32)
    low, high = np.percentile(values, PERCENTILES)
    ends = (
        (float(smoothed.min()), float(smoothed.max())),
        (float(values.min()), float(values.max())),
        (float(low), float(high)),
    )
    return list(zip(SCALINGS, ends, strict=True))


def _less(picture: SurfaceImage, plane: Plane) -> Float[np.ndarray, "rows columns"]:
    """The numbers of the area less those of a plane."""
    area = picture.area
    columns = np.arange(area.left, area.right)
    found = picture.surface.astype(np.float32)
    for row, values in enumerate(found, area.top):
        values -= plane.at(columns, float(row)).astype(np.float32)
    return found


def to_heights(
    values: Float[np.ndarray, "paths n"], height_range: float | None, greys: Greys
) -> Float[np.ndarray, "paths n"]:
    """Scale grey values to heights in m; heights (no height range) stay as they are.

    Raises
    ------
    BadInput
        Black and white are one grey.
    """
    if height_range is None:
        return values
    low, high = greys
    require(high > low, "picture", "flat", "of a rough surface")
    return height_range * (values - low) / (high - low)
