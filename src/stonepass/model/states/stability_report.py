"""Stability of a solved wall, as values."""

from __future__ import annotations

from dataclasses import dataclass

from stonepass.caution import Caution, caution

__all__ = ["StabilityReport"]


@dataclass(frozen=True)
class StabilityReport:
    """Stability of the solved wall; places are reference coordinates R/R_a, Z/R_a.

    Attributes
    ----------
    margin : float
        Stiffness of the weakest shear band in units of the rest r–z shear modulus (the ground
        matrix G of a Fung wall): 1 unloaded, 0 where strong ellipticity is lost.
    weakest_at : (float, float)
        Where that is.
    hoop_compression : float
        Largest σ_rr − σ_tt in the same units.
    compressed_at : (float, float)
        Where that is.
    """

    margin: float
    weakest_at: tuple[float, float]
    hoop_compression: float
    compressed_at: tuple[float, float]

    def warnings(self) -> list[Caution]:
        """One caution for each thing that a real wall would not do."""
        found = []
        if self.margin <= 0.0:
            R, Z = self.weakest_at
            found.append(caution("not_elliptic", R=R, Z=Z, margin=self.margin))
        return [*found, *self.folding()]

    def folding(self) -> list[Caution]:
        """A caution where hoop compression may fold the wall."""
        if self.hoop_compression <= 1.0:
            return []
        R, Z = self.compressed_at
        return [caution("hoop_compression", compression=self.hoop_compression, R=R, Z=Z)]
