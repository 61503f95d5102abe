"""Lost points and spikes of height maps, which are treated as missing heights.

Some instruments store 0 or another constant where they measured no height, and single points may be
wrong by any amount. Two kinds of such heights are recognised, which no flank, step or groove has:

1. *Constants.* The lowest or the highest value occurs repeatedly, lies far from all other heights,
   and is that of many separate patches, of single points, or exactly 0, or it is farther away than
   any surface is high.
2. *Spikes.* A height lies far outside those of the 24 points around it, which agree with each other
   much better; one further spike among these is allowed. Other heights with the exact value of
   several spikes are lost points too, if no other value is nearly as frequent.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from stonepass.array_types import Bool, Float, Int
from stonepass.caution import Caution, caution
from stonepass.errors import require
from stonepass.surface.surface_image import SurfaceImage

__all__ = ["lost_points", "without_lost_points"]

REPEATED = 3  # least number of equal heights that are a constant
FAR = 10.0  # least distance of a constant from other heights, in their standard deviations
HIGHEST = 1e-2  # largest height range of a surface in m
PATCHES = 8  # least number of separate patches of a constant
POINT = 9  # largest number of points of a patch that counts as a single point
REACH = 2  # a spike is compared with the points up to so many pixels away
STEEP = 10.0  # least height of a spike in standard deviations of the differences over REACH pixels
ALONE = 3.0  # least height of a spike above the points around it, divided by their range
FREQUENT = 10  # least frequency of the value of several spikes, divided by that of any other value
AROUND = 12  # least number of known heights around a spike
MOST = 0.1  # largest fraction of the heights that may be lost
STATISTICS = 1_000_000  # number of points from which medians are computed
ROWS = 512  # number of rows that are processed at a time, to limit the memory
NORMAL = 1.4826  # standard deviation of a normal distribution, divided by its MAD
MICRO = 1e6  # µm per m


def without_lost_points(picture: SurfaceImage) -> tuple[SurfaceImage, list[Caution]]:
    """Return a picture whose lost points and spikes are missing heights, and a warning about them.

    A picture of grey levels, or a map without such points, is returned unchanged.

    Raises
    ------
    BadInput
        More than a tenth of the heights of the area are lost.

    References
    ----------
    docs/friction.md, "Which files it reads".
    """
    if not picture.has_heights:
        return picture, []
    lost = lost_points(picture.surface)
    count = int(np.count_nonzero(lost))
    if count == 0:
        return picture, []
    values = picture.surface[lost]
    ends = sorted({f"{float(end) * MICRO:.4g}" for end in (values.min(), values.max())}, key=float)
    shown = f"{' to '.join(ends)} µm"
    fraction = count / max(int(np.count_nonzero(np.isfinite(picture.surface))), 1)
    require(
        fraction <= MOST,
        "height map",
        f"{shown} at {fraction:.0%} of its points, as if no height was measured there",
        f"without such points at more than {MOST:.0%}",
        "leave them out with --area or store them as missing heights",
    )
    area, known = picture.area, picture.values.copy()
    known[area.top : area.bottom, area.left : area.right][lost] = np.nan
    return replace(picture, values=known), [caution("lost_points", count=count, heights=shown)]


def lost_points(values: Float[np.ndarray, "rows columns"]) -> Bool[np.ndarray, "rows columns"]:
    """Return where the heights of a map (m; NaN if missing) are lost points or spikes."""
    lost = np.zeros(values.shape, bool)
    known = -1
    while known < (known := int(np.count_nonzero(lost))):  # one may hide another
        for end in (np.fmin, np.fmax):
            _mark_constant(values, lost, end)
        _mark_spikes(values, lost)
    return lost


def _mark_constant(
    values: Float[np.ndarray, "rows columns"],
    lost: Bool[np.ndarray, "rows columns"],
    end: np.ufunc,
) -> None:
    """Mark the points with the lowest or the highest value if it is a constant of lost points."""
    from scipy.ndimage import label

    others = ~lost & np.isfinite(values)
    if not others.any():
        return
    constant = float(end.reduce(values, axis=None, where=others, initial=np.nan))
    same = values == constant
    count = int(np.count_nonzero(same))
    others &= ~same
    if count < REPEATED or not others.any():
        return
    nearest = float(end.reduce(values, axis=None, where=others, initial=np.nan))
    distance = abs(nearest - constant)
    step = 1 + values.size // STATISTICS
    sample = values.ravel()[::step][others.ravel()[::step]]
    deviation = _deviation(sample)
    if not distance > FAR * deviation > 0.0:
        return
    patches = label(same, np.ones((3, 3), int))[0]
    sizes = np.bincount(patches[same])[1:]
    points = int(sizes[sizes <= POINT].sum())
    is_lost = constant == 0.0 or distance > HIGHEST or len(sizes) >= PATCHES or 2 * points > count
    if is_lost:
        lost |= same


def _deviation(values: Float[np.ndarray, " n"]) -> float:
    """Return the standard deviation from the median absolute deviation, which ignores outliers."""
    if len(values) == 0:
        return 0.0
    return NORMAL * float(np.median(np.abs(values - np.median(values))))


def _mark_spikes(
    values: Float[np.ndarray, "rows columns"], lost: Bool[np.ndarray, "rows columns"]
) -> None:
    """Mark the spikes, and the other points with the exact value of several spikes."""
    least = STEEP * max(_usual_difference(values), _usual_difference(values.T))
    if least == 0.0:  # at least half of the map is flat
        return
    found = np.zeros(values.shape, bool)
    for rows, columns in _candidates(values, lost, least):
        found[rows, columns] = _alone(values, lost, rows, columns, least)
    lost |= found
    heights, counts = np.unique(values[found], return_counts=True)
    for height in heights[counts >= REPEATED]:
        same = values == height
        others = np.unique(values[~same & np.isfinite(values)], return_counts=True)[1]
        if np.count_nonzero(same) > FREQUENT * others.max(initial=1):
            lost |= same


def _usual_difference(values: Float[np.ndarray, "rows columns"]) -> float:
    """Return the standard deviation of the differences between points REACH columns apart."""
    sampled = values[:: 1 + values.size // STATISTICS]
    differences = (sampled[:, REACH:] - sampled[:, :-REACH]).ravel()
    return _deviation(differences[np.isfinite(differences)])


def _candidates(
    values: Float[np.ndarray, "rows columns"], lost: Bool[np.ndarray, "rows columns"], least: float
) -> Iterator[tuple[Int[np.ndarray, " n"], Int[np.ndarray, " n"]]]:
    """Return the points that are far above or below those at their left and right."""
    for start in range(0, len(values), ROWS):
        part = values[start : start + ROWS].copy()
        part[lost[start : start + ROWS]] = np.nan
        beside = np.pad(part, ((0, 0), (REACH, REACH)), constant_values=np.nan)
        left, right = part - beside[:, : -2 * REACH], part - beside[:, 2 * REACH :]
        up = (np.fmin(left, right) > least) | (np.fmax(left, right) < -least)
        rows, columns = np.nonzero(up)
        yield rows + start, columns


def _alone(
    values: Float[np.ndarray, "rows columns"],
    lost: Bool[np.ndarray, "rows columns"],
    rows: Int[np.ndarray, " n"],
    columns: Int[np.ndarray, " n"],
    least: float,
) -> Bool[np.ndarray, " n"]:
    """Return which points lie far outside the heights around them."""
    offsets = [
        (down, across)
        for down in range(-REACH, REACH + 1)
        for across in range(-REACH, REACH + 1)
        if (down, across) != (0, 0)
    ]
    down, across = np.array(offsets).T
    near_rows, near_columns = rows[:, None] + down, columns[:, None] + across
    inside = (near_rows >= 0) & (near_rows < values.shape[0])
    inside &= (near_columns >= 0) & (near_columns < values.shape[1])
    near_rows, near_columns = np.where(inside, near_rows, 0), np.where(inside, near_columns, 0)
    known = inside & ~lost[near_rows, near_columns]
    around = np.sort(np.where(known, values[near_rows, near_columns], np.nan), axis=1)  # NaN last
    count = np.count_nonzero(np.isfinite(around), axis=1)
    # One further spike, the lowest or the highest of the points around, is left out.
    low = around[:, 1]
    high = np.take_along_axis(around, np.maximum(count - 2, 0)[:, None], axis=1)[:, 0]
    own = values[rows, columns]
    height = np.maximum(own - high, low - own)
    return (count >= AROUND) & (height > least) & (height > ALONE * (high - low))
