"""What an advance of the stone exchanges: inflated for uninflated tube (model: section 7).

Without friction that alone is the force on the stone, whatever the contact looks like. Forces are
divided by π R_s², so they are pressures in Pa.
"""

from __future__ import annotations

import numpy as np

from stonepass.fe.core.roots import bracketed_root
from stonepass.materials.protocol import Law
from stonepass.materials.relaxed_energy import relaxed
from stonepass.model.far_field import lumen_ratio, urine_pressure
from stonepass.model.problem import Problem
from stonepass.strain import CauchyGreen, Place

__all__ = ["advance_force", "opened_radius", "opening_pressure", "strained_force"]

WIDEST = 4.0  # r_a/R_a that is looked for
POINTS = 48
STEP = 1e-4  # of the axial stretch, for its slope


def opened_radius(case: Problem, pressure: float) -> float | None:
    """r_a/R_a of the tube under P_u, the pre-stretch kept; None where it has no such state."""
    law = relaxed(case.ureter.material.law)
    lumen = lumen_ratio(case.wall_ratio, law, case.load)
    if lumen is None or pressure <= 0.0:
        return lumen

    def excess(ratio: float) -> float:
        return _urine(case, law, ratio) - pressure

    wide = lumen
    while wide < WIDEST:
        wide *= 1.05
        if excess(wide) > 0.0:
            return bracketed_root(excess, lumen, wide, xtol=1e-13)
    return None


def opening_pressure(case: Problem) -> float:
    """P_u in Pa that opens the tube to R_s."""
    return _urine(case, relaxed(case.ureter.material.law), case.size_ratio)


def advance_force(case: Problem, pressure: float) -> float | None:
    """I(P)/(π R_s²) with I = ∫₀ᴾ π r_a(p)² dp; None where the tube does not bear P.

    By parts, π [r² P − 2 ∫ r p(r) dr] from the lumen to r_a(P).
    """
    radius, lumen = opened_radius(case, pressure), opened_radius(case, 0.0)
    if radius is None or lumen is None:
        return None
    law = relaxed(case.ureter.material.law)
    points, weights = np.polynomial.legendre.leggauss(POINTS)
    r = lumen + (points + 1.0) / 2.0 * (radius - lumen)
    p = urine_pressure(r, case.wall_ratio, law, case.load)
    inside = float((weights * r * p).sum()) * (radius - lumen) / 2.0
    return (radius**2 * pressure - 2.0 * inside) / case.size_ratio**2


def strained_force(
    case: Problem, pressure: float, upstream_stretch: float, downstream_stretch: float
) -> float:
    """N/(π R_s²) without friction where the sides are strained: [(ω − ε S)⁺ − (ω − ε S)⁻]/λ_z.

    ω(λ, p) = min over r_a of 2π ∫ w R dR − p λ π r_a² + the work of P_out, S = ∂ω/∂λ, ε = λ − λ_z
    the change of the axial stretch from the pre-stretch λ_z. The wall slides freely, so ω − λ S is
    the same on both sides; N = S⁺ − S⁻ balances the forces. To second order this is
    I + ½ (K⁻ ε⁻² − K⁺ ε⁺²)/λ_z, K = ∂S/∂λ.
    """
    ahead, behind = _side(case, 0.0, downstream_stretch), _side(case, pressure, upstream_stretch)
    return (ahead - behind) / (case.load.prestretch * case.size_ratio**2)


def _side(case: Problem, pressure: float, stretch: float) -> float:
    slope = _omega(case, pressure, stretch + STEP) - _omega(case, pressure, stretch - STEP)
    strain = stretch - case.load.prestretch
    return _omega(case, pressure, stretch) - strain * slope / (2.0 * STEP)


def _omega(case: Problem, pressure: float, axial: float) -> float:
    """ω/π in units of R_a², Pa."""
    law, load = relaxed(case.ureter.material.law), case.load
    points, weights = np.polynomial.legendre.leggauss(POINTS)
    span = case.wall_ratio - 1.0
    R, weights = 1.0 + (points + 1.0) / 2.0 * span, weights / 2.0 * span
    one = np.ones_like(R)

    def potential(lumen: float) -> float:
        hoop = np.sqrt(lumen**2 + (R**2 - 1.0) / axial) / R
        C = CauchyGreen(1.0 / (hoop * axial) ** 2, hoop**2, axial**2 * one, 0.0 * one)
        stored = 2.0 * float((weights * R * law.energy(C, Place(R), np)).sum())
        outer = float(np.sqrt(lumen**2 + (case.wall_ratio**2 - 1.0) / axial))
        outside = axial * outer**2 if load.hydrostatic else 2.0 * case.wall_ratio * outer
        return stored - pressure * axial * lumen**2 + load.confining_pressure * outside

    bounds = (0.3, WIDEST) if pressure == 0.0 else (0.3, 2.0 * case.size_ratio)
    from scipy.optimize import minimize_scalar  # most of SciPy, for loaded states alone

    found = minimize_scalar(potential, bounds=bounds, options={"xatol": 1e-11})
    return float(found.fun)


def _urine(case: Problem, law: Law, ratio: float) -> float:
    return float(urine_pressure(np.array(ratio), case.wall_ratio, law, case.load))
