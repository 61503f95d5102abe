"""The element strip: the surface of the stone as a row of elements with prescribed displacements.

While an axisymmetric stone is pressed into the wall, all its points move radially, which is not the
motion of a rigid body. Therefore the input files describe the surface of the stone by elements with
prescribed displacements at all nodes.
"""

from __future__ import annotations

import numpy as np

from stonepass.array_types import Float
from stonepass.errors import require
from stonepass.export.grid import Grid, grid
from stonepass.fe.axisymmetric.profile import Profile
from stonepass.model.case import Case
from stonepass.model.seating import Seating

__all__ = ["CLEARANCE", "element_strip"]

CLEARANCE = 1e-3  # gap between strip and lumen at the start, in inner radii R_a
THICKNESS = 0.05  # thickness of the strip in inner radii
REACH = 1.6  # axial length of the strip divided by the guessed length of the contact
COLUMN = np.radians(2.0)  # largest angle of one element of the strip
SMALLEST_RADIUS = 0.02  # smallest radius of the strip at the start, in inner radii


def element_strip(
    case: Case,
    way: Seating,
    place: Profile,
    open_to: float,
    edges: tuple[float, float],
    whole: bool,
    column: float = COLUMN,
) -> tuple[Grid, Float[np.ndarray, "points 2"]]:
    """Return the element strip in its initial position and the displacements of its nodes.

    Parameters
    ----------
    case : Case
        Stone, ureter and load.
    way : Seating
        How the stone is seated in the wall.
    place : Profile
        Meridian of the stone in its final position, in inner radii.
    open_to : float
        Radius of the opening that the strip must fit into at the start, in inner radii. The largest
        radius of the strip is then smaller by `CLEARANCE`.
    edges : (float, float)
        Guessed axial positions z of the upstream and downstream contact edge, in inner radii.
    whole : bool
        True if the wall is the whole tube. For half a tube the strip starts a little beyond the
        plane of symmetry.
    column : float
        Largest angle of one element of the strip in rad.

    Returns
    -------
    strip : Grid
        The strip; the last line of its first index faces the wall.
    displacement : array (points, 2)
        Displacement r, z of each node over both steps, in inner radii.

    Raises
    ------
    BadInput
        The strip would begin closer to the axis than 0.02 inner radii.

    References
    ----------
    docs/export.md, "What is in an input deck".
    """
    stretch, xi = case.load.prestretch, case.size_ratio
    start = open_to - CLEARANCE
    first, last = (_angle_at(place, REACH * stretch * edge) for edge in edges)
    if not whole:
        first = np.pi / 2.0 - 1.5 * column  # a little beyond the plane of symmetry
    count = int(np.ceil((last - first) / column))
    angles = np.linspace(first, last, count + 1)
    layers = np.array([1.0 - THICKNESS / xi, 1.0])

    def at_end(layer, angle):  # type: ignore[no-untyped-def]
        rho, z = case.stone.shape.meridian(angle)
        return xi * layer * rho, xi * layer * z

    end = grid(layers, angles, at_end)
    if way.kind == "growing":
        begin = end.points * (start / xi)
    else:
        begin = end.points - np.array([xi - start, 0.0])
    nearest = float(begin[:, 0].min())
    require(
        nearest >= SMALLEST_RADIUS,
        "size ratio",
        round(xi, 6),
        "small enough for the element strip of the stone to begin outside the axis",
        "use --seating growing, or a smaller stone",
    )
    return Grid(begin, end.cells, end.numbers), end.points - begin


def _angle_at(place: Profile, z: float) -> float:
    """Return the parametric angle at which the stone in its final position has the coordinate z."""
    tau = np.linspace(0.0, np.pi, 2001)
    return float(np.interp(z, place.radius * place.meridian(tau)[1], tau))
