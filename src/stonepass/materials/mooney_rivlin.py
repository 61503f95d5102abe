"""The Mooney–Rivlin law, U = C₁₀ (I₁ − 3) + C₀₁ (I₂ − 3)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from stonepass.errors import require

__all__ = ["MooneyRivlin"]


@dataclass(frozen=True)
class MooneyRivlin:
    """Isotropic rubber with a second constant: shear modulus 2 (C10 + C01).

    Attributes
    ----------
    C10 : float
        Pa, positive.
    C01 : float
        Pa, of the second invariant; its sum with C10 is positive.
    """

    C10: float
    C01: float

    def __post_init__(self) -> None:
        require(0.0 < self.C10 < np.inf, "C10", self.C10, "a positive modulus")
        require(0.0 < self.C10 + self.C01 < np.inf, "C01", self.C01, "above -C10")

    def energy(self, C_rr: Any, C_tt: Any, C_zz: Any, C_rz: Any, xp: Any) -> Any:
        """Strain energy in J/m³; I₂ = ½ (I₁² − tr C²)."""
        first = C_rr + C_tt + C_zz
        squares = C_rr * C_rr + C_tt * C_tt + C_zz * C_zz + 2.0 * C_rz * C_rz
        return self.C10 * (first - 3.0) + self.C01 * ((first * first - squares) / 2.0 - 3.0)

    def without_ground_matrix(self) -> MooneyRivlin:
        """Return itself: there is no fibre part to leave alone."""
        return self
