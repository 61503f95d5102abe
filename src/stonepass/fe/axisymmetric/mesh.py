"""A structured mesh of the tube's meridian whose nodes can be moved without a new set-up."""

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

# The inner wall is "wet" upstream of the contact (also without a fluid), "wetted" in the contact up
# to the seal, "closed" in the rest of the contact (without a seal all of it), and "open" beyond.
BOUNDARIES = ("wet", "wetted", "closed", "open", "outer", "middle", "end")
INNER = "wet|wetted|closed|open"


@dataclass(frozen=True, eq=False)
class Layout:
    """Grid lines of a structured mesh, and the boundary to which each column of it belongs.

    Attributes
    ----------
    radial : array (rows + 1,)
        R in inner radii, from 1 to the outer radius.
    axial : array (columns + 1,)
        Z in inner radii, increasing.
    closed, wet, wetted : int
        Numbers of columns, see `BOUNDARIES`. Along the axis there are wet, wetted and closed
        columns, then open ones. Without wet columns Z = 0 is a plane of symmetry, and the grid
        covers the half Z ≥ 0.
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
        """Whether the grid has both halves of the tube."""
        return self.wet > 0

    @property
    def contact(self) -> tuple[float, float]:
        """Stations of the contact's edges; on a half the first is the mirror image of the last."""
        last = float(self.axial[self.wet + self.wetted + self.closed])
        return (float(self.axial[self.wet]) if self.whole else -last), last


def structured_mesh(layout: Layout) -> ng.Mesh:
    """Build quadrilaterals on `layout`, with the boundaries named in `BOUNDARIES`."""
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
    """Move the nodes of a mesh to a layout with the same numbers of rows and columns."""
    radial, axial = np.meshgrid(layout.radial, layout.axial, indexing="ij")
    mesh.ngmesh.Coordinates()[:] = np.column_stack([radial.ravel(), axial.ravel()])
