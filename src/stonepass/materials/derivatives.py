"""Exact derivatives of any law, by algorithmic differentiation of its one formula.

Autograd is loaded with the first derivative that is asked for: to check a request, or to show the
help of a command, none is needed.
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
    """w′(λ) in Pa: slope of the energy of an inflated tube (model: far field).

    w(λ) is the energy at circumferential stretch λ and axial stretch `axial`; the radial stretch
    follows from incompressibility, 1/(λ λ_z). For a neo-Hookean law 2 C₁₀ (λ − 1/(λ³ λ_z²)). Where
    the energy is not finite, as beyond the locking stretch of a law, the slope is NaN.
    """

    import autograd.numpy as anp
    from autograd import make_vjp

    def w(t: Any) -> Any:
        one = t / t
        C = CauchyGreen(1.0 / (t * axial) ** 2, t * t, axial**2 * one, 0.0 * one)
        return law.energy(C, place, anp)

    with np.errstate(all="ignore"):  # what has no energy gets no slope
        backwards, energy = make_vjp(w)(np.asarray(stretch, dtype=float))
        slope: Values = np.where(np.isfinite(energy), backwards(np.ones_like(energy)), np.nan)
    return slope


def hoop_modulus(law: Law) -> float:
    """w″(1) in Pa: plane-strain circumferential modulus at rest (neo-Hookean: 8 C₁₀)."""
    return float(rest_moduli(law)[0][0, 0])


def rest_gradient(law: Law) -> Float[np.ndarray, 6]:
    """∂U/∂(C_rr, C_tt, C_zz, C_rz, C_rt, C_tz) in Pa at rest at the inner wall.

    A stress-free rest state has (a, a, a, 0, 0, 0).
    """
    gradient, _ = energy_derivatives(law, REST, INNER_WALL)
    return gradient[0]


@one_trace
def energy_derivatives(
    law: Law, C: CauchyGreen, place: Place
) -> tuple[Float[np.ndarray, "points 6"], Float[np.ndarray, "points 6 6"]]:
    """U,ᵢ and U,ᵢⱼ in Pa at many points, i and j over the components rr, tt, zz, rz, rt, tz of C.

    Every component of C is an array (points), and so are the coordinates of the place, or they are
    numbers that hold for all points. The energy at a point depends on that point alone, so that six
    copies of the points give all rows of second derivatives in one pass, one row for each copy.
    Where the energy is not finite the derivatives are NaN.
    """
    import autograd.numpy as anp
    from autograd import grad

    count = len(C.rr)
    components = np.tile(np.stack(C), 6)
    everywhere = Place(*(np.tile(np.broadcast_to(x, count), 6) for x in place))
    own_row = np.repeat(np.eye(6), count, axis=1)

    def total(c: Any) -> Any:
        # Zero times every component, so that no derivative is missing where one is not used.
        energy = law.energy(CauchyGreen(*(c[i] for i in range(6))), everywhere, anp)
        return anp.sum(energy + 0.0 * anp.sum(c, axis=0))

    slopes = grad(total)

    def own_slopes(c: Any) -> Any:
        return anp.sum(slopes(c) * own_row + 0.0 * c)

    with np.errstate(all="ignore"):  # what has no energy gets no derivatives
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
    """Small-strain moduli in Pa of the inner wall at rest: (hoop, axial) matrix, r–z shear modulus.

    The matrix is the Hessian of the energy in the logarithmic strains (e_tt, e_zz) with
    e_rr = −e_tt − e_zz; the shear modulus that of simple shear, C_rz = γ, C_zz = 1 + γ².

    Parameters
    ----------
    law : Law
    strains : (float, float)
        (e_tt, e_zz) at which the matrix is taken. Tiny strains tell the moduli on either side of
        rest of a law with fibres that bear tension only; at rest itself their mean is found.
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
