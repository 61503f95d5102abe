"""One discretisation of the tube: mesh, unknowns, symbols, and the wall's own form."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import ngsolve as ng
import numpy as np
from jaxtyping import Float

from stonepass.fe.axisymmetric.contact import Arc, lobatto, lobatto_rule
from stonepass.fe.axisymmetric.mesh import INNER, Layout, structured_mesh
from stonepass.fe.axisymmetric.problem import Tube
from stonepass.fe.axisymmetric.wall import outside_work, strain, wall_energy
from stonepass.fe.core.newton import Plain

__all__ = [
    "NORMAL",
    "TANGENTIAL",
    "Discrete",
    "InnerWall",
    "contact_force",
    "discretise",
    "edge_unknown",
    "free_unknowns",
    "inner_wall",
    "set_at_nodes",
    "smallest_volume_ratio",
    "wall_form",
]

ng.ngsglobals.msg_level = 0

NORMAL, TANGENTIAL = 3, 4  # components of the state after u, w, p


@dataclass(frozen=True)
class Discrete:
    """Mesh, unknowns (u, w, p, λ_n, λ_t), arc and stiffening of one discretisation.

    Of the `whole` tube, or of its half Z ≥ 0.
    """

    tube: Tube
    mesh: Any
    state: Any
    arc: Arc
    stiffening: Any
    rule: Any
    order: int
    whole: bool

    @cached_property
    def nodal(self) -> tuple[Any, Any, Any]:
        """Space of the inner wall, inverse of its mass matrix, and the measure both use.

        With Gauss–Lobatto quadrature the mass matrix is diagonal in the nodal basis, so the
        projection it gives interpolates.
        """
        inner = self.mesh.Boundaries(INNER)
        space = ng.H1(self.mesh, order=self.order, definedon=inner)
        trial, test = space.TnT()
        where = ng.ds(INNER, intrules={ng.SEGM: self.rule})
        mass = ng.BilinearForm(trial * test * where).Assemble().mat
        used = space.GetDofs(inner)
        return space, mass.Inverse(used, inverse="umfpack"), where


@dataclass(frozen=True)
class InnerWall:
    """The inner wall at the Gauss–Lobatto points of its edges, sorted along the axis.

    Arrays are (edges, points): station Z, deformed r and z, contact forces per reference area,
    and the weights that integrate over Z.
    """

    station: Float[np.ndarray, "edges points"]
    r: Float[np.ndarray, "edges points"]
    z: Float[np.ndarray, "edges points"]
    normal: Float[np.ndarray, "edges points"]
    tangential: Float[np.ndarray, "edges points"]
    weight: Float[np.ndarray, "edges points"]


def discretise(tube: Tube, arc: Arc, layout: Layout, order: int) -> Discrete:
    """Put unknowns on `layout`: displacements u, w, pressure p, contact forces λ_n, λ_t."""
    mesh = structured_mesh(layout)
    inner = mesh.Boundaries(INNER)
    space = ng.FESpace(
        [
            ng.H1(mesh, order=order),
            ng.H1(mesh, order=order, dirichlet="middle|end"),
            ng.H1(mesh, order=order - 1),
            ng.H1(mesh, order=order, definedon=inner),
            ng.H1(mesh, order=order, definedon=inner),
        ]
    )
    state, stiffening = ng.GridFunction(space), ng.Parameter(0.0)
    return Discrete(tube, mesh, state, arc, stiffening, lobatto_rule(order), order, layout.whole)


def wall_form(d: Discrete, *, condense: bool = True) -> Any:
    """The wall's own part of the form; contact is added by the caller."""
    tube, (u, w, p, _, _) = d.tube, d.state.space.TrialFunction()
    form = ng.BilinearForm(d.state.space, condense=condense)
    energy = wall_energy(tube.energy, u, w, p, d.stiffening)
    form += ng.Variation(energy.Compile() * ng.dx(bonus_intorder=2))
    if tube.outside_pressure:
        work = outside_work(u, w, tube.outside_pressure, hydrostatic=tube.hydrostatic)
        form += ng.Variation(work.Compile() * ng.ds("outer", bonus_intorder=2))
    if tube.tether:
        away = w - (tube.axial_stretch - 1.0) * ng.y
        form += ng.Variation(0.5 * tube.tether * away * away * ng.x * ng.ds("outer"))
    return form


def free_unknowns(d: Discrete, contact: str, *, friction: bool = False) -> Any:
    """Unknowns to solve for, contact forces on the boundaries `contact` (none where it is empty).

    λ_t is left out without friction, and at the first node always: on a half that is Z = 0, where
    symmetry makes it zero and no displacement could answer it; on a whole tube nothing touches.
    """
    space = d.state.space
    free = ng.BitArray(space.FreeDofs())
    touching = d.mesh.Boundaries(contact)
    for component, wanted in ((NORMAL, True), (TANGENTIAL, friction)):
        used = space.components[component].GetDofs(touching)
        for local, index in enumerate(space.Range(component)):
            free[index] = bool(wanted and free[index] and used[local])
    free[space.Range(TANGENTIAL).start] = False
    return free


def edge_unknown(d: Discrete, column: int) -> int:
    """Index of the normal force where `column` columns of the inner wall end.

    Vertices were added row by row, so the inner wall has the first ones, in axial order; the
    vertex unknowns of H1 come first and in that order.
    """
    return int(d.state.space.Range(NORMAL).start) + column


def contact_force(d: Discrete, system: Plain) -> float:
    """Norm of the nodal contact forces, the scale of every residual."""
    full, without, kept = (d.state.vec.CreateVector() for _ in range(3))
    system.evaluate(full)
    kept.data = d.state.vec
    for component in (NORMAL, TANGENTIAL):
        d.state.components[component].vec[:] = 0.0
    system.evaluate(without)
    d.state.vec.data = kept
    full.data -= without
    displacement = d.state.space.Range(1).stop
    return float(np.linalg.norm(full.FV().NumPy()[:displacement]))


def inner_wall(d: Discrete, part: str = INNER) -> InnerWall:
    """Read the inner wall, or its `part`, at its Gauss–Lobatto points."""
    at = d.mesh.MapToAllElements({ng.SEGM: d.rule}, d.mesh.Boundaries(part))
    per_edge = (-1, d.order + 1)
    Z = ng.y(at).reshape(per_edge)
    edges = np.argsort(Z.mean(axis=1))
    along = np.argsort(Z[edges[0]])  # an edge may run against the axis

    def values(function: Any) -> Float[np.ndarray, "edges points"]:
        return function(at).reshape(per_edge)[edges][:, along]

    u, w, _, normal, tangential = d.state.components
    Z = values(ng.y)
    return InnerWall(
        station=Z,
        r=1.0 + values(u),
        z=Z + values(w),
        normal=values(normal),
        tangential=values(tangential),
        weight=(Z[:, -1:] - Z[:, :1]) * lobatto(d.order)[1],
    )


def smallest_volume_ratio(d: Discrete) -> float:
    """Smallest J at the integration points."""
    at = d.mesh.MapToAllElements({ng.QUAD: ng.IntegrationRule(ng.QUAD, 2 * d.order)}, ng.VOL)
    u, w, *_ = d.state.components
    return float(strain(u, w).J(at).min())


def set_at_nodes(target: Any, function: Any, d: Discrete) -> None:
    """Give a function on the inner wall the values of `function` at every Gauss–Lobatto point."""
    space, inverse, where = d.nodal
    target.vec.data = (
        inverse * ng.LinearForm(function * space.TestFunction() * where).Assemble().vec
    )
