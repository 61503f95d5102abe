"""The summation of a sparse polynomial with as little work as possible.

The terms are products of Chebyshev polynomials of all coordinates but one. Their sums with the
coefficients of each degree in the remaining coordinate are matrix products. Few terms have a high
degree in this coordinate, so that the matrices of high degrees are small.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Float, Int

__all__ = ["Summation"]

# Measured work for each point, in multiplications of a large matrix product: one product of
# Chebyshev polynomials; one function and degree that is added to the sum; and what a matrix product
# takes beyond its multiplications, as a number of further columns and of further rows.
TERM, ADDED, MORE_COLUMNS, MORE_ROWS = 36, 11, 8, 6
ROWS = 4  # number of rows that a matrix product computes at a time


@array_dataclass
@dataclass(frozen=True)
class _Matrix:
    """The coefficients of consecutive degrees: one row for each degree and function.

    Attributes
    ----------
    first, last : int
        The first degree, and the one after the last degree.
    coefficients : array (rows, columns)
        Filled up with rows of zeros to a multiple of `ROWS`; columns for the first terms only.
    """

    first: int
    last: int
    coefficients: Float[np.ndarray, "rows columns"]


@array_dataclass
@dataclass(frozen=True)
class Summation:
    """The terms of several functions in all coordinates but one, and their coefficients.

    Attributes
    ----------
    column : int
        Number of the remaining coordinate.
    functions : int
        Number of functions.
    degrees : array (terms, d) of int
        Degree of each term in each coordinate, 0 in the remaining one. The terms are in descending
        order of their highest degree in the remaining coordinate.
    matrices : list of _Matrix
        The coefficients, in ascending order of the degree in the remaining coordinate.
    work : float
        Work for each point, in multiplications of a large matrix product.
    """

    column: int
    functions: int
    degrees: Int[np.ndarray, "terms d"]
    matrices: list[_Matrix]
    work: float

    @classmethod
    def planned(
        cls,
        column: int,
        degrees: Int[np.ndarray, "terms d"],
        coefficients: Float[np.ndarray, "levels functions terms"],
    ) -> Summation:
        """Return the summation with the least work for one choice of the remaining coordinate.

        Consecutive degrees share a matrix if one product takes less work than several.

        Parameters
        ----------
        column : int
            Number of the remaining coordinate.
        degrees : array (terms, d) of int
            Degrees of the terms, 0 in the remaining coordinate.
        coefficients : array (levels, functions, terms)
            Coefficients of each degree in the remaining coordinate.
        """
        levels, functions, terms = coefficients.shape
        highest = np.where(coefficients.any(axis=1), np.arange(levels)[:, None], 0).max(axis=0)
        order = np.argsort(-highest, kind="stable")
        sorted_up = coefficients[:, :, order]
        columns = [int((highest >= level).sum()) for level in range(levels)]
        # The least work for the degrees from each one on, and the matrices with this work.
        best: list[tuple[float, list[_Matrix]]] = [(0.0, [])] * (levels + 1)
        for first in reversed(range(levels)):
            works = [
                _work(functions * (last - first), columns[first]) + best[last][0]
                for last in range(first + 1, levels + 1)
            ]
            least = int(np.argmin(works))
            last = first + 1 + least
            part = sorted_up[first:last, :, : columns[first]]
            part = part.reshape(functions * (last - first), columns[first])
            matrix = _Matrix(first, last, _filled_up(part))
            best[first] = (works[least], [matrix, *best[last][1]])
        work, matrices = best[0]
        return cls(column, functions, degrees[order], matrices, work + TERM * terms)

    def __call__(
        self, products: Float[np.ndarray, "terms n"], powers: Float[np.ndarray, "levels n"]
    ) -> Float[np.ndarray, "functions n"]:
        """Return the values of the functions at n points.

        Parameters
        ----------
        products : array (terms, n)
            Values of the terms `degrees`.
        powers : array (levels, n)
            Chebyshev polynomials of the remaining coordinate, of all degrees from 0 on.
        """
        values = np.zeros((self.functions, products.shape[1]))
        for matrix in self.matrices:
            series = matrix.coefficients @ products[: matrix.coefficients.shape[1]]
            for k in range(matrix.last - matrix.first):
                part = series[k * self.functions : (k + 1) * self.functions]
                part *= powers[matrix.first + k]
                values += part
        return values


def _work(rows: int, columns: int) -> float:
    """Return the work of a matrix product and of the sum of its rows for each point."""
    computed = -(-rows // ROWS) * ROWS
    return (computed + MORE_ROWS) * (columns + MORE_COLUMNS) + ADDED * rows


def _filled_up(matrix: Float[np.ndarray, "n columns"]) -> Float[np.ndarray, "rows columns"]:
    """Return a matrix with rows of zeros up to a multiple of `ROWS`."""
    missing = -len(matrix) % ROWS
    return np.ascontiguousarray(np.pad(matrix, ((0, missing), (0, 0))))
