"""Detection of borders: outermost rows or columns of a picture that have one single grey.

Frames and margins that a program adds have a single grey and end abruptly. A smooth surface may
have rows or columns of one grey too, but it continues gradually from one to the next.
"""

from __future__ import annotations

import numpy as np

from stonepass.array_types import Bool, Num
from stonepass.surface.data_bar import HIGHEST
from stonepass.surface.surface_image import PixelArea

__all__ = ["without_border"]

# Grey levels that differ by at most this fraction of the range of the picture count as equal,
# because JPEG compression changes the grey of a border near the surface.
LIKE = 1 / 40
PLAIN = 0.9  # least fraction of the pixels of a line with the grey of the border
# A border differs from the next line by more than JUMP times the difference between the mean greys
# of neighbouring lines of the surface which only the fraction 1 - USUAL of these lines exceeds.
JUMP, USUAL = 3.0, 0.99


def without_border(values: Num[np.ndarray, "rows columns"], area: PixelArea) -> PixelArea:
    """Return the part of an area that remains without the borders at its four sides.

    Parameters
    ----------
    values : array (rows, columns)
        Grey levels of the whole picture.
    area : PixelArea
        The area in pixels.

    Returns
    -------
    PixelArea
        The area itself if it has no border.

    References
    ----------
    docs/friction.md, "Which files it reads".
    """
    while True:
        top, bottom = _lines(values[area.top : area.bottom, area.left : area.right])
        part = PixelArea(area.left, area.top + top, area.right, area.bottom - bottom)
        left, right = _lines(values[part.top : part.bottom, part.left : part.right].T)
        part = PixelArea(part.left + left, part.top, part.right - right, part.bottom)
        if part == area:
            return area
        area = part


def _lines(values: Num[np.ndarray, "lines n"]) -> tuple[int, int]:
    """Return the numbers of lines of the borders at the first and at the last line."""
    near = LIKE * (int(values.max()) - int(values.min()))
    runs = [_plain_lines(each, near) for each in (values, values[::-1])]
    most = HIGHEST * len(values)
    if not any(0 < run <= most for run in runs):
        return 0, 0
    means = values.mean(axis=1)[runs[0] : len(values) - runs[1]]
    allowed = JUMP * float(np.quantile(np.abs(np.diff(means)), USUAL)) if len(means) > 1 else 0.0
    first, last = (
        run if 0 < run <= most and _step(each, run) > max(allowed, near) else 0
        for run, each in zip(runs, (values, values[::-1]), strict=True)
    )
    return first, last


def _plain_lines(values: Num[np.ndarray, "lines n"], near: float) -> int:
    """Return how many lines, from the first on, have the grey of the first line."""
    grey = float(np.median(values[0]))
    for count, line in enumerate(values):
        if np.mean(_alike(line, grey, near)) < PLAIN:
            return count
    return len(values)


def _alike(line: Num[np.ndarray, " n"], grey: float, near: float) -> Bool[np.ndarray, " n"]:
    return np.abs(line.astype(float) - grey) <= near


def _step(values: Num[np.ndarray, "lines n"], count: int) -> float:
    """Return the mean difference in grey between the last line of a border and the next one."""
    inside, border = (values[line].astype(float) for line in (count, count - 1))
    return float(np.abs(inside - border).mean())
