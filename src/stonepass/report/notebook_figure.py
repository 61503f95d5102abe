"""Figures that a notebook displays as the value of a cell, whether or not pyplot was imported."""

from __future__ import annotations

import io

from matplotlib.figure import Figure

from stonepass.report.style import in_style

__all__ = ["NotebookFigure", "displayed"]

SCREEN = 96.0  # pixels per inch of a figure on the screen
SHARP = 2.0  # pixels of the image over pixels on the screen, for screens of high resolution


class NotebookFigure(Figure):
    """A figure of matplotlib with an image of its own for notebooks.

    A notebook displays a plain `Figure` as text until pyplot is imported, because pyplot registers
    the display of figures.
    """

    @in_style
    def _repr_png_(self) -> tuple[bytes, dict[str, int]]:
        """Return the image as PNG, and its width and height on the screen in pixels."""
        drawn = io.BytesIO()
        self.savefig(drawn, format="png", dpi=SHARP * SCREEN)
        width, height = (round(SCREEN * inches) for inches in self.get_size_inches())
        return drawn.getvalue(), {"width": width, "height": height}


def displayed(figure: Figure) -> NotebookFigure:
    """Return the same figure as one that a notebook displays."""
    figure.__class__ = NotebookFigure
    assert isinstance(figure, NotebookFigure)
    return figure
