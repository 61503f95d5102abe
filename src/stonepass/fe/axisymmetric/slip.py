"""Slip of the wall on the stone in one increment, and the energy that friction dissipates in it.

See "Friction and its path" in docs/theory.md.
"""

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
    """Return the slip origins of the last increment (see `friction`), as a function of Z."""
    spline = _origin_spline(start)
    return ng.BSpline(4, spline.t.tolist(), spline.c.tolist())(ng.y)


def last_dissipation(d: Discretisation, start: Start) -> float:
    """Return the energy dissipated in the last increment of a path.

    Parameters
    ----------
    d : Discretisation
        Its state is the end of the increment.
    start : Start
        Supplies the slip origins; without them there is no friction, and the result is zero.

    Returns
    -------
    float
        Energy in the meshed part of the tube, in units of modulus × inner radius³.
    """
    if start.origin is None:
        return 0.0
    wall = inner_wall(d, "closed")
    return dissipation(wall, d.arc.place, _origin_spline(start)(wall.station))


def dissipation(
    wall: InnerWall, place: Profile, origin: Float[np.ndarray, "edges points"]
) -> float:
    """Return the energy dissipated in one increment: −2π ∫ λ_t s R_a dZ, with the slip s.

    Parameters
    ----------
    wall : InnerWall
        The inner wall at the end of the increment.
    place : Profile
        The stone at the end of the increment.
    origin : array (edges, points)
        Slip origins: arc-length coordinates (`Profile.along`), dimensionless.

    Returns
    -------
    float
        Energy in the meshed part of the tube, in units of modulus × inner radius³.
    """
    slip = place.radius * (place.along(wall.r, wall.z) - origin)
    return float(-2.0 * np.pi * (wall.weight * wall.tangential * slip).sum())


def _origin_spline(start: Start) -> Any:
    """Return a cubic spline of the slip origins over Z; it is odd in Z on a half mesh."""
    assert start.origin is not None
    station, place = start.origin
    if not start.discretisation.whole:
        station = np.concatenate([-station[:0:-1], station])
        place = np.concatenate([-place[:0:-1], place])
    # Imported here because it loads most of SciPy, which only friction needs.
    from scipy.interpolate import make_interp_spline

    return make_interp_spline(station, place, k=3)
