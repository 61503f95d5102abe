"""Check that the wall of a solution does not pass through itself or through the axis.

The finite elements model the contact between wall and stone, but not contact of the wall with
itself. A solution in which the wall has folded onto itself, or in which the lumen has closed, is
therefore not a state of a real tube.
"""

from __future__ import annotations

import numpy as np

from stonepass.array_types import Bool, Float
from stonepass.fe.axisymmetric.equilibrium import EquilibriumState
from stonepass.fe.axisymmetric.inner_wall import inner_wall

__all__ = ["crossing", "self_contact"]

OUTER_POINTS = 6  # points of the outer wall in each column
NUDGE = 1e-12  # inward shift of a boundary point
ROUNDING = 1e-9  # rounding error of z in the plane of symmetry, where z is 0


def self_contact(solved: EquilibriumState) -> float | None:
    """Find where the inner or the outer wall intersects itself, the axis, or the other half.

    Returns
    -------
    float or None
        Station Z of an intersection, in inner radii; None if there is none. If only the half Z ≥ 0
        was solved, the wall must not cross the plane of symmetry.
    """
    wall = inner_wall(solved.discretisation)
    Z, first = np.unique(wall.station, return_index=True)
    r, z = wall.r.ravel()[first], wall.z.ravel()[first]
    if r.min() <= 0.0:
        return float(Z[np.argmin(r)])
    for station, radius, axial in ((Z, r, z), _outer(solved)):
        if not solved.layout.whole and axial.min() < -ROUNDING:
            return float(station[np.argmin(axial)])
        found = crossing(radius, axial)
        if found is not None:
            return float(station[found])
    return None


def crossing(r: Float[np.ndarray, " n"], z: Float[np.ndarray, " n"]) -> int | None:
    """Find the first segment of a polyline that crosses another segment.

    Neighbouring segments, which share a vertex, are not compared.

    Parameters
    ----------
    r, z : arrays (n,)
        Coordinates of the vertices, in any one unit of length.

    Returns
    -------
    int or None
        Index of the segment; None if no segments cross. For the vertices (0, 0), (2, 0), (2, 2),
        (1, −1) the result is 0, because the last segment crosses the first one.
    """
    if np.all(np.diff(z) > 0.0):
        return None
    start, end = np.column_stack([r, z])[:-1], np.column_stack([r, z])[1:]
    first, second = np.triu_indices(len(start), k=2)
    apart = _sides(start[first], end[first], start[second], end[second])
    hit = np.flatnonzero(apart & _sides(start[second], end[second], start[first], end[first]))
    return int(first[hit[0]]) if hit.size else None


def _sides(
    a: Float[np.ndarray, "n 2"],
    b: Float[np.ndarray, "n 2"],
    p: Float[np.ndarray, "n 2"],
    q: Float[np.ndarray, "n 2"],
) -> Bool[np.ndarray, " n"]:
    """Return True where p and q lie on different sides of the line through a and b."""

    def side(x: Float[np.ndarray, "n 2"]) -> Float[np.ndarray, " n"]:
        along, across = b - a, x - a
        return along[:, 0] * across[:, 1] - along[:, 1] * across[:, 0]

    return side(p) * side(q) < 0.0


def _outer(
    solved: EquilibriumState,
) -> tuple[Float[np.ndarray, " n"], Float[np.ndarray, " n"], Float[np.ndarray, " n"]]:
    """Return station, r and z of points of the outer wall."""
    lines = solved.layout.axial
    share = np.arange(OUTER_POINTS) / OUTER_POINTS
    Z = np.append((lines[:-1, None] + np.diff(lines)[:, None] * share).ravel(), lines[-1])
    u, w, *_ = solved.discretisation.fields
    radius = solved.layout.radial[-1]
    # The points lie slightly inside the mesh, because NGSolve may not find points on its boundary.
    at = solved.discretisation.mesh(np.full_like(Z, radius - NUDGE), Z * (1.0 - NUDGE))
    return Z, radius + u(at).ravel(), Z + w(at).ravel()
