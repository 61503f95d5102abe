"""The fitted solve: the contact's edges are grid lines, and their places unknowns."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import ngsolve as ng
import numpy as np
from jaxtyping import Float
from scipy.interpolate import make_interp_spline

from stonepass.fe.axisymmetric.contact import Arc, bilateral, unilateral
from stonepass.fe.axisymmetric.contact_predictor import Start, contact_edges
from stonepass.fe.axisymmetric.discrete import (
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
from stonepass.fe.axisymmetric.friction import closed_contact, open_contact
from stonepass.fe.axisymmetric.loading_path import FRICTION_WEIGHT, along_wall, dissipation
from stonepass.fe.axisymmetric.mesh import INNER, Layout, place
from stonepass.fe.axisymmetric.problem import Failure, Resolution, Tube
from stonepass.fe.axisymmetric.profile import Profile
from stonepass.fe.core.grading import graded, growing, intervals
from stonepass.fe.core.newton import Bordered, Plain, Report, newton_or_homotopy

__all__ = ["Fitted", "fit", "settle"]

FIT_TOLERANCE = 1e-9  # of the contact force
POLISH = 1e-2  # further where it costs next to nothing: forces at single nodes are known worse
SETTLING_ROUNDS = 6
INSIDE_OUT = "the wall found is turned inside out at a kink"
ROUNDING = 1e-14  # residual norm that rounding leaves where the contact force is tiny


@dataclass(frozen=True)
class Fitted:
    """A solved state: the engine's objects, for reading values off (see `postprocessing`).

    `steps` counts every Newton step with a tangent of its own on the way, failed attempts too;
    `force`, in units of modulus × inner radius², is the norm of the
    contact forces, `residual` relative to it; `dissipated` is the energy that friction took on the
    path (of what the mesh covers, units of modulus × inner radius³). `slack` is how far, along Z,
    the contact's edges are known where they could not be made unknowns, else 0.
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
    """Solve with the contact's edges as grid lines whose places are unknowns.

    With friction this is the last increment of the path again, on the fitted mesh: slip counts
    from `start.origin`.
    """

    whole = start.discrete.whole

    def layout(values: Float[np.ndarray, " edges"]) -> Layout:
        first, last = values if whole else (-values[0], values[0])
        return _layout((float(first), float(last)), start, tube, resolution)

    edges = np.array(start.contact if whole else start.contact[1:])
    at_start = layout(edges)
    d = discretise(tube, Arc.at(stone), at_start, resolution.order)
    _take_over(d, start)
    free = free_unknowns(d, "closed", friction=start.origin is not None)
    columns = [at_start.wet, at_start.wet + at_start.closed] if whole else [at_start.closed]
    at_edges = [edge_unknown(d, column) for column in columns]

    def move_edges(values: Float[np.ndarray, " edges"]) -> bool:
        first, last = (values[0], values[-1]) if whole else (0.0, values[0])
        if not -tube.half_length < first < last < tube.half_length:
            return False
        place(d.mesh, layout(values))
        return True

    system = Bordered(
        _closed_form(d, start, friction),
        d.state,
        free,
        values=edges,
        scale=np.full(len(edges), (start.contact[1] - start.contact[0]) / 2.0),
        apply=move_edges,
        conditions=lambda: np.array([d.state.vec[index] for index in at_edges]),
    )
    tolerance = max(FIT_TOLERANCE * start.force, ROUNDING)
    report = newton_or_homotopy(system, d.stiffening.Set, tolerance, polish=POLISH)
    if not report.converged:
        return Failure(report.reason, report.steps)
    flaw = _flaw(d)
    if flaw:
        return Failure(flaw, report.steps)
    return _fitted(d, layout(system.values), system, report, start, friction)


def settle(
    tube: Tube, stone: Profile, start: Start, resolution: Resolution, friction: float
) -> Fitted | Failure:
    """Solve with contact as an inequality on meshes that are moved to the edges they find.

    The way out where `fit` fails, as at kinks of a wall that has lost its stability: the edges are
    then known to the spacing of the nodes beside them.
    """
    edges, steps = start.contact, 0
    for _ in range(SETTLING_ROUNDS):
        layout = _layout(edges, start, tube, resolution)
        d = discretise(tube, Arc.at(stone), layout, resolution.order)
        _take_over(d, start)
        free = free_unknowns(d, INNER, friction=start.origin is not None)
        system = Plain(_open_form(d, start, friction), d.state, free)
        tolerance = max(FIT_TOLERANCE * start.force, ROUNDING)
        report = newton_or_homotopy(system, d.stiffening.Set, tolerance, polish=POLISH)
        steps += report.steps
        found = contact_edges(d) if report.converged else None
        if found is None:
            return Failure(report.reason or "the wall left the stone", steps)
        slack = resolution.edge * (edges[1] - edges[0]) / 2.0
        if max(abs(found[0] - edges[0]), abs(found[1] - edges[1])) <= slack:
            if not smallest_volume_ratio(d) > 0.0:
                return Failure(INSIDE_OUT, steps)
            solved = _fitted(d, layout, system, report, start, friction)
            return replace(solved, slack=slack, steps=steps)
        edges = found
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
    """The wall held on the arc between the edges."""
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


def _places(start: Start) -> Any:
    """The places on the arc from which the last increment slips, as a smooth function of Z.

    Odd in Z where the other half of the tube is the mirror image.
    """
    assert start.origin is not None
    station, place = start.origin
    if not start.discrete.whole:
        station = np.concatenate([-station[:0:-1], station])
        place = np.concatenate([-place[:0:-1], place])
    return make_interp_spline(station, place, k=3)


def _origin(start: Start) -> Any:
    """The same for the engine."""
    spline = _places(start)
    return ng.BSpline(4, spline.t.tolist(), spline.c.tolist())(ng.y)


def _last_dissipation(d: Discrete, start: Start) -> float:
    if start.origin is None:
        return 0.0
    wall = inner_wall(d, "closed")
    return dissipation(wall, d.arc.place, _places(start)(wall.station))


def _layout(
    contact: tuple[float, float], start: Start, tube: Tube, resolution: Resolution
) -> Layout:
    """Grid lines for a contact between two stations; counts and rows are fixed by the start."""
    n, fraction, end = resolution.closed, resolution.edge, tube.half_length
    first, last = contact
    half, reference = (last - first) / 2.0, (start.contact[1] - start.contact[0]) / 2.0

    def beyond(room_at_start: float, room: float) -> Float[np.ndarray, " points"]:
        count = intervals(fraction * reference, room_at_start, resolution.growth)
        return graded(count, fraction * half, room)

    inside = half * graded(n, fraction, 1.0)
    downstream = last + beyond(end - start.contact[1], end - last)
    first_row = min(4.0 * fraction, 0.5) * reference
    radial = 1.0 + growing(first_row, tube.wall_ratio - 1.0, 1.5 * resolution.growth)
    ending = np.concatenate([last - inside[::-1], downstream[1:]])
    if not start.discrete.whole:
        return Layout(radial, ending, closed=n)
    upstream = first - beyond(end + start.contact[0], end + first)[::-1]
    axial = np.concatenate([upstream[:-1], first + inside[:-1], ending])
    return Layout(radial, axial, closed=2 * n, wet=len(upstream) - 1)


def _take_over(d: Discrete, start: Start) -> None:
    """Interpolate the state of another discretisation; contact forces end at the edges."""
    for ours, theirs in zip(d.state.components[:3], start.discrete.state.components, strict=False):
        ours.Set(theirs)
    axial = d.state.components[1]  # interpolation has moved the plane of symmetry a little
    for index, on in enumerate(axial.space.GetDofs(d.mesh.Boundaries("middle"))):
        if on:
            axial.vec[index] = 0.0
    wall, (first, last) = inner_wall(start.discrete), start.contact
    for component, force in ((NORMAL, wall.normal), (TANGENTIAL, wall.tangential)):
        on_wall = along_wall(wall.station, force)
        carried = ng.IfPos(last - ng.y, ng.IfPos(ng.y - first, on_wall, 0.0), 0.0)
        set_at_nodes(d.state.components[component], carried, d)


def _flaw(d: Discrete) -> str:
    """Empty where λ_n ≥ 0 on the closed and gap ≥ 0 on the open part of the wall, and J > 0."""
    if not smallest_volume_ratio(d) > 0.0:  # NaN too
        return INSIDE_OUT
    force = inner_wall(d, "closed").normal
    if force.min() < -1e-6 * force.max():
        return "the contact is not one closed band: the wall would lift off inside it"
    opened = inner_wall(d, "wet|open")
    stone = d.arc.place
    if stone.gap(opened.r, opened.z).min() < -1e-7 * stone.radius:
        return "the wall would touch the stone again beyond the contact edge"
    return ""
