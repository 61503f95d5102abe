"""The loading path with friction: the arc moves in increments; wall points stick to it or slip.

The length of the contact is proportional to the square root of the path parameter t, so the
increments are equal in √t and each adds about the same length of contact. Every wall point has a
slip origin, see `friction`. For a point in contact it is the coordinate on the arc at the beginning
of the increment. For a point that comes into contact within the increment, it is the coordinate at
first contact, which is extrapolated from the motion of the point in the previous increment. See
"Friction and its path" in docs/theory.md.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import ngsolve as ng
import numpy as np

from stonepass.array_types import Bool, Float
from stonepass.fe.axisymmetric.contact import AUGMENTATION, Arc
from stonepass.fe.axisymmetric.contact_predictor import PREDICTOR_ORDER, wrap_round
from stonepass.fe.axisymmetric.discretisation import (
    Discretisation,
    discretise,
    free_unknowns,
    wall_form,
)
from stonepass.fe.axisymmetric.equilibrium import residual_tolerance
from stonepass.fe.axisymmetric.friction import open_contact
from stonepass.fe.axisymmetric.inner_wall import (
    InnerWall,
    contact_edges,
    inner_wall,
    piecewise_linear,
    set_at_nodes,
)
from stonepass.fe.axisymmetric.layouts import equal_layout
from stonepass.fe.axisymmetric.mesh import INNER
from stonepass.fe.axisymmetric.problem import Failure, LoadingPath, Resolution, Tube, Wrap
from stonepass.fe.axisymmetric.profile import Profile
from stonepass.fe.axisymmetric.slip import dissipation
from stonepass.fe.axisymmetric.start import Start
from stonepass.fe.core.newton import newton_or_homotopy
from stonepass.fe.core.systems import FormSystem

__all__ = ["WrapAt", "follow_loading_path"]

PATH_TOLERANCE = 1e-5  # tolerance of the residual, relative to the contact force
MARGIN = 1.15  # length of the part with equal columns, relative to the frictionless contact
MOST_HALVINGS = 4
TOUCHES = 1e-6  # smallest contact force of a point in contact, relative to the largest force

# A function that returns a first guess of the wall for a given position of the stone.
WrapAt = Callable[[Profile], Wrap]


@dataclass(frozen=True, eq=False)
class _Moment:
    """The inner wall at the path parameter t.

    `touching`, `gap` and `along` are contact, gap and arc-length coordinate at the Gauss–Lobatto
    points. `state` is a copy of all finite-element unknowns, or None for the start of the path.
    """

    t: float
    touching: Bool[np.ndarray, "edges points"]
    gap: Float[np.ndarray, "edges points"]
    along: Float[np.ndarray, "edges points"]
    state: Any


def follow_loading_path(
    tube: Tube, path: LoadingPath, wrap_at: WrapAt, frictionless: Start, resolution: Resolution
) -> Start | Failure:
    """Follow a loading path from first contact of stone and tube to the final position.

    The mesh has equal columns over the contact of the frictionless solution and 15 % beyond it. An
    increment that does not converge is halved, down to 1/16 of its size.

    Parameters
    ----------
    tube : Tube
    path : LoadingPath
        Position of the stone as a function of the path parameter, and coefficient of friction.
    wrap_at : callable
        ``wrap_at(stone)`` returns a first guess of the wall round a stone in the given position.
    frictionless : Start
        The predicted contact at the final position without friction.
    resolution : Resolution
        Number of increments and of columns in contact.

    Returns
    -------
    Start or Failure
        The state in the final position, with the slip origins of the last increment.
    """
    first, last = frictionless.contact
    layout = equal_layout(
        tube,
        (MARGIN * first, MARGIN * last),
        resolution.path_columns,
        growth=1.7,
        whole=frictionless.discretisation.whole,
    )
    d = discretise(tube, Arc.at(path.place(0.0)), layout, PREDICTOR_ORDER)
    origin = ng.GridFunction(d.nodal[0])
    system = FormSystem(_form(d, path, origin), d.state, free_unknowns(d, INNER, friction=True))
    before, now = None, _untouched(d, path)
    usual = step = 1.0 / resolution.increments
    s, steps, dissipated, tolerance = 0.0, 0, 0.0, 0.0
    while True:
        ahead = s + step if s + step < 1.0 - 1e-9 else 1.0
        t = ahead**2
        d.arc.move(path.place(t))
        touch = _touching_place(before or _rigid_motion(now, d, path, t), now, t)
        set_at_nodes(origin, piecewise_linear(inner_wall(d).station, touch), d)
        _guess(d, before, now, t, path, wrap_at)
        tolerance = tolerance or residual_tolerance(system, frictionless.force, PATH_TOLERANCE)
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
        return Failure("the wall lost contact with the stone", steps)
    stations, at = np.unique(wall.station, return_index=True)
    return Start(d, edges, frictionless.force, steps, (stations, touch.ravel()[at]), dissipated)


def _form(d: Discretisation, path: LoadingPath, origin: Any) -> Any:
    residual = open_contact(d.trial, d.test, d.arc, origin, path.friction, AUGMENTATION)
    form = wall_form(d)
    form += residual.Compile() * ng.ds(INNER, intrules={ng.SEGM: d.rule})
    return form


def _moment(t: float, wall: InnerWall, path: LoadingPath, d: Discretisation) -> _Moment:
    state = d.state.vec.CreateVector()
    state.data = d.state.vec
    touching = wall.normal > TOUCHES * wall.normal.max()
    return _seen(t, wall.r, wall.z, path.place(t), state, touching)


def _untouched(d: Discretisation, path: LoadingPath) -> _Moment:
    """Return the start of the path: a uniform tube whose lumen the arc just touches."""
    place = path.place(0.0)
    Z = inner_wall(d).station
    lumen = np.full_like(Z, place.radius + place.offset)
    return _seen(0.0, lumen, d.tube.axial_stretch * Z, place)


def _rigid_motion(start: _Moment, d: Discretisation, path: LoadingPath, t: float) -> _Moment:
    """Return a fictitious state before the start, for the extrapolation in the first increment.

    The wall is that of the start, and the arc moves as much as in the first increment.
    """
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
    """Return the slip origin of each wall point for the increment that ends at `t`.

    For a point in contact the origin is its current coordinate on the arc. For other points the gap
    and the coordinate are extrapolated linearly from the last two states, and the origin is the
    coordinate at which the gap vanishes, or the coordinate at `t` if the gap stays open.
    """
    ahead = (t - now.t) / (now.t - before.t)
    closing = np.maximum((before.gap - now.gap) * ahead, 1e-15)
    fraction = np.clip(np.maximum(now.gap, 0.0) / closing, 0.0, 1.0)
    fraction[now.touching] = 0.0
    return now.along + fraction * ahead * (now.along - before.along)


def _guess(
    d: Discretisation,
    before: _Moment | None,
    now: _Moment,
    t: float,
    path: LoadingPath,
    wrap_at: WrapAt,
) -> None:
    """Set the first guess of an increment: the wrapped wall, or an extrapolation in t."""
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
