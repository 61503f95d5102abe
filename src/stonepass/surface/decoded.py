"""A decoded picture with one or more channels or a palette, and its grey channel."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from stonepass.array_types import Bool, Num
from stonepass.surface.surface_image import PixelArea

__all__ = ["Decoded"]

COLOURED = 2  # largest difference of the channels of a grey pixel, in levels of 255
SMALLEST_PART = 0.5  # smallest part of an area that is proposed in its place
ROWS = 512  # number of rows that are processed at a time, to limit the memory


@dataclass(frozen=True, eq=False)
class Decoded:
    """The samples of a picture as they are stored in the file.

    Attributes
    ----------
    values : array (rows, columns) or (rows, columns, samples)
        Unsigned integers of 8 or 16 bits. The samples of a pixel are grey, grey and alpha, red,
        green and blue, or these and alpha. With a palette the values are indices into it.
    palette : array (entries, 3) or None
        Red, green and blue of each entry, 0 to 255; None without a palette.
    """

    values: Num[np.ndarray, "rows columns *samples"]
    palette: Num[np.ndarray, "entries 3"] | None = None

    @property
    def has_alpha(self) -> bool:
        """True if the last channel is alpha, the opacity of the pixel."""
        return self.values.ndim == 3 and self.values.shape[2] in (2, 4)

    def grey(self) -> Num[np.ndarray, "rows columns"]:
        """Return the first channel in native byte order.

        In a grey picture that was saved in colour all three colour channels are equal.
        """
        if self.palette is not None:
            return self._look_up(np.ascontiguousarray(self.palette[:, 0]))
        values = self.values if self.values.ndim == 2 else self.values[..., 0]
        return np.ascontiguousarray(values, values.dtype.newbyteorder("="))

    def coloured(self, area: PixelArea) -> tuple[int, int] | None:
        """Return column and row of the first coloured pixel of an area; None if all are grey."""
        for start in range(area.top, area.bottom, ROWS):
            rows = slice(start, min(start + ROWS, area.bottom))
            spots = self._is_coloured(self.values[rows, area.left : area.right])
            if spots is not None and spots.any():
                row, column = np.unravel_index(int(np.argmax(spots)), spots.shape)
                return area.left + int(column), start + int(row)
        return None

    def grey_part(self, area: PixelArea) -> PixelArea | None:
        """Return the largest part of an area without colours that has its full width or height.

        The result is None if this part is smaller than half of the area, e.g. in a photograph.
        """
        rows = np.zeros(area.bottom - area.top, bool)  # whether each row has a coloured pixel
        columns = np.zeros(area.right - area.left, bool)
        for start in range(0, len(rows), ROWS):
            chunk = self.values[area.top + start : area.bottom, area.left : area.right][:ROWS]
            spots = self._is_coloured(chunk)
            if spots is None:
                return area
            rows[start : start + ROWS] = spots.any(axis=1)
            columns |= spots.any(axis=0)
        top, bottom = _longest_run(~rows)
        left, right = _longest_run(~columns)
        tall, wide = (bottom - top) / len(rows), (right - left) / len(columns)
        if max(tall, wide) < SMALLEST_PART:
            return None
        if tall >= wide:
            return replace(area, top=area.top + top, bottom=area.top + bottom)
        return replace(area, left=area.left + left, right=area.left + right)

    def _look_up(self, entries: Num[np.ndarray, " entries"]) -> Num[np.ndarray, "rows columns"]:
        found = np.zeros(self.values.shape[:2], entries.dtype)
        for start in range(0, len(found), ROWS):  # NumPy converts the indices to eight bytes each
            found[start : start + ROWS] = entries[self.values[start : start + ROWS]]
        return found

    def _is_coloured(
        self, values: Num[np.ndarray, "rows columns *samples"]
    ) -> Bool[np.ndarray, "rows columns"] | None:
        """Return for each pixel whether it is coloured; None for a picture without colours."""
        if self.palette is not None:
            return (np.ptp(self.palette.astype(int), axis=1) > COLOURED)[values]
        if values.ndim == 2 or values.shape[2] < 3:
            return None
        full = int(np.iinfo(values.dtype).max)
        red, green, blue = (values[..., channel] for channel in range(3))
        brightest = np.maximum(np.maximum(red, green), blue)
        darkest = np.minimum(np.minimum(red, green), blue)
        return brightest - darkest > COLOURED * (full // 255)


def _longest_run(true: Bool[np.ndarray, " n"]) -> tuple[int, int]:
    """Return the begin and the end of the longest run of true values."""
    changes = np.flatnonzero(np.diff(np.concatenate([[False], true, [False]]).astype(np.int8)))
    if not changes.size:
        return 0, 0
    begins, ends = changes[::2], changes[1::2]
    longest = int(np.argmax(ends - begins))
    return int(begins[longest]), int(ends[longest])
