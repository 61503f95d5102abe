"""Forces of the sliding contact, evaluated from the current state of a workspace.

The solves call these functions during an iteration. The forces of a converged state are stored in
`SlidingState`. The notation is that of the module `sliding_contact`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from stonepass.array_types import Float
from stonepass.fe.axisymmetric.inner_wall import InnerWall, inner_wall
from stonepass.fe.axisymmetric.sliding_workspace import CONTACT, Workspace
from stonepass.fe.core.lobatto import lobatto_slopes, resampling

__all__ = ["ContactForces", "axial_force", "contact_forces", "friction_work", "seal_pressure"]

SEAL_SAMPLES = 65  # points in each column at which the largest contact pressure is sought


@dataclass(frozen=True, eq=False)
class ContactForces:
    """The wall in contact and the forces on it, in units of the modulus.

    Attributes
    ----------
    wall : InnerWall
        The part of the inner wall in contact.
    normal : array (edges, points)
        Total normal contact force per reference area, compression positive.
    tangential : array (edges, points)
        Friction force on the wall per reference area, positive downstream.
    area : array (edges, points)
        Deformed area per reference area, dimensionless.
    """

    wall: InnerWall
    normal: Float[np.ndarray, "edges points"]
    tangential: Float[np.ndarray, "edges points"]
    area: Float[np.ndarray, "edges points"]


def contact_forces(workspace: Workspace) -> ContactForces:
    """Evaluate the total normal contact force and the friction force on the wall."""
    d = workspace.discretisation
    wall = inner_wall(d, CONTACT)
    run = wall.station[:, -1:] - wall.station[:, :1]
    slopes = lobatto_slopes(d.order).T
    area = wall.r * np.hypot(wall.r @ slopes, wall.z @ slopes) / run
    first, last, pressure = (p.Get() for p in (workspace.first, workspace.last, workspace.pressure))
    ramp = (last - wall.station) / (last - first)
    total = wall.normal + pressure * ramp * area
    rubbed, wetted = total.copy(), slice(workspace.problem.resolution.closed)
    rubbed[wetted] -= workspace.wetting.Get() * pressure * area[wetted]
    return ContactForces(wall, total, workspace.friction.Get() * rubbed, area)


def axial_force(workspace: Workspace) -> float:
    """Return the axial force on the stone, positive downstream (modulus × inner radius²).

    It is the force of the fluid on the disc bounded by the first contact edge, minus the axial
    force of the stone on the wall. The quadrature is that of the finite-element form. See N(P_u) in
    docs/theory.md, section "The push-through, solved directly".
    """
    found = contact_forces(workspace)
    wall, pressure = found.wall, workspace.pressure.Get()
    n_r, n_z = workspace.problem.stone.normal(wall.r, wall.z)
    axial = found.normal * n_z + found.tangential * n_r
    on_wall = 2.0 * np.pi * (wall.weight * axial).sum()
    return float(np.pi * pressure * wall.r[0, 0] ** 2 - on_wall)


def friction_work(workspace: Workspace) -> float:
    """Return the frictional dissipation per unit advance of the stone along the reference wall.

    It is ∫ λ_t λ_s dA with the friction traction λ_t and the meridional stretch λ_s of the wall:
    when the stone advances by dZ, a deformed length λ_s dZ of wall slides over each of its points.
    The unit is modulus × inner radius². See "Energy" in docs/theory.md, section "The push-through,
    solved directly".
    """
    found = contact_forces(workspace)
    stretch = found.area / found.wall.r
    return float(2.0 * np.pi * (found.wall.weight * found.tangential * stretch).sum())


def seal_pressure(workspace: Workspace) -> tuple[float, float]:
    """Return the station and the value of the largest contact pressure.

    The station is in inner radii; the pressure, a force per deformed area, is in units of the
    modulus.
    """
    found = contact_forces(workspace)
    fine = resampling(workspace.discretisation.order, SEAL_SAMPLES)[0].T
    pressure = (found.normal / found.area) @ fine
    at = int(np.argmax(pressure))
    return float((found.wall.station @ fine).flat[at]), float(pressure.flat[at])
