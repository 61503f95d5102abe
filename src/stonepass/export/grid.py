"""A structured grid of eight-node quadrilaterals in the r–z plane."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Float, Int

__all__ = ["Grid", "grid"]

Values = Float[np.ndarray, "..."]


@array_dataclass
@dataclass(frozen=True)
class Grid:
    """Eight-node quadrilaterals in rows (first index) and columns (second index).

    Attributes
    ----------
    points : array (points, 2)
        Coordinates r, z of the nodes, in the unit that the caller chose.
    cells : array (cells, 8)
        Nodes of each element, counted from 0: the corners anticlockwise, then the mid-side nodes in
        the same order. The elements are ordered row by row.
    numbers : array (lines_across, lines_along)
        Node at each crossing of the lines through corners and mid-side nodes; −1 at the centres of
        elements, which have no node.
    """

    points: Float[np.ndarray, "points 2"]
    cells: Int[np.ndarray, "cells 8"]
    numbers: Int[np.ndarray, "lines_across lines_along"]

    @property
    def rows(self) -> int:
        """Number of rows of elements."""
        return len(self.numbers) // 2

    @property
    def columns(self) -> int:
        """Number of columns of elements."""
        return self.numbers.shape[1] // 2

    def row_line(self, index: int) -> Int[np.ndarray, " nodes"]:
        """Return the nodes on the first (`index` 0) or last (−1) grid line along the rows."""
        return self.numbers[index]

    def column_line(self, index: int) -> Int[np.ndarray, " nodes"]:
        """Return the nodes on the first (`index` 0) or last (−1) grid line along the columns."""
        return self.numbers[:, index]


def grid(
    across: Float[np.ndarray, " rows_1"],
    along: Float[np.ndarray, " columns_1"],
    place: Callable[[Values, Values], tuple[Values, Values]] = lambda a, b: (a, b),
) -> Grid:
    """Return the grid with given lines through the corners and mid-side nodes halfway between.

    Parameters
    ----------
    across : array (rows + 1)
        First coordinate of the lines through the corners, ascending.
    along : array (columns + 1)
        Second coordinate of these lines, ascending.
    place : callable
        Function that maps arrays of both coordinates to r and z; by default the identity.

    Examples
    --------

    >>> grid(np.array([1.0, 2.0]), np.array([0.0, 1.0])).points.tolist()[:3]
    [[1.0, 0.0], [1.0, 0.5], [1.0, 1.0]]
    """
    a, b = np.meshgrid(_with_middles(across), _with_middles(along), indexing="ij")
    kept = np.ones(a.shape, dtype=bool)
    kept[1::2, 1::2] = False
    numbers = np.where(kept, np.cumsum(kept).reshape(a.shape) - 1, -1)
    r, z = place(a[kept], b[kept])
    i, j = (2 * index.ravel() for index in np.indices((len(across) - 1, len(along) - 1)))
    around = ((0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1))
    cells = np.column_stack([numbers[i + di, j + dj] for di, dj in around])
    return Grid(np.column_stack([r, z]), cells, numbers)


def _with_middles(corners: Float[np.ndarray, " n"]) -> Float[np.ndarray, " m"]:
    lines = np.empty(2 * len(corners) - 1)
    lines[::2] = corners
    lines[1::2] = (corners[1:] + corners[:-1]) / 2.0
    return lines
