"""Data bars: the rows of text and scale that a microscope draws under or over a micrograph.

A row of a bar has one grey, the bar's background, at half of its pixels or more; the frame and the
writing take the rest. A row of a surface has not, unless the picture has next to no contrast.
"""

from __future__ import annotations

import numpy as np

from stonepass.array_types import Bool, Int, Num

__all__ = ["drawn_rows", "find_bar"]

LIKE = 64  # a grey counts as the background's within this fraction of the picture's greys,
LIKE_MOST = 2  # and two at most: what JPEG makes of one grey
BACKGROUND = 0.5  # of a row, from which it counts as drawn
SURFACE = 0.3  # of the rows beside a bar, the largest fraction of one grey
DRAWN = 0.75  # of the rows of a bar, at least drawn: large letters hide the background of some
THINNEST, HIGHEST = 6, 0.4  # rows; of the picture
BESIDE = 8  # least number of rows looked at beside a bar
EDGE = slice(2, 6)  # of them, where the surface must have begun; JPEG smears two rows


def drawn_rows(values: Num[np.ndarray, "rows columns"], contrast: int) -> Bool[np.ndarray, " rows"]:
    """Whether each row has one grey at half of its pixels or more.

    Parameters
    ----------
    values : array (rows, columns)
        Grey values.
    contrast : int
        Brightest less darkest grey of the picture.
    """
    return _background(values, contrast)[0] >= BACKGROUND


def find_bar(values: Num[np.ndarray, "rows columns"]) -> tuple[int, int]:
    """Numbers of rows at the top and at the bottom of a grey picture that are a data bar.

    A bar is found where it begins sharply: rows that are drawn, mostly on one background, beside
    rows that are not. At most 40 % of the picture are taken for a bar.
    """
    contrast = int(values.max()) - int(values.min())
    most = int(HIGHEST * len(values))
    found = []
    for edge in (values[:most], values[::-1][:most]):
        share, grey = _background(edge, contrast)
        found.append(_rows_of_bar(share, grey, contrast))
    return found[0], found[1]


def _background(
    values: Num[np.ndarray, "rows columns"], contrast: int
) -> tuple[Num[np.ndarray, " rows"], Int[np.ndarray, " rows"]]:
    """Fraction of each row that has the grey of its median, and that grey.

    A grey that half of a row has is the row's median.
    """
    near = min(LIKE_MOST, contrast // LIKE)
    share, grey = np.zeros(len(values)), np.zeros(len(values), int)
    middle = values.shape[1] // 2
    for row, pixels in enumerate(values):
        grey[row] = np.partition(pixels, middle)[middle]
        share[row] = np.count_nonzero(np.abs(pixels.astype(np.int32) - grey[row]) <= near)
    return share / values.shape[1], grey


def _rows_of_bar(
    share: Num[np.ndarray, " rows"], grey: Int[np.ndarray, " rows"], contrast: int
) -> int:
    """Height of the bar at the first of these rows; 0 where there is none."""
    drawn = share >= BACKGROUND
    near = min(LIKE_MOST, contrast // LIKE)
    for rows in range(len(share) - BESIDE, THINNEST - 1, -1):
        begins_here = drawn[rows - 1] and not drawn[rows]
        if not begins_here or drawn[:rows].mean() < DRAWN:
            continue
        beside = share[rows : rows + max(BESIDE, rows // 2)]
        backgrounds = grey[:rows][drawn[:rows]]
        commonest = np.bincount(backgrounds).argmax()
        on_one = np.mean(np.abs(backgrounds - commonest) <= near) >= BACKGROUND
        if on_one and max(beside.mean(), beside[EDGE].mean()) <= SURFACE:
            return rows
    return 0
