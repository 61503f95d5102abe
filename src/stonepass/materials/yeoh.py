"""The Yeoh law, U = C₁₀ (I₁ − 3) + C₂₀ (I₁ − 3)² + C₃₀ (I₁ − 3)³."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from stonepass.errors import require

__all__ = ["Yeoh"]


@dataclass(frozen=True)
class Yeoh:
    """Isotropic rubber that stiffens at large strain: shear modulus 2 C10 at rest.

    Attributes
    ----------
    C10 : float
        Pa, positive.
    C20, C30 : float
        Pa, of the second and third power.
    """

    C10: float
    C20: float
    C30: float

    def __post_init__(self) -> None:
        require(0.0 < self.C10 < np.inf, "C10", self.C10, "a positive modulus")
        for name in ("C20", "C30"):
            value = getattr(self, name)
            require(abs(value) < np.inf, name, value, "a finite modulus")

    def energy(self, C_rr: Any, C_tt: Any, C_zz: Any, C_rz: Any, xp: Any) -> Any:
        """Strain energy in J/m³."""
        x = C_rr + C_tt + C_zz - 3.0
        return x * (self.C10 + x * (self.C20 + x * self.C30))

    def without_ground_matrix(self) -> Yeoh:
        """Return itself: there is no fibre part to leave alone."""
        return self
