"""Gauss–Lobatto quadrature on one edge, and polynomials given by their values at its points."""

from __future__ import annotations

from functools import lru_cache

import ngsolve as ng
import numpy as np

from stonepass.array_types import Float

__all__ = ["joined", "lobatto", "lobatto_rule", "lobatto_slopes", "resampling"]


@lru_cache(maxsize=8)
def lobatto(order: int) -> tuple[Float[np.ndarray, " n"], Float[np.ndarray, " n"]]:
    """Gauss–Lobatto points and weights on [0, 1]; exact for polynomials of degree 2 × order − 1.

    Parameters
    ----------
    order : int
        Degree of the polynomial through the points, at least 1.

    Returns
    -------
    points, weights : arrays (order + 1,)
        ``lobatto(2)`` is Simpson's rule: points 0, ½, 1 and weights 1/6, 4/6, 1/6.
    """
    legendre = np.polynomial.legendre.Legendre.basis(order)
    x = np.concatenate([[-1.0], np.sort(legendre.deriv().roots().real), [1.0]])
    weights = 2.0 / (order * (order + 1) * legendre(x) ** 2)
    return (x + 1.0) / 2.0, weights / 2.0


def lobatto_rule(order: int) -> ng.IntegrationRule:
    """The rule of `lobatto` as an integration rule of the engine, for edges."""
    points, weights = lobatto(order)
    return ng.IntegrationRule(
        points=[(float(p), 0.0, 0.0) for p in points], weights=[float(w) for w in weights]
    )


@lru_cache(maxsize=8)
def resampling(
    order: int, count: int
) -> tuple[Float[np.ndarray, "count n"], Float[np.ndarray, "count n"]]:
    """Matrices from the values of a polynomial at the Gauss–Lobatto points to equidistant points.

    Parameters
    ----------
    order : int
        Degree of the polynomial, at least 1.
    count : int
        Number of equidistant points of [0, 1], both ends included, at least 2.

    Returns
    -------
    values, slopes : arrays (count, order + 1)
        Matrices that give the values and the derivatives. ``resampling(1, 3)`` is
        [[1, 0], [0.5, 0.5], [0, 1]] and three rows of [-1, 1].
    """
    return _basis_change(order, np.linspace(0.0, 1.0, count))


@lru_cache(maxsize=8)
def lobatto_slopes(order: int) -> Float[np.ndarray, "n n"]:
    """Matrix from the values at the Gauss–Lobatto points to the derivatives at the same points.

    ``lobatto_slopes(1)`` is [[-1, 1], [-1, 1]].
    """
    return _basis_change(order, lobatto(order)[0])[1]


def joined(samples: Float[np.ndarray, "edges count"]) -> Float[np.ndarray, " n"]:
    """Samples of successive edges in one array; the value that two edges share appears once.

    ``joined`` of [[1, 2], [2, 3]] is [1, 2, 3].
    """
    return np.concatenate([samples[0, :1], samples[:, 1:].ravel()])


def _basis_change(
    order: int, points: Float[np.ndarray, " m"]
) -> tuple[Float[np.ndarray, "m n"], Float[np.ndarray, "m n"]]:
    """Matrices from values at the Gauss–Lobatto points to values and derivatives at `points`."""
    basis = [np.polynomial.legendre.Legendre.basis(k, domain=[0.0, 1.0]) for k in range(order + 1)]
    inverse = np.linalg.inv(np.column_stack([b(lobatto(order)[0]) for b in basis]))
    values = np.column_stack([b(points) for b in basis])
    slopes = np.column_stack([b.deriv()(points) for b in basis])
    return values @ inverse, slopes @ inverse
