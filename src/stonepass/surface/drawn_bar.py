"""Detection of a scale bar that is drawn into a picture: a filled rectangle of white or black."""

from __future__ import annotations

import numpy as np

from stonepass.array_types import Num
from stonepass.surface.surface_image import PixelArea

__all__ = ["drawn_bar"]

FEWEST = 100  # smallest number of pixels of a bar
THINNEST = 3  # smallest number of rows or columns of a bar
OBLONG = 3.0  # smallest ratio of its sides
FILLED = 0.9  # smallest part of its rectangle that has its grey; a saturated patch is rounder
ALIKE = 3  # largest difference from the extreme grey in levels of 255, as JPEG leaves it


def drawn_bar(values: Num[np.ndarray, "rows columns"], full_scale: int) -> PixelArea | None:
    """Return the largest bar of the darkest or of the brightest grey; None if there is none.

    Parameters
    ----------
    values : array (rows, columns)
        Grey levels.
    full_scale : int
        Largest possible grey level.

    Returns
    -------
    PixelArea or None
        Rows and columns of the bar in `values`.
    """
    from scipy.ndimage import find_objects, label

    tolerance = ALIKE * (full_scale // 255)
    found: list[tuple[int, PixelArea]] = []
    darkest, brightest = int(values.min()) + tolerance, int(values.max()) - tolerance
    for near in (values <= darkest, values >= brightest):
        marked, _ = label(near)
        counts, places = np.bincount(marked.ravel()), find_objects(marked)
        for number in np.flatnonzero(counts[1:] >= FEWEST) + 1:  # 0 is all that is not near
            rows, columns = places[number - 1]
            tall, wide = rows.stop - rows.start, columns.stop - columns.start
            long, short = max(tall, wide), min(tall, wide)
            filled = counts[number] >= FILLED * tall * wide
            # A bar from side to side is a data bar or a border, which are found elsewhere.
            inside = tall < len(values) and wide < values.shape[1]
            if filled and inside and short >= THINNEST and long >= OBLONG * short:
                area = PixelArea(columns.start, rows.start, columns.stop, rows.stop)
                found.append((int(counts[number]), area))
    return max(found, key=lambda each: each[0])[1] if found else None
