"""The integral of a monotone piecewise cubic interpolant.

The interpolant is that of Fritsch and Butland (1984, SIAM Journal on Scientific and Statistical
Computing 5, 300–304). It is implemented here because the import of `scipy.interpolate`, which
contains it as `PchipInterpolator`, takes as long as the solution of a frictionless case.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Float
from stonepass.units import Values

__all__ = ["MonotoneIntegral", "monotone_integral"]

Points = Float[np.ndarray, " points"]


@array_dataclass
@dataclass(frozen=True)
class MonotoneIntegral:
    """The integral of the interpolant from the first point to x, a piecewise quartic.

    Attributes
    ----------
    x : array (points,)
        The points x_k, increasing.
    coefficients : array (5, intervals)
        Coefficients of the powers 0 to 4 of x − x_k in each interval [x_k, x_k+1].
    """

    x: Points
    coefficients: Float[np.ndarray, "5 intervals"]

    def __call__(self, x: Values) -> Values:
        """Return the integral up to `x`; outside the points the nearest quartic is continued."""
        k = np.clip(np.searchsorted(self.x, x, side="right") - 1, 0, len(self.x) - 2)
        h, c = np.asarray(x) - self.x[k], self.coefficients
        return c[0, k] + h * (c[1, k] + h * (c[2, k] + h * (c[3, k] + h * c[4, k])))


def monotone_integral(x: Points, y: Points) -> MonotoneIntegral:
    """Integrate the piecewise cubic interpolant that is monotone wherever the data are.

    Parameters
    ----------
    x : array (points,)
        At least three increasing numbers.
    y : array (points,)
        Values at `x`. The unit of the integral is the product of both units.
    """
    h = np.diff(x)
    slope = np.diff(y) / h
    at = _derivatives(h, slope)
    bend = (at[:-1] + at[1:] - 2.0 * slope) / h
    quadratic, cubic = (slope - at[:-1]) / h - bend, bend / h
    parts = [y[:-1], at[:-1] / 2.0, quadratic / 3.0, cubic / 4.0]
    whole = h * (parts[0] + h * (parts[1] + h * (parts[2] + h * parts[3])))
    start = np.concatenate([[0.0], np.cumsum(whole)[:-1]])
    return MonotoneIntegral(x, np.stack([start, *parts]))


def _derivatives(h: Float[np.ndarray, " n"], slope: Float[np.ndarray, " n"]) -> Points:
    """Return derivatives at the points.

    At an interior point the derivative is a weighted harmonic mean of the slopes of the adjacent
    intervals, or zero if these differ in sign.
    """
    left, right = slope[:-1], slope[1:]
    one, two = 2.0 * h[1:] + h[:-1], h[1:] + 2.0 * h[:-1]
    turn = left * right <= 0.0
    with np.errstate(divide="ignore", invalid="ignore"):
        mean = (one + two) / (one / left + two / right)
    inside = np.where(turn, 0.0, mean)
    ends = [_at_end(h[0], h[1], slope[0], slope[1]), _at_end(h[-1], h[-2], slope[-1], slope[-2])]
    return np.concatenate([ends[:1], inside, ends[1:]])


def _at_end(near: float, next_: float, slope: float, beyond: float) -> float:
    """Return the derivative of a parabola at its end, limited so that the cubic is monotone."""
    found = ((2.0 * near + next_) * slope - near * beyond) / (near + next_)
    if np.sign(found) != np.sign(slope):
        return 0.0
    if np.sign(slope) != np.sign(beyond) and abs(found) > 3.0 * abs(slope):
        return float(3.0 * slope)
    return float(found)
