"""Independent checks of a solution: axial force balances, friction cone, strain energy.

None of these conditions is an equation of the solver, so each of them tests the solution. See "What
is checked" in docs/theory.md, section "Seated state".
"""

from __future__ import annotations

import ngsolve as ng
import numpy as np

from stonepass.fe.axisymmetric.equilibrium import EquilibriumState
from stonepass.fe.axisymmetric.inner_wall import inner_wall
from stonepass.fe.axisymmetric.postprocessing import SolvedWall
from stonepass.fe.axisymmetric.wall import PLACE, SYMBOLS, cauchy_stress, strain

__all__ = ["axial_balance", "cone_excess", "loaded_balance", "stored_energy"]

NUDGE = 1e-12  # inward shift of a boundary point, as a fraction of the size of the mesh


def axial_balance(solved: EquilibriumState) -> float:
    """Return the unbalanced axial force on the meshed wall, relative to the normal contact force.

    The mesh covers the half Z ≥ 0 or the whole tube. The resultants of the stress on both end
    sections, which stay plane, of the contact forces, and of a hydrostatic pressure on the outer
    wall must add up to zero.
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
    """Return the unbalanced axial force on tube and stone, relative to the forces at the ends.

    The resultants of the stress on both end sections, of the fluid pressure on the upstream
    section, of the force that holds the stone, of a hydrostatic pressure on the outer wall, and of
    the tether must add up to zero.

    Parameters
    ----------
    solved : SolvedWall
        Solution on a mesh of the whole tube.
    pressure : float
        Pressure of the fluid upstream of the contact, in units of the modulus.
    force : float
        Axial force on the stone, positive downstream, in units of modulus × inner radius². It was
        integrated over the contact only, so this balance is an independent check of it.

    Returns
    -------
    float
        Absolute value of the unbalanced force, divided by the sum of the magnitudes of both section
        forces and the force of the fluid.
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
    """Return the largest |λ_t| − μ λ_n at the nodes, divided by the largest λ_n.

    Coulomb's law requires a value of at most zero, apart from rounding.
    """
    wall = inner_wall(solved.discretisation)
    excess = np.abs(wall.tangential) - solved.friction * np.maximum(wall.normal, 0.0)
    return float(excess.max() / wall.normal.max())


def _section_force(solved: SolvedWall, Z: float) -> tuple[float, float]:
    """Return the axial force 2π ∫ σ_zz r dr on the plane section at Z, and its outer radius."""
    d = solved.discretisation
    u, w, p, *_ = d.fields
    stress_zz = cauchy_stress(d.tube.energy, u, w, p)[2].Compile()
    stretch_rr = strain(u, w).F_rr
    points, weights = np.polynomial.legendre.leggauss(d.order + 3)
    lines = solved.layout.radial
    run = np.diff(lines)[:, None]
    R = (lines[:-1, None] + run * (points + 1.0) / 2.0).ravel()
    # The points lie slightly inside the mesh, because NGSolve may not find points on its boundary.
    middle = solved.layout.axial.mean()
    Z += NUDGE * (middle - Z)
    outer = lines[-1] - NUDGE * (lines[-1] - lines[0])
    at = d.mesh(R, np.full_like(R, Z))
    density = stress_zz(at).ravel() * (R + u(at).ravel()) * stretch_rr(at).ravel()
    force = 2.0 * np.pi * float(((run * weights / 2.0).ravel() * density).sum())
    return force, float(lines[-1] + u(d.mesh(float(outer), float(Z))))


def stored_energy(solved: EquilibriumState) -> float:
    """Return the strain energy of the meshed part of the wall, in units of modulus × inner radius³.

    If the contact with a sphere of radius R is the only load, the derivative of this energy with
    respect to R is the contact force ∫ σ dA, because an increase of R by dR does the work ∫ σ dA
    dR.
    """
    u, w, *_ = solved.discretisation.fields
    density = ng.CF(solved.discretisation.tube.energy(strain(u, w).C, PLACE, SYMBOLS))
    return float(
        2.0
        * np.pi
        * ng.Integrate(density * ng.x * ng.dx(bonus_intorder=8), solved.discretisation.mesh)
    )
