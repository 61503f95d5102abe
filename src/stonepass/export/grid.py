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
    """Eight-node quadrilaterals on grid lines, rows (first index) by columns.

    Attributes
    ----------
    points : array
        r, z of every node.
    cells : array
        Nodes of every element, from 0: corners anticlockwise, then the middles of the sides in the
        same order. Elements run along a row, then to the next.
    numbers : array
        Node on each line of corners or middles, −1 where there is none (centres of elements).
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
        """Return the nodes along the first (0) or last (−1) line of the first index."""
        return self.numbers[index]

    def column_line(self, index: int) -> Int[np.ndarray, " nodes"]:
        """Return the nodes along the first (0) or last (−1) line of the second index."""
        return self.numbers[:, index]


def grid(
    across: Float[np.ndarray, " rows_1"],
    along: Float[np.ndarray, " columns_1"],
    place: Callable[[Values, Values], tuple[Values, Values]] = lambda a, b: (a, b),
) -> Grid:
    """Return the grid with corner lines at `across` × `along` and middle nodes halfway between.

    Parameters
    ----------
    across, along : arrays
        Coordinates of the corner lines, ascending.
    place : callable
        Maps the two coordinates of nodes to r and z; by default they are r and z.

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
