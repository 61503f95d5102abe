"""Exact derivatives of any law, by automatic differentiation of its formula.

Autograd is imported only when the first derivative is computed, because the checks of a request and
the help of a command need no derivatives.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np

from stonepass.array_types import Float
from stonepass.materials.one_trace import one_trace
from stonepass.materials.protocol import Law
from stonepass.strain import INNER_WALL, CauchyGreen, Place
from stonepass.units import Values

__all__ = [
    "energy_derivatives",
    "hoop_energy_slope",
    "hoop_modulus",
    "rest_gradient",
    "rest_moduli",
]

REST = CauchyGreen(*(np.array([each]) for each in (1.0, 1.0, 1.0, 0.0, 0.0, 0.0)))


@one_trace
def hoop_energy_slope(
    law: Law, stretch: Values, axial: float = 1.0, place: Place = INNER_WALL
) -> Values:
    """Return w′(λ), the derivative of the energy of a uniformly inflated tube.

    w(λ) is the energy density at the circumferential stretch λ and the axial stretch λ_z; the
    radial stretch 1/(λ λ_z) follows from incompressibility. For a neo-Hookean law the result is
    2 C₁₀ (λ − 1/(λ³ λ_z²)). See "Far field" in docs/theory.md.

    Parameters
    ----------
    law : Law
    stretch : float or array
        Circumferential stretch λ, positive.
    axial : float
        Axial stretch λ_z, positive.
    place : Place
        Reference coordinates in inner radii, as numbers or as arrays of the shape of `stretch`.

    Returns
    -------
    array
        w′(λ) in Pa. It is NaN where the energy is not finite, as beyond a locking stretch.
    """

    import autograd.numpy as anp
    from autograd import make_vjp

    def w(t: Any) -> Any:
        one = t / t
        C = CauchyGreen(1.0 / (t * axial) ** 2, t * t, axial**2 * one, 0.0 * one)
        return law.energy(C, place, anp)

    with np.errstate(all="ignore"):  # where the energy is not finite the slope becomes NaN
        backwards, energy = make_vjp(w)(np.asarray(stretch, dtype=float))
        slope: Values = np.where(np.isfinite(energy), backwards(np.ones_like(energy)), np.nan)
    return slope


def hoop_modulus(law: Law) -> float:
    """Return w″(1) in Pa, the circumferential modulus at rest in plane strain.

    For a neo-Hookean law it is 8 C₁₀. For w see `hoop_energy_slope`.
    """
    return float(rest_moduli(law)[0][0, 0])


def rest_gradient(law: Law) -> Float[np.ndarray, 6]:
    """Return ∂U/∂(C_rr, C_tt, C_zz, C_rz, C_rt, C_tz) in Pa at rest, at the inner wall.

    In a stress-free rest state it has the form (a, a, a, 0, 0, 0).
    """
    gradient, _ = energy_derivatives(law, REST, INNER_WALL)
    return gradient[0]


@one_trace
def energy_derivatives(
    law: Law, C: CauchyGreen, place: Place
) -> tuple[Float[np.ndarray, "points 6"], Float[np.ndarray, "points 6 6"]]:
    """Return first and second derivatives of the energy with respect to C at several points.

    Parameters
    ----------
    law : Law
    C : CauchyGreen
        Six arrays (points,).
    place : Place
        Reference coordinates in inner radii, as arrays (points,) or as numbers for all points.

    Returns
    -------
    gradient : array (points, 6)
        ∂U/∂C_i in Pa for the components i = rr, tt, zz, rz, rt, tz.
    curvature : array (points, 6, 6)
        ∂²U/∂C_i ∂C_j in Pa. Both arrays are NaN at points where the energy is not finite.

    Notes
    -----
    The energy at a point depends on that point only. Therefore the points are copied six times, and
    a single backward pass returns one row of the second derivatives for each copy.
    """
    import autograd.numpy as anp
    from autograd import grad

    count = len(C.rr)
    components = np.tile(np.stack(C), 6)
    everywhere = Place(*(np.tile(np.broadcast_to(x, count), 6) for x in place))
    own_row = np.repeat(np.eye(6), count, axis=1)

    def total(c: Any) -> Any:
        # With this sum the derivatives with respect to components that U does not use are zero;
        # without it they would be undefined.
        energy = law.energy(CauchyGreen(*(c[i] for i in range(6))), everywhere, anp)
        return anp.sum(energy + 0.0 * anp.sum(c, axis=0))

    slopes = grad(total)

    def own_slopes(c: Any) -> Any:
        return anp.sum(slopes(c) * own_row + 0.0 * c)

    with np.errstate(all="ignore"):  # where the energy is not finite the derivatives become NaN
        curvature = np.asarray(grad(own_slopes)(components)).reshape(6, 6, count)
        gradient = np.asarray(slopes(components))[:, :count].T
        energy = law.energy(C, Place(*(x[:count] for x in everywhere)), anp)
    known = np.isfinite(np.broadcast_to(energy, count))
    return (
        np.where(known[:, None], gradient, np.nan),
        np.where(known[:, None, None], np.moveaxis(curvature, -1, 0), np.nan),
    )


@lru_cache(maxsize=64)
@one_trace
def rest_moduli(
    law: Law, strains: tuple[float, float] = (0.0, 0.0)
) -> tuple[Float[np.ndarray, "2 2"], float]:
    """Return the small-strain moduli of the inner wall at rest.

    Parameters
    ----------
    law : Law
    strains : (float, float)
        Logarithmic strains (e_tt, e_zz) at which the matrix is evaluated. For a law with
        tension-only fibres the second derivatives jump at rest. Tiny strains then select one side;
        at zero strain automatic differentiation returns the mean of both sides.

    Returns
    -------
    matrix : array (2, 2)
        Hessian of the energy in Pa with respect to the logarithmic strains (e_tt, e_zz), with
        e_rr = −e_tt − e_zz.
    shear : float
        r–z shear modulus in Pa, from the simple shear C_rz = γ, C_zz = 1 + γ² at γ = 0.
    """

    import autograd.numpy as anp
    from autograd import hessian

    def stretched(e: Any) -> Any:
        radial = anp.exp(-2.0 * (e[0] + e[1]))
        C = CauchyGreen(radial, anp.exp(2.0 * e[0]), anp.exp(2.0 * e[1]), 0.0 * e[0])
        return law.energy(C, INNER_WALL, anp)

    def sheared(g: Any) -> Any:
        one = 1.0 + 0.0 * g[0]
        return law.energy(CauchyGreen(one, one, 1.0 + g[0] ** 2, g[0]), INNER_WALL, anp)

    return (
        np.asarray(hessian(stretched)(np.array(strains))),
        float(np.asarray(hessian(sheared)(np.zeros(1)))[0, 0]),
    )
