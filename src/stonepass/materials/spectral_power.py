"""Sums of powers of the eigenvalues of C in all six components, with derivatives given by hand.

The eigenvalues c_i come from LAPACK. The derivatives are those of Daleckii and Krein: with
S = Σ c_iᵃ, ∂S/∂C = a C^(a−1), and its derivative along dC has, in the frame of eigenvectors, the
components Γ_ij dC_ij with the divided differences Γ_ij of a c^(a−1), which are series where
eigenvalues are close. NumPy and automatic differentiation (twice) can evaluate it. This module
loads autograd, so `principal_stretches` asks for it only where all six components are given.
"""

from __future__ import annotations

from typing import Any

import autograd.numpy as anp
import numpy as np
from autograd.extend import defvjp, primitive

from stonepass.array_types import Float
from stonepass.materials.binomial_series import NEAR, TERMS, binomials
from stonepass.strain import CauchyGreen

__all__ = ["trace_of_power"]

_ROWS = ((0, 0), (1, 1), (2, 2), (0, 2), (0, 1), (1, 2))  # rr, tt, zz, rz, rt, tz
_TWICE = np.array([1.0, 1.0, 1.0, 2.0, 2.0, 2.0])  # an off-diagonal component stands for two


def trace_of_power(C: CauchyGreen, a: float) -> Any:
    """Sum c₁ᵃ + c₂ᵃ + c₃ᵃ over the eigenvalues of C.

    Parameters
    ----------
    C : CauchyGreen
        Positive definite; its components are numbers or arrays of one shape.
    a : float
        Power of the squared stretches.
    """
    spread = 0.0 * (C.I1 + C.rz + C.rt + C.tz)
    return _trace_of_power(anp.stack([each + spread for each in C]), a)


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
    choose = binomials(a - 1.0)
    series = sum(choose[2 * k + 1] * near**k for k in range(TERMS))
    apart = u > NEAR
    exact = a * (one ** (a - 1.0) - other ** (a - 1.0)) / np.where(apart, one - other, 1.0)
    return np.asarray(np.where(apart, exact, a * mean ** (a - 2.0) * series))


defvjp(_trace_of_power, lambda _, C, a: lambda g: g * _slope(C, a), argnums=(0,))
defvjp(_slope, lambda _, C, a: lambda g: _slope_of_slope(g, C, a), argnums=(0,))


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
