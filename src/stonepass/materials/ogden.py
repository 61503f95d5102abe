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
    meaning = f"modulus of term {number}; its product with α counts"
    return constant(f"μ{number}", "Pa", meaning, low=-math.inf, guess=0.5, **more)


def _power(number: str, **more: Any) -> Any:
    return constant(
        f"α{number}", "1", f"power of the stretches in term {number}, not zero", low=-LARGEST_POWER,
        high=LARGEST_POWER, low_allowed=True, high_allowed=True, guess=2.0, **more,
    )  # fmt: skip


@dataclass(frozen=True)
class Ogden:
    """Isotropic rubber in principal stretches: shear modulus ½ Σ μ_p α_p at rest.

    Source: Ogden 1972, Proceedings of the Royal Society of London A 326, 565–584. Constants are in
    his convention; Abaqus and CalculiX take μ_p α_p/2 as their μ_p. A term with μ_p = 0 is absent.
    With one term and α = 2 this is the neo-Hookean law of C₁₀ = μ/2.

    Attributes
    ----------
    mu1, mu2, mu3 : float
        Pa, of any sign; Σ μ_p α_p is positive.
    alpha1, alpha2, alpha3 : float
        Powers, −20 to 20 and not zero.
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
        """(μ_p, α_p) of the terms that are present."""
        pairs = ((self.mu1, self.alpha1), (self.mu2, self.alpha2), (self.mu3, self.alpha3))
        return tuple((mu, alpha) for mu, alpha in pairs if mu != 0.0)

    def energy(self, C: CauchyGreen, place: Place, xp: Any) -> Any:
        """Strain energy in J/m³."""
        first, *rest = (
            mu / alpha * (power_sum(C, alpha / 2.0, xp) - 3.0) for mu, alpha in self.terms
        )
        return sum(rest, start=first)
