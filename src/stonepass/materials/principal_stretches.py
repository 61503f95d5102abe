"""Sums over principal stretches, λ₁ᵅ + λ₂ᵅ + λ₃ᵅ, smooth where principal stretches are equal.

The squared stretches c₁, c₂, c₃ are the eigenvalues of C. They are not differentiable where two of
them meet, which is so at rest and in every uniaxial state, but the sum S = Σ c_iᵃ with a = α/2 is.

**Axisymmetry** (C_rt and C_tz the plain number 0). One eigenvalue is C_tt, the other two are
m (1 ± √u), m = (C_rr + C_zz)/2, u = ((C_rr − C_zz)²/4 + C_rz²)/m². Their sum is a function of u
without a root, 2 mᵃ Σ_k binom(a, 2k) uᵏ. Beyond u = `NEAR` it is evaluated with the root, below by
three terms of the series. Both are added with u clipped to either side, so no branch is needed and
the formula serves NumPy, automatic differentiation and the finite elements.

**All six components** are for `spectral_power`.
"""

from __future__ import annotations

from typing import Any

from stonepass.materials.binomial_series import NEAR, TERMS, binomials
from stonepass.strain import CauchyGreen

__all__ = ["power_sum"]


def power_sum(C: CauchyGreen, a: float, xp: Any) -> Any:
    """Sum c₁ᵃ + c₂ᵃ + c₃ᵃ over the eigenvalues of C.

    Parameters
    ----------
    C : CauchyGreen
        Positive definite. `rt` and `tz` are both the plain number 0.0, or all are arrays.
    a : float
        Power of the squared stretches, α/2, at most 10 in size.
    xp : namespace
        Array namespace of the law; it serves the first case only.
    """
    if _is_zero(C.rt) and _is_zero(C.tz):
        return C.tt**a + _pair(C.rr, C.zz, C.rz, a, xp)
    from stonepass.materials.spectral_power import trace_of_power  # loads autograd

    return trace_of_power(C, a)


def _is_zero(value: Any) -> bool:
    return isinstance(value, float | int) and bool(value == 0.0)


def _pair(x: Any, y: Any, shear: Any, a: float, xp: Any) -> Any:
    """Sum over both eigenvalues of the matrix [x, shear; shear, y]."""
    mean, half = (x + y) / 2.0, (x - y) / 2.0
    u = (half * half + shear * shear) / (mean * mean)
    root = xp.sqrt(xp.maximum(u, NEAR))
    near = xp.minimum(u, NEAR)
    choose = binomials(a)
    series = 0.0
    for k in range(TERMS, 0, -1):
        series = near * (choose[2 * k] + series)
    at_the_border = sum(choose[2 * k] * NEAR**k for k in range(1, TERMS + 1))
    return mean**a * ((1.0 + root) ** a + (1.0 - root) ** a + 2.0 * (series - at_the_border))
