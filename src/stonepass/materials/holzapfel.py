"""The Holzapfel–Gasser–Ogden law: two families of tension-only fibres in a soft matrix."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from stonepass.materials.constants import check_constants, constant
from stonepass.strain import CauchyGreen, Place

__all__ = ["HolzapfelGasserOgden"]


@dataclass(frozen=True)
class HolzapfelGasserOgden:
    """Two families of fibres in an isotropic matrix.

    The energy is U = μ/2 (I₁ − 3) + k₁/(2k₂) Σ (exp(k₂ ⟨E⟩²) − 1), with the sum over both families.
    The strain of a family is E = κ (I₁ − 3) + (1 − 3κ)(I₄ − 1), where I₄ = a·C a is the squared
    stretch in the direction a of the fibres. In the t–z surface the fibres lie at the angles +γ and
    −γ to the circumference. ⟨E⟩ = max(E, 0), because fibres resist tension only.

    The second derivative of U jumps at E = 0. There, automatic differentiation returns the mean of
    both one-sided values; `materials.stability.one_sided_moduli` returns each of them.

    Sources: Holzapfel, Gasser, Ogden 2000, Journal of Elasticity 61, 1–48 (κ = 0); Gasser, Ogden,
    Holzapfel 2006, Journal of the Royal Society Interface 3, 15–35 (dispersion κ).

    Attributes
    ----------
    mu : float
        Shear modulus of the matrix in Pa, positive. The matrix is part of the published law, so
        `composition.fibres_of` does not remove it.
    k1 : float
        Stiffness of the fibres in Pa, zero or positive.
    k2 : float
        Dimensionless exponent of the stiffening of the fibres, above 0 and below 1000.
    angle : float
        γ in rad, from 0 (circumferential) to π/2 (axial).
    kappa : float
        Dispersion κ of the fibre directions, from 0 (parallel) to 1/3 (isotropic).
    """

    mu: float = constant("μ", "Pa", "shear modulus of the matrix", guess=0.5)
    k1: float = constant("k₁", "Pa", "stiffness of the fibres", low_allowed=True, guess=0.5)
    k2: float = constant("k₂", "1", "exponential stiffening of the fibres", high=1e3, guess=1.0)
    angle: float = constant(
        "γ", "rad", "angle of the fibres to the circumference", high=math.pi / 2.0,
        low_allowed=True, high_allowed=True, guess=0.7,
    )  # fmt: skip
    kappa: float = constant(
        "κ", "1", "dispersion of the fibres, 0 parallel, 1/3 isotropic", high=1.0 / 3.0,
        low_allowed=True, high_allowed=True, guess=0.1, held=True, default=0.0,
    )  # fmt: skip

    def __post_init__(self) -> None:
        check_constants(self)

    def energy(self, C: CauchyGreen, place: Place, xp: Any) -> Any:
        """Return the strain energy in J/m³, see `Law.energy`."""
        c, s = math.cos(self.angle), math.sin(self.angle)
        excess = C.I1 - 3.0
        along, across = C.tt * c * c + C.zz * s * s - 1.0, 2.0 * c * s * C.tz
        total = self.mu / 2.0 * excess
        for side in (across, -across):
            E = self.kappa * excess + (1.0 - 3.0 * self.kappa) * (along + side)
            fibres = xp.exp(self.k2 * E * xp.maximum(E, 0.0)) - 1.0
            total = total + self.k1 / (2.0 * self.k2) * fibres
        return total
