"""Sums of powers of the eigenvalues of a full symmetric tensor C, with explicit derivatives.

The eigenvalues c_i of C are computed by LAPACK. Let S = Σ c_iᵃ. Its first derivative is the tensor
∂S/∂C = h(C) with the function h(c) = a c^(a−1). The derivative of h(C) in the direction dC follows
from the theorem of Daleckii and Krein (1965): in the frame of the eigenvectors of C its components
are Γ_ij dC_ij with the divided differences Γ_ij = (h(c_i) − h(c_j))/(c_i − c_j). For nearly equal
eigenvalues Γ_ij is evaluated by a series. The functions can be evaluated with NumPy, and autograd
can differentiate them twice. This module imports autograd, so `principal_stretches` loads it only
if C has all six components.
"""

from __future__ import annotations

from typing import Any

import autograd.numpy as anp
import numpy as np
from autograd.extend import defvjp, primitive

from stonepass.array_types import Float
from stonepass.materials.binomial_series import NEAR, TERMS, binomials
from stonepass.strain import COMPONENTS, CauchyGreen

__all__ = ["trace_of_power"]

# A derivative with respect to C_rz counts both C_rz and C_zr; the same holds for C_rt and C_tz.
_TWICE = np.array([1.0, 1.0, 1.0, 2.0, 2.0, 2.0])


def trace_of_power(C: CauchyGreen, a: float) -> Any:
    """Return c₁ᵃ + c₂ᵃ + c₃ᵃ for the eigenvalues c_i of C.

    Parameters
    ----------
    C : CauchyGreen
        Positive definite; its components are numbers or arrays of one shape.
    a : float
        Power of the eigenvalues, which are squared principal stretches.
    """
    spread = 0.0 * (C.I1 + C.rz + C.rt + C.tz)
    return _trace_of_power(anp.stack([each + spread for each in C]), a)


@primitive  # type: ignore[untyped-decorator]
def _trace_of_power(C: Float[np.ndarray, "6 ..."], a: float) -> Float[np.ndarray, "..."]:
    values, _ = _eigen(C)
    return np.asarray((values**a).sum(axis=-1))


@primitive  # type: ignore[untyped-decorator]
def _slope(C: Float[np.ndarray, "6 ..."], a: float) -> Float[np.ndarray, "6 ..."]:
    """Return ∂S/∂C; each off-diagonal component counts twice."""
    values, vectors = _eigen(C)
    return _components((vectors * (a * values ** (a - 1.0))[..., None, :]) @ _transposed(vectors))


def _slope_of_slope(
    along: Float[np.ndarray, "6 ..."], C: Float[np.ndarray, "6 ..."], a: float
) -> Float[np.ndarray, "6 ..."]:
    """Return the derivative of ∂S/∂C in the direction `along`, see the docstring of the module."""
    values, vectors = _eigen(C)
    turned = _transposed(vectors) @ _matrix(along) @ vectors
    return _components(vectors @ (_divided_difference(values, a) * turned) @ _transposed(vectors))


def _divided_difference(c: Float[np.ndarray, "... 3"], a: float) -> Float[np.ndarray, "... 3 3"]:
    """Return (h(c_i) − h(c_j))/(c_i − c_j) for h(c) = a cᵃ⁻¹, and h′(c_i) for equal eigenvalues."""
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
    for component, (i, j) in zip(C, COMPONENTS, strict=True):
        full[..., i, j] = full[..., j, i] = component
    return full


def _components(full: Float[np.ndarray, "... 3 3"]) -> Float[np.ndarray, "6 ..."]:
    """Convert a derivative with respect to the matrix C to derivatives for its six components."""
    return np.stack(
        [twice * full[..., i, j] for twice, (i, j) in zip(_TWICE, COMPONENTS, strict=True)]
    )


def _transposed(full: Float[np.ndarray, "... 3 3"]) -> Float[np.ndarray, "... 3 3"]:
    return np.swapaxes(full, -1, -2)
