"""A wedge of hexahedra: an axisymmetric grid swept through a small angle about the axis."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from stonepass.array_types import Float, Int
from stonepass.export.grid import Grid

__all__ = ["WEDGE", "Wedge"]

WEDGE = float(np.radians(2.0))  # angle of the wedge in rad


@dataclass(frozen=True)
class Wedge:
    """A wedge of hexahedra between a grid at angle 0 and its copy at the angle `WEDGE`.

    The nodes are numbered on the side at angle 0 first, then on the rotated side, then at the
    middles of the edges between corresponding corners.

    Attributes
    ----------
    grid : Grid
        Nodes and elements in the r–z plane.
    first : int
        Number of the first node.
    """

    grid: Grid
    first: int

    @cached_property
    def corners(self) -> Int[np.ndarray, " corners"]:
        """Indices of the nodes of the grid that are corners of elements."""
        return np.unique(self.grid.cells[:, :4])

    @property
    def count(self) -> int:
        """Number of nodes."""
        return 2 * len(self.grid.points) + len(self.corners)

    @cached_property
    def sides(self) -> tuple[Int[np.ndarray, " points"], ...]:
        """Node numbers at angle 0, on the rotated side, and halfway between, for each grid node.

        A mid-side node of the grid has no node halfway; the third array contains −1 for it.
        """
        n = len(self.grid.points)
        halfway = np.full(n, -1)
        halfway[self.corners] = self.first + 2 * n + np.arange(len(self.corners))
        return self.first + np.arange(n), self.first + n + np.arange(n), halfway

    def turned(self, vectors: Float[np.ndarray, "points 2"]) -> Float[np.ndarray, "nodes 3"]:
        """Rotate vectors with the components r, z at the nodes of the grid.

        Returns
        -------
        array (nodes, 3)
            Components x, y, z at every node of the wedge.
        """
        parts = []
        for angle, (r, z) in (
            (0.0, vectors.T),
            (WEDGE, vectors.T),
            (WEDGE / 2.0, vectors[self.corners].T),
        ):
            parts.append(np.column_stack([r * np.cos(angle), r * np.sin(angle), z]))
        return np.vstack(parts)

    def elements(self) -> Int[np.ndarray, "cells 20"]:
        """Return the node numbers of the 20-node hexahedra (hex20).

        The rotated side is the bottom of each element, since e_r × e_z = −e_θ.
        """
        flat, turned, halfway = (side[self.grid.cells] for side in self.sides)
        parts = (turned[:, :4], flat[:, :4], turned[:, 4:], flat[:, 4:], halfway[:, :4])
        return np.hstack(parts)

    def faces(
        self, cells: Int[np.ndarray, "faces 8"], start: int, end: int, middle: int
    ) -> Int[np.ndarray, "faces 8"]:
        """Return the eight-node faces (quad8) that one side of each element sweeps.

        The normal of a face is the cross product of the direction from `start` to `end` with e_θ.

        Parameters
        ----------
        cells : array (faces, 8)
            Grid nodes of the elements.
        start, end, middle : int
            Positions in `cells`, 0 to 7, of the two corners and of the middle of the side.
        """
        a, b, m = cells[:, start], cells[:, end], cells[:, middle]
        flat, turned, halfway = self.sides
        around = (flat[a], flat[b], turned[b], turned[a], flat[m], halfway[b], turned[m])
        return np.column_stack([*around, halfway[a]])

    def inner(self, columns: slice) -> Int[np.ndarray, "faces 8"]:
        """Return the faces on the inner side of the first row; normals point towards the axis."""
        return self.faces(self.grid.cells[: self.grid.columns][columns], 0, 3, 7)

    def outer(self) -> Int[np.ndarray, "faces 8"]:
        """Return the faces on the outer side of the last row; normals point away from the axis."""
        return self.faces(self.grid.cells[-self.grid.columns :], 2, 1, 5)

    def on(self, line: Int[np.ndarray, " nodes"]) -> Int[np.ndarray, " numbers"]:
        """Return the numbers of all nodes that a line of the grid sweeps, in ascending order."""
        numbers = np.concatenate([side[line] for side in self.sides])
        return np.sort(numbers[numbers >= 0])
