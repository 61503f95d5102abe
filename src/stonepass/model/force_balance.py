"""Resistance of the wall and drive of the urine in the paper's model (Eqs 3–7).

All forces in this module are divided by π R_s², so they are pressures in Pa that do not depend on
the absolute size. See "Resistance and drive" in docs/theory.md.
"""

from __future__ import annotations

from dataclasses import dataclass

from stonepass.model.monotone import MonotoneIntegral, monotone_integral
from stonepass.model.states.seated_state import Contact
from stonepass.units import Values

__all__ = ["Resistance", "drive", "resistance"]


@dataclass(frozen=True)
class Resistance:
    """The resistance F_re(α) of the wall that is still in contact when it has opened up to α.

    σ⁰(θ) is the contact pressure of the seated state, and ρ(θ), z(θ) is the meridian of the stone.
    The integrals extend over the remaining contact, from α to its downstream edge. The resistance
    has two parts, both positive against the motion:

    * friction, F_f = 2π μ_f ∫ σ⁰ ρ dz; for a sphere 2π μ_f R_s² ∫ σ⁰ sin²θ dθ (Eq. 6);
    * axial resultant of the contact pressure, F_σ = −π ∫ σ⁰ d(ρ²); for a sphere
      −π R_s² ∫ σ⁰ sin 2θ dθ (Eq. 5). The pressure on the upstream half pushes the stone downstream,
      the pressure on the downstream half pushes it upstream. Both cancel in the seated state. When
      the upstream half has partly opened, the remainder resists the motion. Eq. 5 is printed
      without the minus sign; with the printed sign the wall would assist the motion.

    Attributes
    ----------
    contact_angle, downstream_angle : float
        Angles θ in rad at which the seated contact begins and ends.
    friction_coefficient : float
        μ_f.
    wall_sign : float
        1 for the derived sign of F_σ, −1 for the printed one.
    """

    contact_angle: float
    downstream_angle: float
    friction_coefficient: float
    wall_sign: float
    _shear: MonotoneIntegral
    _axial: MonotoneIntegral

    def friction(self, alpha: Values) -> Values:
        """Return the friction F_f(α)/(π R_s²) in Pa for α in [α₀, π/2]."""
        return 2.0 * self.friction_coefficient * self._beyond(self._shear, alpha)

    def wall(self, alpha: Values) -> Values:
        """Return the axial resultant F_σ(α)/(π R_s²) in Pa for α in [α₀, π/2]."""
        return -self.wall_sign * self._beyond(self._axial, alpha)

    def total(self, alpha: Values) -> Values:
        """Return the resistance F_re(α)/(π R_s²) in Pa for α in [α₀, π/2] (Eq. 7)."""
        return self.friction(alpha) + self.wall(alpha)

    def _beyond(self, integral: MonotoneIntegral, alpha: Values) -> Values:
        return integral(self.downstream_angle) - integral(alpha)


def resistance(contact: Contact, *, as_printed: bool = False) -> Resistance:
    """Integrate the seated contact pressure; the result gives the resistance at any angle.

    Parameters
    ----------
    contact : Contact
        The seated contact, pressures in Pa.
    as_printed : bool
        True to use the sign of Eq. 5 as it is printed.
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
    """Return the drive F_dr/(π R_s²) in Pa: the force of the urine on the opened disc (Eq. 3).

    Parameters
    ----------
    urine_pressure : float or array
        P_u in Pa.
    width : float or array
        ρ_α/R_s at the angle α up to which the wall has opened; sin α for a sphere.
    """
    return urine_pressure * width**2
