"""The relaxed energy of a wall whose axial fibres buckle on a small scale under compression.

Axially compressed fibres buckle if the ground matrix is too soft to keep them straight
(*microbuckling*). Consider thin layers with alternating shears ±ε e_r ⊗ e_z. They preserve the
volume and the mean deformation, but they increase C_zz by ε² C_rr for either sign. A wall with the
energy U can therefore reach the energy U(C_zz + k) for any k ≥ 0 at the same mean deformation. The
smallest of these energies is the *relaxed* energy. It equals U if ∂U/∂C_zz ≥ 0. If ∂U/∂C_zz < 0, it
equals U at the larger C_zz at which ∂U/∂C_zz vanishes. Finite elements with the energy U form
buckles as wide as an element and approach the relaxed energy with mesh refinement. Finite elements
with the relaxed energy have smooth solutions that hardly depend on the mesh. See "Microbuckling and
the relaxed energy" in docs/theory.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol, runtime_checkable

from stonepass.materials.composition import fibres_of
from stonepass.materials.protocol import Law
from stonepass.strain import CauchyGreen, Place

__all__ = ["Microbuckling", "RelaxedEnergy", "relaxed"]

# The relaxed energy has no stiffness against microbuckling, so its problem is degenerate. This
# fraction of the ground matrix is kept as a regularisation: microbuckling begins where ∂U/∂C_zz
# falls to this fraction of its value at rest, G/2.
KEPT = 0.2


@runtime_checkable
class Microbuckling(Law, Protocol):
    """A law that declares at which axial strain its fibres buckle in their ground matrix."""

    @property
    def G(self) -> float:
        """Shear modulus of the ground matrix in Pa."""
        ...

    def microbuckling_threshold(self, C_tt: Any, kept: float, xp: Any) -> Any:
        """Return the C_zz at which ∂U/∂C_zz = `kept` × G/2.

        Parameters
        ----------
        C_tt : number, array or symbol
            Circumferential component of the right Cauchy–Green tensor.
        kept : float
            Fraction of the ground matrix that is kept, in [0, 1].
        xp : namespace
            Array namespace for the type of `C_tt`.
        """
        ...


@dataclass(frozen=True)
class RelaxedEnergy:
    """The regularised relaxed energy of a law that microbuckles.

    Let C*(C_tt) be the C_zz at which ∂U/∂C_zz = `kept` × G/2. For C_zz ≥ C* the energy is U. For
    C_zz < C* it is the tangent of U at C*, a linear function of C_zz. With `kept` = 0 this is the
    relaxed energy itself. The stiffness in r–z shear is at least `kept` × G.

    Attributes
    ----------
    law : Microbuckling
        The law with the energy U.
    kept : float
        Fraction of the ground matrix that is kept as a regularisation, in [0, 1].
    """

    law: Microbuckling
    kept: float = KEPT

    def energy(self, C: CauchyGreen, place: Place, xp: Any) -> Any:
        """Return the strain energy in J/m³, see `Law.energy`."""
        straight = xp.maximum(C.zz, self.threshold(C.tt, xp))
        return self.law.energy(C._replace(zz=straight), place, xp) + (
            0.5 * self.kept * self.law.G * (C.zz - straight)
        )

    def threshold(self, C_tt: Any, xp: Any) -> Any:
        """Return C*(C_tt), the C_zz below which the fibres are buckled; dimensionless."""
        return self.law.microbuckling_threshold(C_tt, self.kept, xp)

    @property
    def fibres(self) -> Law:
        """The law of the fibres, without ground matrix and without relaxation."""
        return fibres_of(self.law)


def relaxed(law: Law, kept: float = KEPT) -> Law:
    """Relax a law that declares where it microbuckles; return any other law unchanged.

    Parameters
    ----------
    law : Law
    kept : float
        See `RelaxedEnergy`.
    """
    return RelaxedEnergy(law, kept) if isinstance(law, Microbuckling) else law
