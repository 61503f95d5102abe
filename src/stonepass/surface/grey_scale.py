"""Conversion of grey levels to heights, and checks of the grey levels of a picture.

The darkest grey level is taken as the lowest point of the surface and the brightest as the highest
point. Heights are linear in the grey level between them, over the known height range.
"""

from __future__ import annotations

import numpy as np

from stonepass.array_types import Float, Num
from stonepass.caution import Caution, caution
from stonepass.errors import require
from stonepass.surface.border import without_border
from stonepass.surface.data_bar import drawn_rows
from stonepass.surface.drawn_bar import drawn_bar
from stonepass.surface.levelling import Plane
from stonepass.surface.surface_image import PixelArea, SurfaceImage

__all__ = ["SCALINGS", "Greys", "check_surface", "grey_ranges", "to_heights"]

ROWS = 512  # number of rows that are processed at a time, to limit the memory
LEVELS = 16  # smallest difference between the brightest and the darkest grey level
# Largest fraction of pixels with the darkest or brightest level. Above it the picture is refused.
SATURATED = 0.25
# Fraction of such pixels above which a warning is given; a smooth surface has fewer.
TELL_SATURATED = 0.1
# Letters or a scale bar are suspected if the brightest or the darkest level is farther from the
# next used level than this fraction of the range of levels.
GAP = 0.1
DRAWN_ROWS = 0.01  # fraction of rows with few grey levels above which a data bar is suspected
SMOOTHED = 5  # side in pixels of the square over which grey levels are averaged for their range
PERCENTILES = (0.1, 99.9)  # percentiles of the grey levels that bound their range
SCALINGS = ("smoothed range", "range", "percentiles")  # three ways to find the range

# Grey levels of the lowest and of the highest point of the surface.
Greys = tuple[float, float]


def check_surface(picture: SurfaceImage) -> list[Caution]:
    """Refuse a picture without relief or with saturated grey levels, and warn of other signs.

    Parameters
    ----------
    picture : SurfaceImage
        Grey levels or heights.

    Returns
    -------
    list of Caution
        Warnings about saturated pixels, isolated grey levels, rows that look like a data bar,
        borders, and a scale bar inside the picture.

    Raises
    ------
    BadInput
        A height map has no heights or is flat, the darkest and the brightest level of a picture
        differ by less than 16, or at least a quarter of its pixels have one of these two levels.
    """
    values = picture.surface
    if picture.has_heights:
        lowest, highest = (least.reduce(values, axis=None) for least in (np.fmin, np.fmax))
        require(highest > lowest, "height map", "flat or empty", "of a rough surface")
        return []
    counts = np.zeros(picture.full_scale + 1, int)
    for start in range(0, len(values), ROWS):  # bincount converts each value to eight bytes
        counts += np.bincount(values[start : start + ROWS].ravel(), minlength=len(counts))
    greys = np.flatnonzero(counts)
    low, high = int(greys[0]), int(greys[-1])
    shown = f"flat, with greys from {low} to {high}"
    allowed = f"with at least {LEVELS} grey levels between darkest and brightest"
    require(high - low >= LEVELS, "picture", shown, allowed)
    ends = float(counts[low] + counts[high]) / values.size
    allowed = f"less than {SATURATED:.0%} of it"
    inner = without_border(picture.values, picture.area)
    remedy = "take one that is not saturated"
    if inner != picture.area:
        remedy = f"leave out the border of one single grey with {inner.option}"
    require(ends < SATURATED, "darkest or brightest grey", f"{ends:.0%} of the picture", allowed,
            remedy)  # fmt: skip
    told = []
    if ends > TELL_SATURATED:
        told.append(caution("saturated_greys", fraction=ends))
    gaps = np.diff(greys) > GAP * (high - low)
    if gaps[0] or gaps[-1]:
        told.append(caution("isolated_grey"))
    drawn = float(np.mean(drawn_rows(values)))
    if drawn > DRAWN_ROWS:
        told.append(caution("plain_rows", fraction=drawn))
    if inner != picture.area:
        told.append(caution("plain_border", option=inner.option))
    bar = drawn_bar(values, picture.full_scale)
    if bar is not None:
        left, top = picture.area.left, picture.area.top
        place = PixelArea(left + bar.left, top + bar.top, left + bar.right, top + bar.bottom)
        told.append(caution("drawn_bar", place=str(place)))
    return told


def grey_ranges(picture: SurfaceImage, plane: Plane | None = None) -> list[tuple[str, Greys]]:
    """Return the grey levels of the lowest and the highest point, in each of three ways.

    Noise makes the range of single pixels wider than that of the surface, so that the first way
    takes the range of means over 5 × 5 pixels. The others are the range of single pixels and the
    range between two percentiles.

    Parameters
    ----------
    picture : SurfaceImage
        A grey picture.
    plane : Plane, optional
        Plane in grey levels that is subtracted first.

    Returns
    -------
    list of (str, (float, float))
        Name of the way (`SCALINGS`), and the two grey levels.

    References
    ----------
    docs/friction.md, "What is done".
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
    """Return the grey levels of the area minus those of a plane."""
    area = picture.area
    columns = np.arange(area.left, area.right)
    found = picture.surface.astype(np.float32)
    for row, values in enumerate(found, area.top):
        values -= plane.at(columns, float(row)).astype(np.float32)
    return found


def to_heights(
    values: Float[np.ndarray, "paths n"], height_range: float | None, greys: Greys
) -> Float[np.ndarray, "paths n"]:
    """Convert grey levels to heights.

    Parameters
    ----------
    values : array (paths, n)
        Grey levels, or heights in m.
    height_range : float or None
        Height of the highest point above the lowest in m; None if the values are heights already.
    greys : (float, float)
        Grey levels of the lowest and of the highest point.

    Returns
    -------
    array (paths, n)
        Heights in m.

    Raises
    ------
    BadInput
        Both grey levels are equal.

    References
    ----------
    docs/friction.md, "What is done".
    """
    if height_range is None:
        return values
    low, high = greys
    require(high > low, "picture", "flat", "of a rough surface")
    return height_range * (values - low) / (high - low)
