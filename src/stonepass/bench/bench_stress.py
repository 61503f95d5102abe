"""Stress of a strip and pressure of a tube, also for constants that make the law unstable.

During a fit the search passes through constants for which the law is not stable. For these
constants too, the prediction is the stress or pressure in equilibrium, even if the equilibrium is
unstable. The prediction is therefore a smooth function of the constants. All points are evaluated
at once. Derivatives are taken by the complex-step method, which is exact to rounding for the
analytic functions of the known laws.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from stonepass.array_types import Bool, Float
from stonepass.materials.protocol import Law
from stonepass.strain import INNER_WALL, CauchyGreen

__all__ = ["strip_stress", "tube_pressure"]

STEPS = 60  # largest number of Newton steps
# Newton's method has converged when a step of ln b is below this. The remaining error of ln b is
# then about 1e-5 times that step.
TOLERANCE = 1e-7
LARGEST_STEP = 0.1  # largest change of the logarithm of the lateral stretch in one step
IMAGINARY = 1e-30  # imaginary step; no difference is formed, so that no digits cancel
NEARBY = 1e-5  # distance in ln b of the two slopes whose difference is the stiffness
QUADRATURE_POINTS = 32  # Gauss points over the thickness of a wall


def strip_stress(
    law: Law, stretch: Float[np.ndarray, " n"], around: Bool[np.ndarray, " n"]
) -> tuple[Float[np.ndarray, " n"], Float[np.ndarray, " n"]]:
    """Compute the nominal stress of strips in uniaxial tension and their lateral stiffness.

    Let w(λ, b) be the energy of the incompressible strip with the stretch λ along it and b across
    it, in the plane of the wall. The sides are free of load, so that ∂w/∂b = 0 determines b. The
    nominal stress is ∂w/∂λ. Newton's method for b starts from b = λ^(−1/2), which is the solution
    for an isotropic law, and finds the equilibrium nearest to it.

    Parameters
    ----------
    law : Law
        Its constants may lie outside their bounds.
    stretch : array (n)
        Stretch λ along the strip, above 0.
    around : array (n) of bool
        True if the strip was cut around the tube, False if it was cut along the axis.

    Returns
    -------
    stress : array (n)
        Nominal stress in Pa; NaN if no equilibrium was found.
    stiffness : array (n)
        ∂²w/∂(ln b)² in Pa. If it is negative, the equilibrium is unstable.

    References
    ----------
    docs/bench.md, "The fit".
    """
    log_a = np.log(np.asarray(stretch, dtype=float))
    log_b, near = -0.5 * log_a, np.array([[0.0], [NEARBY]])
    with np.errstate(all="ignore"):  # points that do not converge become NaN below
        for _ in range(STEPS):
            here, there = _slope(law, log_a, log_b + near, around, lateral=True)
            stiffness = (there - here) / NEARBY
            step = np.minimum(np.maximum(-here / stiffness, -LARGEST_STEP), LARGEST_STEP)
            step = np.where(here == 0.0, 0.0, step)
            log_b = log_b + step
            if not (np.abs(step) > TOLERANCE).any():
                break
        log_b = np.where(np.abs(step) <= TOLERANCE, log_b, np.nan)
        return _slope(law, log_a, log_b, around, lateral=False) / stretch, stiffness


def _slope(
    law: Law,
    log_a: Float[np.ndarray, " n"],
    log_b: Float[np.ndarray, "... n"],
    around: Bool[np.ndarray, " n"],
    *,
    lateral: bool,
) -> Float[np.ndarray, "... n"]:
    """Compute ∂w/∂ln b (`lateral`) or ∂w/∂ln λ in Pa."""
    C_aa, C_bb = np.exp(2.0 * log_a), np.exp(2.0 * log_b)
    # exp(x + i ε) = exp(x) (1 + i ε) to rounding, without a complex exponential.
    C_rr = (1.0 / (C_aa * C_bb)) * (1.0 - 2j * IMAGINARY)
    if lateral:
        C_bb = C_bb * (1.0 + 2j * IMAGINARY)
    else:
        C_aa = C_aa * (1.0 + 2j * IMAGINARY)
    C_tt, C_zz = np.where(around, C_aa, C_bb), np.where(around, C_bb, C_aa)
    energy = law.energy(CauchyGreen(C_rr, C_tt, C_zz, 0.0 * C_rr), INNER_WALL, np)
    return np.imag(energy) / IMAGINARY


def tube_pressure(
    law: Law,
    radius_ratio: Float[np.ndarray, " n"],
    wall_ratio: float,
    axial: Float[np.ndarray, " n"],
) -> Float[np.ndarray, " n"]:
    """Compute the transmural pressure of tubes, P = ∫ w′(λ)/(λ_z λ) d ln R over the wall.

    Unlike `model.far_field.inflation`, each point has its own axial stretch, and constants outside
    their bounds are allowed.

    Parameters
    ----------
    law : Law
        Its constants may lie outside their bounds.
    radius_ratio : array (n)
        Inner radius r_a over the unloaded inner radius R_a, above 0.
    wall_ratio : float
        Wall ratio η = R_b/R_a, above 1.
    axial : array (n)
        Axial stretch λ_z, above 0.

    Returns
    -------
    array (n)
        Pressure inside less pressure outside, in Pa.

    References
    ----------
    Liu et al. 2022, Eq. 12; docs/theory.md, "Far field".
    """
    points, weights = _gauss()
    R = wall_ratio**points
    along = axial[:, None]
    with np.errstate(all="ignore"):  # the exponential of extreme trial constants may overflow
        stretch = np.sqrt(radius_ratio[:, None] ** 2 + (R**2 - 1.0) / along) / R
        t = stretch * (1.0 + 1j * IMAGINARY)
        C_tt = t * t
        C = CauchyGreen(1.0 / (C_tt * along**2), C_tt, along**2 + 0.0 * C_tt, 0.0 * C_tt)
        slope = np.imag(law.energy(C, INNER_WALL, np)) / IMAGINARY  # λ w′(λ)
        return (slope / (along * stretch**2)) @ weights * np.log(wall_ratio)


@lru_cache(maxsize=1)
def _gauss() -> tuple[Float[np.ndarray, " n"], Float[np.ndarray, " n"]]:
    """Return the Gauss–Legendre points and weights on [0, 1]."""
    points, weights = np.polynomial.legendre.leggauss(QUADRATURE_POINTS)
    return (points + 1.0) / 2.0, weights / 2.0
