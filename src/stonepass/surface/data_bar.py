"""Detection of data bars, the rows with text and a scale that a microscope adds to a micrograph.

In a row of a data bar at least half of the pixels have one grey level, the background of the bar,
or nearly all pixels have one of three grey levels, the backgrounds of its cells. The frame and the
letters take the other pixels. The grey levels of a row of the surface vary more, unless the picture
has almost no contrast.
"""

from __future__ import annotations

import numpy as np

from stonepass.array_types import Bool, Float, Num

__all__ = ["HIGHEST", "drawn_rows", "find_bar"]

# JPEG compression spreads the grey level of a background over neighbouring levels. Levels that
# differ from it by at most 1/LIKE of the range of the picture, but not by more than LIKE_MOST
# levels, are therefore counted as the same background.
LIKE = 64
LIKE_MOST = 2
BINS = 256  # number of grey levels that are distinguished
GREYS = 3  # largest number of backgrounds of the cells of a bar
# A row is "drawn" if at least the first fraction of its pixels have its most frequent grey level,
# or at least the second fraction have one of its three most frequent levels.
DRAWN = (0.5, 0.85)
SURFACE = (0.3, 0.5)  # largest mean values of these two fractions in the rows next to a bar
ROWS_DRAWN = 0.75  # least fraction of drawn rows in a bar; large letters hide some backgrounds
THINNEST = 6  # smallest height of a bar in rows
HIGHEST = 0.4  # largest height of a bar, or of a border, as a fraction of the picture
BESIDE = 8  # least number of rows next to a bar that are examined
EDGE = slice(2, 6)  # rows next to a bar that must be surface; JPEG blurs the first two


def drawn_rows(values: Num[np.ndarray, "rows columns"]) -> Bool[np.ndarray, " rows"]:
    """Return for each row whether one or three grey levels dominate it, as in a data bar."""
    return _drawn(_shares(values, int(values.min()), int(values.max())))


def find_bar(values: Num[np.ndarray, "rows columns"]) -> tuple[int, int]:
    """Return the heights of the data bars at the top and at the bottom of a grey picture.

    A bar consists of rows with few dominating grey levels, and the rows next to it must have the
    many grey levels of a surface. Its height is at most 40 % of that of the picture. A height of 0
    means that there is no bar.
    """
    low, high = int(values.min()), int(values.max())
    most = int(HIGHEST * len(values))
    top, bottom = (
        _rows_of_bar(_shares(edge, low, high)) for edge in (values[:most], values[::-1][:most])
    )
    return top, bottom


def _shares(
    values: Num[np.ndarray, "rows columns"], low: int, high: int
) -> Float[np.ndarray, "rows 2"]:
    """Return two fractions of the pixels of each row.

    The first is the fraction with the most frequent grey level of the row, the second the fraction
    with one of its three most frequent levels.
    """
    shift = max((high - low).bit_length() - (BINS - 1).bit_length(), 0)
    near = 0 if shift else min(LIKE_MOST, (high - low) // LIKE)
    shares = np.zeros((len(values), 2))
    for row, pixels in enumerate(values):
        counts = np.bincount((pixels - pixels.dtype.type(low)) >> shift, minlength=BINS)
        counts = np.convolve(counts, np.ones(2 * near + 1, int), "same")
        found = []
        for _ in range(GREYS):
            grey = int(counts.argmax())
            found.append(counts[grey])
            counts[max(grey - 2 * near, 0) : grey + 2 * near + 1] = 0
        shares[row] = found[0], sum(found)
    return shares / values.shape[1]


def _drawn(shares: Float[np.ndarray, "rows 2"]) -> Bool[np.ndarray, " rows"]:
    return np.any(shares >= DRAWN, axis=1)


def _rows_of_bar(shares: Float[np.ndarray, "rows 2"]) -> int:
    """Return the height of the bar that begins at the first row; 0 if there is none."""
    drawn = _drawn(shares)
    for rows in range(len(shares) - BESIDE, THINNEST - 1, -1):
        begins_here = drawn[rows - 1] and not drawn[rows]
        if not begins_here or drawn[:rows].mean() < ROWS_DRAWN:
            continue
        beside = shares[rows : rows + max(BESIDE, rows // 2)]
        if (np.maximum(beside.mean(axis=0), beside[EDGE].mean(axis=0)) <= SURFACE).all():
            return rows
    return 0
