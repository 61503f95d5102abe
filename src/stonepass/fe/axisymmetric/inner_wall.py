"""Values on the inner wall at the Gauss–Lobatto points of its edges: reading and setting."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import ngsolve as ng
import numpy as np

from stonepass.array_types import Float
from stonepass.fe.axisymmetric.discretisation import Discretisation
from stonepass.fe.axisymmetric.mesh import INNER
from stonepass.fe.core.lobatto import lobatto

__all__ = ["InnerWall", "contact_edges", "inner_wall", "piecewise_linear", "set_at_nodes"]

TOUCHES = 1e-6  # smallest contact force of a point in contact, relative to the largest force


@dataclass(frozen=True, eq=False)
class InnerWall:
    """Values at the Gauss–Lobatto points of the inner wall's edges, sorted along the axis.

    Attributes
    ----------
    station : array (edges, points)
        Reference coordinate Z, in inner radii.
    r, z : arrays (edges, points)
        Deformed radial and axial coordinate, in inner radii.
    normal, tangential : arrays (edges, points)
        Normal (compression positive) and tangential (downstream positive) contact force per
        reference area, in units of the modulus.
    weight : array (edges, points)
        Quadrature weights for integration over Z, in inner radii.
    """

    station: Float[np.ndarray, "edges points"]
    r: Float[np.ndarray, "edges points"]
    z: Float[np.ndarray, "edges points"]
    normal: Float[np.ndarray, "edges points"]
    tangential: Float[np.ndarray, "edges points"]
    weight: Float[np.ndarray, "edges points"]


def inner_wall(d: Discretisation, part: str = INNER) -> InnerWall:
    """Evaluate the current state on the inner wall.

    Parameters
    ----------
    d : Discretisation
    part : str
        Names of boundaries of the inner wall, separated by ``|`` (`mesh.BOUNDARIES`); by default
        all of them.
    """
    at = d.mesh.MapToAllElements({ng.SEGM: d.rule}, d.mesh.Boundaries(part))
    per_edge = (-1, d.order + 1)
    Z = ng.y(at).reshape(per_edge)
    edges = np.argsort(Z.mean(axis=1))
    along = np.argsort(Z[edges[0]])  # NGSolve may orient an edge against the axis

    def values(function: Any) -> Float[np.ndarray, "edges points"]:
        return function(at).reshape(per_edge)[edges][:, along]

    Z = values(ng.y)
    return InnerWall(
        station=Z,
        r=1.0 + values(d.fields.u),
        z=Z + values(d.fields.w),
        normal=values(d.fields.normal),
        tangential=values(d.fields.tangential),
        weight=(Z[:, -1:] - Z[:, :1]) * lobatto(d.order)[1],
    )


def contact_edges(d: Discretisation) -> tuple[float, float] | None:
    """Return the first and the last station with contact force, in inner radii.

    On a half mesh the first station is the mirror image of the last one. The result is None if no
    point is in contact.
    """
    wall = inner_wall(d)
    touching = wall.station[wall.normal > TOUCHES * wall.normal.max()]
    if not touching.size:
        return None
    last = float(touching.max())
    return (float(touching.min()) if d.whole else -last), last


def set_at_nodes(target: Any, function: Any, d: Discretisation) -> None:
    """Interpolate `function` at all Gauss–Lobatto points of the inner wall.

    Parameters
    ----------
    target : ngsolve.GridFunction
        Receives the values: a contact-force field of `d`, or a function of the space
        ``d.nodal[0]``.
    function : ngsolve.CoefficientFunction
        The function to interpolate; it has the unit of `target`.
    d : Discretisation
    """
    space, inverse, where = d.nodal
    target.vec.data = (
        inverse * ng.LinearForm(function * space.TestFunction() * where).Assemble().vec
    )


def piecewise_linear(
    station: Float[np.ndarray, "..."], values: Float[np.ndarray, "..."]
) -> ng.CoefficientFunction:
    """Create an NGSolve function of Z that is linear between the given stations.

    Parameters
    ----------
    station : array
        Stations in inner radii, in any order.
    values : array
        Values at the stations, of the same shape. If a station occurs twice, as at the common node
        of two edges, its first value is used.
    """
    Z, first = np.unique(station, return_index=True)
    v = values.ravel()[first]
    knots = [Z[0], *Z, Z[-1]]
    return ng.BSpline(2, [float(k) for k in knots], [float(x) for x in v])(ng.y)
