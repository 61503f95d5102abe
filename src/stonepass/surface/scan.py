"""The scan that a file describes: the size of a pixel, for which width, and a data bar.

Every microscope writes it in its own words (`pixel_size`); here it is compared with the picture as
it is stored. A picture that was made larger or smaller since keeps the words, not their meaning.
"""

from __future__ import annotations

from dataclasses import dataclass

from stonepass.surface.surface_image import possible_pixel

__all__ = ["NO_SCAN", "Pixel", "Scan"]

Pixel = tuple[float, float]  # width and height in m
MICRO = 1e6  # µm per m


@dataclass(frozen=True)
class Scan:
    """The description of a scan in the file, or in a text file beside it.

    Attributes
    ----------
    source : str
        Who says it, e.g. "FEI tag"; empty where nothing is said.
    pixel : tuple of float or None
        Width and height of a pixel in m.
    columns, rows : int or None
        Size in pixels of the scan that it holds for, where that is said.
    bar : int
        Rows of the picture's lower end that are said to be a data bar.
    doubt : str
        Why the pixel size is not taken, where it is said in a way that may be mistaken.
    """

    source: str = ""
    pixel: Pixel | None = None
    columns: int | None = None
    rows: int | None = None
    bar: int = 0
    doubt: str = ""

    def same_width(self, columns: int) -> bool:
        """Whether a picture of so many columns has the width that was scanned, as far as said."""
        return self.columns is None or self.columns == columns

    def rows_of_bar(self, columns: int, rows: int) -> int:
        """Rows at the lower end of a picture that are its data bar; 0 where nothing is said."""
        if not self.same_width(columns):
            return 0
        if self.bar or self.rows is None:
            return self.bar
        return max(rows - self.rows, 0)

    def pixel_for(self, columns: int) -> tuple[Pixel | None, str]:
        """The pixel of a picture of so many columns, and why it is not taken.

        Returns
        -------
        pixel : tuple of float or None
            None where nothing is said, or where it cannot be taken.
        why : str
            The sentence of a refusal; empty where the pixel is taken, or nothing is said.
        """
        if self.pixel is None:
            return None, self.doubt
        width = self.pixel[0] * MICRO
        if not possible_pixel(self.pixel):
            return None, f"the {self.source} says {width:.4g} µm, which is impossible"
        if self.same_width(columns):
            return self.pixel, ""
        assert self.columns is not None
        resized = width * self.columns / columns
        return None, (
            f"the {self.source} says {width:.4g} µm for a picture {self.columns} pixels wide, but "
            f"this one is {columns} wide: give {resized:.4g}um if it was resized as a whole, or "
            f"{width:.4g}um if it was cut"
        )


NO_SCAN = Scan()
