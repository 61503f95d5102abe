"""The neo-Hookean law, U = C₁₀ (I₁ − 3) (paper, Eq. 19)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from stonepass.materials.constants import check_constants, constant
from stonepass.strain import CauchyGreen, Place
from stonepass.units import Values

__all__ = ["NeoHookean"]


@dataclass(frozen=True)
class NeoHookean:
    """Isotropic rubber: shear modulus 2 C10.

    Attributes
    ----------
    C10 : float
        Pa, positive.
    """

    C10: float = constant("C₁₀", "Pa", "half the shear modulus", guess=0.5)

    def __post_init__(self) -> None:
        check_constants(self)

    def energy(self, C: CauchyGreen, place: Place, xp: Any) -> Any:
        """Strain energy in J/m³; I₁ is the trace of C."""
        return self.C10 * (C.rr + C.tt + C.zz - 3.0)

    def inflation_pressure(self, inner_ratio: Values, wall_ratio: Values) -> Values:
        """Eq. 20 without P_out, in Pa.

        With s = (r_a/R_a)² and t = s + η² − 1:  C₁₀ (η²/t − 1/s + ln s − ln(t/η²)).
        """
        s = inner_ratio**2
        t = s + wall_ratio**2 - 1.0
        return self.C10 * (wall_ratio**2 / t - 1.0 / s + np.log(s) - np.log(t / wall_ratio**2))
