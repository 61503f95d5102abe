"""The solved seated contact, its tolerances, and the checks that a solved contact must pass.

See "Seated state" in docs/theory.md.
"""

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

TOLERANCE = 1e-9  # tolerance of the residual, relative to the contact force
# The residual is reduced further, to this fraction of the tolerance, if that needs no new
# factorisation, because forces at single nodes are less accurate than the norm of the residual.
POLISH = 1e-2
ROUNDING = 1e-14  # smallest norm of the residual that can be reached in spite of rounding
PULLS = 1e-6  # largest tensile contact force at a node, relative to the largest contact force


@dataclass(frozen=True)
class EquilibriumState:
    """A solved seated state, with the NGSolve objects that `postprocessing` evaluates.

    Attributes
    ----------
    discretisation : Discretisation
        Its state is the solution and does not change after the solve.
    layout : Layout
        Grid lines of its mesh, in inner radii.
    steps : int
        Newton steps with a newly factorised tangent, including those of failed attempts.
    dofs : int
        Number of unknowns solved for.
    residual : float
        Norm of the residual relative to `force`.
    force : float
        Norm of the nodal contact forces, in units of modulus × inner radius².
    friction : float
        Coulomb coefficient.
    dissipated : float
        Energy that friction dissipated along the loading path in the meshed part of the tube, in
        units of modulus × inner radius³.
    edge_uncertainty : float
        Uncertainty of the stations of the contact edges, in inner radii. It is zero if the stations
        were unknowns of the solve (`fitted_contact`) and positive otherwise (`active_set`).
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
    """Return the norm of the residual at which a contact problem counts as solved.

    The tolerance is a fraction of the contact force, but not less than the effect of rounding. If
    the load stretches or compresses the wall without a stone, large internal forces balance each
    other. If in addition the stone is hardly larger than the loaded lumen, the contact force is so
    small that the rounding of the internal forces exceeds the given fraction of it.

    Parameters
    ----------
    system : FormSystem
        Its state is the starting point of the solve.
    force : float
        Expected norm of the nodal contact forces, in units of modulus × inner radius².
    fraction : float
        Tolerance relative to `force`, positive.

    Returns
    -------
    float
        In units of modulus × inner radius².
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
    """Collect the results of a converged solve.

    Parameters
    ----------
    d : Discretisation
        Its state is the solution.
    layout : Layout
        Grid lines of the mesh of `d`.
    system : FormSystem
        The solved system.
    report : Report
        Result of its Newton iteration.
    start : Start
        Starting point of the solve; it supplies slip origins and the energy dissipated so far.
    friction : float
        Coulomb coefficient.
    """
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
    """Check the wall (`wall_flaw`), λ_n ≥ 0 in the contact, and gap ≥ 0 outside the contact.

    Parameters
    ----------
    d : Discretisation
        Its state is checked.
    normal : array (edges, points)
        Total normal contact force per reference area at the nodes of the contact, in units of the
        modulus.
    allowed : float
        Largest allowed penetration of the open wall into the stone, in radii of the stone.

    Returns
    -------
    str
        Reason why the state is inadmissible, as part of a sentence; empty if it is admissible.
    """
    flaw = wall_flaw(d)
    if flaw:
        return flaw
    if normal.min() < -PULLS * normal.max():
        return "the wall would lift off the stone within the assumed contact"
    if penetration(d) > allowed:
        return "the wall would touch the stone again outside the assumed contact"
    return ""


def penetration(d: Discretisation) -> float:
    """Return the largest penetration of the open wall into the stone, in radii of the stone.

    The *open* wall is the part of the inner wall outside the contact.
    """
    opened, stone = inner_wall(d, "wet|open"), d.arc.place
    return max(0.0, -float(stone.gap(opened.r, opened.z).min()) / stone.radius)
