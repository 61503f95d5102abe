"""A strip pulled along one direction of the wall, the others free."""

from __future__ import annotations

import numpy as np

from stonepass.array_types import Float
from stonepass.errors import require
from stonepass.materials.protocol import Law
from stonepass.strain import INNER_WALL, CauchyGreen

__all__ = ["AXES", "nominal_stress"]

AXES = ("circumferential", "axial")  # tt and zz of the wall
STEPS = 60
TOLERANCE = 1e-12  # of the lateral stretch
LARGEST_STEP = 0.1  # of ln of it
STRETCH = (0.2, 5.0)
IMAGINARY = 1e-30  # step into the complex plane: no difference is taken, so none cancels
NEARBY = 1e-5  # between two slopes


def nominal_stress(
    law: Law, stretch: Float[np.ndarray, " n"], axis: str
) -> Float[np.ndarray, " n"]:
    """Force over the section at rest in Pa of a strip cut along `axis` and stretched.

    In the plane of the wall the strip contracts by b, which follows from ∂w/∂b = 0 with
    w(λ, b) the energy at the stretches λ, b and 1/(λb); the stress is ∂w/∂λ. For a neo-Hookean law
    2 C₁₀ (λ − λ⁻²). NaN where no lateral stretch balances, as in an unstable law. Slopes are by the
    complex step, exact for a law of analytic functions, as all known ones are.

    Parameters
    ----------
    stretch : array
        λ, 0.2 to 5.
    axis : {"circumferential", "axial"}
    """
    along = np.asarray(stretch, dtype=float)
    low, high = STRETCH
    within = bool(along.size) and bool(np.all((low <= along) & (along <= high)))
    require(within, "stretch", "out of bounds or missing", f"{low:g} to {high:g}")
    log_a, log_b = np.log(along), -0.5 * np.log(along)
    round_it = axis == AXES[0]
    with np.errstate(all="ignore"):  # what does not converge is NaN below
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
    """∂w/∂ln b or ∂w/∂ln λ in Pa."""
    a = log_a + (0.0 if lateral else 1j * IMAGINARY)
    b = log_b + (1j * IMAGINARY if lateral else 0.0)
    C_aa, C_bb, C_rr = np.exp(2.0 * a), np.exp(2.0 * b), np.exp(-2.0 * (a + b))
    C_tt, C_zz = (C_aa, C_bb) if round_it else (C_bb, C_aa)
    return (
        np.imag(law.energy(CauchyGreen(C_rr, C_tt, C_zz, 0.0 * C_rr), INNER_WALL, np)) / IMAGINARY
    )
