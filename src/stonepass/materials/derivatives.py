"""Exact derivatives of any law, by algorithmic differentiation of its one formula."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import autograd.numpy as anp
import numpy as np
from autograd import elementwise_grad, grad, hessian
from jaxtyping import Float

from stonepass.materials.protocol import Law
from stonepass.units import Values

__all__ = [
    "energy_derivatives",
    "hoop_energy_slope",
    "hoop_modulus",
    "rest_gradient",
    "rest_moduli",
]


def hoop_energy_slope(law: Law, stretch: Values, axial: float = 1.0) -> Values:
    """w′(λ) in Pa: slope of the energy of an inflated tube (model: far field).

    w(λ) is the energy at circumferential stretch λ and axial stretch `axial`; the radial stretch
    follows from incompressibility, 1/(λ λ_z). For a neo-Hookean law 2 C₁₀ (λ − 1/(λ³ λ_z²)).
    """

    def w(t: Any) -> Any:
        one = t / t
        return law.energy(1.0 / (t * axial) ** 2, t * t, axial**2 * one, 0.0 * one, anp)

    slope: Values = elementwise_grad(w)(np.asarray(stretch, dtype=float))
    return slope


def hoop_modulus(law: Law) -> float:
    """w″(1) in Pa: plane-strain circumferential modulus at rest (neo-Hookean: 8 C₁₀)."""
    return float(rest_moduli(law)[0][0, 0])


def rest_gradient(law: Law) -> Float[np.ndarray, 4]:
    """∂U/∂(C_rr, C_tt, C_zz, C_rz) in Pa at rest; a stress-free rest state has (a, a, a, 0)."""

    def energy(c: Any) -> Any:
        return law.energy(c[0:1], c[1:2], c[2:3], c[3:4], anp)

    gradient: Float[np.ndarray, 4] = elementwise_grad(energy)(np.array([1.0, 1.0, 1.0, 0.0]))
    return gradient


def energy_derivatives(
    law: Law,
    C_rr: Float[np.ndarray, " points"],
    C_tt: Float[np.ndarray, " points"],
    C_zz: Float[np.ndarray, " points"],
    C_rz: Float[np.ndarray, " points"],
) -> tuple[Float[np.ndarray, "points 4"], Float[np.ndarray, "points 4 4"]]:
    """U,ᵢ and U,ᵢⱼ in Pa at many points, i and j over the components rr, tt, zz, rz of C.

    One pass gives all four slopes and one more each row of second derivatives, since the energy
    at a point depends on that point alone.
    """
    C = np.stack([C_rr, C_tt, C_zz, C_rz])

    def total(c: Any) -> Any:
        # Zero times every component, so that no derivative is missing where one is not used.
        return anp.sum(law.energy(c[0], c[1], c[2], c[3], anp) + 0.0 * anp.sum(c, axis=0))

    slopes = grad(total)

    def row(i: int) -> Float[np.ndarray, "4 points"]:
        return np.asarray(grad(lambda c: anp.sum(slopes(c)[i] + 0.0 * anp.sum(c, axis=0)))(C))

    curvature = np.stack([row(i) for i in range(4)])
    return np.asarray(slopes(C)).T, np.moveaxis(curvature, -1, 0)


@lru_cache(maxsize=64)
def rest_moduli(law: Law) -> tuple[Float[np.ndarray, "2 2"], float]:
    """Small-strain moduli in Pa at rest: the (hoop, axial) matrix and the r–z shear modulus.

    The matrix is the Hessian of the energy in the logarithmic strains (e_tt, e_zz) with
    e_rr = −e_tt − e_zz; the shear modulus that of simple shear, C_rz = γ, C_zz = 1 + γ².
    """

    def stretched(e: Any) -> Any:
        return law.energy(
            anp.exp(-2.0 * (e[0] + e[1])), anp.exp(2.0 * e[0]), anp.exp(2.0 * e[1]), 0.0 * e[0], anp
        )

    def sheared(g: Any) -> Any:
        one = 1.0 + 0.0 * g[0]
        return law.energy(one, one, 1.0 + g[0] ** 2, g[0], anp)

    return (
        np.asarray(hessian(stretched)(np.zeros(2))),
        float(np.asarray(hessian(sheared)(np.zeros(1)))[0, 0]),
    )
