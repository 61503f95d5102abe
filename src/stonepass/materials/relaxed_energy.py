"""A wall that kinks under axial compression: its law in the limit of ever finer kinks.

Fibres along the axis buckle where the ground matrix no longer holds them straight. A layer of
shears ±ε e_r ⊗ e_z keeps volume and the mean deformation, and lengthens those fibres: C_zz grows
by ε² C_rr, whatever the sign. So a wall of energy U can reach, at the same mean deformation, any
energy U(C_zz + k) with k ≥ 0, and takes the least: where ∂U/∂C_zz < 0, that of the C_zz at which it
vanishes. This *relaxed* energy is what finite elements approach as their mesh gets finer, with
kinks as wide as an element on the way. Solved directly it is smooth, and tells one mesh from
another no more.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from stonepass.materials.fung import Fung
from stonepass.materials.protocol import Law

__all__ = ["Relaxed", "relaxed"]

# The relaxed wall has no stiffness left against the kinks it is made of. A part of the ground
# matrix is kept as stiffness: kinks begin where ∂U/∂C_zz falls to that part of its value at rest.
KEPT = 0.2
ROUNDS = 4  # of a fixed point that gains two digits with each


@dataclass(frozen=True)
class Relaxed:
    """A Fung wall with kinks: U at max(C_zz, C*), and beyond C* the slope that U has there.

    C*(C_tt) is where ∂U/∂C_zz = `kept` × G/2. With `kept` = 0 it is the relaxed energy itself; the
    stiffness in r–z shear stays above `kept` × G.
    """

    law: Fung
    kept: float = KEPT

    def energy(self, C_rr: Any, C_tt: Any, C_zz: Any, C_rz: Any, xp: Any) -> Any:
        """Strain energy in J/m³."""
        least = self.kink(C_tt, xp)
        straight = xp.maximum(C_zz, least)
        return self.law.energy(C_rr, C_tt, straight, C_rz, xp) + (
            0.5 * self.kept * self.law.G * (C_zz - straight)
        )

    def kink(self, C_tt: Any, xp: Any) -> Any:
        """C*: with E = (C* − 1)/2, C exp(Q) (a2222 E + a1122 E_tt) + (1 − kept) G = 0."""
        law, E_tt = self.law, (C_tt - 1.0) / 2.0
        pull = (1.0 - self.kept) * law.G / law.C
        E = -(pull + law.a1122 * E_tt) / law.a2222
        for _ in range(ROUNDS):
            Q = law.a1111 * E_tt * E_tt + law.a2222 * E * E + 2.0 * law.a1122 * E_tt * E
            E = -(pull * xp.exp(-Q) + law.a1122 * E_tt) / law.a2222
        return 1.0 + 2.0 * E

    def without_ground_matrix(self) -> Law:
        """Return the fibres alone."""
        return self.law.without_ground_matrix()


def relaxed(law: Law, kept: float = KEPT) -> Law:
    """The law of the wall with kinks where it is known, for Fung walls; else the law itself."""
    return Relaxed(law, kept) if isinstance(law, Fung) else law
