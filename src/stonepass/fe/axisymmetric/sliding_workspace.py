"""NGSolve objects for one sliding problem: mesh, fields, parameters, form.

The objects are reused in all solves of the problem, because their set-up takes longer than a Newton
step. Between calls their content is undefined: each solve and each evaluation first loads the
configuration that it needs.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import ngsolve as ng

from stonepass.fe.axisymmetric.contact import Arc
from stonepass.fe.axisymmetric.discretisation import (
    Discretisation,
    discretise,
    edge_unknown,
    free_unknowns,
    wall_form,
)
from stonepass.fe.axisymmetric.equilibrium import EquilibriumState
from stonepass.fe.axisymmetric.mesh import place
from stonepass.fe.axisymmetric.sliding_state import Configuration, SlidingProblem
from stonepass.fe.axisymmetric.transfer import project_seated

__all__ = [
    "CONTACT",
    "Workspace",
    "capture",
    "load",
    "move_contact",
    "seated_configuration",
    "workspace_for",
]

CONTACT = "wetted|closed"


@dataclass(frozen=True, eq=False)
class Workspace:
    """NGSolve objects of a sliding problem.

    Attributes
    ----------
    problem : SlidingProblem
    discretisation : Discretisation
        Discretisation of the whole tube.
    first, last, pressure, friction, wetting : ngsolve.Parameter
        The scalars of a `Configuration`, with its units; `first` and `last` are the stations of the
        contact edges.
    form : ngsolve.BilinearForm
        Residual of the problem; see `sliding_contact`.
    free : ngsolve.BitArray
        Mask of the unknowns that are solved for.
    at_edges : (int, int)
        Indices of the normal contact force at the first and the last contact edge.
    """

    problem: SlidingProblem
    discretisation: Discretisation
    first: Any
    last: Any
    pressure: Any
    friction: Any
    wetting: Any
    form: Any
    free: Any
    at_edges: tuple[int, int]

    @property
    def dofs(self) -> int:
        """Number of unknowns solved for."""
        return int(sum(self.free))


def workspace_for(problem: SlidingProblem) -> Workspace:
    """Set up mesh, fields, parameters and form of a sliding problem."""
    first, last = problem.contact
    layout = problem.layout(problem.contact, 0.5)
    d = discretise(problem.tube, Arc.at(problem.stone), layout, problem.resolution.order)
    begin, end = layout.wet, layout.wet + layout.wetted + layout.closed
    edges, pressure = (ng.Parameter(first), ng.Parameter(last)), ng.Parameter(0.0)
    friction, wetting = ng.Parameter(0.0), ng.Parameter(0.0)
    return Workspace(
        problem=problem,
        discretisation=d,
        first=edges[0],
        last=edges[1],
        pressure=pressure,
        friction=friction,
        wetting=wetting,
        form=_form(d, edges, pressure, friction, wetting),
        free=free_unknowns(d, CONTACT),
        at_edges=(edge_unknown(d, begin), edge_unknown(d, end)),
    )


def seated_configuration(workspace: Workspace, seated: EquilibriumState) -> Configuration:
    """Return the seated state as a configuration without fluid and without friction.

    Parameters
    ----------
    workspace : Workspace
        Its content is overwritten.
    seated : EquilibriumState
        Seated state without friction, on a mesh of the half or of the whole tube.
    """
    project_seated(workspace.discretisation, seated)
    unknowns = workspace.discretisation.state.vec.FV().NumPy().copy()
    return Configuration(unknowns, workspace.problem.contact, pressure=0.0, friction=0.0)


def load(workspace: Workspace, configuration: Configuration) -> None:
    """Set the NGSolve objects of a workspace to a configuration."""
    workspace.discretisation.state.vec.FV().NumPy()[:] = configuration.unknowns
    workspace.friction.Set(configuration.friction)
    workspace.wetting.Set(configuration.wetting)
    possible = move_contact(
        workspace, configuration.edges, configuration.pressure, configuration.seal
    )
    assert possible, "the contact edges of the configuration are in the wrong order"


def capture(workspace: Workspace, seal: float) -> Configuration:
    """Copy the content of a workspace into a configuration.

    Parameters
    ----------
    workspace : Workspace
    seal : float
        Position of the seal for which the mesh was placed, as a fraction of the contact; the
        workspace does not store it.
    """
    return Configuration(
        unknowns=workspace.discretisation.state.vec.FV().NumPy().copy(),
        edges=(workspace.first.Get(), workspace.last.Get()),
        pressure=workspace.pressure.Get(),
        friction=workspace.friction.Get(),
        seal=seal,
        wetting=workspace.wetting.Get(),
    )


def move_contact(
    workspace: Workspace, edges: tuple[float, float], pressure: float, seal: float
) -> bool:
    """Move the contact edges together with the mesh, and set the pressure.

    Parameters
    ----------
    workspace : Workspace
    edges : (float, float)
        Stations of the contact edges, in inner radii.
    pressure : float
        Pressure of the fluid, in units of the modulus.
    seal : float
        Position of the seal, as a fraction of the contact from its first edge.

    Returns
    -------
    bool
        False if the edges are in the wrong order or outside the tube; then nothing is changed.
    """
    problem, (first, last) = workspace.problem, edges
    if not -problem.inlet < first < last < problem.outlet:
        return False
    place(workspace.discretisation.mesh, problem.layout(edges, seal))
    workspace.first.Set(first)
    workspace.last.Set(last)
    workspace.pressure.Set(pressure)
    return True


def _form(
    d: Discretisation, edges: tuple[Any, Any], pressure: Any, friction: Any, wetting: Any
) -> Any:
    """Return the residual of wall, fluid pressure, and contact with fully mobilised friction."""
    trial, test = d.trial, d.test
    u, w, (first, last) = trial.u, trial.w, edges
    form = wall_form(d)
    r, r_slope, z_slope = _meridian(u, w)
    # Virtual work of the follower load P n dA on the wall.
    fluid = pressure * r * (z_slope * test.u - r_slope * test.w)
    form += (-1.0 * fluid).Compile() * ng.ds("wet", bonus_intorder=4)
    ramp = (last - ng.y) / (last - first)
    force = trial.normal + pressure * ramp * _area(u, w)
    slip = d.arc.virtual_slip(u, w, test.u, test.w)
    rubbed = force - wetting * pressure * _area(u, w)
    gap = d.arc.virtual_gap(u, w, test.u, test.w)
    rows = d.arc.gap(u, w) * test.normal
    for part, pressed in (("wetted", rubbed), ("closed", force)):
        work = force * gap + friction * pressed * slip
        where = ng.ds(part, intrules={ng.SEGM: d.rule})
        form += (-1.0 * (work + rows) * ng.x).Compile() * where
    return form


def _meridian(u: Any, w: Any) -> tuple[Any, Any, Any]:
    """Return the deformed radius r of the inner wall, and the derivatives dr/dZ and dz/dZ."""
    return ng.x + u, ng.grad(u).Trace()[1], 1.0 + ng.grad(w).Trace()[1]


def _area(u: Any, w: Any) -> Any:
    """Return the deformed area of the inner wall per reference area (R_a = 1)."""
    r, r_slope, z_slope = _meridian(u, w)
    return r * ng.sqrt(r_slope * r_slope + z_slope * z_slope)
