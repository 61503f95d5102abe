"""A wedge: an axisymmetric grid turned about the axis by a small angle, as hexahedra."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from stonepass.array_types import Float, Int
from stonepass.export.grid import Grid

__all__ = ["WEDGE", "Wedge"]

WEDGE = float(np.radians(2.0))  # angle of the wedge


@dataclass(frozen=True)
class Wedge:
    """A grid turned about the axis; node numbers start at `first`.

    Numbers go through the side at angle 0, then through the turned side, then through the middles
    of the edges between their corners.
    """

    grid: Grid
    first: int

    @cached_property
    def corners(self) -> Int[np.ndarray, " corners"]:
        """Nodes of the grid that are corners of its elements."""
        return np.unique(self.grid.cells[:, :4])

    @property
    def count(self) -> int:
        """Number of nodes."""
        return 2 * len(self.grid.points) + len(self.corners)

    @cached_property
    def sides(self) -> tuple[Int[np.ndarray, " points"], ...]:
        """Node numbers at angle 0, on the turned side, and halfway between.

        The last are −1 where the node of the grid is no corner.
        """
        n = len(self.grid.points)
        halfway = np.full(n, -1)
        halfway[self.corners] = self.first + 2 * n + np.arange(len(self.corners))
        return self.first + np.arange(n), self.first + n + np.arange(n), halfway

    def turned(self, vectors: Float[np.ndarray, "points 2"]) -> Float[np.ndarray, "nodes 3"]:
        """Return x, y, z of every node for points or displacements r, z of the grid."""
        parts = []
        for angle, (r, z) in (
            (0.0, vectors.T),
            (WEDGE, vectors.T),
            (WEDGE / 2.0, vectors[self.corners].T),
        ):
            parts.append(np.column_stack([r * np.cos(angle), r * np.sin(angle), z]))
        return np.vstack(parts)

    def elements(self) -> Int[np.ndarray, "cells 20"]:
        """Return the nodes of the elements (hex20).

        The turned side is the bottom, since e_r × e_z = −e_θ.
        """
        flat, turned, halfway = (side[self.grid.cells] for side in self.sides)
        parts = (turned[:, :4], flat[:, :4], turned[:, 4:], flat[:, 4:], halfway[:, :4])
        return np.hstack(parts)

    def faces(
        self, cells: Int[np.ndarray, "faces 8"], start: int, end: int, middle: int
    ) -> Int[np.ndarray, "faces 8"]:
        """Return the faces (quad8) on the side of each cell from corner `start` to corner `end`.

        Their normal is the direction from `start` to `end` times e_θ (cross product).
        """
        a, b, m = cells[:, start], cells[:, end], cells[:, middle]
        flat, turned, halfway = self.sides
        around = (flat[a], flat[b], turned[b], turned[a], flat[m], halfway[b], turned[m])
        return np.column_stack([*around, halfway[a]])

    def inner(self, columns: slice) -> Int[np.ndarray, "faces 8"]:
        """Return the faces of the first row; their normals point towards the axis."""
        return self.faces(self.grid.cells[: self.grid.columns][columns], 0, 3, 7)

    def outer(self) -> Int[np.ndarray, "faces 8"]:
        """Return the faces of the last row; their normals point away from the axis."""
        return self.faces(self.grid.cells[-self.grid.columns :], 2, 1, 5)

    def on(self, line: Int[np.ndarray, " nodes"]) -> Int[np.ndarray, " numbers"]:
        """Return the numbers of all nodes on a line of the grid, in ascending order."""
        numbers = np.concatenate([side[line] for side in self.sides])
        return np.sort(numbers[numbers >= 0])
