"""An additional wall law, as a file of `stonepass/materials` would define it: Gent's rubber.

A. N. Gent, A new constitutive relation for rubber, Rubber Chemistry and Technology 69 (1996) 59:
W = −μ J_m/2 ln(1 − (I₁ − 3)/J_m). The chains of the network are fully extended at I₁ − 3 = J_m.
"""

from __future__ import annotations

from dataclasses import dataclass

from stonepass.materials.constants import check_constants, constant


@dataclass(frozen=True)
class Gent:
    """Isotropic rubber with chains of limited length; its shear modulus at rest is μ."""

    mu: float = constant("μ", "Pa", "shear modulus at rest")
    Jm: float = constant("J_m", "1", "limit of I1 - 3", low=0.1, high=1e4, guess=10.0)

    def __post_init__(self):
        check_constants(self)

    def energy(self, C, place, xp):
        """Strain energy in J/m³."""
        return -self.mu * self.Jm / 2.0 * xp.log(1.0 - (C.I1 - 3.0) / self.Jm)
