"""Slip of the wall on the stone in one increment, and the energy that friction dissipates in it."""

from __future__ import annotations

from typing import Any

import ngsolve as ng
import numpy as np

from stonepass.array_types import Float
from stonepass.fe.axisymmetric.discretisation import Discretisation
from stonepass.fe.axisymmetric.inner_wall import InnerWall, inner_wall
from stonepass.fe.axisymmetric.profile import Profile
from stonepass.fe.axisymmetric.start import Start

__all__ = ["dissipation", "last_dissipation", "slip_origin"]


def slip_origin(start: Start) -> Any:
    """Places on the arc from which the last increment slips, as a symbolic function of Z."""
    spline = _origin_spline(start)
    return ng.BSpline(4, spline.t.tolist(), spline.c.tolist())(ng.y)


def last_dissipation(d: Discretisation, start: Start) -> float:
    """Energy dissipated in the last increment of a path, in units of modulus × inner radius³.

    Zero without friction.
    """
    if start.origin is None:
        return 0.0
    wall = inner_wall(d, "closed")
    return dissipation(wall, d.arc.place, _origin_spline(start)(wall.station))


def dissipation(
    wall: InnerWall, place: Profile, origin: Float[np.ndarray, "edges points"]
) -> float:
    """Energy dissipated in one increment on the given wall: −2π ∫ λ_t s R_a dZ.

    Parameters
    ----------
    wall : InnerWall
        At the end of the increment.
    place : Profile
        The stone at the end of the increment.
    origin : array (edges, points)
        Places on the arc, arc length over the radius, from which the wall points slip.

    Returns
    -------
    float
        In units of modulus × inner radius³, for what the mesh covers.
    """
    slip = place.radius * (place.along(wall.r, wall.z) - origin)
    return float(-2.0 * np.pi * (wall.weight * wall.tangential * slip).sum())


def _origin_spline(start: Start) -> Any:
    """Cubic spline of the origins over Z; odd in Z where the mesh covers only a half."""
    assert start.origin is not None
    station, place = start.origin
    if not start.discretisation.whole:
        station = np.concatenate([-station[:0:-1], station])
        place = np.concatenate([-place[:0:-1], place])
    from scipy.interpolate import make_interp_spline  # most of SciPy, for friction alone

    return make_interp_spline(station, place, k=3)
