"""Self-intersection: whether a solved wall passes through itself, or through the axis.

The only contact that the finite elements model is that with the stone. A wall that has folded, or a
lumen that has closed, would touch itself, so such a state is not that of a real tube.
"""

from __future__ import annotations

import numpy as np

from stonepass.array_types import Bool, Float
from stonepass.fe.axisymmetric.equilibrium import EquilibriumState
from stonepass.fe.axisymmetric.inner_wall import inner_wall

__all__ = ["crossing", "self_contact"]

OUTER_POINTS = 6  # per column
NUDGE = 1e-12
ROUNDING = 1e-9  # of z at the middle, where symmetry makes it 0


def self_contact(solved: EquilibriumState) -> float | None:
    """Where the inner or outer wall meets itself, the axis, or the other half of the tube.

    Returns
    -------
    float or None
        Station Z, in inner radii; None where nothing meets. Where a half is solved, the other half
        of the tube is its mirror image.
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
    """First segment of a polyline that crosses a later segment which is not its neighbour.

    Parameters
    ----------
    r, z : arrays (n,)
        Coordinates of the vertices.

    Returns
    -------
    int or None
        ``crossing`` of (0,0), (2,0), (2,2), (1,-1) is 0: the last segment cuts the first. None
        where nothing crosses.
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
    """Whether p and q lie on different sides of the line through a and b."""

    def side(x: Float[np.ndarray, "n 2"]) -> Float[np.ndarray, " n"]:
        along, across = b - a, x - a
        return along[:, 0] * across[:, 1] - along[:, 1] * across[:, 0]

    return side(p) * side(q) < 0.0


def _outer(
    solved: EquilibriumState,
) -> tuple[Float[np.ndarray, " n"], Float[np.ndarray, " n"], Float[np.ndarray, " n"]]:
    """Station, r and z of points of the outer wall."""
    lines = solved.layout.axial
    share = np.arange(OUTER_POINTS) / OUTER_POINTS
    Z = np.append((lines[:-1, None] + np.diff(lines)[:, None] * share).ravel(), lines[-1])
    u, w, *_ = solved.discretisation.fields
    radius = solved.layout.radial[-1]
    # Slightly inside the mesh, because a point on its boundary may not be found in it.
    at = solved.discretisation.mesh(np.full_like(Z, radius - NUDGE), Z * (1.0 - NUDGE))
    return Z, radius + u(at).ravel(), Z + w(at).ravel()
