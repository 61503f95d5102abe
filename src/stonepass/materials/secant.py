"""Secant moduli of a law: the moduli of a linear wall with the same stress at a given stretch."""

from __future__ import annotations

from typing import Any

import numpy as np

from stonepass.errors import require
from stonepass.materials.derivatives import hoop_energy_slope
from stonepass.materials.one_trace import one_trace
from stonepass.materials.protocol import Law
from stonepass.strain import INNER_WALL, CauchyGreen

__all__ = ["secant_moduli"]

STRETCH = (1.001, 2.0)


@one_trace
def secant_moduli(law: Law, stretch: float) -> tuple[float, float]:
    """Return the circumferential and the longitudinal secant modulus in plane strain.

    The secant modulus is the nominal stress divided by λ − 1. The wall is stretched in one of the
    two directions and keeps its length in the other; the radial stretch follows from
    incompressibility. For a neo-Hookean law both moduli are 2 C₁₀ (λ − λ⁻³)/(λ − 1), which tends to
    8 C₁₀ as λ tends to 1. See "The thin wall as a beam" in docs/theory.md.

    Parameters
    ----------
    law : Law
        It is evaluated at the inner wall, R = 1.
    stretch : float
        λ, from 1.001 to 2.

    Returns
    -------
    (float, float)
        Circumferential and longitudinal modulus in Pa.

    Raises
    ------
    BadInput
        The stretch is out of bounds.
    """
    low, high = STRETCH
    require(low <= stretch <= high, "secant stretch", stretch, f"a number from {low:g} to {high:g}")

    import autograd.numpy as anp
    from autograd import elementwise_grad

    def lengthened(t: Any) -> Any:
        one = t / t
        C = CauchyGreen(1.0 / (t * t), one, t * t, 0.0 * one)
        return law.energy(C, INNER_WALL, anp)

    at = np.array([stretch])
    slopes = np.array([hoop_energy_slope(law, at), elementwise_grad(lengthened)(at)])
    hoop, axial = slopes[:, 0] / (stretch - 1.0)
    return float(hoop), float(axial)
