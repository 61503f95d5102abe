"""The Yeoh law, U = C₁₀ (I₁ − 3) + C₂₀ (I₁ − 3)² + C₃₀ (I₁ − 3)³."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from stonepass.materials.constants import check_constants, constant
from stonepass.strain import CauchyGreen, Place

__all__ = ["Yeoh"]


@dataclass(frozen=True)
class Yeoh:
    """Isotropic rubber that stiffens at large strain; its shear modulus at rest is 2 C10.

    Source: Yeoh 1993, Rubber Chemistry and Technology 66, 754–771.

    Attributes
    ----------
    C10 : float
        Factor of I₁ − 3 in Pa, positive.
    C20, C30 : float
        Factors of (I₁ − 3)² and (I₁ − 3)³ in Pa, of either sign; the default of C30 is 0.
    """

    C10: float = constant("C₁₀", "Pa", "factor of I₁ − 3", guess=0.5)
    C20: float = constant("C₂₀", "Pa", "factor of (I₁ − 3)²", low=-math.inf, guess=0.1)
    C30: float = constant("C₃₀", "Pa", "factor of (I₁ − 3)³", low=-math.inf, guess=0.1, default=0.0)

    def __post_init__(self) -> None:
        check_constants(self)

    def energy(self, C: CauchyGreen, place: Place, xp: Any) -> Any:
        """Return the strain energy in J/m³, see `Law.energy`."""
        x = C.rr + C.tt + C.zz - 3.0
        return x * (self.C10 + x * (self.C20 + x * self.C30))
