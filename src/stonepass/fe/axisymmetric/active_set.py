"""The active-set solve: contact as an inequality, with remeshing to the contact edges found.

It is the fallback if the fitted solve fails because the wall has no smooth contact edge. An example
is a wall that has lost its stability and whose axial fibres buckle. The active-set solve locates
the edges to within one nodal spacing only.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import ngsolve as ng

from stonepass.fe.axisymmetric.contact import AUGMENTATION, Arc, unilateral
from stonepass.fe.axisymmetric.discretisation import (
    Discretisation,
    discretise,
    free_unknowns,
    wall_flaw,
    wall_form,
)
from stonepass.fe.axisymmetric.equilibrium import (
    POLISH,
    EquilibriumState,
    equilibrium_state,
    residual_tolerance,
)
from stonepass.fe.axisymmetric.friction import open_contact
from stonepass.fe.axisymmetric.inner_wall import contact_edges
from stonepass.fe.axisymmetric.layouts import graded_layout
from stonepass.fe.axisymmetric.mesh import INNER
from stonepass.fe.axisymmetric.problem import Failure, Resolution, Tube
from stonepass.fe.axisymmetric.profile import Profile
from stonepass.fe.axisymmetric.slip import slip_origin
from stonepass.fe.axisymmetric.start import Start
from stonepass.fe.axisymmetric.transfer import interpolate_start
from stonepass.fe.core.newton import newton_or_homotopy
from stonepass.fe.core.systems import FormSystem

__all__ = ["solve_active_set"]

MOST_MESHES = 6


def solve_active_set(
    tube: Tube, stone: Profile, start: Start, resolution: Resolution, friction: float
) -> EquilibriumState | Failure:
    """Solve the contact inequality on a sequence of meshes, each refined at the last edges found.

    The sequence ends when the contact edges of the solution agree with those for which the mesh was
    graded.

    Parameters
    ----------
    tube : Tube
    stone : Profile
        The stone in its final position, lengths in inner radii.
    start : Start
        First guess; it also supplies the contact edges for the first mesh.
    resolution : Resolution
    friction : float
        Coulomb coefficient, zero or positive. It has no effect if `start` has no slip origins,
        which the module `friction` explains.

    Returns
    -------
    EquilibriumState or Failure
        `edge_uncertainty` of the state is the length of the columns next to the edges, in inner
        radii.
    """
    edges, steps, whole = start.contact, 0, start.discretisation.whole
    for _ in range(MOST_MESHES):
        layout = graded_layout(tube, resolution, edges, start.contact, whole=whole)
        d = discretise(tube, Arc.at(stone), layout, resolution.order)
        interpolate_start(d, start)
        free = free_unknowns(d, INNER, friction=start.origin is not None)
        system = FormSystem(_form(d, start, friction), d.state, free, d.kink_width)
        tolerance = residual_tolerance(system, start.force)
        report = newton_or_homotopy(system, d.stiffening.Set, tolerance, polish=POLISH)
        steps += report.steps
        found = contact_edges(d) if report.converged else None
        if found is None:
            return Failure(report.reason or "the wall lost contact with the stone", steps)
        uncertainty = resolution.edge * (edges[1] - edges[0]) / 2.0
        if max(abs(found[0] - edges[0]), abs(found[1] - edges[1])) <= uncertainty:
            flaw = wall_flaw(d)
            if flaw:
                return Failure(flaw, steps)
            solved = equilibrium_state(d, layout, system, report, start, friction)
            return replace(solved, edge_uncertainty=uncertainty, steps=steps)
        edges = found
    return Failure("the contact edge changes from mesh to mesh", steps)


def _form(d: Discretisation, start: Start, friction: float) -> Any:
    """Return the form of the wall with contact as an inequality on the whole inner wall."""
    where = ng.ds(INNER, intrules={ng.SEGM: d.rule})
    form, trial = wall_form(d), d.trial
    if start.origin is None:
        gap = d.arc.gap(trial.u, trial.w)
        form += ng.Variation(unilateral(trial.normal, gap, AUGMENTATION).Compile() * where)
        return form
    contact = open_contact(trial, d.test, d.arc, slip_origin(start), friction, AUGMENTATION)
    form += contact.Compile() * where
    return form
