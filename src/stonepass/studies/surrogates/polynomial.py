"""Functions on the unit cube as sparse sums of products of Chebyshev polynomials."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from operator import attrgetter

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Float, Int
from stonepass.studies.surrogates.summation import Summation

__all__ = ["SparsePolynomial", "chebyshev_products"]

BLOCK = 4096  # number of points whose terms are computed at a time, so that they stay in the cache


@array_dataclass
@dataclass(frozen=True)
class SparsePolynomial:
    """Several functions of d coordinates, each between 0 and 1.

    A function is Σ c_k T_k₁(2u₁ − 1) ⋯ T_k_d(2u_d − 1), where T_k is the Chebyshev polynomial of
    degree k. All functions share the terms k.

    Attributes
    ----------
    degrees : array (terms, d) of int
        Degree of each term in each coordinate.
    coefficients : array (terms, functions)
        Coefficient of each term in each function.

    Examples
    --------
    The function 1 + 2 u of one coordinate is 2 T₀ + T₁:

    >>> line = SparsePolynomial(np.array([[0], [1]]), np.array([[2.0], [1.0]]))
    >>> line(np.array([[0.0], [0.5], [1.0]])).ravel().tolist()
    [1.0, 2.0, 3.0]
    """

    degrees: Int[np.ndarray, "terms d"]
    coefficients: Float[np.ndarray, "terms functions"]

    def __call__(self, points: Float[np.ndarray, "n d"]) -> Float[np.ndarray, "n functions"]:
        """Return the values of all functions at n points, each coordinate between 0 and 1."""
        # In this order the values of a function are contiguous in memory.
        values = np.empty((self.coefficients.shape[1], len(points)))
        for first in range(0, len(points), BLOCK):
            block = slice(first, first + BLOCK)
            values[:, block] = self._values(points[block])
        return values.T

    def _values(self, points: Float[np.ndarray, "n d"]) -> Float[np.ndarray, "functions n"]:
        plan = self._summation
        highest = int(self.degrees[:, plan.column].max(initial=0))
        powers = _chebyshev(2.0 * points[:, plan.column] - 1.0, highest)
        return plan(chebyshev_products(points, plan.degrees), powers)

    @cached_property
    def _summation(self) -> Summation:
        """The summation of the functions that takes the least work."""
        columns = range(self.degrees.shape[1])
        plans = [Summation.planned(column, *self.by_degree(column)) for column in columns]
        return min(plans, key=attrgetter("work"))

    def by_degree(
        self, column: int
    ) -> tuple[Int[np.ndarray, "terms d"], Float[np.ndarray, "k functions terms"]]:
        """Return the terms in all coordinates but one, and their coefficients by its degree.

        Parameters
        ----------
        column : int
            Number of the coordinate; its degrees in the returned terms are 0.
        """
        degrees, places = self._without(column)
        highest = int(self.degrees[:, column].max(initial=0))
        spread = np.zeros((highest + 1, self.coefficients.shape[1], len(degrees)))
        spread[self.degrees[:, column], :, places] = self.coefficients
        return degrees, spread

    def _without(
        self, column: int
    ) -> tuple[Int[np.ndarray, "others d"], Int[np.ndarray, " terms"]]:
        """Return the different terms in the other coordinates, and the place of each term there."""
        rest = self.degrees.copy()
        rest[:, column] = 0
        degrees, places = np.unique(rest, axis=0, return_inverse=True)
        return degrees, np.ravel(places)

    def fixed(self, column: int, value: float) -> SparsePolynomial:
        """Return the functions with one coordinate fixed at a value; its degrees become 0.

        The result has the same coordinates, of which one has no influence, and fewer terms.

        Parameters
        ----------
        column : int
            Number of the coordinate.
        value : float
            Its value, 0 to 1.
        """
        factors = np.cos(self.degrees[:, column] * np.arccos(2.0 * value - 1.0))
        degrees, places = self._without(column)
        coefficients = np.zeros((len(degrees), self.coefficients.shape[1]))
        np.add.at(coefficients, places, factors[:, None] * self.coefficients)
        return SparsePolynomial(degrees, coefficients)


def chebyshev_products(
    points: Float[np.ndarray, "n d"], degrees: Int[np.ndarray, "terms d"]
) -> Float[np.ndarray, "terms n"]:
    """Return the products of Chebyshev polynomials of all terms at n points.

    Parameters
    ----------
    points : array (n, d)
        Coordinates between 0 and 1.
    degrees : array (terms, d) of int
        Degree of each term in each coordinate.
    """
    powers = [
        _chebyshev(2.0 * column - 1.0, int(degree.max(initial=0)))
        for column, degree in zip(points.T, degrees.T, strict=True)
    ]
    found = np.empty((len(degrees), len(points)))
    for row, term in zip(found, degrees.tolist(), strict=True):
        factors = [power[k] for power, k in zip(powers, term, strict=True) if k]
        if len(factors) < 2:
            row[:] = factors[0] if factors else 1.0
            continue
        np.multiply(factors[0], factors[1], out=row)
        for factor in factors[2:]:
            row *= factor
    return found


def _chebyshev(x: Float[np.ndarray, " n"], highest: int) -> Float[np.ndarray, "m n"]:
    """Return the Chebyshev polynomials of the degrees 0 to `highest` at x from −1 to 1."""
    found = np.ones((highest + 1, len(x)))
    if highest:
        found[1] = x
    for k in range(2, highest + 1):
        found[k] = 2.0 * x * found[k - 1] - found[k - 2]
    return found
