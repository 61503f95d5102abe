"""Transfer of a state to another mesh."""

from __future__ import annotations

import ngsolve as ng
import numpy as np
from ngsolve.comp import IntegrationRuleSpace

from stonepass.fe.axisymmetric.discretisation import Discretisation
from stonepass.fe.axisymmetric.equilibrium import EquilibriumState
from stonepass.fe.axisymmetric.inner_wall import inner_wall, piecewise_linear, set_at_nodes
from stonepass.fe.axisymmetric.start import Start

__all__ = ["interpolate_start", "project_seated"]


def interpolate_start(d: Discretisation, start: Start) -> None:
    """Interpolate the state of a starting point on the mesh of `d`.

    Contact forces are set to zero outside the contact of the start.

    Parameters
    ----------
    d : Discretisation
        Its state is overwritten.
    start : Start
        Its mesh covers the same part of the tube as that of `d`.
    """
    before = start.discretisation.fields
    for field, other in zip(d.fields[:3], before[:3], strict=True):
        field.Set(other)
    axial = d.fields.w  # interpolation errors in the plane of symmetry are reset to zero
    for index, on in enumerate(axial.space.GetDofs(d.mesh.Boundaries("middle"))):
        if on:
            axial.vec[index] = 0.0
    wall, (first, last) = inner_wall(start.discretisation), start.contact
    for field, force in ((d.fields.normal, wall.normal), (d.fields.tangential, wall.tangential)):
        on_wall = piecewise_linear(wall.station, force)
        carried = ng.IfPos(last - ng.y, ng.IfPos(ng.y - first, on_wall, 0.0), 0.0)
        set_at_nodes(field, carried, d)


def project_seated(d: Discretisation, seated: EquilibriumState) -> None:
    """Project a seated state on the mesh of `d`, which covers the whole tube.

    If the seated state covers only the half Z ≥ 0, the other half is its mirror image. NGSolve
    cannot interpolate a mirrored field, so displacements and pressure are projected from samples at
    integration points. Contact forces are interpolated at the nodes.

    Parameters
    ----------
    d : Discretisation
        Its state is overwritten.
    seated : EquilibriumState
        Seated state without friction.
    """
    space = IntegrationRuleSpace(d.mesh, order=2 * d.order)
    rules = space.GetIntegrationRules()
    at = d.mesh.MapToAllElements(rules, ng.VOL)
    R, Z = ng.x(at).ravel(), ng.y(at).ravel()
    whole, end = seated.layout.whole, seated.layout.axial[-1]
    there = seated.discretisation.mesh(R, np.clip(Z if whole else np.abs(Z), -end, end))
    samples, where = ng.GridFunction(space), ng.dx(intrules=rules)
    fields, mirror = seated.discretisation.fields, 1.0 if whole else np.sign(Z)
    for target, field, sign in zip(d.fields[:3], fields[:3], (1.0, mirror, 1.0), strict=True):
        samples.vec.FV().NumPy()[:] = sign * field(there).ravel()
        trial, test = target.space.TnT()
        mass = ng.BilinearForm(trial * test * where).Assemble().mat
        rhs = ng.LinearForm(samples * test * where).Assemble().vec
        target.vec.data = mass.Inverse(inverse="umfpack") * rhs
    _hold_ends(d)
    wall = inner_wall(seated.discretisation)
    station, normal = wall.station.ravel(), wall.normal.ravel()
    if not whole:
        station = np.concatenate([-station[::-1], station])
        normal = np.concatenate([normal[::-1], normal])
    set_at_nodes(d.fields.normal, piecewise_linear(station, normal), d)


def _hold_ends(d: Discretisation) -> None:
    """Set the axial displacement of the ends to the value given by the imposed stretch."""
    w, ends = d.fields.w, d.mesh.Boundaries("end")
    held = ng.GridFunction(w.space)
    held.Set((d.tube.axial_stretch - 1.0) * ng.y, definedon=ends)
    for index, on in enumerate(w.space.GetDofs(ends)):
        if on:
            w.vec[index] = held.vec[index]
