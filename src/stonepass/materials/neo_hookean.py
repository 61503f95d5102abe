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
    """Isotropic rubber with the shear modulus 2 C10 (paper, Eq. 19).

    Attributes
    ----------
    C10 : float
        Half the shear modulus in Pa, positive.
    """

    C10: float = constant("C₁₀", "Pa", "half the shear modulus", guess=0.5)

    def __post_init__(self) -> None:
        check_constants(self)

    def energy(self, C: CauchyGreen, place: Place, xp: Any) -> Any:
        """Return the strain energy in J/m³, see `Law.energy`."""
        return self.C10 * (C.rr + C.tt + C.zz - 3.0)

    def inflation_pressure(self, inner_ratio: Values, wall_ratio: Values) -> Values:
        """Return the transmural pressure in Pa, see `ClosedForm.inflation_pressure`.

        It is Eq. 20 of the paper without P_out: with s = (r_a/R_a)² and t = s + η² − 1,
        P = C₁₀ (η²/t − 1/s + ln s − ln(t/η²)).
        """
        s = inner_ratio**2
        t = s + wall_ratio**2 - 1.0
        return self.C10 * (wall_ratio**2 / t - 1.0 / s + np.log(s) - np.log(t / wall_ratio**2))
