"""Resistance of the wall and drive of the urine (paper, Eqs 3–7).

All forces here are divided by π R_s², so they are pressures in Pa and absolute size drops out.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.interpolate import PchipInterpolator

from stonepass.model.seated import Contact
from stonepass.units import Values

__all__ = ["Resistance", "drive", "resistance"]


@dataclass(frozen=True)
class Resistance:
    """F_re(α)/(π R_s²) of the part of the wall that is still closed, θ from α to π − α₀.

    `friction` and `wall` are its two parts, both counted positive against the motion:

    * F_f = 2π μ_f R_s c ∫ σ⁰ sin²θ dθ, c the half-length of the stone (Eq. 6, where c = R_s);
    * F_σ = −π R_s² ∫ σ⁰ sin 2θ dθ: pressure on the upstream half pushes the stone downstream, on
      the downstream half upstream; where they no longer cancel, the rest resists. Eq. 5 as
      printed lacks the minus sign, and so would assist.
    """

    contact_angle: float
    friction_coefficient: float
    wall_sign: float
    _shear: Any
    _axial: Any
    aspect: float

    def friction(self, alpha: Values) -> Values:
        """F_f(α)/(π R_s²) in Pa, α in [α₀, π/2]."""
        end = self._shear(np.pi / 2)
        upstream = end - self._shear(alpha)  # ∫ from α to π/2 of σ sin²θ
        return 2.0 * self.friction_coefficient * self.aspect * (upstream + end)

    def wall(self, alpha: Values) -> Values:
        """F_σ(α)/(π R_s²) in Pa, α in [α₀, π/2].

        σ⁰ is symmetric about π/2 and sin 2θ antisymmetric, so the integral from α to π − α₀ is
        minus that over the opened part, α₀ to α.
        """
        return self.wall_sign * self._axial(alpha)

    def total(self, alpha: Values) -> Values:
        """F_re(α)/(π R_s²) in Pa (Eq. 7)."""
        return self.friction(alpha) + self.wall(alpha)


def resistance(contact: Contact) -> Resistance:
    """Integrate the seated contact pressure into the resistance of every contact angle."""
    theta, sigma = contact.theta, contact.contact_pressure
    return Resistance(
        contact_angle=contact.contact_angle,
        friction_coefficient=contact.case.stone.friction,
        wall_sign=-1.0 if contact.case.method.as_printed else 1.0,
        _shear=PchipInterpolator(theta, sigma * np.sin(theta) ** 2).antiderivative(),
        aspect=contact.case.stone.aspect,
        _axial=PchipInterpolator(theta, sigma * np.sin(2.0 * theta)).antiderivative(),
    )


def drive(urine_pressure: Values, alpha: Values) -> Values:
    """F_dr/(π R_s²) in Pa: the urine pressure acts on the disc of radius R_s sin α (Eq. 3)."""
    return urine_pressure * np.sin(alpha) ** 2
