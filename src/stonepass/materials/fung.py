"""The four-constant Fung law with a ground matrix (paper, Eqs 21 and 22)."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.special import erfi

from stonepass.errors import require
from stonepass.materials.neo_hookean import NeoHookean
from stonepass.units import Values

__all__ = ["Fung"]


@dataclass(frozen=True)
class Fung:
    """Fibre-reinforced wall: U = C/2 (exp Q − 1) + G/2 (I₁ − 3).

    Q = a1111 E_tt² + a2222 E_zz² + 2 a1122 E_tt E_zz, E the Green–Lagrange strain; t is the
    circumferential and z the axial direction. The paper's law (Eq. 21) is G = 0; it has no
    stiffness in r–z shear, so finite elements need the ground matrix.

    Attributes
    ----------
    C : float
        Pa, positive.
    a1111, a2222, a1122 : float
        Circumferential, axial and cross constants, without unit.
    G : float
        Shear modulus of the ground matrix in Pa, zero or positive.
    """

    C: float
    a1111: float
    a2222: float
    a1122: float
    G: float = 0.0

    def __post_init__(self) -> None:
        require(0.0 < self.C < np.inf, "C", self.C, "a positive modulus")
        require(0.0 <= self.G < np.inf, "G", self.G, "a modulus, zero or positive")
        require(0.0 < self.a1111 < 1e3, "a1111", self.a1111, "a number above 0 and below 1000")
        require(0.0 < self.a2222 < 1e3, "a2222", self.a2222, "a number above 0 and below 1000")
        require(abs(self.a1122) < 1e3, "a1122", self.a1122, "a number between -1000 and 1000")

    def energy(self, C_rr: Any, C_tt: Any, C_zz: Any, C_rz: Any, xp: Any) -> Any:
        """Strain energy in J/m³."""
        E_tt, E_zz = (C_tt - 1.0) / 2.0, (C_zz - 1.0) / 2.0
        Q = self.a1111 * E_tt * E_tt + self.a2222 * E_zz * E_zz + 2.0 * self.a1122 * E_tt * E_zz
        return self.C / 2.0 * (xp.exp(Q) - 1.0) + self.G / 2.0 * (C_rr + C_tt + C_zz - 3.0)

    def without_ground_matrix(self) -> Fung:
        """Return the fibres alone, as the paper's Eq. 22 has them."""
        return replace(self, G=0.0)

    def inflation_pressure(self, inner_ratio: Values, wall_ratio: Values) -> Values:
        """Eq. 22 without P_out, corrected, in Pa; the ground matrix adds Eq. 20 with C₁₀ = G/2.

        With q = ½ √a1111 ((r_a/R_a)² − 1):  ¼ C √(π a1111) (erfi q − erfi(q/η²)).
        As printed the paper has the factor R_a²/R_b² outside the second erfi; integrating Eq. 12
        puts it inside, because E_tt at the outer wall is smaller by just that factor.
        """
        q = 0.5 * np.sqrt(self.a1111) * (inner_ratio**2 - 1.0)
        fibres = 0.25 * self.C * np.sqrt(np.pi * self.a1111) * (erfi(q) - erfi(q / wall_ratio**2))
        if self.G == 0.0:
            return fibres
        return fibres + NeoHookean(self.G / 2.0).inflation_pressure(inner_ratio, wall_ratio)
