"""The inner wall at the Gauss–Lobatto points of its edges: reading and setting of values."""

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

TOUCHES = 1e-6  # of the largest contact force, at a point in contact


@dataclass(frozen=True, eq=False)
class InnerWall:
    """Values at the Gauss–Lobatto points of the inner wall's edges, sorted along the axis.

    Attributes
    ----------
    station : array (edges, points)
        Reference coordinate Z, in inner radii.
    r, z : arrays (edges, points)
        Deformed coordinates, in inner radii.
    normal, tangential : arrays (edges, points)
        Contact force per reference area, in units of the modulus.
    weight : array (edges, points)
        Weights that integrate over Z.
    """

    station: Float[np.ndarray, "edges points"]
    r: Float[np.ndarray, "edges points"]
    z: Float[np.ndarray, "edges points"]
    normal: Float[np.ndarray, "edges points"]
    tangential: Float[np.ndarray, "edges points"]
    weight: Float[np.ndarray, "edges points"]


def inner_wall(d: Discretisation, part: str = INNER) -> InnerWall:
    """Read the inner wall, or only the boundaries named in `part`, from the current state."""
    at = d.mesh.MapToAllElements({ng.SEGM: d.rule}, d.mesh.Boundaries(part))
    per_edge = (-1, d.order + 1)
    Z = ng.y(at).reshape(per_edge)
    edges = np.argsort(Z.mean(axis=1))
    along = np.argsort(Z[edges[0]])  # an edge may run against the axis

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
    """First and last station of the inner wall with contact force, in inner radii.

    On a half the first is the mirror image of the last. None where nothing touches.
    """
    wall = inner_wall(d)
    touching = wall.station[wall.normal > TOUCHES * wall.normal.max()]
    if not touching.size:
        return None
    last = float(touching.max())
    return (float(touching.min()) if d.whole else -last), last


def set_at_nodes(target: Any, function: Any, d: Discretisation) -> None:
    """Set a function on the inner wall to the values of `function` at all Gauss–Lobatto points.

    Parameters
    ----------
    target : ngsolve.GridFunction
        One of the contact forces of `d`, or a function of the space ``d.nodal[0]``.
    function : ngsolve.CoefficientFunction
    d : Discretisation
    """
    space, inverse, where = d.nodal
    target.vec.data = (
        inverse * ng.LinearForm(function * space.TestFunction() * where).Assemble().vec
    )


def piecewise_linear(
    station: Float[np.ndarray, "..."], values: Float[np.ndarray, "..."]
) -> ng.CoefficientFunction:
    """Symbolic function of Z that is linear between the given stations.

    Parameters
    ----------
    station, values : arrays of equal shape
        Where a station is given twice, as at the end of an edge, its first value counts.
    """
    Z, first = np.unique(station, return_index=True)
    v = values.ravel()[first]
    knots = [Z[0], *Z, Z[-1]]
    return ng.BSpline(2, [float(k) for k in knots], [float(x) for x in v])(ng.y)
