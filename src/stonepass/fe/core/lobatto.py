"""Gauss–Lobatto quadrature on one edge, and polynomials interpolated at the quadrature points."""

from __future__ import annotations

from functools import lru_cache

import ngsolve as ng
import numpy as np

from stonepass.array_types import Float

__all__ = ["joined", "lobatto", "lobatto_rule", "lobatto_slopes", "resampling"]


@lru_cache(maxsize=8)
def lobatto(order: int) -> tuple[Float[np.ndarray, " n"], Float[np.ndarray, " n"]]:
    """Return Gauss–Lobatto points and weights on [0, 1].

    The rule is exact for polynomials of degree 2 × order − 1.

    Parameters
    ----------
    order : int
        Degree of the polynomial that interpolates the points, at least 1.

    Returns
    -------
    points, weights : arrays (order + 1,)
        ``lobatto(2)`` returns Simpson's rule: points 0, ½, 1 and weights 1/6, 4/6, 1/6.
    """
    legendre = np.polynomial.legendre.Legendre.basis(order)
    x = np.concatenate([[-1.0], np.sort(legendre.deriv().roots().real), [1.0]])
    weights = 2.0 / (order * (order + 1) * legendre(x) ** 2)
    return (x + 1.0) / 2.0, weights / 2.0


def lobatto_rule(order: int) -> ng.IntegrationRule:
    """Return the rule of `lobatto` as an NGSolve integration rule for edges."""
    points, weights = lobatto(order)
    return ng.IntegrationRule(
        points=[(float(p), 0.0, 0.0) for p in points], weights=[float(w) for w in weights]
    )


@lru_cache(maxsize=8)
def resampling(
    order: int, count: int
) -> tuple[Float[np.ndarray, "count n"], Float[np.ndarray, "count n"]]:
    """Return matrices that map values at the Gauss–Lobatto points to equidistant points.

    Parameters
    ----------
    order : int
        Degree of the polynomial, at least 1.
    count : int
        Number of equidistant points of [0, 1], both ends included, at least 2.

    Returns
    -------
    values, slopes : arrays (count, order + 1)
        Matrices that return the values and the first derivatives of the interpolating polynomial.
        ``resampling(1, 3)`` returns [[1, 0], [0.5, 0.5], [0, 1]] and three rows of [-1, 1].
    """
    return _basis_change(order, np.linspace(0.0, 1.0, count))


@lru_cache(maxsize=8)
def lobatto_slopes(order: int) -> Float[np.ndarray, "n n"]:
    """Return the differentiation matrix of the Gauss–Lobatto points on [0, 1].

    It maps the values of a polynomial of degree `order` at the points to its derivatives at the
    same points. ``lobatto_slopes(1)`` returns [[-1, 1], [-1, 1]].
    """
    return _basis_change(order, lobatto(order)[0])[1]


def joined(samples: Float[np.ndarray, "edges count"]) -> Float[np.ndarray, " n"]:
    """Concatenate samples of successive edges; a value that two edges share is kept once.

    ``joined`` of [[1, 2], [2, 3]] returns [1, 2, 3].
    """
    return np.concatenate([samples[0, :1], samples[:, 1:].ravel()])


def _basis_change(
    order: int, points: Float[np.ndarray, " m"]
) -> tuple[Float[np.ndarray, "m n"], Float[np.ndarray, "m n"]]:
    """Return matrices from values at the Gauss–Lobatto points to values and slopes at `points`."""
    basis = [np.polynomial.legendre.Legendre.basis(k, domain=[0.0, 1.0]) for k in range(order + 1)]
    inverse = np.linalg.inv(np.column_stack([b(lobatto(order)[0]) for b in basis]))
    values = np.column_stack([b(points) for b in basis])
    slopes = np.column_stack([b.deriv()(points) for b in basis])
    return values @ inverse, slopes @ inverse
