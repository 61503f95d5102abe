"""Sums over principal stretches, λ₁ᵅ + λ₂ᵅ + λ₃ᵅ, smooth where principal stretches are equal.

The squared principal stretches c₁, c₂, c₃ are the eigenvalues of C. Eigenvalues are not
differentiable where two of them are equal, as at rest and in every uniaxial state. The sum
S = Σ c_iᵃ with a = α/2 is differentiable everywhere.

**Axisymmetry**: C_rt and C_tz are the Python number 0.0. One eigenvalue is C_tt. The other two are
m (1 ± √u) with m = (C_rr + C_zz)/2 and u = ((C_rr − C_zz)²/4 + C_rz²)/m². The sum of their powers
is a power series in u, 2 mᵃ Σ_k binom(a, 2k) uᵏ, and therefore smooth at u = 0. For u > `NEAR` the
sum is evaluated with the root √u, for u ≤ `NEAR` by three terms of the series. To avoid a
conditional expression, the code evaluates the root formula at max(u, `NEAR`) and adds the series at
min(u, `NEAR`) minus the series at `NEAR`. The same formula can therefore be used with NumPy,
automatic differentiation and the finite elements.

**General deformation**: if all six components are arrays, `spectral_power` evaluates the sum.
"""

from __future__ import annotations

from typing import Any

from stonepass.materials.binomial_series import NEAR, TERMS, binomials
from stonepass.strain import CauchyGreen

__all__ = ["power_sum"]


def power_sum(C: CauchyGreen, a: float, xp: Any) -> Any:
    """Return c₁ᵃ + c₂ᵃ + c₃ᵃ for the eigenvalues c_i of C.

    Parameters
    ----------
    C : CauchyGreen
        Positive definite. Either both `rt` and `tz` are the Python number 0.0, or all components
        are arrays of one shape.
    a : float
        Power α/2 of the squared stretches, between −10 and 10.
    xp : namespace
        Array namespace of the law. It is used only if `rt` and `tz` are 0.0.
    """
    if _is_zero(C.rt) and _is_zero(C.tz):
        return C.tt**a + _pair(C.rr, C.zz, C.rz, a, xp)
    from stonepass.materials.spectral_power import trace_of_power  # loads autograd

    return trace_of_power(C, a)


def _is_zero(value: Any) -> bool:
    return isinstance(value, float | int) and bool(value == 0.0)


def _pair(x: Any, y: Any, shear: Any, a: float, xp: Any) -> Any:
    """Return the sum of the a-th powers of the eigenvalues of the matrix [x, shear; shear, y]."""
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
