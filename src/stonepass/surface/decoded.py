"""A decoded picture of one or more channels, or of a palette, and the one channel of grey in it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from stonepass.array_types import Bool, Num
from stonepass.surface.surface_image import Area

__all__ = ["Decoded"]

COLOURED = 2  # grey levels of 255 by which channels may differ in a grey picture
ROWS = 512  # compared at a time


@dataclass(frozen=True, eq=False)
class Decoded:
    """Samples of a picture as the file has them.

    Attributes
    ----------
    values : array (rows, columns) or (rows, columns, samples)
        Unsigned numbers of 8 or 16 bits: grey, grey and alpha, colours, or colours and alpha; or
        places in the palette.
    palette : array (entries, 3) or None
        Colours, 8 bit.
    """

    values: Num[np.ndarray, "rows columns *samples"]
    palette: Num[np.ndarray, "entries 3"] | None = None

    @property
    def has_alpha(self) -> bool:
        """Whether the last channel says how opaque a pixel is."""
        return self.values.ndim == 3 and self.values.shape[2] in (2, 4)

    def grey(self) -> Num[np.ndarray, "rows columns"]:
        """The first channel, in native byte order; an equal one for each colour counts as one."""
        if self.palette is not None:
            return self._look_up(np.ascontiguousarray(self.palette[:, 0]))
        values = self.values if self.values.ndim == 2 else self.values[..., 0]
        return np.ascontiguousarray(values, values.dtype.newbyteorder("="))

    def coloured(self, area: Area) -> tuple[int, int] | None:
        """Column and row of the first pixel of an area that is not grey; None where all are."""
        for start in range(area.top, area.bottom, ROWS):
            rows = slice(start, min(start + ROWS, area.bottom))
            spots = self._is_coloured(self.values[rows, area.left : area.right])
            if spots is not None and spots.any():
                row, column = np.unravel_index(int(np.argmax(spots)), spots.shape)
                return area.left + int(column), start + int(row)
        return None

    def _look_up(self, entries: Num[np.ndarray, " entries"]) -> Num[np.ndarray, "rows columns"]:
        found = np.zeros(self.values.shape[:2], entries.dtype)
        for start in range(0, len(found), ROWS):  # indices take eight bytes each
            found[start : start + ROWS] = entries[self.values[start : start + ROWS]]
        return found

    def _is_coloured(
        self, values: Num[np.ndarray, "rows columns *samples"]
    ) -> Bool[np.ndarray, "rows columns"] | None:
        """Whether each pixel is coloured; None where none can be."""
        if self.palette is not None:
            return (np.ptp(self.palette.astype(int), axis=1) > COLOURED)[values]
        if values.ndim == 2 or values.shape[2] < 3:
            return None
        full = int(np.iinfo(values.dtype).max)
        red, green, blue = (values[..., channel] for channel in range(3))
        brightest = np.maximum(np.maximum(red, green), blue)
        darkest = np.minimum(np.minimum(red, green), blue)
        return brightest - darkest > COLOURED * (full // 255)
