"""Stress of a strip and pressure of a tube for any constants, whether they describe a solid or not.

A fit tries constants that may be no solid. Equilibrium is taken there as well, stable or not, so
that what the law predicts is a smooth function of its constants. All points are evaluated at once;
slopes are by the complex step, exact for a law of analytic functions, as all known ones are.
"""

from __future__ import annotations

from functools import lru_cache

import numpy as np

from stonepass.array_types import Bool, Float
from stonepass.materials.protocol import Law
from stonepass.strain import INNER_WALL, CauchyGreen

__all__ = ["strip_stress", "tube_pressure"]

STEPS = 60
TOLERANCE = 1e-7  # of ln of the lateral stretch in the last step, whose error is 1e-5 of it
LARGEST_STEP = 0.1  # of ln of it
IMAGINARY = 1e-30  # step into the complex plane: no difference is taken, so none cancels
NEARBY = 1e-5  # between two slopes
QUADRATURE_POINTS = 32  # of a wall


def strip_stress(
    law: Law, stretch: Float[np.ndarray, " n"], around: Bool[np.ndarray, " n"]
) -> tuple[Float[np.ndarray, " n"], Float[np.ndarray, " n"]]:
    """Force over the section at rest of strips, and what resists a change of their width.

    With w(λ, b) the energy at the stretches λ along the strip and b across it in the plane of the
    wall, b follows from ∂w/∂b = 0 and the stress is ∂w/∂λ. Both are of the equilibrium that is
    nearest to b = λ^(−1/2); for an isotropic law it is this one, of equal stretches across.

    Parameters
    ----------
    law : Law
    stretch : array (n)
        λ, positive.
    around : array (n) of bool
        Whether the strip was cut around the tube; else along its axis.

    Returns
    -------
    stress : array (n)
        In Pa; NaN where no equilibrium was found.
    stiffness : array (n)
        ∂²w/∂(ln b)² in Pa; an equilibrium with a negative one is not stable.
    """
    log_a = np.log(np.asarray(stretch, dtype=float))
    log_b, near = -0.5 * log_a, np.array([[0.0], [NEARBY]])
    with np.errstate(all="ignore"):  # what does not converge is NaN below
        for _ in range(STEPS):
            here, there = _slope(law, log_a, log_b + near, around, lateral=True)
            stiffness = (there - here) / NEARBY
            step = np.clip(-here / stiffness, -LARGEST_STEP, LARGEST_STEP)
            step = np.where(here == 0.0, 0.0, step)
            log_b = log_b + step
            if np.all(~(np.abs(step) > TOLERANCE)):
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
    """∂w/∂ln b or ∂w/∂ln λ in Pa."""
    a = log_a + (0.0 if lateral else 1j * IMAGINARY)
    b = log_b + (1j * IMAGINARY if lateral else 0.0)
    C_aa, C_bb, C_rr = np.exp(2.0 * a), np.exp(2.0 * b), np.exp(-2.0 * (a + b))
    C_tt, C_zz = np.where(around, C_aa, C_bb), np.where(around, C_bb, C_aa)
    energy = law.energy(CauchyGreen(C_rr, C_tt, C_zz, 0.0 * C_rr), INNER_WALL, np)
    return np.imag(energy) / IMAGINARY


def tube_pressure(
    law: Law,
    radius_ratio: Float[np.ndarray, " n"],
    wall_ratio: float,
    axial: Float[np.ndarray, " n"],
) -> Float[np.ndarray, " n"]:
    """Transmural pressure in Pa of tubes, ∫ w′(λ)/(λ_z λ) d ln R over the wall (paper, Eq. 12).

    The formula is that of `model.far_field.inflation`, for an axial stretch of each point.

    Parameters
    ----------
    law : Law
    radius_ratio : array (n)
        r_a/R_a.
    wall_ratio : float
        η.
    axial : array (n)
        λ_z.
    """
    points, weights = _gauss()
    R = wall_ratio**points
    along = axial[:, None]
    with np.errstate(all="ignore"):  # far-off constants of a fit may overflow
        stretch = np.sqrt(radius_ratio[:, None] ** 2 + (R**2 - 1.0) / along) / R
        t = stretch * (1.0 + 1j * IMAGINARY)
        C_tt = t * t
        C = CauchyGreen(1.0 / (C_tt * along**2), C_tt, along**2 + 0.0 * C_tt, 0.0 * C_tt)
        slope = np.imag(law.energy(C, INNER_WALL, np)) / IMAGINARY  # λ w′(λ)
        return (slope / (along * stretch**2)) @ weights * np.log(wall_ratio)


@lru_cache(maxsize=1)
def _gauss() -> tuple[Float[np.ndarray, " n"], Float[np.ndarray, " n"]]:
    """Gauss–Legendre points and weights on [0, 1]."""
    points, weights = np.polynomial.legendre.leggauss(QUADRATURE_POINTS)
    return (points + 1.0) / 2.0, weights / 2.0
