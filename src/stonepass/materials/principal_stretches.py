"""Sums over principal stretches, λ₁ᵅ + λ₂ᵅ + λ₃ᵅ, smooth where principal stretches are equal.

The squared stretches c₁, c₂, c₃ are the eigenvalues of C. They are not differentiable where two of
them meet, which is so at rest and in every uniaxial state, but the sum S = Σ c_iᵃ with a = α/2 is.

**Axisymmetry** (C_rt and C_tz the plain number 0). One eigenvalue is C_tt, the other two are
m (1 ± √u), m = (C_rr + C_zz)/2, u = ((C_rr − C_zz)²/4 + C_rz²)/m². Their sum is a function of u
without a root, 2 mᵃ Σ_k binom(a, 2k) uᵏ. Beyond u = `NEAR` it is evaluated with the root, below by
three terms of the series. Both are added with u clipped to either side, so no branch is needed and
the formula serves NumPy, automatic differentiation and the finite elements.

**All six components**. The eigenvalues come from LAPACK; derivatives are given by hand (Daleckii
and Krein): ∂S/∂C = a C^(a−1), and its derivative along dC has, in the frame of eigenvectors, the
components Γ_ij dC_ij with the divided differences Γ_ij of a c^(a−1), which are series too where
eigenvalues are close. NumPy and automatic differentiation (twice) can evaluate it.
"""

from __future__ import annotations

from typing import Any

import autograd.numpy as anp
import numpy as np
from autograd.extend import defvjp, primitive
from jaxtyping import Float

from stonepass.strain import CauchyGreen

__all__ = ["power_sum"]

# At u = `NEAR` eigenvalues differ by 0.2 %. The series errs by 1e-20 there, and differences of
# powers lose three of sixteen digits.
NEAR = 1e-6
TERMS = 3
_ROWS = ((0, 0), (1, 1), (2, 2), (0, 2), (0, 1), (1, 2))  # rr, tt, zz, rz, rt, tz
_TWICE = np.array([1.0, 1.0, 1.0, 2.0, 2.0, 2.0])  # an off-diagonal component stands for two


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
    spread = 0.0 * (C.I1 + C.rz + C.rt + C.tz)
    return _trace_of_power(anp.stack([each + spread for each in C]), a)


def _is_zero(value: Any) -> bool:
    return isinstance(value, float | int) and value == 0.0


def _pair(x: Any, y: Any, shear: Any, a: float, xp: Any) -> Any:
    """Sum over both eigenvalues of the matrix [x, shear; shear, y]."""
    mean, half = (x + y) / 2.0, (x - y) / 2.0
    u = (half * half + shear * shear) / (mean * mean)
    root = xp.sqrt(xp.maximum(u, NEAR))
    near = xp.minimum(u, NEAR)
    choose = _binomials(a)
    series = 0.0
    for k in range(TERMS, 0, -1):
        series = near * (choose[2 * k] + series)
    at_the_border = sum(choose[2 * k] * NEAR**k for k in range(1, TERMS + 1))
    return mean**a * ((1.0 + root) ** a + (1.0 - root) ** a + 2.0 * (series - at_the_border))


@primitive  # type: ignore[untyped-decorator]
def _trace_of_power(C: Float[np.ndarray, "6 ..."], a: float) -> Float[np.ndarray, "..."]:
    values, _ = _eigen(C)
    return np.asarray((values**a).sum(axis=-1))


@primitive  # type: ignore[untyped-decorator]
def _slope(C: Float[np.ndarray, "6 ..."], a: float) -> Float[np.ndarray, "6 ..."]:
    """∂S/∂C, the off-diagonal components counted twice."""
    values, vectors = _eigen(C)
    return _components((vectors * (a * values ** (a - 1.0))[..., None, :]) @ _transposed(vectors))


def _slope_of_slope(
    along: Float[np.ndarray, "6 ..."], C: Float[np.ndarray, "6 ..."], a: float
) -> Float[np.ndarray, "6 ..."]:
    """Second derivative of S along one direction and each component."""
    values, vectors = _eigen(C)
    turned = _transposed(vectors) @ _matrix(along) @ vectors
    return _components(vectors @ (_divided_difference(values, a) * turned) @ _transposed(vectors))


def _divided_difference(c: Float[np.ndarray, "... 3"], a: float) -> Float[np.ndarray, "... 3 3"]:
    """(h(c_i) − h(c_j))/(c_i − c_j) of h = a cᵃ⁻¹, h′ where both are equal."""
    one, other = c[..., :, None], c[..., None, :]
    mean, half = (one + other) / 2.0, (one - other) / 2.0
    u = (half / mean) ** 2
    near = np.minimum(u, NEAR)
    choose = _binomials(a - 1.0)
    series = sum(choose[2 * k + 1] * near**k for k in range(TERMS))
    apart = u > NEAR
    exact = a * (one ** (a - 1.0) - other ** (a - 1.0)) / np.where(apart, one - other, 1.0)
    return np.asarray(np.where(apart, exact, a * mean ** (a - 2.0) * series))


defvjp(_trace_of_power, lambda _, C, a: lambda g: g * _slope(C, a), argnums=(0,))
defvjp(_slope, lambda _, C, a: lambda g: _slope_of_slope(g, C, a), argnums=(0,))


def _binomials(a: float) -> list[float]:
    """Coefficients a (a − 1) … (a − k + 1)/k! of the binomial series."""
    found = [1.0]
    for k in range(2 * TERMS):
        found.append(found[-1] * (a - k) / (k + 1))
    return found


def _eigen(
    C: Float[np.ndarray, "6 ..."],
) -> tuple[Float[np.ndarray, "... 3"], Float[np.ndarray, "... 3 3"]]:
    values, vectors = np.linalg.eigh(_matrix(C))
    return values, vectors


def _matrix(C: Float[np.ndarray, "6 ..."]) -> Float[np.ndarray, "... 3 3"]:
    full = np.empty((*C.shape[1:], 3, 3))
    for component, (i, j) in zip(C, _ROWS, strict=True):
        full[..., i, j] = full[..., j, i] = component
    return full


def _components(full: Float[np.ndarray, "... 3 3"]) -> Float[np.ndarray, "6 ..."]:
    """Derivatives by the six components from the derivative by the matrix."""
    return np.stack([twice * full[..., i, j] for twice, (i, j) in zip(_TWICE, _ROWS, strict=True)])


def _transposed(full: Float[np.ndarray, "... 3 3"]) -> Float[np.ndarray, "... 3 3"]:
    return np.swapaxes(full, -1, -2)
