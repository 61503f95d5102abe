"""Checks of a solved wall that no equation of the solver states: balances, friction, energy."""

from __future__ import annotations

import ngsolve as ng
import numpy as np

from stonepass.fe.axisymmetric.equilibrium import EquilibriumState
from stonepass.fe.axisymmetric.inner_wall import inner_wall
from stonepass.fe.axisymmetric.postprocessing import SolvedWall
from stonepass.fe.axisymmetric.wall import PLACE, SYMBOLS, cauchy_stress, strain

__all__ = ["axial_balance", "cone_excess", "loaded_balance", "stored_energy"]

NUDGE = 1e-12  # of the size of the mesh


def axial_balance(solved: EquilibriumState) -> float:
    """Axial force that remains on what the mesh covers, relative to the normal contact force.

    The stress at both end sections (which stay plane), the contact forces, and a hydrostatic
    pressure on the outer wall must add up to zero.
    """
    d, tube = solved.discretisation, solved.discretisation.tube
    wall = inner_wall(d, "closed")
    n_r, n_z = d.arc.place.normal(wall.r, wall.z)
    axial = wall.normal * n_z + wall.tangential * n_r
    contact = 2.0 * np.pi * (wall.weight * axial).sum()
    scale = 2.0 * np.pi * (wall.weight * wall.normal).sum()
    sections = (_section_force(solved, float(Z)) for Z in solved.layout.axial[[0, -1]])
    (first, outer_first), (last, outer_last) = sections
    bath = np.pi * (outer_last**2 - outer_first**2) * tube.outside_pressure * tube.hydrostatic
    return float(abs(last - first + contact + bath) / scale)


def loaded_balance(solved: SolvedWall, pressure: float, force: float) -> float:
    """Axial force that remains on a loaded tube and its stone, relative to the force at its ends.

    The stress of the wall at both ends, the pressure of the fluid on the upstream section, the
    force that holds the stone, a hydrostatic pressure on the outer wall and the tether must add up
    to zero.

    Parameters
    ----------
    solved : SolvedWall
        The whole tube.
    pressure : float
        Pressure of the fluid upstream of the contact, in units of the modulus.
    force : float
        Axial force on the stone, positive downstream, in units of modulus × inner radius². It is
        integrated from the contact alone, which makes this balance a check.
    """
    tube, ends = solved.discretisation.tube, solved.layout.axial[[0, -1]]
    (first, outer_first), (last, outer_last) = (_section_force(solved, float(Z)) for Z in ends)
    lumen = inner_wall(solved.discretisation).r[0, 0]
    fluid = np.pi * pressure * lumen**2
    bath = np.pi * (outer_last**2 - outer_first**2) * tube.outside_pressure * tube.hydrostatic
    away = solved.discretisation.fields.w - (tube.axial_stretch - 1.0) * ng.y
    springs = ng.Integrate(tube.tether * away * ng.x * ng.ds("outer"), solved.discretisation.mesh)
    rest = last - first + fluid - force + bath - 2.0 * np.pi * float(springs)
    return float(abs(rest) / (abs(first) + abs(last) + fluid))


def cone_excess(solved: EquilibriumState) -> float:
    """Largest |λ_t| − μ λ_n at the nodes, over the largest λ_n; at most 0 in Coulomb's law."""
    wall = inner_wall(solved.discretisation)
    excess = np.abs(wall.tangential) - solved.friction * np.maximum(wall.normal, 0.0)
    return float(excess.max() / wall.normal.max())


def _section_force(solved: SolvedWall, Z: float) -> tuple[float, float]:
    """2π ∫ σ_zz r dr over a plane section, and the outer radius there."""
    d = solved.discretisation
    u, w, p, *_ = d.fields
    stress_zz = cauchy_stress(d.tube.energy, u, w, p)[2].Compile()
    stretch_rr = strain(u, w).F_rr
    points, weights = np.polynomial.legendre.leggauss(d.order + 3)
    lines = solved.layout.radial
    run = np.diff(lines)[:, None]
    R = (lines[:-1, None] + run * (points + 1.0) / 2.0).ravel()
    # Slightly inside the mesh, because a point on its boundary may not be found in it.
    middle = solved.layout.axial.mean()
    Z += NUDGE * (middle - Z)
    outer = lines[-1] - NUDGE * (lines[-1] - lines[0])
    at = d.mesh(R, np.full_like(R, Z))
    density = stress_zz(at).ravel() * (R + u(at).ravel()) * stretch_rr(at).ravel()
    force = 2.0 * np.pi * float(((run * weights / 2.0).ravel() * density).sum())
    return force, float(lines[-1] + u(d.mesh(float(outer), float(Z))))


def stored_energy(solved: EquilibriumState) -> float:
    """Strain energy of what the mesh covers, in units of modulus × inner radius³.

    Where no other load acts, its derivative by the radius of a sphere is the contact force, since
    growing the sphere by dR does the work ∫ σ dA dR.
    """
    u, w, *_ = solved.discretisation.fields
    density = ng.CF(solved.discretisation.tube.energy(strain(u, w).C, PLACE, SYMBOLS))
    return float(
        2.0
        * np.pi
        * ng.Integrate(density * ng.x * ng.dx(bonus_intorder=8), solved.discretisation.mesh)
    )
