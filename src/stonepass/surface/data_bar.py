"""Data bars: the rows of text and scale that a microscope draws under or over a micrograph.

A row of a bar has one grey, the bar's background, at half of its pixels or more, or three greys,
the backgrounds of its cells, at nearly all; frame and writing take the rest. A row of a surface has
not, unless the picture has next to no contrast.
"""

from __future__ import annotations

import numpy as np

from stonepass.array_types import Bool, Float, Num

__all__ = ["drawn_rows", "find_bar"]

LIKE = 64  # a grey counts as the background's within this fraction of the picture's greys,
LIKE_MOST = 2  # and two at most: what JPEG makes of one grey
BINS = 256  # greys that are told apart
GREYS = 3  # backgrounds of the cells of a bar
DRAWN = (0.5, 0.85)  # of a row, with its commonest grey and with the three commonest: as in a bar
SURFACE = (0.3, 0.5)  # the same of the rows beside a bar, at most
ROWS_DRAWN = 0.75  # of the rows of a bar, at least: large letters hide the background of some
THINNEST, HIGHEST = 6, 0.4  # rows; of the picture
BESIDE = 8  # least number of rows looked at beside a bar
EDGE = slice(2, 6)  # of them, where the surface must have begun; JPEG smears two rows


def drawn_rows(values: Num[np.ndarray, "rows columns"]) -> Bool[np.ndarray, " rows"]:
    """Whether each row of grey values is made of few greys, as those of a bar are."""
    return _drawn(_shares(values, int(values.min()), int(values.max())))


def find_bar(values: Num[np.ndarray, "rows columns"]) -> tuple[int, int]:
    """Numbers of rows at the top and at the bottom of a grey picture that are a data bar.

    A bar is found where it begins sharply: rows that are drawn beside rows that are not. At most
    40 % of the picture are taken for a bar.
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
    """Fractions of each row that have its commonest grey, and its three commonest."""
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
    """Height of the bar at the first of these rows; 0 where there is none."""
    drawn = _drawn(shares)
    for rows in range(len(shares) - BESIDE, THINNEST - 1, -1):
        begins_here = drawn[rows - 1] and not drawn[rows]
        if not begins_here or drawn[:rows].mean() < ROWS_DRAWN:
            continue
        beside = shares[rows : rows + max(BESIDE, rows // 2)]
        if (np.maximum(beside.mean(axis=0), beside[EDGE].mean(axis=0)) <= SURFACE).all():
            return rows
    return 0
