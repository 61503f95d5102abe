"""The learnt functions of a surrogate of the direct model, as polynomials of the urine pressure.

The functions without friction depend on the stone, the wall and the load only, and vary fast where
the contact widens from a line to a band; many cheap cases are fitted. What the urine pressure
changes in them is a smooth function of the half-width of the contact without friction, of the wall,
of the pressure, and of the load.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Float
from stonepass.studies.surrogates.box import Setting
from stonepass.studies.surrogates.learnt import LOAD, half_width
from stonepass.studies.surrogates.polynomial import SparsePolynomial

__all__ = ["HIGHEST", "HeldFunctions", "in_contact"]

# Largest urine pressure of a surrogate, divided by the pressure that opens the tube to the width of
# the stone. Close to 1 and above it many cases have no solution.
HIGHEST = 0.95
PRESSURE = 2  # number of the coordinate p/`HIGHEST` of the corrections


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
        All functions but the first one: polynomials of the coordinates `in_contact`.
    """

    base: SparsePolynomial
    correction: SparsePolynomial

    def __call__(self, at: Setting) -> Float[np.ndarray, "n coefficients"]:
        """Return, for each function but the first, its base and its coefficients in p.

        The coefficients of a function are those of the Chebyshev polynomials in 2p/`HIGHEST` − 1.
        """
        values = self.base(at.unit)
        count = values.shape[1] - 1
        parts = self._in_pressure(in_contact(at, values, np.zeros(len(values))))
        # The number of conditions may be 0, for which numpy cannot infer the length of an axis.
        parts = parts.reshape(len(values), count, parts.shape[1] // count)
        whole = np.concatenate([values[:, 1:, None], parts], axis=2)
        return np.ascontiguousarray(whole.reshape(len(values), count * whole.shape[2]))

    def without_load(self) -> HeldFunctions:
        """Return the functions for tubes without a load, which have fewer terms."""
        return replace(
            self, base=self.base.fixed(LOAD, 0.0), correction=self.correction.fixed(LOAD, 0.0)
        )

    @cached_property
    def _in_pressure(self) -> SparsePolynomial:
        """The coefficients of the correction in p, as polynomials of the other coordinates."""
        degrees, spread = self.correction.by_degree(PRESSURE)
        return SparsePolynomial(degrees, spread.T.reshape(len(degrees), -1))


def in_contact(
    at: Setting, without: Float[np.ndarray, "n functions"], p: Float[np.ndarray, " n"]
) -> Float[np.ndarray, "n 4"]:
    """Return the coordinates of the corrections, each between 0 and 1.

    They are the half-width of the contact without friction divided by π/2, the coordinate of the
    wall, p/`HIGHEST`, and the coordinate of the load.

    Parameters
    ----------
    at : Setting
        The n conditions.
    without : array (n, functions)
        The functions without friction.
    p : array (n)
        Urine pressure divided by the pressure that opens the tube to the width of the stone.
    """
    _, wall, _, narrowed = at.unit.T
    return np.stack([half_width(at, without), wall, p / HIGHEST, narrowed], axis=1)
