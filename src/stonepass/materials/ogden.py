"""The Ogden law, U = Σ μ_p/α_p (λ₁^α_p + λ₂^α_p + λ₃^α_p − 3), up to three terms."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

from stonepass.errors import require
from stonepass.materials.constants import check_constants, constant
from stonepass.materials.principal_stretches import power_sum
from stonepass.strain import CauchyGreen, Place

__all__ = ["Ogden"]

LARGEST_POWER = 20.0


def _modulus(number: str, **more: Any) -> Any:
    meaning = f"modulus of term {number}, whose shear modulus is μ{number} α{number}/2"
    return constant(f"μ{number}", "Pa", meaning, low=-math.inf, guess=0.5, **more)


def _power(number: str, **more: Any) -> Any:
    return constant(
        f"α{number}", "1", f"power of the stretches in term {number}, not zero", low=-LARGEST_POWER,
        high=LARGEST_POWER, low_allowed=True, high_allowed=True, guess=2.0, **more,
    )  # fmt: skip


@dataclass(frozen=True)
class Ogden:
    """Isotropic rubber in principal stretches; its shear modulus at rest is ½ Σ μ_p α_p.

    Source: Ogden 1972, Proceedings of the Royal Society of London A 326, 565–584. The constants
    follow Ogden's convention. The constant μ_p of Abaqus and CalculiX equals μ_p α_p/2 here. With
    one term and α = 2 the law is the neo-Hookean law with C₁₀ = μ/2.

    Attributes
    ----------
    mu1, mu2, mu3 : float
        Moduli of the terms in Pa, of either sign; Σ μ_p α_p is positive. A modulus of zero, the
        default of the second and the third term, removes the term.
    alpha1, alpha2, alpha3 : float
        Dimensionless powers of the terms, from −20 to 20, but not zero.
    """

    mu1: float = _modulus("₁")
    alpha1: float = _power("₁")
    mu2: float = _modulus("₂", held=True, default=0.0)
    alpha2: float = _power("₂", held=True, default=4.0)
    mu3: float = _modulus("₃", held=True, default=0.0)
    alpha3: float = _power("₃", held=True, default=-2.0)

    def __post_init__(self) -> None:
        check_constants(self)
        for name in ("alpha1", "alpha2", "alpha3"):
            require(getattr(self, name) != 0.0, name, 0.0, "a number that is not zero")
        twice = sum(mu * alpha for mu, alpha in self.terms)
        require(twice > 0.0, "mu1", self.mu1, "such that the sum of mu times alpha is positive")

    @property
    def terms(self) -> tuple[tuple[float, float], ...]:
        """Pairs (μ_p, α_p) of the terms with μ_p ≠ 0."""
        pairs = ((self.mu1, self.alpha1), (self.mu2, self.alpha2), (self.mu3, self.alpha3))
        return tuple((mu, alpha) for mu, alpha in pairs if mu != 0.0)

    def energy(self, C: CauchyGreen, place: Place, xp: Any) -> Any:
        """Return the strain energy in J/m³, see `Law.energy`."""
        terms = [mu / alpha * (power_sum(C, alpha / 2.0, xp) - 3.0) for mu, alpha in self.terms]
        return sum(terms[1:], start=terms[0]) if terms else 0.0 * C.rr
