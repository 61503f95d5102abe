"""The closure: how wide the tube above the stone is when the wall has opened up to α (Eq. 15)."""

from __future__ import annotations

import numpy as np

from stonepass.units import Values

__all__ = ["linear_closure"]


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
