"""The claimed error of a surrogate, from the leave-one-out errors of its solved cases."""

from __future__ import annotations

import numpy as np

from stonepass.array_types import Float
from stonepass.studies.surrogates.polynomial import SparsePolynomial
from stonepass.studies.surrogates.regression import fit_polynomial

__all__ = ["FLOOR", "NONE", "claimed_error"]

CLAIM = 0.99  # fraction of the leave-one-out errors that the claimed error covers
MARGIN = 2.0  # factor on the claimed relative error
FLOOR = 5.0  # Pa, claimed absolute error
NONE = 10.0  # Pa, difference of two critical pressures that counts as none
DEGREES, TOTAL = (2, 2, 2, 2), 2  # degrees of the claimed relative error
SMALLEST = 1e-4  # smallest relative error in the fit of the claimed error


def claimed_error(
    points: Float[np.ndarray, "n 4"],
    pressure: Float[np.ndarray, " n"],
    true: Float[np.ndarray, " n"],
) -> SparsePolynomial:
    """Return the natural logarithm of the claimed relative error of P_ucr.

    Parameters
    ----------
    points : array (n, 4)
        Coordinates of the solved cases in the box.
    pressure : array (n)
        P_ucr in Pa of each case by a fit to all other cases; NaN where it does not exist.
    true : array (n)
        P_ucr in Pa by the model; NaN where it does not exist.
    """
    with np.errstate(invalid="ignore", divide="ignore"):
        off = np.maximum(np.abs(pressure - true) - FLOOR, 0.0) / true
    known = np.isfinite(off)
    logarithm = np.log(np.maximum(off[known], SMALLEST))
    fitted = fit_polynomial(points[known], logarithm, DEGREES, TOTAL).polynomial
    excess = np.quantile(logarithm - fitted(points[known])[:, 0], CLAIM)
    coefficients = fitted.coefficients.copy()
    coefficients[~fitted.degrees.any(axis=1), 0] += excess + np.log(MARGIN)
    return SparsePolynomial(fitted.degrees, coefficients)
