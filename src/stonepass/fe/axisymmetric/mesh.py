"""A structured mesh of the meridian section of the tube, with nodes that can be moved."""

from __future__ import annotations

from dataclasses import dataclass

import netgen.meshing as nm
import ngsolve as ng
import numpy as np

from stonepass.array_types import Float

__all__ = [
    "BOUNDARIES",
    "INNER",
    "Layout",
    "place",
    "structured_mesh",
]

# Boundaries of the inner wall, from upstream: "wet" before the contact, "wetted" in the contact up
# to the seal, "closed" in the rest of the contact, and "open" behind the contact. A mesh without a
# seal has no "wetted" boundary, and a half mesh has no "wet" one.
BOUNDARIES = ("wet", "wetted", "closed", "open", "outer", "middle", "end")
INNER = "wet|wetted|closed|open"


@dataclass(frozen=True, eq=False)
class Layout:
    """Grid lines of a structured mesh, and the assignment of its columns to boundaries.

    Attributes
    ----------
    radial : array (rows + 1,)
        Reference coordinates R in inner radii, increasing from 1 to the outer radius.
    axial : array (columns + 1,)
        Reference coordinates Z in inner radii, increasing.
    closed, wet, wetted : int
        Numbers of columns on the boundaries of these names. Along the axis the order is wet,
        wetted, closed; the remaining columns are open. If `wet` is zero, the grid covers the half
        Z ≥ 0, and Z = 0 is a plane of symmetry.
    """

    radial: Float[np.ndarray, rows + 1]
    axial: Float[np.ndarray, columns + 1]
    closed: int
    wet: int = 0
    wetted: int = 0

    @property
    def rows(self) -> int:
        """Number of element rows through the wall."""
        return len(self.radial) - 1

    @property
    def columns(self) -> int:
        """Number of element columns along the tube."""
        return len(self.axial) - 1

    @property
    def whole(self) -> bool:
        """True if the grid covers the whole tube."""
        return self.wet > 0

    @property
    def contact(self) -> tuple[float, float]:
        """Stations of the contact edges; on a half grid the first mirrors the last."""
        last = float(self.axial[self.wet + self.wetted + self.closed])
        return (float(self.axial[self.wet]) if self.whole else -last), last


def structured_mesh(layout: Layout) -> ng.Mesh:
    """Build a mesh of quadrilaterals on the grid lines, with the boundaries in `BOUNDARIES`."""
    mesh = nm.Mesh(dim=2)
    wall = mesh.AddRegion("wall", dim=2)
    side = {name: mesh.AddRegion(name, dim=1) for name in BOUNDARIES}
    rows, columns = layout.rows, layout.columns
    node = [
        [mesh.Add(nm.MeshPoint(nm.Pnt(r, z, 0.0))) for z in layout.axial] for r in layout.radial
    ]
    for i in range(rows):
        for j in range(columns):
            corners = [node[i][j], node[i + 1][j], node[i + 1][j + 1], node[i][j + 1]]
            mesh.Add(nm.Element2D(wall, corners))
    counts = {"wet": layout.wet, "wetted": layout.wetted, "closed": layout.closed}
    names = [name for name, count in counts.items() for _ in range(count)]
    names += ["open"] * (columns - len(names))
    for j, inner in enumerate(names):
        mesh.Add(nm.Element1D([node[0][j], node[0][j + 1]], index=side[inner]))
        mesh.Add(nm.Element1D([node[rows][j], node[rows][j + 1]], index=side["outer"]))
    first = side["end" if layout.wet else "middle"]
    for i in range(rows):
        mesh.Add(nm.Element1D([node[i][0], node[i + 1][0]], index=first))
        mesh.Add(nm.Element1D([node[i][columns], node[i + 1][columns]], index=side["end"]))
    return ng.Mesh(mesh)


def place(mesh: ng.Mesh, layout: Layout) -> None:
    """Move the nodes of a mesh to other grid lines.

    Parameters
    ----------
    mesh : ngsolve.Mesh
        A mesh from `structured_mesh`; it is changed in place.
    layout : Layout
        Grid lines with the numbers of rows and columns of the mesh.
    """
    radial, axial = np.meshgrid(layout.radial, layout.axial, indexing="ij")
    mesh.ngmesh.Coordinates()[:] = np.column_stack([radial.ravel(), axial.ravel()])
