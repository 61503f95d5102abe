"""Does the solved wall pass through itself, or through the axis?

The finite elements know of contact with the stone alone. A wall that has folded, or a lumen that
has closed, would touch itself; then the state found is none of a real tube.
"""

from __future__ import annotations

import numpy as np
from jaxtyping import Bool, Float

from stonepass.fe.axisymmetric.discrete import inner_wall
from stonepass.fe.axisymmetric.fitted_contact import Fitted

__all__ = ["crossing", "self_contact"]

OUTER_POINTS = 6  # per column
NUDGE = 1e-12
ROUNDING = 1e-9  # of z at the middle, where symmetry makes it 0


def self_contact(solved: Fitted) -> float | None:
    """Station Z/R_a where the inner or outer wall meets itself, the axis or its mirror image.

    None where it does not. Of a half tube the other half is the mirror image.
    """
    wall = inner_wall(solved.discrete)
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
    """First segment of a polyline that crosses a later one which is not its neighbour.

    ``crossing`` of (0,0), (2,0), (2,2), (1,-1) is 0: the last segment cuts the first.
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
    solved: Fitted,
) -> tuple[Float[np.ndarray, " n"], Float[np.ndarray, " n"], Float[np.ndarray, " n"]]:
    """Station, r and z of points of the outer wall."""
    lines = solved.layout.axial
    share = np.arange(OUTER_POINTS) / OUTER_POINTS
    Z = np.append((lines[:-1, None] + np.diff(lines)[:, None] * share).ravel(), lines[-1])
    u, w, *_ = solved.discrete.state.components
    radius = solved.layout.radial[-1]
    # A hair inside the mesh: a point on its boundary may not be found in it.
    at = solved.discrete.mesh(np.full_like(Z, radius - NUDGE), Z * (1.0 - NUDGE))
    return Z, radius + u(at).ravel(), Z + w(at).ravel()
