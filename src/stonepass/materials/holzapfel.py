"""The Holzapfel–Gasser–Ogden law: two families of fibres, in tension only, in a soft matrix."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from stonepass.materials.constants import check_constants, constant
from stonepass.strain import CauchyGreen, Place

__all__ = ["HolzapfelGasserOgden"]


@dataclass(frozen=True)
class HolzapfelGasserOgden:
    """U = μ/2 (I₁ − 3) + k₁/(2k₂) Σ (exp(k₂ ⟨E_i⟩²) − 1), the sum over two families of fibres.

    E = κ (I₁ − 3) + (1 − 3κ)(I₄ − 1) with I₄ = a·C a the squared stretch along the fibres, which
    lie at +γ and −γ from the circumference in the surface θ–z. ⟨E⟩ is E where it is positive, else
    zero: fibres bear tension only. U has a second derivative on either side of E = 0 but not there;
    at exactly E = 0 automatic differentiation gives the mean of both. `one_sided_moduli` has both.

    Sources: Holzapfel, Gasser, Ogden 2000, Journal of Elasticity 61, 1–48 (κ = 0); Gasser, Ogden,
    Holzapfel 2006, Journal of the Royal Society Interface 3, 15–35 (dispersion κ).

    Attributes
    ----------
    mu : float
        Shear modulus of the matrix in Pa, positive. The matrix is a part of this law as it is
        published, so `composition.fibres_of` leaves it in.
    k1 : float
        Stiffness of the fibres in Pa, zero or positive.
    k2 : float
        Stiffening of the fibres, without unit, above 0 and below 1000.
    angle : float
        γ in rad, 0 (around) to π/2 (along the axis).
    kappa : float
        Dispersion κ, 0 (parallel) to 1/3 (isotropic).
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
        """Strain energy in J/m³."""
        c, s = math.cos(self.angle), math.sin(self.angle)
        excess = C.I1 - 3.0
        along, across = C.tt * c * c + C.zz * s * s - 1.0, 2.0 * c * s * C.tz
        total = self.mu / 2.0 * excess
        for side in (across, -across):
            E = self.kappa * excess + (1.0 - 3.0 * self.kappa) * (along + side)
            fibres = xp.exp(self.k2 * E * xp.maximum(E, 0.0)) - 1.0
            total = total + self.k1 / (2.0 * self.k2) * fibres
        return total
