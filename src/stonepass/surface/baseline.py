"""Baselines of profiles: least-squares fits of a parabola and cosine waves.

A baseline of order N on a profile of length L is a sum of the terms 1, t, t² and cos(kπt) for
k = 1 … N, with t = x/L. It follows waves of the length 2L/N and longer. The terms t and t² allow
slopes at the ends, which the cosines alone cannot have. Unlike a polynomial of degree N, the
baseline is about equally accurate over most of the path.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Float
from stonepass.surface.analysis import MARGIN

__all__ = ["POWERS", "Baseline", "fit_baseline"]

POWERS = 3  # number of power terms: 1, t, t²
PER_HALF_WAVE = 100  # points per shortest half wave at which the slope is evaluated
MOST = 0.25  # widest margin at each end, as a fraction of the length


@array_dataclass
@dataclass(frozen=True)
class Baseline:
    """A baseline fitted to a profile.

    Attributes
    ----------
    order : int
        Order N, the number of half waves of the shortest cosine along the profile.
    length : float
        Length L of the profile in m.
    coefficients : array (N + 3)
        Coefficients of 1, t, t² and the cosines in m.
    margin : float
        Margin at each end that is excluded from the search for the steepest slope, in units of the
        shortest wavelength 2L/N. The margin is a quarter of the length at most.

    References
    ----------
    docs/friction.md, "What is done".
    """

    order: int
    length: float
    coefficients: Float[np.ndarray, " terms"]
    margin: float = MARGIN

    @property
    def wavelength(self) -> float:
        """Shortest wavelength 2L/N that the baseline follows, in m."""
        return 2.0 * self.length / self.order

    @property
    def steepest(self) -> float:
        """Largest slope |dz/dx| outside the margins, dimensionless.

        Near the ends the slope of any least-squares fit is several times less accurate, and waves
        that are too short for the baseline appear too steep there.
        """
        return float(self.slopes()[1].max())

    @property
    def at_edge(self) -> bool:
        """True if the steepest slope lies at the edge of a margin."""
        steep = int(np.argmax(self.slopes()[1]))
        return steep in (0, PER_HALF_WAVE * max(self.order, 2))

    @property
    def looked_at(self) -> tuple[float, float]:
        """Range in which the steepest slope is searched: two fractions of the length, 0 to 1."""
        away = min(self.margin * 2.0 / self.order, MOST)
        return away, 1.0 - away

    def slopes(self) -> tuple[Float[np.ndarray, " n"], Float[np.ndarray, " n"]]:
        """Return the distances from the start in m, between the margins, and |dz/dx| there."""
        t = np.linspace(*self.looked_at, PER_HALF_WAVE * max(self.order, 2) + 1)
        return t * self.length, np.abs(_slopes(t, self.order) @ self.coefficients) / self.length

    def at(self, distance: Float[np.ndarray, " n"]) -> Float[np.ndarray, " n"]:
        """Return the heights of the baseline at distances from the start, both in m."""
        return _terms(distance / self.length, self.order) @ self.coefficients


def fit_baseline(
    distance: Float[np.ndarray, " n"],
    heights: Float[np.ndarray, " n"],
    order: int,
    margin: float = MARGIN,
) -> Baseline:
    """Fit a baseline to a profile by least squares.

    Parameters
    ----------
    distance : array (n)
        Distances from the start of the profile in m, equally spaced from 0.
    heights : array (n)
        Heights in m.
    order : int
        Order N of the baseline, at least 1; the fit needs more than N + 3 points.
    margin : float
        Margin at each end in units of the shortest wavelength (see `Baseline`).

    References
    ----------
    docs/friction.md, "What is done".
    """
    length = float(distance[-1])
    weights = np.ones_like(distance)
    weights[[0, -1]] = np.sqrt(0.5)  # the sum of squares is the trapezoidal rule of the integral
    terms = _terms(distance / length, order)
    found, *_ = np.linalg.lstsq(weights[:, None] * terms, weights * heights, rcond=None)
    return Baseline(order, length, found, margin)


def _terms(t: Float[np.ndarray, " n"], order: int) -> Float[np.ndarray, "n terms"]:
    waves = np.pi * np.arange(1, order + 1)
    return np.column_stack([np.ones_like(t), t, t**2, np.cos(np.outer(t, waves))])


def _slopes(t: Float[np.ndarray, " n"], order: int) -> Float[np.ndarray, "n terms"]:
    """Return the derivatives of the terms with respect to t."""
    waves = np.pi * np.arange(1, order + 1)
    cosines = -waves * np.sin(np.outer(t, waves))
    return np.column_stack([np.zeros_like(t), np.ones_like(t), 2.0 * t, cosines])
