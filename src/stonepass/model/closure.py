"""The closure: the width of the tube above the stone where the wall has opened to α (Eqs 13–15)."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float

from stonepass.errors import require
from stonepass.units import Values

__all__ = ["fit_series", "linear_closure", "series_closure"]


def linear_closure(
    alpha: Values, contact_angle: float, size_ratio: float, start: float = 1.0
) -> Values:
    """r_a/R_a, linear in sin α from `start` at α₀ to ξ at π/2 (Eq. 15, where `start` is 1).

    A choice, not a derivation: the paper's "tangent" condition does not fix it. Only the value at
    α₀ is exact; r_a = R_s at π/2 is the limit of a membrane, and finite elements of the loaded
    tube give smaller radii in between. Holds for α ≤ π/2, since sin α folds there.
    """
    first = np.sin(contact_angle)
    return start + (size_ratio - start) * (np.sin(alpha) - first) / (1.0 - first)


def series_closure(
    alpha: Values,
    contact_angle: float,
    size_ratio: float,
    coefficients: Float[np.ndarray, " order"],
    start: float = 1.0,
) -> Values:
    """r_a/R_a = s + (ξ − s) (c₁ t + c₂ t² + …), t = (sin α − sin α₀)/(1 − sin α₀) (Eqs 13–14).

    The paper's series in sin α, written in t: at α₀ it is `start` s (the lumen) whatever the
    coefficients, and powers of t tell each other apart, which those of sin α do not. With c₁ = 1
    alone it is Eq. 15.
    """
    t = _opening(alpha, contact_angle)
    powers = np.stack([t**k for k in range(1, len(coefficients) + 1)], axis=-1)
    return start + (size_ratio - start) * (powers @ coefficients)


def fit_series(
    alpha: Float[np.ndarray, " pairs"],
    radius: Float[np.ndarray, " pairs"],
    contact_angle: float,
    size_ratio: float,
    order: int,
    start: float = 1.0,
) -> Float[np.ndarray, " order"]:
    """Coefficients of `series_closure` by least squares on pairs (α, r_a/R_a), α up to π/2."""
    require(1 <= order <= 8, "order", order, "1 to 8")
    require(len(alpha) >= order, "pairs", len(alpha), f"at least as many as coefficients, {order}")
    t = _opening(alpha, contact_angle)
    powers = np.stack([t**k for k in range(1, order + 1)], axis=-1)
    found: Float[np.ndarray, " order"] = np.linalg.lstsq(
        powers, (radius - start) / (size_ratio - start), rcond=None
    )[0]
    return found


def _opening(alpha: Values, contact_angle: float) -> Values:
    first = np.sin(contact_angle)
    return (np.sin(alpha) - first) / (1.0 - first)
