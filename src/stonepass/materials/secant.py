"""Secant moduli of a law: what a wall of linear springs would have between rest and a stretch."""

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
    """Circumferential and longitudinal modulus in Pa: nominal stress over λ − 1, plane strain.

    The other of the two directions keeps its length, the radial stretch follows from volume. For a
    neo-Hookean law both are 2 C₁₀ (λ − λ⁻³)/(λ − 1), at rest 8 C₁₀.

    Raises
    ------
    BadInput
        A stretch outside 1.001 to 2.
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
