"""Laws made of parts: fibres in a ground matrix, whose energies add."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol, runtime_checkable

from stonepass.materials.protocol import Law
from stonepass.strain import CauchyGreen, Place

__all__ = ["Composed", "HasGroundMatrix", "fibres_of"]


@runtime_checkable
class HasGroundMatrix(Protocol):
    """A law to which a ground matrix was added that its published form does not have."""

    @property
    def fibres(self) -> Law:
        """The published law alone."""
        ...


@dataclass(frozen=True)
class Composed:
    """Fibres in a ground matrix.

    Attributes
    ----------
    fibres : Law
        The fibres, which need not resist every strain.
    matrix : Law
        The ground matrix.
    """

    fibres: Law
    matrix: Law

    def energy(self, C: CauchyGreen, place: Place, xp: Any) -> Any:
        """Strain energy in J/m³."""
        return self.fibres.energy(C, place, xp) + self.matrix.energy(C, place, xp)


def fibres_of(law: Law) -> Law:
    """Leave out the ground matrix of a composed law; any other law is returned as it is.

    The seated-balance model of the paper evaluates its far field with this part (Eq. 22).
    """
    return law.fibres if isinstance(law, HasGroundMatrix) else law
