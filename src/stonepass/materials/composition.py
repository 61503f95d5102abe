"""Laws composed of fibres and a ground matrix, whose energies are added."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol, runtime_checkable

from stonepass.materials.protocol import Law
from stonepass.strain import CauchyGreen, Place

__all__ = ["Composed", "HasGroundMatrix", "fibres_of"]


@runtime_checkable
class HasGroundMatrix(Protocol):
    """A law whose ground matrix is not part of its published form."""

    @property
    def fibres(self) -> Law:
        """The published law, without the ground matrix."""
        ...


@dataclass(frozen=True)
class Composed:
    """Fibres in a ground matrix.

    Attributes
    ----------
    fibres : Law
        The law of the fibres; by itself it may be without stiffness against some strains.
    matrix : Law
        The law of the ground matrix.
    """

    fibres: Law
    matrix: Law

    def energy(self, C: CauchyGreen, place: Place, xp: Any) -> Any:
        """Return the strain energy in J/m³, see `Law.energy`."""
        return self.fibres.energy(C, place, xp) + self.matrix.energy(C, place, xp)


def fibres_of(law: Law) -> Law:
    """Return a law without its ground matrix; a law without one is returned unchanged.

    The paper's model evaluates its far field without the ground matrix (Eq. 22; "Far field" in
    docs/theory.md).
    """
    return law.fibres if isinstance(law, HasGroundMatrix) else law
