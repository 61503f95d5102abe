"""Comparison of two laws by their energies: different constants may describe the same solid.

Exchanging both terms of an Ogden law, for example, changes the constants and not the solid.
"""

from __future__ import annotations

import numpy as np

from stonepass.array_types import Float
from stonepass.materials.protocol import Law
from stonepass.strain import INNER_WALL, CauchyGreen

__all__ = ["energies", "same_solid"]

# Stretches along the circumference and along the axis, and r-z shears, at which solids are
# compared; laws whose energies differ by a larger fraction than DIFFERENT are different.
STATES = np.array(
    [(1.2, 1.2**-0.5, 0.0), (1.2**-0.5, 1.2, 0.0), (1.15, 1.15, 0.0), (1.2, 1.0, 0.0),
     (1.0, 1.2, 0.0), (0.85, 1.0, 0.0), (1.0, 1.0, 0.2)]
)  # fmt: skip
DIFFERENT = 0.01


def energies(law: Law) -> Float[np.ndarray, " states"]:
    """Return the energies of a law in J/m³ at the states of comparison; 0 where it has none."""
    hoop, axial, shear = STATES.T
    through = 1.0 / (hoop * axial)
    # F has the columns (1/λ_t λ_z, 0, 0), (0, λ_t, 0) and (shear, 0, λ_z).
    C = CauchyGreen(through**2, hoop**2, axial**2 + shear**2, through * shear)
    with np.errstate(all="ignore"):  # a law with a limit of its stretch may have no energy here
        found = np.asarray(law.energy(C, INNER_WALL, np), dtype=float) + 0.0 * hoop
    return np.where(np.isfinite(found), found, 0.0)


def same_solid(first: Float[np.ndarray, " states"], second: Float[np.ndarray, " states"]) -> bool:
    """Return True if the energies of two laws agree to 1 % of the largest one of the second."""
    return bool(np.abs(first - second).max() <= DIFFERENT * np.abs(second).max())
