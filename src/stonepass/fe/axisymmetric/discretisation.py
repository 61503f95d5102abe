"""A discretisation of the tube: mesh, unknown fields, NGSolve symbols, and the form of the wall."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, NamedTuple

import ngsolve as ng
import numpy as np

from stonepass.fe.axisymmetric.contact import Arc
from stonepass.fe.axisymmetric.mesh import INNER, Layout, structured_mesh
from stonepass.fe.axisymmetric.problem import Tube
from stonepass.fe.axisymmetric.wall import (
    PLACE,
    SYMBOLS,
    outside_work,
    rounded_symbols,
    strain,
    wall_energy,
)
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
    """The unknown fields of the mixed problem, in the order of NGSolve's compound space.

    Each entry is a grid function, a trial function or a test function.

    Attributes
    ----------
    u, w
        Radial and axial displacement, in inner radii.
    p
        Pressure that enforces incompressibility, in units of the modulus.
    normal, tangential
        Normal and tangential contact force on the inner wall per reference area, in units of the
        modulus. The normal force is positive in compression, the tangential force is positive
        downstream.
    """

    u: Any
    w: Any
    p: Any
    normal: Any
    tangential: Any


PRESSURE, NORMAL, TANGENTIAL = (Unknowns._fields.index(n) for n in ("p", "normal", "tangential"))


@dataclass(frozen=True)
class Discretisation:
    """NGSolve objects of one discretisation, either of the whole tube or of its half Z ≥ 0.

    Attributes
    ----------
    tube : Tube
    mesh : ngsolve.Mesh
    state : ngsolve.GridFunction
        Current values of all unknowns.
    arc : Arc
        The meridian of the stone.
    stiffening : ngsolve.Parameter
        Shear modulus of the matrix that the homotopy of `newton_or_homotopy` adds, in units of the
        modulus; zero otherwise.
    kink_width : ngsolve.Parameter
        Width over which a tangent rounds kinks of the energy density (see `newton`); zero
        otherwise.
    rule : ngsolve.IntegrationRule
        Gauss–Lobatto rule on the edges of the inner wall.
    order : int
        Polynomial order of the displacements.
    whole : bool
        True if the mesh covers the whole tube.
    """

    tube: Tube
    mesh: Any
    state: Any
    arc: Arc
    stiffening: Any
    kink_width: Any
    rule: Any
    order: int
    whole: bool

    @property
    def fields(self) -> Unknowns:
        """The components of the current state, as grid functions."""
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
        """Function space on the inner wall, inverse of its mass matrix, and integration measure.

        The measure uses Gauss–Lobatto quadrature. With this quadrature the mass matrix is diagonal
        in the nodal basis, so that an L² projection is an interpolation at the nodes.
        """
        inner = self.mesh.Boundaries(INNER)
        space = ng.H1(self.mesh, order=self.order, definedon=inner)
        trial, test = space.TnT()
        where = ng.ds(INNER, intrules={ng.SEGM: self.rule})
        mass = ng.BilinearForm(trial * test * where).Assemble().mat
        used = space.GetDofs(inner)
        return space, mass.Inverse(used, inverse="umfpack"), where


def discretise(tube: Tube, arc: Arc, layout: Layout, order: int) -> Discretisation:
    """Create a mesh and unknown fields on it that are zero.

    Parameters
    ----------
    tube : Tube
    arc : Arc
        The meridian of the stone.
    layout : Layout
        Grid lines of the mesh, in inner radii.
    order : int
        Polynomial order of displacements and contact forces, at least 2. The order of the pressure
        is lower by one. See "Elements" in docs/theory.md, section "Seated state".

    Returns
    -------
    Discretisation
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
    return Discretisation(
        tube,
        mesh,
        ng.GridFunction(space),
        arc,
        ng.Parameter(0.0),
        ng.Parameter(0.0),
        lobatto_rule(order),
        order,
        layout.whole,
    )


def wall_form(d: Discretisation, *, condense: bool = True) -> Any:
    """Create the form of the wall, the pressure on its outer surface, and the tether.

    Contact is not included. See Π in docs/theory.md, section "Seated state".

    Parameters
    ----------
    d : Discretisation
    condense : bool
        True if unknowns inside the elements are eliminated before the tangent is factorised.

    Returns
    -------
    ngsolve.BilinearForm
    """
    tube, (u, w, p, *_) = d.tube, d.trial
    form = ng.BilinearForm(d.state.space, condense=condense)
    energy = wall_energy(tube.energy, u, w, p, d.stiffening, rounded_symbols(d.kink_width))
    form += ng.Variation(energy.Compile() * ng.dx(bonus_intorder=2))
    if tube.outside_pressure:
        work = outside_work(u, w, tube.outside_pressure, hydrostatic=tube.hydrostatic)
        form += ng.Variation(work.Compile() * ng.ds("outer", bonus_intorder=2))
    if tube.tether:
        away = w - (tube.axial_stretch - 1.0) * ng.y
        form += ng.Variation(0.5 * tube.tether * away * away * ng.x * ng.ds("outer"))
    return form


def free_unknowns(d: Discretisation, contact: str, *, friction: bool = False) -> Any:
    """Return the mask of the unknowns to solve for.

    Parameters
    ----------
    d : Discretisation
    contact : str
        Names of the boundaries with unknown contact forces, separated by ``|``; empty for none.
    friction : bool
        True if the tangential contact force is unknown as well. It is excluded at the first node.
        On a half mesh that node lies at Z = 0, where the force vanishes by symmetry and the axial
        displacement is fixed. On a mesh of the whole tube the wall is not in contact at that node.

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
    """Return the index of the unknown normal contact force at vertex `column` of the inner wall.

    Vertices are counted from the first one, with index 0, along the axis. The mesh numbers its
    vertices row by row, so the vertices of the inner wall come first and in axial order. The
    unknowns of an H1 space begin with the vertex unknowns, in the order of the vertices.

    Parameters
    ----------
    d : Discretisation
    column : int
        Number of element columns between the first vertex and the wanted one, zero or positive.
    """
    return int(d.state.space.Range(NORMAL).start) + column


def contact_force(d: Discretisation, system: FormSystem) -> float:
    """Return the norm of the nodal contact forces, in units of modulus × inner radius².

    It is the scale of the residual of every solve. The state of `d` is restored before the call
    returns.

    Parameters
    ----------
    d : Discretisation
    system : FormSystem
        A system whose state is that of `d`.
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
    """Return the smallest volume ratio J at the integration points; NaN for a non-finite state."""
    return float(strain(d.fields.u, d.fields.w).J(_integration_points(d)).min())


def wall_flaw(d: Discretisation) -> str:
    """Check that J > 0 and that the energy is finite at all integration points.

    The energy of a law with a locking stretch is not finite beyond that stretch, but its
    derivatives may be, so that a solver does not notice.

    Returns
    -------
    str
        Reason why the current state is inadmissible, as part of a sentence; empty if it is
        admissible.
    """
    deformed = strain(d.fields.u, d.fields.w)
    energy = d.tube.energy(deformed.C, PLACE, SYMBOLS)
    # Compiled, since an expression that occurs twice is otherwise evaluated twice.
    both = ng.CF((deformed.J, energy)).Compile()
    volume_ratio, energies = both(_integration_points(d)).T
    if not volume_ratio.min() > 0.0:  # also true for NaN
        return "an element of the wall is inverted in the state that was found"
    if not np.all(np.isfinite(energies)):
        return "the wall is stretched beyond the range in which the energy of its law is finite"
    return ""


def _integration_points(d: Discretisation) -> Any:
    rule = ng.IntegrationRule(ng.QUAD, 2 * d.order)
    return d.mesh.MapToAllElements({ng.QUAD: rule}, ng.VOL)
