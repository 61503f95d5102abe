"""The fitted solve: the contact edge is a grid line, and its place one of the unknowns."""

from __future__ import annotations

from typing import Any

import ngsolve as ng
import numpy as np

from stonepass.fe.contact import bilateral
from stonepass.fe.discrete import Discrete, contact_force, discretise, wall_form
from stonepass.fe.mesh import Layout, graded, growing, intervals, place
from stonepass.fe.newton import Bordered, newton
from stonepass.fe.problem import Failure, Fitted, Resolution, Tube
from stonepass.fe.scout import Scouted

__all__ = ["fit"]

FIT_TOLERANCE = 1e-9  # of the contact force
ROUNDING = 1e-14  # residual norm that rounding leaves where the contact force is tiny


def fit(tube: Tube, radius: float, scouted: Scouted, resolution: Resolution) -> Fitted | Failure:
    """Solve with the contact edge as a grid line whose place is an unknown."""

    def layout(edge: float) -> Layout:
        return _layout(edge, scouted.edge, tube, resolution)

    d = discretise(tube, radius, layout(scouted.edge), resolution.order)
    _take_over(d, scouted.discrete)
    form = wall_form(d)
    form += ng.Variation(
        bilateral(d.multiplier, d.gap).Compile() * ng.ds("closed", intrules={ng.SEGM: d.rule})
    )
    system = Bordered(
        form,
        d.state,
        _free_with_closed_contact(d),
        value=scouted.edge,
        apply=lambda edge: place(d.mesh, layout(edge)),
        index=_edge_unknown(d, resolution.closed),
    )
    report = newton(system, max(FIT_TOLERANCE * scouted.force, ROUNDING), most=30)
    if not report.converged:
        return Failure(report.reason, report.steps)
    flaw = _complementarity_flaw(d, radius)
    if flaw:
        return Failure(flaw, report.steps)
    return Fitted(
        tube=tube,
        radius=radius,
        layout=layout(system.value),
        mesh=d.mesh,
        state=d.state,
        order=resolution.order,
        steps=report.steps,
        dofs=int(sum(d.state.space.FreeDofs())),
        residual=report.residual / contact_force(d, system),
    )


def _layout(edge: float, reference: float, tube: Tube, resolution: Resolution) -> Layout:
    """Grid lines for a contact edge at `edge`; counts and rows are fixed by `reference`."""
    n, fraction = resolution.closed, resolution.edge
    inside = 1.0 - graded(n, fraction, 1.0)[::-1]
    beyond = intervals(fraction * reference, tube.half_length - reference, resolution.growth)
    return Layout(
        radial=1.0
        + growing(
            min(4.0 * fraction, 0.5) * reference, tube.wall_ratio - 1.0, 1.5 * resolution.growth
        ),
        axial=np.concatenate(
            [
                edge * inside,
                edge + graded(beyond, fraction * edge, tube.half_length - edge)[1:],
            ]
        ),
        closed=n,
    )


def _take_over(d: Discrete, other: Discrete) -> None:
    """Interpolate the state of another discretisation of the same wall."""
    for ours, theirs in zip(d.state.components[:3], other.state.components[:3], strict=True):
        ours.Set(theirs)
    contact, touched = d.state.components[3], other.state.components[3]
    contact.Set(touched, definedon=d.mesh.Boundaries("closed"))


def _free_with_closed_contact(d: Discrete) -> Any:
    """Free unknowns, the multiplier only where the wall is closed on the sphere."""
    space = d.state.space
    free = ng.BitArray(space.FreeDofs())
    contact = space.Range(3)
    closed = space.components[3].GetDofs(d.mesh.Boundaries("closed"))
    for local, index in enumerate(contact):
        free[index] = bool(free[index] and closed[local])
    return free


def _edge_unknown(d: Discrete, closed: int) -> int:
    """Index of the multiplier at the contact edge: inner-wall vertex number `closed`.

    Vertices were added row by row, so the inner wall has the first ones, in axial order; the
    vertex unknowns of H1 come first and in that order.
    """
    return int(d.state.space.Range(3).start) + closed


def _complementarity_flaw(d: Discrete, radius: float) -> str:
    """Empty where λ ≥ 0 on the closed and gap ≥ 0 on the open part of the inner wall."""
    u, w, _, multiplier = d.state.components
    closed = d.mesh.MapToAllElements({ng.SEGM: d.rule}, d.mesh.Boundaries("closed"))
    force = multiplier(closed)
    if force.min() < -1e-6 * force.max():
        return "the contact is not one closed band: the wall would lift off inside it"
    opened = d.mesh.MapToAllElements({ng.SEGM: d.rule}, d.mesh.Boundaries("open"))
    r, z = ng.x(opened) + u(opened), ng.y(opened) + w(opened)
    if (np.hypot(r, z) - radius).min() < -1e-7 * radius:
        return "the wall would touch the stone again beyond the contact edge"
    return ""
