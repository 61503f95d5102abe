"""The fitted solve: the contact edge is a grid line, and its place one of the unknowns."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import ngsolve as ng
import numpy as np
from jaxtyping import Float
from scipy.interpolate import make_interp_spline

from stonepass.fe.contact import Arc, bilateral, unilateral
from stonepass.fe.discrete import (
    NORMAL,
    TANGENTIAL,
    Discrete,
    contact_force,
    discretise,
    edge_unknown,
    free_unknowns,
    inner_wall,
    set_at_nodes,
    smallest_volume_ratio,
    wall_form,
)
from stonepass.fe.friction import closed_contact, open_contact
from stonepass.fe.mesh import INNER, Layout, graded, growing, intervals, place
from stonepass.fe.newton import Bordered, Plain, Report, newton_or_homotopy
from stonepass.fe.press import FRICTION_WEIGHT, along_wall, dissipation
from stonepass.fe.problem import Failure, Resolution, Tube
from stonepass.fe.profile import Profile
from stonepass.fe.scout import Start, edge_of_contact

__all__ = ["Fitted", "fit", "settle"]

FIT_TOLERANCE = 1e-9  # of the contact force
POLISH = 1e-2  # further where it costs next to nothing: forces at single nodes are known worse
SETTLING_ROUNDS = 6
INSIDE_OUT = "the wall found is turned inside out at a kink"
ROUNDING = 1e-14  # residual norm that rounding leaves where the contact force is tiny


@dataclass(frozen=True)
class Fitted:
    """A solved state: the engine's objects, for reading values off (see `fe.readout`).

    `steps` counts every Newton step with a tangent of its own on the way, failed attempts too;
    `force`, in units of modulus × inner radius², is the norm of the
    contact forces, `residual` relative to it; `dissipated` is the energy that friction took on the
    path (half tube, units of modulus × inner radius³). `slack` is how far, along Z, the contact
    edge is known where it could not be made an unknown, else 0.
    """

    discrete: Discrete
    layout: Layout
    steps: int
    dofs: int
    residual: float
    force: float
    friction: float
    dissipated: float
    slack: float = 0.0


def fit(
    tube: Tube, stone: Profile, start: Start, resolution: Resolution, friction: float
) -> Fitted | Failure:
    """Solve with the contact edge as a grid line whose place is an unknown.

    With friction this is the last increment of the path again, on the fitted mesh: slip counts
    from `start.origin`.
    """

    def layout(edge: float) -> Layout:
        return _layout(edge, start.edge, tube, resolution)

    d = discretise(tube, Arc.at(stone), layout(start.edge), resolution.order)
    _take_over(d, start)
    free = free_unknowns(d, "closed", friction=start.origin is not None)
    at_edge = edge_unknown(d, resolution.closed)

    def move_edge(values: Float[np.ndarray, " one"]) -> bool:
        edge = float(values[0])
        if not 0.0 < edge < tube.half_length:
            return False
        place(d.mesh, layout(edge))
        return True

    system = Bordered(
        _closed_form(d, start, friction),
        d.state,
        free,
        values=np.array([start.edge]),
        scale=np.array([start.edge]),
        apply=move_edge,
        conditions=lambda: np.array([d.state.vec[at_edge]]),
    )
    tolerance = max(FIT_TOLERANCE * start.force, ROUNDING)
    report = newton_or_homotopy(system, d.stiffening.Set, tolerance, polish=POLISH)
    if not report.converged:
        return Failure(report.reason, report.steps)
    flaw = _flaw(d)
    if flaw:
        return Failure(flaw, report.steps)
    return _fitted(d, layout(float(system.values[0])), system, report, start, friction)


def settle(
    tube: Tube, stone: Profile, start: Start, resolution: Resolution, friction: float
) -> Fitted | Failure:
    """Solve with contact as an inequality on meshes that are moved to the edge they find.

    The way out where `fit` fails, as at kinks of a wall that has lost its stability: the edge is
    then known to the spacing of the nodes beside it.
    """
    edge, steps = start.edge, 0
    for _ in range(SETTLING_ROUNDS):
        layout = _layout(edge, start.edge, tube, resolution)
        d = discretise(tube, Arc.at(stone), layout, resolution.order)
        _take_over(d, start)
        free = free_unknowns(d, INNER, friction=start.origin is not None)
        system = Plain(_open_form(d, start, friction), d.state, free)
        tolerance = max(FIT_TOLERANCE * start.force, ROUNDING)
        report = newton_or_homotopy(system, d.stiffening.Set, tolerance, polish=POLISH)
        steps += report.steps
        found = edge_of_contact(d) if report.converged else None
        if found is None:
            return Failure(report.reason or "the wall left the stone", steps)
        slack = resolution.edge * edge
        if abs(found - edge) <= slack:
            if not smallest_volume_ratio(d) > 0.0:
                return Failure(INSIDE_OUT, steps)
            solved = _fitted(d, layout, system, report, start, friction)
            return replace(solved, slack=slack, steps=steps)
        edge = found
    return Failure("the contact edge does not settle", steps)


def _fitted(
    d: Discrete,
    layout: Layout,
    system: Plain,
    report: Report,
    start: Start,
    friction: float,
) -> Fitted:
    force = contact_force(d, system)
    return Fitted(
        discrete=d,
        layout=layout,
        steps=report.steps,
        dofs=int(sum(system.free)),
        residual=report.residual / force,
        force=force,
        friction=friction,
        dissipated=start.dissipated + _last_dissipation(d, start),
    )


def _closed_form(d: Discrete, start: Start, friction: float) -> Any:
    """The wall held on the arc up to the edge."""
    where = ng.ds("closed", intrules={ng.SEGM: d.rule})
    form, space = wall_form(d), d.state.space
    trial, test = space.TrialFunction(), space.TestFunction()
    if start.origin is None:
        form += ng.Variation(bilateral(trial[NORMAL], d.arc.gap(*trial[:2])).Compile() * where)
        return form
    origin = _origin(start)
    form += closed_contact(trial, test, d.arc, origin, friction, FRICTION_WEIGHT).Compile() * where
    return form


def _open_form(d: Discrete, start: Start, friction: float) -> Any:
    """Contact as an inequality all along the inner wall."""
    where = ng.ds(INNER, intrules={ng.SEGM: d.rule})
    form, space = wall_form(d), d.state.space
    trial, test = space.TrialFunction(), space.TestFunction()
    if start.origin is None:
        gap = d.arc.gap(*trial[:2])
        form += ng.Variation(unilateral(trial[NORMAL], gap, FRICTION_WEIGHT).Compile() * where)
        return form
    origin = _origin(start)
    form += open_contact(trial, test, d.arc, origin, friction, FRICTION_WEIGHT).Compile() * where
    return form


def _origin(start: Start) -> Any:
    """The places on the arc from which the last increment slips, as a smooth function of Z."""
    assert start.origin is not None
    spline = make_interp_spline(*start.origin, k=3)
    return ng.BSpline(4, spline.t.tolist(), spline.c.tolist())(ng.y)


def _last_dissipation(d: Discrete, start: Start) -> float:
    if start.origin is None:
        return 0.0
    wall = inner_wall(d, "closed")
    origin = make_interp_spline(*start.origin, k=3)(wall.station)
    return dissipation(wall, d.arc.place, origin)


def _layout(edge: float, reference: float, tube: Tube, resolution: Resolution) -> Layout:
    """Grid lines for a contact edge at `edge`; counts and rows are fixed by `reference`."""
    n, fraction = resolution.closed, resolution.edge
    inside = 1.0 - graded(n, fraction, 1.0)[::-1]
    beyond = intervals(fraction * reference, tube.half_length - reference, resolution.growth)
    outside = graded(beyond, fraction * edge, tube.half_length - edge)
    first_row = min(4.0 * fraction, 0.5) * reference
    return Layout(
        radial=1.0 + growing(first_row, tube.wall_ratio - 1.0, 1.5 * resolution.growth),
        axial=np.concatenate([edge * inside, edge + outside[1:]]),
        closed=n,
    )


def _take_over(d: Discrete, start: Start) -> None:
    """Interpolate the state of another discretisation; contact forces end at the edge."""
    for ours, theirs in zip(d.state.components[:3], start.discrete.state.components, strict=False):
        ours.Set(theirs)
    axial = d.state.components[1]  # interpolation has moved the plane of symmetry a little
    for index, on in enumerate(axial.space.GetDofs(d.mesh.Boundaries("middle"))):
        if on:
            axial.vec[index] = 0.0
    wall = inner_wall(start.discrete)
    for component, force in ((NORMAL, wall.normal), (TANGENTIAL, wall.tangential)):
        carried = ng.IfPos(start.edge - ng.y, along_wall(wall.station, force), 0.0)
        set_at_nodes(d.state.components[component], carried, d)


def _flaw(d: Discrete) -> str:
    """Empty where λ_n ≥ 0 on the closed and gap ≥ 0 on the open part of the wall, and J > 0."""
    if not smallest_volume_ratio(d) > 0.0:  # NaN too
        return INSIDE_OUT
    force = inner_wall(d, "closed").normal
    if force.min() < -1e-6 * force.max():
        return "the contact is not one closed band: the wall would lift off inside it"
    opened = inner_wall(d, "open")
    stone = d.arc.place
    if stone.gap(opened.r, opened.z).min() < -1e-7 * stone.radius:
        return "the wall would touch the stone again beyond the contact edge"
    return ""
