"""One discretisation of the tube: mesh, unknowns, symbols, and the wall's own form."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import ngsolve as ng
import numpy as np

from stonepass.fe.contact import lobatto_rule, sphere_gap
from stonepass.fe.mesh import Layout, structured_mesh
from stonepass.fe.newton import Plain
from stonepass.fe.problem import Tube
from stonepass.fe.wall import outside_work, wall_energy

__all__ = ["Discrete", "contact_force", "discretise", "wall_form"]

ng.ngsglobals.msg_level = 0


@dataclass(frozen=True)
class Discrete:
    """Mesh, unknowns and symbols of one discretisation."""

    mesh: Any
    state: Any
    energy: Any
    gap: Any
    multiplier: Any
    work: Any
    rule: Any


def discretise(tube: Tube, radius: float, layout: Layout, order: int) -> Discrete:
    """Put unknowns on `layout`: displacements u, w, pressure p, multiplier on the inner wall."""
    mesh = structured_mesh(layout)
    inner = mesh.Boundaries("closed|open")
    space = ng.FESpace(
        [
            ng.H1(mesh, order=order),
            ng.H1(mesh, order=order, dirichlet="middle|end"),
            ng.H1(mesh, order=order - 1),
            ng.H1(mesh, order=order, definedon=inner),
        ]
    )
    u, w, p, multiplier = space.TrialFunction()
    work = outside_work(u, w, tube.outside_pressure, hydrostatic=tube.hydrostatic)
    return Discrete(
        mesh=mesh,
        state=ng.GridFunction(space),
        energy=wall_energy(tube.energy, u, w, p),
        gap=sphere_gap(u, w, radius),
        multiplier=multiplier,
        work=work if tube.outside_pressure else None,
        rule=lobatto_rule(order),
    )


def wall_form(d: Discrete) -> Any:
    """The wall's own part of the form; contact is added by the caller."""
    form = ng.BilinearForm(d.state.space, condense=True)
    form += ng.Variation(d.energy.Compile() * ng.dx(bonus_intorder=2))
    if d.work is not None:
        form += ng.Variation(d.work.Compile() * ng.ds("outer", bonus_intorder=2))
    return form


def contact_force(d: Discrete, system: Plain) -> float:
    """Norm of the nodal contact forces, the scale of every residual."""
    full, without = d.state.vec.CreateVector(), d.state.vec.CreateVector()
    kept = d.state.vec.CreateVector()
    system.evaluate(full)
    kept.data = d.state.vec
    d.state.components[3].vec[:] = 0.0
    system.evaluate(without)
    d.state.vec.data = kept
    full.data -= without
    displacement = d.state.space.Range(1).stop
    return float(np.linalg.norm(full.FV().NumPy()[:displacement]))
