"""Baselines: least squares in waves down to a shortest length, beside a parabola.

A baseline of order N on a profile of length L is a sum of 1, t, t² and cos(kπt), k = 1 … N, with
t = x/L: waves of length 2L/N and longer, whatever the slopes at the ends, which plain cosines take
as level. Against a polynomial of degree N it is as certain in the middle of the path as beside it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Float

__all__ = ["MARGIN", "POWERS", "Baseline", "fit_baseline"]

POWERS = 3  # 1, t, t²
PER_HALF_WAVE = 100  # places where the slope is looked at
MARGIN = 0.5  # of the shortest wave: at each end, where the slope is not looked at
MOST = 0.25  # of the length: the widest margin at each end


@array_dataclass
@dataclass(frozen=True)
class Baseline:
    """A fitted baseline.

    Attributes
    ----------
    order : int
        N, the number of half waves of its shortest wave.
    length : float
        L in m.
    coefficients : array (N + 3)
        Of 1, t, t² and the cosines.
    margin : float
        How far from each end its steepest slope is looked for, in shortest waves; a quarter of the
        length at most.
    """

    order: int
    length: float
    coefficients: Float[np.ndarray, " terms"]
    margin: float = MARGIN

    @property
    def wavelength(self) -> float:
        """Its shortest wave in m."""
        return 2.0 * self.length / self.order

    @property
    def steepest(self) -> float:
        """The largest slope |dz/dx| outside the margins.

        Near the ends the slope is several times less certain, as that of every fit is, and waves
        that the baseline cannot follow come out too steep.
        """
        return float(self.slopes()[1].max())

    @property
    def at_edge(self) -> bool:
        """Whether it is steepest where slopes cease to be looked at."""
        steep = int(np.argmax(self.slopes()[1]))
        return steep in (0, PER_HALF_WAVE * max(self.order, 2))

    @property
    def looked_at(self) -> tuple[float, float]:
        """Where the steepest slope is looked for, from and to a fraction of the length."""
        away = min(self.margin * 2.0 / self.order, MOST)
        return away, 1.0 - away

    def slopes(self) -> tuple[Float[np.ndarray, " n"], Float[np.ndarray, " n"]]:
        """Distances from the start in m where slopes are looked at, and |dz/dx| there."""
        t = np.linspace(*self.looked_at, PER_HALF_WAVE * max(self.order, 2) + 1)
        return t * self.length, np.abs(_slopes(t, self.order) @ self.coefficients) / self.length

    def at(self, distance: Float[np.ndarray, " n"]) -> Float[np.ndarray, " n"]:
        """Heights at distances from the start, both in m."""
        return _terms(distance / self.length, self.order) @ self.coefficients


def fit_baseline(
    distance: Float[np.ndarray, " n"],
    heights: Float[np.ndarray, " n"],
    order: int,
    margin: float = MARGIN,
) -> Baseline:
    """Fit a baseline of order N to heights at even distances: least squares along the length."""
    length = float(distance[-1])
    weights = np.ones_like(distance)
    weights[[0, -1]] = np.sqrt(0.5)  # of squares, half at both ends: the trapezoidal rule
    terms = _terms(distance / length, order)
    found, *_ = np.linalg.lstsq(weights[:, None] * terms, weights * heights, rcond=None)
    return Baseline(order, length, found, margin)


def _terms(t: Float[np.ndarray, " n"], order: int) -> Float[np.ndarray, "n terms"]:
    waves = np.pi * np.arange(1, order + 1)
    return np.column_stack([np.ones_like(t), t, t**2, np.cos(np.outer(t, waves))])


def _slopes(t: Float[np.ndarray, " n"], order: int) -> Float[np.ndarray, "n terms"]:
    """d/dt of the terms."""
    waves = np.pi * np.arange(1, order + 1)
    cosines = -waves * np.sin(np.outer(t, waves))
    return np.column_stack([np.zeros_like(t), np.ones_like(t), 2.0 * t, cosines])
