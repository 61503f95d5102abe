"""Least-squares fit of a sparse polynomial, whose terms are chosen one by one.

The method is orthogonal matching pursuit: in each step the term that reduces the residual most,
with a preference for low degrees, joins the fit. The number of terms is the one with the smallest
leave-one-out error. See "How a surrogate is built" in docs/surrogates.md.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Float, Int
from stonepass.errors import BadInput
from stonepass.studies.surrogates.polynomial import SparsePolynomial, chebyshev_products

__all__ = ["FEWEST", "Fitted", "fit_polynomial", "joined"]

FEWEST = 8  # smallest number of cases that a function is fitted to
DECAY = 0.8  # preference of a term over another one whose degree is higher by 1
MOST_TERMS = 0.4  # largest number of terms, as a fraction of the number of points
PATIENCE = 25  # number of further terms that are tried after the best leave-one-out error


@array_dataclass
@dataclass(frozen=True)
class Fitted:
    """A fitted function of d coordinates.

    Attributes
    ----------
    polynomial : SparsePolynomial
        A single function.
    left_out : array (n)
        Difference at each point between the polynomial that is fitted to all other points, with the
        chosen terms, and the value at this point; NaN where there is no value.
    """

    polynomial: SparsePolynomial
    left_out: Float[np.ndarray, " n"]


def fit_polynomial(
    points: Float[np.ndarray, "n d"],
    values: Float[np.ndarray, " n"],
    largest: tuple[int, ...],
    total: int,
    factor: Float[np.ndarray, " n"] | None = None,
) -> Fitted:
    """Fit a sparse polynomial to the values that exist at points.

    Parameters
    ----------
    points : array (n, d)
        Coordinates between 0 and 1.
    values : array (n)
        Values at the points; NaN where they do not exist.
    largest : tuple of d int
        Largest degree of a term in each coordinate.
    total : int
        Largest total degree of a term.
    factor : array (n), optional
        Known factors: the fitted values are the polynomial times the factor.

    Raises
    ------
    BadInput
        Fewer than eight values exist.
    """
    known = np.isfinite(values)
    if known.sum() < FEWEST:
        raise BadInput("number of cases with an answer", f"{known.sum()} of {len(known)}",
                       f"at least {FEWEST}", "make the box smaller")  # fmt: skip
    pool = _pool(largest, total)
    columns = chebyshev_products(points[known], pool)
    if factor is not None:
        columns = columns * factor[known]
    some = values[known]
    chosen, best = _pursue(columns, some, DECAY ** pool.sum(axis=1))
    terms = chosen[:best]
    matrix = columns[terms].T
    Q, R = np.linalg.qr(matrix)
    coefficients = np.linalg.solve(R, Q.T @ some)
    leverage = np.clip((Q**2).sum(axis=1), 0.0, 1.0 - 1e-9)
    left_out = np.full(len(values), np.nan)
    left_out[known] = (matrix @ coefficients - some) / (1.0 - leverage)
    return Fitted(SparsePolynomial(pool[terms], coefficients[:, None]), left_out)


def joined(polynomials: list[SparsePolynomial]) -> SparsePolynomial:
    """Return all functions of several polynomials as one polynomial with the union of the terms.

    Parameters
    ----------
    polynomials : list of SparsePolynomial
        Polynomials of the same coordinates.
    """
    every = np.concatenate([each.degrees for each in polynomials])
    degrees, places = np.unique(every, axis=0, return_inverse=True)
    columns, start = [], 0
    for each in polynomials:
        coefficients = np.zeros((len(degrees), each.coefficients.shape[1]))
        own = np.ravel(places)[start : start + len(each.degrees)]
        coefficients[own] = each.coefficients
        columns.append(coefficients)
        start += len(each.degrees)
    return SparsePolynomial(degrees, np.concatenate(columns, axis=1))


def _pool(largest: tuple[int, ...], total: int) -> Int[np.ndarray, "terms d"]:
    """Return the degrees of all terms within the limits, the constant first."""
    every = product(*(range(each + 1) for each in largest))
    inside = [each for each in every if sum(each) <= total]
    return np.array(sorted(inside, key=lambda each: (sum(each), each)))


def _pursue(
    columns: Float[np.ndarray, "terms n"],
    values: Float[np.ndarray, " n"],
    favour: Float[np.ndarray, " terms"],
) -> tuple[list[int], int]:
    """Return the terms in the order in which they join, and the best number of them."""
    rest, residual = columns.copy(), values.copy()
    norms = np.einsum("ij,ij->i", columns, columns)
    leverage = np.zeros(len(values))
    chosen: list[int] = []
    errors: list[float] = []
    taken = np.zeros(len(columns), dtype=bool)
    most = max(1, int(MOST_TERMS * len(values)))
    while len(chosen) < min(most, len(columns)):
        length = np.einsum("ij,ij->i", rest, rest)
        usable = ~taken & (length > 1e-9 * norms)
        if not usable.any():
            break
        gain = np.where(usable, (rest @ residual) ** 2 / np.where(usable, length, 1.0), -1.0)
        k = 0 if not chosen else int(np.argmax(gain * favour))
        direction = rest[k] / np.sqrt(length[k])
        residual -= direction * (direction @ residual)
        rest -= np.outer(rest @ direction, direction)
        leverage += direction**2
        taken[k] = True
        chosen.append(k)
        # The factor corrects the leave-one-out error for the choice of the terms.
        worse = 1.0 / (1.0 - len(chosen) / len(values))
        left_out = residual / (1.0 - np.minimum(leverage, 1.0 - 1e-9))
        errors.append(float(worse * np.sqrt(np.mean(left_out**2))))
        if len(errors) - int(np.argmin(errors)) > PATIENCE:
            break
    return chosen, int(np.argmin(errors)) + 1
