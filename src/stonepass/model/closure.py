"""The closure: the width of the tube above the stone where the wall has opened to α (Eqs 13–15).

An angle α is given by the half-width of the stone there, ρ_α/R_s: sin α of a sphere.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.polynomial import Polynomial

from stonepass.array_types import Float
from stonepass.errors import require
from stonepass.model.opening_curve import OpeningCurve
from stonepass.model.problem import Problem
from stonepass.units import Values

__all__ = ["ORDER", "Series", "first_radius", "fit_series", "linear_closure", "series_through"]

ORDER = (1, 8)


def linear_closure(
    width: Values, first_width: float, size_ratio: float, start: float = 1.0
) -> Values:
    """r_a/R_a, linear in ρ_α from `start` at α₀ to ξ at π/2 (Eq. 15, where `start` is 1).

    A choice, not a derivation: the paper's "tangent" condition does not fix it. Only the value at
    α₀ is exact; r_a = R_s at π/2 is the limit of a membrane, and finite elements of the loaded
    tube give smaller radii in between. Holds for α ≤ π/2, since ρ_α folds there.
    """
    return start + (size_ratio - start) * _opening(width, first_width)


def first_radius(size_ratio: float) -> float:
    """Return r_a/R_a at α₀ by Eq. 15: 1, and ξ for a stone that is smaller than the unloaded lumen.

    A load that narrows the lumen holds stones with ξ < 1 too. From R_a to R_s < R_a the closure
    would narrow as the wall opens. With r_a = R_s at every α the pressure is P(R_s), at which the
    tube far away is as wide as the stone; at ξ = 1 both are the same.
    """
    return min(1.0, size_ratio)


@dataclass(frozen=True)
class Series:
    """r_a/R_a = s + (ξ − s) (c₁ t + c₂ t² + …), t = (ρ_α − ρ₀)/(R_s − ρ₀) (Eqs 13–14).

    The paper's series in sin α, here ρ_α, written in t: at α₀ it is `start` s (the lumen) whatever
    the `coefficients` c, and powers of t tell each other apart, which those of ρ_α do not. With
    c₁ = 1 alone it is Eq. 15.
    """

    coefficients: tuple[float, ...]
    start: float = 1.0

    def __call__(self, width: Values, first_width: float, size_ratio: float) -> Values:
        """r_a/R_a where the stone is `width` R_s wide, `first_width` R_s at α₀."""
        t = _opening(width, first_width)
        powers = np.stack([t**k for k in range(1, len(self.coefficients) + 1)], axis=-1)
        return self.start + (size_ratio - self.start) * (powers @ np.array(self.coefficients))

    def printed(self, first_width: float, size_ratio: float) -> tuple[float, ...]:
        """a₀, a₁, … of Eq. 14 in inner radii: R_s ρ_α − r_a = Σ aᵢ ρ_αⁱ, ρ_α over R_s."""
        t = Polynomial([-first_width, 1.0]) / (1.0 - first_width)
        opened = Polynomial([0.0, *self.coefficients])(t) * (size_ratio - self.start)
        return tuple((Polynomial([-self.start, size_ratio]) - opened).coef.tolist())


def fit_series(
    width: Float[np.ndarray, " pairs"],
    radius: Float[np.ndarray, " pairs"],
    first_width: float,
    size_ratio: float,
    order: int,
    start: float = 1.0,
) -> Series:
    """The series nearest to pairs (ρ_α/R_s, r_a/R_a), α ≤ π/2, by least squares."""
    low, high = ORDER
    require(low <= order <= high, "order", order, f"{low} to {high}")
    require(
        len(width) >= order,
        "number of opened states",
        len(width),
        f"at least {order}, the order of the series",
    )
    t = _opening(width, first_width)
    powers = np.stack([t**k for k in range(1, order + 1)], axis=-1)
    found = np.linalg.lstsq(powers, (radius - start) / (size_ratio - start), rcond=None)[0]
    return Series(tuple(found.tolist()), start)


def series_through(case: Problem, curve: OpeningCurve, order: int) -> Series | None:
    """Fit the series to an opening curve that begins at the seated stone.

    None where the curve has too few states for the order.
    """
    alpha, radius = curve.arrays
    if len(alpha) <= order:
        return None
    first, *widths = case.stone.shape.width(alpha)
    start = float(radius[0])
    return fit_series(np.array(widths), radius[1:], float(first), case.size_ratio, order, start)


def _opening(width: Values, first_width: float) -> Values:
    return (width - first_width) / (1.0 - first_width)
