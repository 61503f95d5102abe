"""The learnt functions of a surrogate: a part without friction, and what friction changes in it.

In a thin wall the contact widens from a line to a band within a small change of the size of the
stone. The change by friction is concentrated there. It is a smoother function of the half-width of
the contact without friction than of the size. It vanishes with the friction coefficient, so that a
polynomial is multiplied by this coefficient.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Float
from stonepass.studies.surrogates.box import Setting
from stonepass.studies.surrogates.polynomial import SparsePolynomial

__all__ = ["LOAD", "LearntFunctions", "half_width"]

LOAD = 3  # number of the load's coordinate


@array_dataclass
@dataclass(frozen=True)
class LearntFunctions:
    """The learnt functions of the conditions; the first one is ln(w/root), with half-width w.

    Attributes
    ----------
    base : SparsePolynomial
        Polynomial of the coordinates of the box (`Setting.unit`).
    correction : SparsePolynomial or None
        Polynomial of the coordinates `by_width` that is added after multiplication by μ_f; None if
        there is none.
    """

    base: SparsePolynomial
    correction: SparsePolynomial | None = None

    def __call__(self, at: Setting) -> Float[np.ndarray, "n functions"]:
        """Return the values of all functions for n conditions."""
        values = self.base(at.unit)
        if self.correction is None:
            return values
        return values + at.conditions.friction[:, None] * self.correction(_by(at, values))

    def by_width(self, at: Setting) -> Float[np.ndarray, "n 4"]:
        """Return the coordinates of the correction, each between 0 and 1.

        They are the half-width of the contact by the base, divided by π/2; the coordinate of the
        wall; the square of that of friction; and that of the load.
        """
        return _by(at, self.base(at.unit))

    def without_load(self) -> LearntFunctions:
        """Return the functions for tubes without a load, which have fewer terms."""
        change = None if self.correction is None else self.correction.fixed(LOAD, 0.0)
        return LearntFunctions(self.base.fixed(LOAD, 0.0), change)

    def corrected(self, more: SparsePolynomial) -> LearntFunctions:
        """Return the functions with a correction."""
        return replace(self, correction=more)


def half_width(at: Setting, values: Float[np.ndarray, "n functions"]) -> Float[np.ndarray, " n"]:
    """Return the half-width of the contact divided by π/2, if the first function is ln(w/root)."""
    return np.clip(at.root * np.exp(values[:, 0]) / (np.pi / 2), 0.0, 1.0)


def _by(at: Setting, values: Float[np.ndarray, "n functions"]) -> Float[np.ndarray, "n 4"]:
    _, wall, friction, narrowed = at.unit.T
    return np.stack([half_width(at, values), wall, friction**2, narrowed], axis=1)
