"""One discretisation of the tube: mesh, unknown fields, symbols, and the form of the wall."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import ngsolve as ng
import numpy as np

from stonepass.fe.axisymmetric.contact import Arc
from stonepass.fe.axisymmetric.mesh import INNER, Layout, structured_mesh
from stonepass.fe.axisymmetric.problem import Tube
from stonepass.fe.axisymmetric.wall import PLACE, SYMBOLS, outside_work, strain, wall_energy
from stonepass.fe.core.lobatto import lobatto_rule
from stonepass.fe.core.systems import FormSystem

__all__ = [
    "NORMAL",
    "PRESSURE",
    "TANGENTIAL",
    "Discretisation",
    "Unknowns",
    "contact_force",
    "discretise",
    "edge_unknown",
    "free_unknowns",
    "smallest_volume_ratio",
    "wall_flaw",
    "wall_form",
]


class Unknowns(NamedTuple):
    """The unknown fields of the mixed problem, in the order of the engine's compound space.

    Each entry is a grid function, or a trial or test function.

    Attributes
    ----------
    u, w
        Radial and axial displacement, in inner radii.
    p
        Pressure that enforces incompressibility, in units of the modulus.
    normal, tangential
        Contact force per reference area of the inner wall, normal (positive where the stone
        presses) and tangential (positive downstream), in units of the modulus.
    """

    u: Any
    w: Any
    p: Any
    normal: Any
    tangential: Any


PRESSURE, NORMAL, TANGENTIAL = (Unknowns._fields.index(n) for n in ("p", "normal", "tangential"))


@dataclass(frozen=True)
class Discretisation:
    """The engine's objects of one discretisation, of the whole tube or of its half Z ≥ 0.

    Attributes
    ----------
    tube : Tube
    mesh : ngsolve.Mesh
    state : ngsolve.GridFunction
        Current values of all unknowns.
    arc : Arc
        The stone as symbols.
    stiffening : ngsolve.Parameter
        Shear modulus of a matrix added for a homotopy, in units of the modulus; usually 0.
    rule : ngsolve.IntegrationRule
        Gauss–Lobatto rule on the edges of the inner wall.
    order : int
        Polynomial order of the displacements.
    whole : bool
        Whether the mesh covers both halves of the tube.
    """

    tube: Tube
    mesh: Any
    state: Any
    arc: Arc
    stiffening: Any
    rule: Any
    order: int
    whole: bool

    @property
    def fields(self) -> Unknowns:
        """The current unknown fields as grid functions."""
        return Unknowns(*self.state.components)

    @property
    def trial(self) -> Unknowns:
        """Trial functions of the unknown fields."""
        return Unknowns(*self.state.space.TrialFunction())

    @property
    def test(self) -> Unknowns:
        """Test functions of the unknown fields."""
        return Unknowns(*self.state.space.TestFunction())

    @cached_property
    def nodal(self) -> tuple[Any, Any, Any]:
        """Space of the inner wall, inverse of its mass matrix, and the measure that both use.

        With Gauss–Lobatto quadrature the mass matrix is diagonal in the nodal basis, so the
        projection with it is an interpolation.
        """
        inner = self.mesh.Boundaries(INNER)
        space = ng.H1(self.mesh, order=self.order, definedon=inner)
        trial, test = space.TnT()
        where = ng.ds(INNER, intrules={ng.SEGM: self.rule})
        mass = ng.BilinearForm(trial * test * where).Assemble().mat
        used = space.GetDofs(inner)
        return space, mass.Inverse(used, inverse="umfpack"), where


def discretise(tube: Tube, arc: Arc, layout: Layout, order: int) -> Discretisation:
    """Create a mesh and the unknown fields on it, all zero.

    Parameters
    ----------
    tube : Tube
    arc : Arc
        The stone.
    layout : Layout
        Grid lines of the mesh, in inner radii.
    order : int
        Polynomial order of displacements and contact forces, at least 2; the pressure has one
        order less.
    """
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
    return Discretisation(
        tube, mesh, state, arc, stiffening, lobatto_rule(order), order, layout.whole
    )


def wall_form(d: Discretisation, *, condense: bool = True) -> Any:
    """Form of the wall, the pressure on its outer surface and the tether; contact is not included.

    Parameters
    ----------
    d : Discretisation
    condense : bool
        Whether unknowns inside the elements are eliminated before the tangent is factorised.

    Returns
    -------
    ngsolve.BilinearForm
    """
    tube, (u, w, p, *_) = d.tube, d.trial
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


def free_unknowns(d: Discretisation, contact: str, *, friction: bool = False) -> Any:
    """Unknowns to solve for.

    Parameters
    ----------
    d : Discretisation
    contact : str
        Boundaries on which contact forces are unknown; none if empty.
    friction : bool
        Whether the tangential contact force is unknown too. It never is at the first node. On a
        half that node is at Z = 0, where the force vanishes by symmetry and the displacement is
        fixed; on the whole tube nothing touches there.

    Returns
    -------
    ngsolve.BitArray
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


def edge_unknown(d: Discretisation, column: int) -> int:
    """Index of the unknown normal contact force at the end of the first `column` columns.

    The mesh has its vertices row by row, so those of the inner wall come first, in axial order; the
    unknowns of H1 begin with those of the vertices, in the same order.
    """
    return int(d.state.space.Range(NORMAL).start) + column


def contact_force(d: Discretisation, system: FormSystem) -> float:
    """Norm of the nodal contact forces, in units of modulus × inner radius².

    It is the scale of every residual. The unknowns are the same before and after the call.
    """
    full, without, kept = (d.state.vec.CreateVector() for _ in range(3))
    system.evaluate(full)
    kept.data = d.state.vec
    for force in (d.fields.normal, d.fields.tangential):
        force.vec[:] = 0.0
    system.evaluate(without)
    d.state.vec.data = kept
    full.data -= without
    displacement = d.state.space.Range(1).stop
    return float(np.linalg.norm(full.FV().NumPy()[:displacement]))


def smallest_volume_ratio(d: Discretisation) -> float:
    """Smallest volume ratio J at the integration points; NaN where the state is not finite."""
    return float(strain(d.fields.u, d.fields.w).J(_integration_points(d)).min())


def wall_flaw(d: Discretisation) -> str:
    """Why the current state is no wall: J ≤ 0 or no energy at some integration point.

    A law with a locking stretch has no energy beyond it, but its derivatives may have values there.

    Returns
    -------
    str
        Empty where the wall is sound.
    """
    deformed = strain(d.fields.u, d.fields.w)
    energy = d.tube.energy(deformed.C, PLACE, SYMBOLS)
    volume_ratio, energies = ng.CF((deformed.J, energy))(_integration_points(d)).T
    if not volume_ratio.min() > 0.0:  # NaN too
        return "the wall found is turned inside out where its axial fibres buckle"
    if not np.all(np.isfinite(energies)):
        return "the wall found is stretched beyond where its law has an energy"
    return ""


def _integration_points(d: Discretisation) -> Any:
    rule = ng.IntegrationRule(ng.QUAD, 2 * d.order)
    return d.mesh.MapToAllElements({ng.QUAD: rule}, ng.VOL)
