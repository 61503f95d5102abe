"""Results of the stability checks of a solved wall."""

from __future__ import annotations

from dataclasses import dataclass

from stonepass.caution import Caution, caution

__all__ = ["StabilityReport"]


@dataclass(frozen=True)
class StabilityReport:
    """Stability of a solved wall. See "Stability" in docs/theory.md.

    Attributes
    ----------
    margin : float
        Stability margin: stiffness of the weakest shear band, divided by the r–z shear modulus at
        rest, which is G for a Fung wall. It is 1 without load, and strong ellipticity is lost where
        it is 0 or negative.
    weakest_at : (float, float)
        Reference coordinates (R/R_a, Z/R_a) of the weakest shear band.
    hoop_compression : float
        Largest σ_rr − σ_tt, divided by the same modulus.
    compressed_at : (float, float)
        Reference coordinates (R/R_a, Z/R_a) of the largest hoop compression.
    """

    margin: float
    weakest_at: tuple[float, float]
    hoop_compression: float
    compressed_at: tuple[float, float]

    def warnings(self) -> list[Caution]:
        """Return a caution for each sign that a real wall would not stay in this state."""
        found = []
        if self.margin <= 0.0:
            R, Z = self.weakest_at
            found.append(caution("not_elliptic", R=R, Z=Z, margin=self.margin))
        return [*found, *self.folding()]

    def folding(self) -> list[Caution]:
        """Return a caution if hoop compression exceeds the shear modulus, so the wall may fold."""
        if self.hoop_compression <= 1.0:
            return []
        R, Z = self.compressed_at
        return [caution("hoop_compression", compression=self.hoop_compression, R=R, Z=Z)]
