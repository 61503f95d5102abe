"""Resistance of the wall and drive of the urine (paper, Eqs 3–7).

All forces here are divided by π R_s², so they are pressures in Pa and absolute size drops out.
"""

from __future__ import annotations

from dataclasses import dataclass

from stonepass.model.monotone import MonotoneIntegral, monotone_integral
from stonepass.model.states.seated_state import Contact
from stonepass.units import Values

__all__ = ["Resistance", "drive", "resistance"]


@dataclass(frozen=True)
class Resistance:
    """F_re(α)/(π R_s²) of the part of the wall that is still closed, θ from α to its end.

    With the stone's meridian ρ(θ), z(θ); `friction` and `wall` are its two parts, both counted
    positive against the motion:

    * F_f = 2π μ_f ∫ σ⁰ ρ dz (of a sphere 2π μ_f R_s² ∫ σ⁰ sin²θ dθ, Eq. 6);
    * F_σ = −π ∫ σ⁰ d(ρ²) (of a sphere −π R_s² ∫ σ⁰ sin 2θ dθ): pressure on the upstream half pushes
      the stone downstream, on the downstream half upstream; where they no longer cancel, the rest
      resists. Eq. 5 as printed lacks the minus sign, and so would assist.
    """

    contact_angle: float
    downstream_angle: float
    friction_coefficient: float
    wall_sign: float
    _shear: MonotoneIntegral
    _axial: MonotoneIntegral

    def friction(self, alpha: Values) -> Values:
        """F_f(α)/(π R_s²) in Pa, α in [α₀, π/2]."""
        return 2.0 * self.friction_coefficient * self._beyond(self._shear, alpha)

    def wall(self, alpha: Values) -> Values:
        """F_σ(α)/(π R_s²) in Pa, α in [α₀, π/2]."""
        return -self.wall_sign * self._beyond(self._axial, alpha)

    def total(self, alpha: Values) -> Values:
        """F_re(α)/(π R_s²) in Pa (Eq. 7)."""
        return self.friction(alpha) + self.wall(alpha)

    def _beyond(self, integral: MonotoneIntegral, alpha: Values) -> Values:
        return integral(self.downstream_angle) - integral(alpha)


def resistance(contact: Contact, *, as_printed: bool = False) -> Resistance:
    """Integrate the seated contact pressure into the resistance of every contact angle.

    `as_printed` takes the sign of the axial wall pressure as Eq. 5 prints it.
    """
    theta, sigma, shape = contact.theta, contact.contact_pressure, contact.case.stone.shape
    (rho, _), (rho_slope, z_slope) = shape.meridian(theta), shape.slopes(theta)
    return Resistance(
        contact_angle=contact.contact_angle,
        downstream_angle=contact.downstream_angle,
        friction_coefficient=contact.case.stone.friction,
        wall_sign=-1.0 if as_printed else 1.0,
        _shear=monotone_integral(theta, sigma * rho * z_slope),
        _axial=monotone_integral(theta, sigma * 2.0 * rho * rho_slope),
    )


def drive(urine_pressure: Values, width: Values) -> Values:
    """F_dr/(π R_s²) in Pa: the urine pressure acts on the disc of radius ρ_α (Eq. 3).

    `width` is ρ_α/R_s, where the wall has opened to; sin α of a sphere.
    """
    return urine_pressure * width**2
