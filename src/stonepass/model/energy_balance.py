"""Energy balance of an advance of the stone along the tube, without friction.

When the stone advances, inflated tube upstream of it replaces uninflated tube downstream. The
change of energy per unit advance is the axial force N on the stone if there is no friction; it does
not depend on the details of the contact. See "Identity" in docs/theory.md, section "The
push-through, solved directly". Forces are divided by π R_s², so they are pressures in Pa. The law
is relaxed (`materials.relaxed_energy`), as in the direct model.
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

WIDEST = 4.0  # largest r_a/R_a in the search for the opened radius
POINTS = 48  # number of quadrature points
STEP = 1e-4  # increment of the axial stretch in a difference quotient


def opened_radius(case: Problem, pressure: float) -> float | None:
    """Return r_a/R_a of the uniform tube under the urine pressure P_u, at constant pre-stretch.

    Parameters
    ----------
    case : Problem
    pressure : float
        P_u in Pa; a value of zero or less stands for no urine pressure.

    Returns
    -------
    float or None
        None if the tube has no equilibrium at this pressure up to r_a = 4 R_a.
    """
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
    """Return the urine pressure P_u in Pa at which the uniform tube is as wide as the stone."""
    return _urine(case, relaxed(case.ureter.material.law), case.size_ratio)


def advance_force(case: Problem, pressure: float) -> float | None:
    """Return I(P)/(π R_s²) in Pa, with I(P) = ∫₀ᴾ π r_a(p)² dp.

    I(P) is the axial force on the stone without friction, if the axial stretch of the tube is the
    same on both sides of the stone. Integration by parts gives I = π [r_a² P − 2 ∫ r p(r) dr],
    where r extends from the lumen to r_a(P).

    Parameters
    ----------
    case : Problem
    pressure : float
        P in Pa.

    Returns
    -------
    float or None
        None if the tube has no equilibrium at this pressure.
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
    """Return N/(π R_s²) in Pa without friction, if the axial stretches of both sides differ.

    Let ω(λ, p) be the minimum over r_a of 2π ∫ w R dR − p λ π r_a² + the potential of P_out: the
    energy per reference length of a uniform tube with the axial stretch λ and the inner pressure p.
    Let S = ∂ω/∂λ, and let ε = λ − λ_z be the deviation of the axial stretch from the pre-stretch
    λ_z. The superscript − denotes the upstream side (p = P_u), + the downstream side (p = 0). The
    wall slides freely along the stone, so ω − λ S is equal on both sides, and the axial equilibrium
    is N = S⁺ − S⁻. Both together give N = [(ω − ε S)⁺ − (ω − ε S)⁻]/λ_z. To second order in ε this
    is I + ½ (K⁻ ε⁻² − K⁺ ε⁺²)/λ_z with K = ∂S/∂λ.

    Parameters
    ----------
    case : Problem
    pressure : float
        P_u in Pa.
    upstream_stretch, downstream_stretch : float
        Axial stretch λ far from the stone on either side, positive.
    """
    ahead, behind = _side(case, 0.0, downstream_stretch), _side(case, pressure, upstream_stretch)
    return (ahead - behind) / (case.load.prestretch * case.size_ratio**2)


def _side(case: Problem, pressure: float, stretch: float) -> float:
    slope = _omega(case, pressure, stretch + STEP) - _omega(case, pressure, stretch - STEP)
    strain = stretch - case.load.prestretch
    return _omega(case, pressure, stretch) - strain * slope / (2.0 * STEP)


def _omega(case: Problem, pressure: float, axial: float) -> float:
    """Return ω/π in Pa × inner radius²."""
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
    # Imported here because it loads most of SciPy, which only loaded states need.
    from scipy.optimize import minimize_scalar

    found = minimize_scalar(potential, bounds=bounds, options={"xatol": 1e-11})
    return float(found.fun)


def _urine(case: Problem, law: Law, ratio: float) -> float:
    return float(urine_pressure(np.array(ratio), case.wall_ratio, law, case.load))
