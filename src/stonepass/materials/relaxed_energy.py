"""The relaxed energy of a wall whose axial fibres buckle on a small scale under compression.

Fibres along the axis buckle where the ground matrix no longer holds them straight (microbuckling).
A layer of shears ±ε e_r ⊗ e_z keeps volume and the mean deformation, and lengthens those fibres:
C_zz grows by ε² C_rr, whatever the sign. So a wall of energy U can reach, at the same mean
deformation, any energy U(C_zz + k) with k ≥ 0, and takes the least: where ∂U/∂C_zz < 0, that of the
C_zz at which it vanishes. This *relaxed* energy is what finite elements approach as their mesh gets
finer, with buckles as wide as an element on the way. Solved directly it is smooth, and tells one
mesh from another no more.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol, runtime_checkable

from stonepass.materials.composition import fibres_of
from stonepass.materials.protocol import Law
from stonepass.strain import CauchyGreen, Place

__all__ = ["Microbuckling", "RelaxedEnergy", "relaxed"]

# The relaxed wall has no stiffness left against the buckles it is made of. A part of the ground
# matrix is kept as stiffness: microbuckling begins where ∂U/∂C_zz falls to that part of its value
# at rest.
KEPT = 0.2


@runtime_checkable
class Microbuckling(Law, Protocol):
    """A law that knows where its axial fibres buckle in their ground matrix."""

    @property
    def G(self) -> float:
        """Shear modulus of the ground matrix in Pa."""
        ...

    def microbuckling_threshold(self, C_tt: Any, kept: float, xp: Any) -> Any:
        """C_zz at which ∂U/∂C_zz has fallen to `kept` × G/2."""
        ...


@dataclass(frozen=True)
class RelaxedEnergy:
    """A wall that microbuckles: U at max(C_zz, C*), and below C* the slope that U has there.

    C*(C_tt) is where ∂U/∂C_zz = `kept` × G/2. With `kept` = 0 it is the relaxed energy itself; the
    stiffness in r–z shear stays above `kept` × G.
    """

    law: Microbuckling
    kept: float = KEPT

    def energy(self, C: CauchyGreen, place: Place, xp: Any) -> Any:
        """Strain energy in J/m³."""
        straight = xp.maximum(C.zz, self.threshold(C.tt, xp))
        return self.law.energy(C._replace(zz=straight), place, xp) + (
            0.5 * self.kept * self.law.G * (C.zz - straight)
        )

    def threshold(self, C_tt: Any, xp: Any) -> Any:
        """C*, the axial component below which the fibres are buckled."""
        return self.law.microbuckling_threshold(C_tt, self.kept, xp)

    @property
    def fibres(self) -> Law:
        """The fibres of the wall alone, without ground matrix and not relaxed."""
        return fibres_of(self.law)


def relaxed(law: Law, kept: float = KEPT) -> Law:
    """Relax the energy of a law that declares where it microbuckles; others stay as they are."""
    return RelaxedEnergy(law, kept) if isinstance(law, Microbuckling) else law
