"""Constants that describe the data as well as the fitted ones, and another solid than these.

A test may leave more than one set of constants, although each of them is determined in its
neighbourhood. At axial stretch 1, for example, the pressure in a tube of an Ogden law is the same
for (μ, α) and for (−μ, −α).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from stonepass.bench.fit_search import Search
from stonepass.caution import Caution, caution
from stonepass.errors import BadInput
from stonepass.materials.protocol import Law
from stonepass.strain import INNER_WALL, CauchyGreen

__all__ = ["ambiguous"]

# Stretches along the circumference and along the axis, and r-z shears, at which solids are
# compared; laws whose energies differ by a larger fraction than this are different.
STATES = np.array(
    [(1.2, 1.2**-0.5, 0.0), (1.2**-0.5, 1.2, 0.0), (1.15, 1.15, 0.0), (1.2, 1.0, 0.0),
     (1.0, 1.2, 0.0), (0.85, 1.0, 0.0), (1.0, 1.0, 0.2)]
)  # fmt: skip
DIFFERENT = 0.01


def ambiguous(search: Search, law: Law, as_good: Sequence[Mapping[str, float]]) -> list[Caution]:
    """Return a caution if other constants describe the data as well, but another solid.

    Parameters
    ----------
    search : Search
        The fitted constants.
    law : Law
        The fitted law.
    as_good : sequence of mapping of str to float
        Sets of all constants, in SI units, that describe the data as well.
    """
    energies = _energies(law)
    for values in as_good:
        try:
            other = search.made(**values)
        except BadInput:  # these constants describe no solid
            continue
        apart = np.abs(_energies(other) - energies).max()
        if apart > DIFFERENT * np.abs(energies).max():
            return [caution("ambiguous_fit", constants=search.shown(values))]
    return []


def _energies(law: Law) -> np.ndarray:
    hoop, axial, shear = STATES.T
    through = 1.0 / (hoop * axial)
    # F has the columns (1/λ_t λ_z, 0, 0), (0, λ_t, 0) and (shear, 0, λ_z).
    C = CauchyGreen(through**2, hoop**2, axial**2 + shear**2, through * shear)
    with np.errstate(all="ignore"):  # a law with a limit of its stretch may have no energy here
        found = np.asarray(law.energy(C, INNER_WALL, np), dtype=float) + 0.0 * hoop
    return np.where(np.isfinite(found), found, 0.0)
