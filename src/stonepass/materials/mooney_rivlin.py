"""The Mooney–Rivlin law, U = C₁₀ (I₁ − 3) + C₀₁ (I₂ − 3)."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from stonepass.errors import require
from stonepass.materials.constants import check_constants, constant
from stonepass.strain import CauchyGreen, Place

__all__ = ["MooneyRivlin"]


@dataclass(frozen=True)
class MooneyRivlin:
    """Isotropic rubber with two constants; its shear modulus at rest is 2 (C10 + C01).

    Source: Rivlin 1948, Philosophical Transactions of the Royal Society A 241, 379–397.

    Attributes
    ----------
    C10 : float
        Factor of I₁ − 3 in Pa, positive.
    C01 : float
        Factor of I₂ − 3 in Pa, above −C10.
    """

    C10: float = constant("C₁₀", "Pa", "factor of I₁ − 3", guess=0.5)
    C01: float = constant("C₀₁", "Pa", "factor of I₂ − 3, above −C10", low=-math.inf, guess=0.1)

    def __post_init__(self) -> None:
        check_constants(self)
        require(self.C10 + self.C01 > 0.0, "C01", self.C01, "above -C10")

    def energy(self, C: CauchyGreen, place: Place, xp: Any) -> Any:
        """Return the strain energy in J/m³, see `Law.energy`."""
        return self.C10 * (C.I1 - 3.0) + self.C01 * (C.I2 - 3.0)
