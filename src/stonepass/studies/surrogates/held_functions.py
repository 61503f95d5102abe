"""The learnt functions of a surrogate of the direct model, as polynomials of the urine pressure.

The functions without friction depend on the stone and the wall only, and vary fast where the
contact widens from a line to a band; many cheap cases are fitted. What the urine pressure changes
in them is a smooth function of the half-width of the contact without friction, of the wall, and of
the pressure.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Float
from stonepass.studies.surrogates.box import Setting
from stonepass.studies.surrogates.learnt import half_width
from stonepass.studies.surrogates.polynomial import SparsePolynomial

__all__ = ["HIGHEST", "HeldFunctions"]

# Largest urine pressure of a surrogate, divided by the pressure that opens the tube to the width of
# the stone. Close to 1 and above it many cases have no solution.
HIGHEST = 0.95


@array_dataclass
@dataclass(frozen=True)
class HeldFunctions:
    """The learnt functions at the urine pressure P, with p = P/P_s.

    P_s is the pressure that opens the tube to the width of the stone. Each function is a base
    without friction, where p vanishes, plus p times a correction. The first one is
    ln((π/2 − α₀)/root), whose correction is not used; see `held_stone.HeldStone` for the others.

    Attributes
    ----------
    base : SparsePolynomial
        All functions without friction, as polynomials of the coordinates of the box
        (`Setting.unit`).
    correction : SparsePolynomial
        All functions but the first one: polynomials of the half-width of the contact without
        friction divided by π/2, of the coordinate of the wall, and of p/`HIGHEST`.
    """

    base: SparsePolynomial
    correction: SparsePolynomial

    def __call__(self, at: Setting) -> Float[np.ndarray, "n coefficients"]:
        """Return, for each function but the first, its base and its coefficients in p.

        The coefficients of a function are those of the Chebyshev polynomials in 2p/`HIGHEST` − 1.
        """
        values = self.base(at.unit)
        count = values.shape[1] - 1
        parts = self._in_pressure(np.stack([half_width(at, values), at.unit[:, 1]], axis=1))
        # The number of conditions may be 0, for which numpy cannot infer the length of an axis.
        parts = parts.reshape(len(values), count, parts.shape[1] // count)
        whole = np.concatenate([values[:, 1:, None], parts], axis=2)
        return np.ascontiguousarray(whole.reshape(len(values), count * whole.shape[2]))

    @property
    def _in_pressure(self) -> SparsePolynomial:
        """The coefficients of the correction in p, as polynomials of the other coordinates."""
        degrees, coefficients = self.correction.degrees, self.correction.coefficients
        pairs, places = np.unique(degrees[:, :2], axis=0, return_inverse=True)
        highest = int(degrees[:, 2].max(initial=0))
        spread = np.zeros((len(pairs), coefficients.shape[1], highest + 1))
        spread[np.ravel(places), :, degrees[:, 2]] = coefficients
        return SparsePolynomial(pairs, spread.reshape(len(pairs), -1))
