"""The path with friction: the arc moves in increments, wall points stick or slip on it.

Contact grows with the square root of the way, so t = s² with equal increments of s: each adds about
as much contact as the others. Wall points remember where they stuck. A point that comes into
contact within an increment starts from the place at which it touches, extrapolated from its free
motion in the increment before.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import ngsolve as ng
import numpy as np
from jaxtyping import Bool, Float

from stonepass.fe.axisymmetric.contact import Arc
from stonepass.fe.axisymmetric.contact_predictor import (
    SCOUT_ORDER,
    Start,
    contact_edges,
    scout_layout,
    wrap_round,
)
from stonepass.fe.axisymmetric.discrete import (
    Discrete,
    InnerWall,
    discretise,
    free_unknowns,
    inner_wall,
    set_at_nodes,
    wall_form,
)
from stonepass.fe.axisymmetric.friction import open_contact
from stonepass.fe.axisymmetric.mesh import INNER
from stonepass.fe.axisymmetric.problem import Failure, Path, Resolution, Tube, Wrap
from stonepass.fe.axisymmetric.profile import Profile
from stonepass.fe.core.newton import Plain, newton_or_homotopy

__all__ = ["FRICTION_WEIGHT", "WrapAt", "along_wall", "dissipation", "press"]

PATH_TOLERANCE = 1e-5  # of the contact force
FRICTION_WEIGHT = 8.0  # factor of gap and slip in the augmented forms, in units of the modulus
MARGIN = 1.15  # the equal columns reach this much beyond the frictionless contact edge
MOST_HALVINGS = 4
CARRIES = 1e-6  # share of the largest contact force that a point in contact carries at least

# The arc at a place to a first guess for it.
WrapAt = Callable[[Profile], Wrap]


@dataclass(frozen=True)
class _Moment:
    """The inner wall seen from the arc: gap, place along it, which points touch; the state."""

    t: float
    touching: Bool[np.ndarray, "edges points"]
    gap: Float[np.ndarray, "edges points"]
    along: Float[np.ndarray, "edges points"]
    state: Any


def press(
    tube: Tube, path: Path, wrap_at: WrapAt, frictionless: Start, resolution: Resolution
) -> Start | Failure:
    """Follow the path, from the unloaded wall that the arc just touches to the arc's last place.

    The mesh has equal columns to beyond the contact edges of the frictionless solution. An
    increment that does not converge is halved, down to 1/16 of its size.
    """
    first, last = frictionless.contact
    layout = scout_layout(
        tube,
        (MARGIN * first, MARGIN * last),
        resolution.path_columns,
        growth=1.7,
        whole=frictionless.discrete.whole,
    )
    d = discretise(tube, Arc.at(path.place(0.0)), layout, SCOUT_ORDER)
    origin = ng.GridFunction(d.nodal[0])
    system = Plain(_form(d, path, origin), d.state, free_unknowns(d, INNER, friction=True))
    before, now = None, _untouched(d, path)
    usual = step = 1.0 / resolution.increments
    s, steps, dissipated = 0.0, 0, 0.0
    while True:
        ahead = s + step if s + step < 1.0 - 1e-9 else 1.0
        t = ahead**2
        d.arc.move(path.place(t))
        touch = _touching_place(before or _rigid_motion(now, d, path, t), now, t)
        set_at_nodes(origin, along_wall(inner_wall(d).station, touch), d)
        _guess(d, before, now, t, path, wrap_at)
        tolerance = PATH_TOLERANCE * frictionless.force
        report = newton_or_homotopy(system, d.stiffening.Set, tolerance)
        steps += report.steps
        if not report.converged:
            step /= 2.0
            if step < 0.9 * usual / 2.0**MOST_HALVINGS:
                return Failure(f"at {now.t:.0%} of the path, {report.reason}", steps)
            continue
        wall = inner_wall(d)
        if t == 1.0:
            break
        dissipated += dissipation(wall, path.place(t), touch)
        before, now = now, _moment(t, wall, path, d)
        s, step = ahead, usual
    edges = contact_edges(d)
    if edges is None:
        return Failure("the wall left the stone", steps)
    stations, at = np.unique(wall.station, return_index=True)
    return Start(d, edges, frictionless.force, steps, (stations, touch.ravel()[at]), dissipated)


def dissipation(
    wall: InnerWall, place: Profile, origin: Float[np.ndarray, "edges points"]
) -> float:
    """Energy that friction took in one increment on the wall given: −2π ∫ λ_t slip R_a dZ."""
    slip = place.radius * (place.along(wall.r, wall.z) - origin)
    return float(-2.0 * np.pi * (wall.weight * wall.tangential * slip).sum())


def along_wall(
    station: Float[np.ndarray, "..."], values: Float[np.ndarray, "..."]
) -> ng.CoefficientFunction:
    """A function of Z, piecewise linear through values at stations (each exact)."""
    Z, first = np.unique(station, return_index=True)
    v = values.ravel()[first]
    knots = [Z[0], *Z, Z[-1]]
    return ng.BSpline(2, [float(k) for k in knots], [float(x) for x in v])(ng.y)


def _form(d: Discrete, path: Path, origin: Any) -> Any:
    space = d.state.space
    residual = open_contact(
        space.TrialFunction(), space.TestFunction(), d.arc, origin, path.friction, FRICTION_WEIGHT
    )
    form = wall_form(d)
    form += residual.Compile() * ng.ds(INNER, intrules={ng.SEGM: d.rule})
    return form


def _moment(t: float, wall: InnerWall, path: Path, d: Discrete) -> _Moment:
    state = d.state.vec.CreateVector()
    state.data = d.state.vec
    touching = wall.normal > CARRIES * wall.normal.max()
    return _seen(t, wall.r, wall.z, path.place(t), state, touching)


def _untouched(d: Discrete, path: Path) -> _Moment:
    """The start: a uniform tube whose lumen is what the arc reaches."""
    place = path.place(0.0)
    Z = inner_wall(d).station
    lumen = np.full_like(Z, place.radius + place.offset)
    return _seen(0.0, lumen, d.tube.axial_stretch * Z, place)


def _rigid_motion(start: _Moment, d: Discrete, path: Path, t: float) -> _Moment:
    """A moment before the start, made up: the wall at rest, the arc coming at its first speed."""
    place, ahead = path.place(0.0), path.place(t)
    Z = inner_wall(d).station
    lumen = np.full_like(Z, place.radius + place.offset)
    past = replace(
        place,
        radius=2.0 * place.radius - ahead.radius,
        offset=2.0 * place.offset - ahead.offset,
    )
    return _seen(-t, lumen, d.tube.axial_stretch * Z, past)


def _seen(
    t: float,
    r: Float[np.ndarray, "edges points"],
    z: Float[np.ndarray, "edges points"],
    place: Profile,
    state: Any = None,
    touching: Bool[np.ndarray, "edges points"] | None = None,
) -> _Moment:
    if touching is None:
        touching = np.zeros(r.shape, dtype=bool)
    return _Moment(t, touching, place.gap(r, z), place.along(r, z), state)


def _touching_place(before: _Moment, now: _Moment, t: float) -> Float[np.ndarray, "edges points"]:
    """Where on the arc each wall point touches before `t`; where it is, if it touches already.

    Gap and place of open points are taken to go on as between the last two moments.
    """
    ahead = (t - now.t) / (now.t - before.t)
    closing = np.maximum((before.gap - now.gap) * ahead, 1e-15)
    fraction = np.clip(np.maximum(now.gap, 0.0) / closing, 0.0, 1.0)
    fraction[now.touching] = 0.0
    return now.along + fraction * ahead * (now.along - before.along)


def _guess(
    d: Discrete, before: _Moment | None, now: _Moment, t: float, path: Path, wrap_at: WrapAt
) -> None:
    """First guess of an increment: the wall wrapped, or the motion so far continued."""
    if now.state is None:
        wrap_round(d, wrap_at(path.place(t)))
    elif before is None or before.state is None:
        wrap_round(d, wrap_at(path.place(now.t)))
        change = d.state.vec.CreateVector()
        change.data = -1.0 * d.state.vec
        wrap_round(d, wrap_at(path.place(t)))
        change.data += d.state.vec
        d.state.vec.data = now.state + change
    else:
        ahead = (t - now.t) / (now.t - before.t)
        d.state.vec.data = now.state + ahead * (now.state - before.state)
