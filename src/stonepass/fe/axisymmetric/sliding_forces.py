"""Forces of the sliding contact, evaluated from what a workspace holds at present.

The solves call these functions within an iteration. The forces of a solved state are values of
`SlidingState`.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from stonepass.array_types import Float
from stonepass.fe.axisymmetric.inner_wall import InnerWall, inner_wall
from stonepass.fe.axisymmetric.sliding_workspace import CONTACT, Workspace
from stonepass.fe.core.lobatto import lobatto_slopes, resampling

__all__ = ["ContactForces", "axial_force", "contact_forces", "friction_work", "seal_pressure"]

SEAL_SAMPLES = 65  # of each column


@dataclass(frozen=True, eq=False)
class ContactForces:
    """The wall in contact and the forces on it, in units of the modulus.

    Attributes
    ----------
    wall : InnerWall
        The part of the inner wall in contact.
    normal : array (edges, points)
        Total normal contact force per reference area.
    tangential : array (edges, points)
        Friction on the wall per reference area, positive downstream.
    area : array (edges, points)
        Deformed area per reference area.
    """

    wall: InnerWall
    normal: Float[np.ndarray, "edges points"]
    tangential: Float[np.ndarray, "edges points"]
    area: Float[np.ndarray, "edges points"]


def contact_forces(workspace: Workspace) -> ContactForces:
    """Evaluate total contact force λ = P φ(Z) + λ_n and friction on the wall."""
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
    """Axial force on the stone, positive downstream, in units of modulus × inner radius².

    It is the pressure of the fluid on the disc that the first edge encloses, less the force of the
    stone on the wall, in the quadrature of the form.
    """
    found = contact_forces(workspace)
    wall, pressure = found.wall, workspace.pressure.Get()
    n_r, n_z = workspace.problem.stone.normal(wall.r, wall.z)
    axial = found.normal * n_z + found.tangential * n_r
    on_wall = 2.0 * np.pi * (wall.weight * axial).sum()
    return float(np.pi * pressure * wall.r[0, 0] ** 2 - on_wall)


def friction_work(workspace: Workspace) -> float:
    """Energy dissipated per length of reference wall by which the stone advances.

    ∫ λ_t λ_s dA, with the traction λ_t and the meridional stretch λ_s of the wall, because so much
    wall slides over each point of the stone. In units of modulus × inner radius².
    """
    found = contact_forces(workspace)
    stretch = found.area / found.wall.r
    return float(2.0 * np.pi * (found.wall.weight * found.tangential * stretch).sum())


def seal_pressure(workspace: Workspace) -> tuple[float, float]:
    """Station (inner radii) and size (units of the modulus) of the largest contact pressure."""
    found = contact_forces(workspace)
    fine = resampling(workspace.discretisation.order, SEAL_SAMPLES)[0].T
    pressure = (found.normal / found.area) @ fine
    at = int(np.argmax(pressure))
    return float((found.wall.station @ fine).flat[at]), float(pressure.flat[at])
