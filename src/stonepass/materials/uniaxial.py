"""Uniaxial tension of a strip of the wall: nominal stress as a function of stretch."""

from __future__ import annotations

import numpy as np

from stonepass.array_types import Float
from stonepass.errors import require
from stonepass.materials.protocol import Law
from stonepass.strain import INNER_WALL, CauchyGreen

__all__ = ["AXES", "nominal_stress"]

AXES = ("circumferential", "axial")  # tt and zz of the wall
STEPS = 60
TOLERANCE = 1e-12  # tolerance of the logarithm of the lateral stretch
LARGEST_STEP = 0.1  # largest Newton step of the logarithm of the lateral stretch
STRETCH = (0.2, 5.0)
IMAGINARY = 1e-30  # complex step of a derivative; it takes no difference, so no digits cancel
NEARBY = 1e-5  # increment of ln b for the second derivative, a difference of two derivatives


def nominal_stress(
    law: Law, stretch: Float[np.ndarray, " n"], axis: str
) -> Float[np.ndarray, " n"]:
    """Return the nominal stress of a strip that is cut along `axis` and stretched.

    Let w(λ, b) be the energy density at the stretches λ along the strip, b across the strip in the
    plane of the wall, and 1/(λb) through the wall. The lateral stretch b follows from ∂w/∂b = 0,
    and the nominal stress is ∂w/∂λ. For a neo-Hookean law it is 2 C₁₀ (λ − λ⁻²). The derivatives
    are computed with a complex step, which is exact to rounding if the law is built from analytic
    functions.

    Parameters
    ----------
    law : Law
        It is evaluated at the inner wall, R = 1.
    stretch : array (n,)
        Stretches λ along the strip, from 0.2 to 5.
    axis : {"circumferential", "axial"}
        Direction of the wall along which the strip was cut.

    Returns
    -------
    array (n,)
        Force per undeformed cross-section in Pa; NaN where no lateral stretch with ∂w/∂b = 0 is
        found, as for an unstable law.

    Raises
    ------
    BadInput
        A stretch is out of bounds, or there is none.
    """
    along = np.asarray(stretch, dtype=float)
    low, high = STRETCH
    within = bool(along.size) and bool(np.all((low <= along) & (along <= high)))
    require(within, "stretch", "out of bounds or missing", f"{low:g} to {high:g}")
    log_a, log_b = np.log(along), -0.5 * np.log(along)
    round_it = axis == AXES[0]
    with np.errstate(all="ignore"):  # stretches without convergence are set to NaN after the loop
        for _ in range(STEPS):
            here = _slope(law, log_a, log_b, round_it, lateral=True)
            there = _slope(law, log_a, log_b + NEARBY, round_it, lateral=True)
            curvature = (there - here) / NEARBY
            step = -here / np.where(curvature > 0.0, curvature, np.nan)
            step = np.clip(step, -LARGEST_STEP, LARGEST_STEP)
            log_b = log_b + step
            if np.all(~(np.abs(step) > TOLERANCE)):
                break
        log_b = np.where(np.abs(step) <= TOLERANCE, log_b, np.nan)
        return _slope(law, log_a, log_b, round_it, lateral=False) / along


def _slope(
    law: Law,
    log_a: Float[np.ndarray, " n"],
    log_b: Float[np.ndarray, " n"],
    round_it: bool,
    *,
    lateral: bool,
) -> Float[np.ndarray, " n"]:
    """Return ∂w/∂ln b (`lateral`) or ∂w/∂ln λ in Pa."""
    a = log_a + (0.0 if lateral else 1j * IMAGINARY)
    b = log_b + (1j * IMAGINARY if lateral else 0.0)
    C_aa, C_bb, C_rr = np.exp(2.0 * a), np.exp(2.0 * b), np.exp(-2.0 * (a + b))
    C_tt, C_zz = (C_aa, C_bb) if round_it else (C_bb, C_aa)
    return (
        np.imag(law.energy(CauchyGreen(C_rr, C_tt, C_zz, 0.0 * C_rr), INNER_WALL, np)) / IMAGINARY
    )
