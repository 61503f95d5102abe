"""The Demiray law, U = μ/(2b) (exp(b (I₁ − 3)) − 1)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from stonepass.materials.constants import check_constants, constant
from stonepass.strain import CauchyGreen, Place

__all__ = ["Demiray"]


@dataclass(frozen=True)
class Demiray:
    """Isotropic soft tissue that stiffens exponentially; its shear modulus at rest is μ.

    Source: Demiray 1972, Journal of Biomechanics 5, 309–311, where μ and b are called β and α.

    Attributes
    ----------
    mu : float
        Shear modulus at rest in Pa, positive.
    b : float
        Dimensionless exponent of the stiffening, above 0 and below 1000.
    """

    mu: float = constant("μ", "Pa", "shear modulus at rest", guess=1.0)
    b: float = constant("b", "1", "exponential stiffening with I₁", high=1e3, guess=1.0)

    def __post_init__(self) -> None:
        check_constants(self)

    def energy(self, C: CauchyGreen, place: Place, xp: Any) -> Any:
        """Return the strain energy in J/m³, see `Law.energy`."""
        return self.mu / (2.0 * self.b) * (xp.exp(self.b * (C.I1 - 3.0)) - 1.0)
