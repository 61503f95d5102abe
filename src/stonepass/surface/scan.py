"""The pixel size and the data bar that a file declares for the original scan.

`pixel_size` reads these declarations of different microscopes. Here they are compared with the
stored picture. If the picture was resized or cropped after the scan, they no longer apply.
"""

from __future__ import annotations

from dataclasses import dataclass

from stonepass.surface.surface_image import possible_pixel

__all__ = ["NO_SCAN", "Pixel", "Scan"]

Pixel = tuple[float, float]  # width and height in m
MICRO = 1e6  # µm per m


@dataclass(frozen=True)
class Scan:
    """Declarations about the scan in the file of a picture, or in a text file next to it.

    Attributes
    ----------
    source : str
        Origin of the declarations, e.g. "FEI tag"; empty if there are none.
    pixel : (float, float) or None
        Width and height of a pixel of the scan in m; None if they are not declared.
    columns, rows : int or None
        Size of the scan in pixels; None if it is not declared.
    bar : int
        Height of the data bar at the lower end in rows; 0 if none is declared.
    doubt : str
        Reason why a declared pixel size is not used; empty if it is used.
    """

    source: str = ""
    pixel: Pixel | None = None
    columns: int | None = None
    rows: int | None = None
    bar: int = 0
    doubt: str = ""

    def same_width(self, columns: int) -> bool:
        """Return whether a picture has the width of the scan, or the scan declares no width."""
        return self.columns is None or self.columns == columns

    def rows_of_bar(self, columns: int, rows: int) -> int:
        """Return the height in rows of the declared data bar; 0 if none is declared.

        Parameters
        ----------
        columns, rows : int
            Size of the stored picture in pixels.
        """
        if not self.same_width(columns):
            return 0
        if self.bar or self.rows is None:
            return self.bar
        return max(rows - self.rows, 0)

    def pixel_for(self, columns: int) -> tuple[Pixel | None, str]:
        """Return the pixel size of a picture with so many columns, or why it cannot be used.

        Returns
        -------
        pixel : (float, float) or None
            Width and height in m; None if no size is declared or the size cannot be used.
        why : str
            Reason why a declared size cannot be used, otherwise empty.
        """
        if self.pixel is None:
            return None, self.doubt
        width = self.pixel[0] * MICRO
        if not possible_pixel(self.pixel):
            return (
                None,
                f"the {self.source} says {width:.4g} µm, which is outside the accepted range",
            )
        if self.same_width(columns):
            return self.pixel, ""
        assert self.columns is not None
        resized = width * self.columns / columns
        return None, (
            f"the {self.source} says {width:.4g} µm for a picture {self.columns} pixels wide, but "
            f"this one is {columns} wide: give {resized:.4g}um if it was resized as a whole, or "
            f"{width:.4g}um if it was cropped"
        )


NO_SCAN = Scan()
