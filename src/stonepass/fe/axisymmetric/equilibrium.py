"""The solved seated contact, its tolerances, and the checks that a solved contact must pass."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from stonepass.array_types import Float
from stonepass.fe.axisymmetric.discretisation import (
    Discretisation,
    contact_force,
    wall_flaw,
)
from stonepass.fe.axisymmetric.inner_wall import inner_wall
from stonepass.fe.axisymmetric.mesh import Layout
from stonepass.fe.axisymmetric.slip import last_dissipation
from stonepass.fe.axisymmetric.start import Start
from stonepass.fe.core.newton import Report
from stonepass.fe.core.systems import FormSystem

__all__ = [
    "POLISH",
    "TOLERANCE",
    "EquilibriumState",
    "contact_flaw",
    "equilibrium_state",
    "penetration",
    "residual_tolerance",
]

TOLERANCE = 1e-9  # of the contact force
POLISH = 1e-2  # of the tolerance, where that is cheap: forces at single nodes are less accurate
ROUNDING = 1e-14  # norm of the residual that rounding leaves in any case
PULLS = 1e-6  # of the largest contact force: largest tension at a node


@dataclass(frozen=True)
class EquilibriumState:
    """A solved seated state, with the engine's objects from which `postprocessing` reads values.

    Attributes
    ----------
    discretisation : Discretisation
        Holds the solution; nothing changes it after the solve.
    layout : Layout
        Grid lines of its mesh, in inner radii.
    steps : int
        Newton steps with a tangent of their own, failed attempts included.
    dofs : int
        Number of unknowns solved for.
    residual : float
        Norm of the residual relative to `force`.
    force : float
        Norm of the nodal contact forces, in units of modulus × inner radius².
    friction : float
        Coulomb coefficient.
    dissipated : float
        Energy that friction dissipated on the path, for what the mesh covers, in units of modulus
        × inner radius³.
    edge_uncertainty : float
        Uncertainty of the stations of the contact's edges, in inner radii, where they could not be
        made unknowns (`active_set`), else 0.
    """

    discretisation: Discretisation
    layout: Layout
    steps: int
    dofs: int
    residual: float
    force: float
    friction: float
    dissipated: float
    edge_uncertainty: float = 0.0


def residual_tolerance(system: FormSystem, force: float, fraction: float = TOLERANCE) -> float:
    """Norm of the residual at which a contact counts as solved.

    It is a fraction of the contact force, but not less than what rounding leaves. A wall that is
    stretched before the stone comes has large internal forces that balance each other, and near
    the size of the loaded lumen their rounding exceeds that fraction of a tiny contact force.

    Parameters
    ----------
    system : FormSystem
        At the starting point of the solve.
    force : float
        Norm of the nodal contact forces that are expected.
    fraction : float
        Fraction of the contact force that may be left.
    """
    return max(fraction * force, ROUNDING, system.rounding())


def equilibrium_state(
    d: Discretisation,
    layout: Layout,
    system: FormSystem,
    report: Report,
    start: Start,
    friction: float,
) -> EquilibriumState:
    """Collect what a converged solve found."""
    force = contact_force(d, system)
    return EquilibriumState(
        discretisation=d,
        layout=layout,
        steps=report.steps,
        dofs=int(sum(system.free)),
        residual=report.residual / force,
        force=force,
        friction=friction,
        dissipated=start.dissipated + last_dissipation(d, start),
    )


def contact_flaw(
    d: Discretisation, normal: Float[np.ndarray, "edges points"], allowed: float
) -> str:
    """Why the current state is no admissible contact: no wall, λ_n < 0 or gap < 0 somewhere.

    Parameters
    ----------
    d : Discretisation
    normal : array (edges, points)
        Total normal contact force on the closed part of the wall.
    allowed : float
        Largest penetration of the open part of the wall into the stone, in radii of the stone.

    Returns
    -------
    str
        Empty where the state is admissible.
    """
    flaw = wall_flaw(d)
    if flaw:
        return flaw
    if normal.min() < -PULLS * normal.max():
        return "the contact is not one closed band: the wall would lift off inside it"
    if penetration(d) > allowed:
        return "the wall would touch the stone again beyond the contact edge"
    return ""


def penetration(d: Discretisation) -> float:
    """Largest depth of the open part of the wall inside the stone, in radii of the stone."""
    opened, stone = inner_wall(d, "wet|open"), d.arc.place
    return max(0.0, -float(stone.gap(opened.r, opened.z).min()) / stone.radius)
