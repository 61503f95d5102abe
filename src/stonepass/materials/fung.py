"""The four-constant Fung law with a ground matrix (paper, Eqs 21 and 22)."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from stonepass.materials.constants import check_constants, constant
from stonepass.materials.neo_hookean import NeoHookean
from stonepass.strain import CauchyGreen, Place
from stonepass.units import Values

__all__ = ["Fung"]

ROUNDS = 4  # iterations of a fixed-point method that gains two digits in each iteration


@dataclass(frozen=True)
class Fung:
    """Fibre-reinforced wall: U = C/2 (exp Q − 1) + G/2 (I₁ − 3).

    The exponent is Q = a1111 E_tt² + a2222 E_zz² + 2 a1122 E_tt E_zz with the Green–Lagrange strain
    E; t is the circumferential and z the axial direction. The paper's law (Eq. 21) is the case
    G = 0. It has no stiffness in r–z shear, so finite elements need the ground matrix. See "The
    wall" in docs/theory.md.

    Attributes
    ----------
    C : float
        Stiffness of the fibres in Pa, positive.
    a1111, a2222, a1122 : float
        Dimensionless circumferential, axial and cross constants. The first two are above 0 and
        below 1000, the cross constant is between −1000 and 1000.
    G : float
        Shear modulus of the ground matrix in Pa, zero or positive.
    """

    C: float = constant("C", "Pa", "stiffness of the fibres", guess=0.5)
    a1111: float = constant("a₁₁₁₁", "1", "circumferential constant", high=1e3, guess=1.0)
    a2222: float = constant("a₂₂₂₂", "1", "axial constant", high=1e3, guess=1.0)
    a1122: float = constant("a₁₁₂₂", "1", "cross constant", low=-1e3, high=1e3, guess=0.2)
    G: float = constant(
        "G", "Pa", "shear modulus of the ground matrix", low_allowed=True, guess=0.5, default=0.0
    )

    def __post_init__(self) -> None:
        check_constants(self)

    def energy(self, C: CauchyGreen, place: Place, xp: Any) -> Any:
        """Return the strain energy in J/m³, see `Law.energy`."""
        E_tt, E_zz = (C.tt - 1.0) / 2.0, (C.zz - 1.0) / 2.0
        Q = self.a1111 * E_tt * E_tt + self.a2222 * E_zz * E_zz + 2.0 * self.a1122 * E_tt * E_zz
        return self.C / 2.0 * (xp.exp(Q) - 1.0) + self.G / 2.0 * (C.rr + C.tt + C.zz - 3.0)

    @property
    def fibres(self) -> Fung:
        """This law without its ground matrix, as in the paper (Eqs 21 and 22)."""
        return replace(self, G=0.0)

    def microbuckling_threshold(self, C_tt: Any, kept: float, xp: Any) -> Any:
        """Return C_zz at which ∂U/∂C_zz = `kept` × G/2, see `Microbuckling`.

        With E = (C_zz − 1)/2 the equation is C exp(Q) (a2222 E + a1122 E_tt) + (1 − kept) G = 0.
        """
        E_tt = (C_tt - 1.0) / 2.0
        pull = (1.0 - kept) * self.G / self.C
        E = -(pull + self.a1122 * E_tt) / self.a2222
        for _ in range(ROUNDS):
            Q = self.a1111 * E_tt * E_tt + self.a2222 * E * E + 2.0 * self.a1122 * E_tt * E
            E = -(pull * xp.exp(-Q) + self.a1122 * E_tt) / self.a2222
        return 1.0 + 2.0 * E

    @property
    def defect(self) -> tuple[str, str] | None:
        """Reason and remedy if the Fung form Q is not positive definite, else None."""
        form = np.array([[self.a1111, self.a1122], [self.a1122, self.a2222]])
        values, vectors = np.linalg.eigh(form)
        if values[0] > 0.0:
            return None
        hoop, axial = vectors[:, 0] / vectors[np.argmax(np.abs(vectors[:, 0])), 0]
        axial_modulus = self.C * (self.a2222 - self.a1122**2 / self.a1111)
        return (
            f"its Fung form is indefinite, a1111 a2222 = {self.a1111 * self.a2222:.4g} is below "
            f"a1122² = {self.a1122**2:.4g}: straining the circumference by {hoop:+.2f} % and the "
            f"axis by {axial:+.2f} % lowers the fibre energy, and the axial modulus at zero hoop "
            f"stress is {axial_modulus / 1e6:.2f} MPa",
            "the constants were probably published in another order: exchange a1122 and a2222 "
            "(catalogue: 'ureter')",
        )

    def inflation_pressure(self, inner_ratio: Values, wall_ratio: Values) -> Values:
        """Return the transmural pressure in Pa, see `ClosedForm.inflation_pressure`.

        The fibres contribute the corrected Eq. 22 of the paper without P_out: with
        q = ½ √a1111 ((r_a/R_a)² − 1), P = ¼ C √(π a1111) (erfi q − erfi(q/η²)). In the printed
        equation the factor R_a²/R_b² = 1/η² stands outside the second erfi. Integration of Eq. 12
        shows that it belongs inside, because E_tt at the outer wall is E_tt at the inner wall times
        this factor (docs/theory.md, "Errata"). The ground matrix adds Eq. 20 with C₁₀ = G/2.
        """
        from scipy.special import erfi  # imported here because it loads half of SciPy

        q = 0.5 * np.sqrt(self.a1111) * (inner_ratio**2 - 1.0)
        fibres = 0.25 * self.C * np.sqrt(np.pi * self.a1111) * (erfi(q) - erfi(q / wall_ratio**2))
        if self.G == 0.0:
            return fibres
        return fibres + NeoHookean(self.G / 2.0).inflation_pressure(inner_ratio, wall_ratio)
