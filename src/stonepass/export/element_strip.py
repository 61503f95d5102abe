"""The element strip: the stone's surface as a row of elements with a prescribed motion.

The points of an axisymmetric stone that is pressed into the wall move radially, which no rigid body
can do. So other programs get the surface of the stone as elements whose nodes are all moved.
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

CLEARANCE = 1e-3  # gap between strip and lumen at the start, over R_a
THICKNESS = 0.05  # over R_a
REACH = 1.6  # how far the strip goes, over the guessed contact
COLUMN = np.radians(2.0)  # angle of one element of the strip
SMALLEST_RADIUS = 0.02  # at the start, over R_a


def element_strip(
    case: Case,
    way: Seating,
    place: Profile,
    open_to: float,
    edges: tuple[float, float],
    whole: bool,
    column: float = COLUMN,
) -> tuple[Grid, Float[np.ndarray, "points 2"]]:
    """Return the element strip at its start and the displacement of each of its points.

    Parameters
    ----------
    case : Case
    way : Seating
        The way of the stone into the wall.
    place : Profile
        Meridian of the stone in its final place, in inner radii.
    open_to : float
        Radius that the strip leaves free at its start but for `CLEARANCE`, in inner radii.
    edges : (float, float)
        Guessed upstream and downstream edges of the contact, z in inner radii.
    whole : bool
        Whether the wall is the whole tube; otherwise the strip starts a little beyond the plane of
        symmetry.
    column : float
        Largest angle of one element of the strip, in rad.

    Returns
    -------
    Grid, array
        The strip, whose last row line faces the wall, and displacements r, z over both steps.

    Raises
    ------
    BadInput
        The strip would begin at or beyond the axis.
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
        "such that the element strip of the stone begins clear of the axis",
        "use --seating growing, or a smaller stone",
    )
    return Grid(begin, end.cells, end.numbers), end.points - begin


def _angle_at(place: Profile, z: float) -> float:
    """Parametric angle at which the stone in its final place has the axial coordinate z."""
    tau = np.linspace(0.0, np.pi, 2001)
    return float(np.interp(z, place.radius * place.meridian(tau)[1], tau))
