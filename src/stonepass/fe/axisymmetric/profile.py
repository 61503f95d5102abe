"""The meridian of a rigid, convex stone: gap, normal and arc length, for arrays and symbols.

See "Stones that are not spheres" in docs/theory.md.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.polynomial import chebyshev

from stonepass.array_types import Float

__all__ = ["ROUND", "Profile"]

ROUND = (1.0,)  # outline g = 1 of a spheroid
SAMPLES = 1024  # number of samples of the meridian for the Fourier series of its arc length
SMALLEST_TERM = 1e-13  # terms of that series below this fraction of its mean are dropped


@dataclass(frozen=True)
class Profile:
    """The meridian of a convex body of revolution.

    Let a = r − `offset` and s = z/`aspect`, where z points downstream, and let τ be the parametric
    angle from the upstream axis, cos τ = −s/√(a² + s²). The meridian is the curve

        √(a² + s²) g(τ) = radius,    g(τ) = Σ outline[k] cos kτ,    g(π/2) = 1, g′(π/2) = 0,

    or in parametric form r = offset + radius sin τ/g, z = −aspect × radius cos τ/g. The body is
    widest at z = 0 and convex if g + g″ > 0. If g = 1, it is a spheroid of half-length
    aspect × radius; if in addition aspect = 1, it is a sphere. See "Stones that are not spheres" in
    docs/theory.md.

    The methods take points by their coordinates r and z in inner radii, which may be numbers,
    arrays or NGSolve symbols. `xp` is the array namespace for their type: `numpy`, or `SYMBOLS` of
    the module `wall`.

    Attributes
    ----------
    radius : float or ngsolve.Parameter
        Largest half-width, in inner radii.
    aspect : float
        Axial scale, positive.
    offset : float or ngsolve.Parameter
        Radial coordinate of the centre of the arc, in inner radii. A loading path may move the arc
        by changing it; in the final position it is 0, and the axes of body and tube coincide.
    outline : tuple of float
        Coefficients of g.
    """

    radius: Any
    aspect: float = 1.0
    offset: Any = 0.0
    outline: tuple[float, ...] = ROUND

    @property
    def symmetric(self) -> bool:
        """True if the halves upstream and downstream of z = 0 are mirror images."""
        return not any(self.outline[1::2])

    def turned(self) -> Profile:
        """Return the body reflected at the plane z = 0."""
        return replace(self, outline=tuple(c * (-1) ** k for k, c in enumerate(self.outline)))

    def gap(self, r: Any, z: Any, xp: Any = np) -> Any:
        """Return the distance of points from the meridian in inner radii, positive outside.

        The distance is (G − radius)/|∇G| with G = √(a² + s²) g. It is exact for a sphere, and
        correct to first order in the distance for other bodies.
        """
        a, s = r - self.offset, z / self.aspect
        size = xp.sqrt(a * a + s * s)
        if self.aspect == 1.0 and self.outline == ROUND:
            return size - self.radius
        g, _ = self._outline(-1.0 * s / size)
        n_r, n_z = self._gradient(a / size, -1.0 * s / size)
        return (size * g - self.radius) / xp.sqrt(n_r * n_r + n_z * n_z)

    def normal(self, r: Any, z: Any, xp: Any = np) -> tuple[Any, Any]:
        """Return the outward unit normal (n_r, n_z); the downstream unit tangent is (−n_z, n_r)."""
        a, s = r - self.offset, z / self.aspect
        size = xp.sqrt(a * a + s * s)
        n_r, n_z = self._gradient(a / size, -1.0 * s / size)
        steepness = xp.sqrt(n_r * n_r + n_z * n_z)
        return n_r / steepness, n_z / steepness

    def along(self, r: Any, z: Any, xp: Any = np) -> Any:
        """Return the arc-length coordinate of points: arc length from z = 0, divided by the radius.

        It is positive downstream. For a sphere it is the angle at the centre, for other bodies the
        integral of the Fourier series of ds/dτ.
        """
        t = xp.arctan(z / self.aspect / (r - self.offset))  # τ − π/2
        mean, terms = _arc_series(self.aspect, self.outline)
        turned = (c * (xp.sin(k * t + k * np.pi / 2) - np.sin(k * np.pi / 2)) for k, c in terms)
        return mean * t + sum(turned)

    def parametric(self, r: Any, z: Any) -> Any:
        """Return the parametric angle τ in rad of points of a body with `offset` 0."""
        return np.arctan2(r, -z / self.aspect)

    def meridian(
        self, tau: Float[np.ndarray, "*n"]
    ) -> tuple[Float[np.ndarray, "*n"], Float[np.ndarray, "*n"]]:
        """Return half-width ρ and axial coordinate z at angles τ (rad), divided by the radius."""
        x, y = np.cos(tau), np.sin(tau)
        g, _ = self._outline(x)
        return np.asarray(y / g), np.asarray(-self.aspect * x / g)

    def slopes(
        self, tau: Float[np.ndarray, "*n"]
    ) -> tuple[Float[np.ndarray, "*n"], Float[np.ndarray, "*n"]]:
        """Return dρ/dτ and dz/dτ at the angles τ (rad), divided by the radius."""
        x, y = np.cos(tau), np.sin(tau)
        n_r, n_z = self._gradient(y, x)
        g, _ = self._outline(x)
        # The tangent is perpendicular to ∇G; its length follows from G = radius.
        slopes = -self.aspect * n_z / g**2, self.aspect * n_r / g**2
        return np.asarray(slopes[0]), np.asarray(slopes[1])

    def _outline(self, x: Any) -> tuple[Any, Any]:
        """Return g and dg/dx at x = cos τ."""
        if len(self.outline) == 1:
            return self.outline[0], 0.0
        return _series(self.outline, x), _series(tuple(chebyshev.chebder(self.outline)), x)

    def _gradient(self, y: Any, x: Any) -> tuple[Any, Any]:
        """Return ∂G/∂r and ∂G/∂z on the ray with y = sin τ and x = cos τ."""
        if len(self.outline) == 1:
            return self.outline[0] * y, -self.outline[0] / self.aspect * x
        g, slope = self._outline(x)
        return y * (g - x * slope), -1.0 / self.aspect * (x * g + y * y * slope)


def _series(coefficients: tuple[float, ...], x: Any) -> Any:
    """Evaluate the Chebyshev series Σ c_k T_k(x) by Clenshaw's rule, for arrays or symbols."""
    ahead, beyond = 0.0, 0.0
    for c in coefficients[:0:-1]:
        ahead, beyond = float(c) + 2.0 * x * ahead - beyond, ahead
    return float(coefficients[0]) + x * ahead - beyond


@lru_cache(maxsize=64)
def _arc_series(
    aspect: float, outline: tuple[float, ...]
) -> tuple[float, tuple[tuple[int, float], ...]]:
    """Return the Fourier series of the arc length s(τ) of a body of radius 1.

    The results are the mean of ds/dτ, and pairs of k and the coefficient of sin kτ in s(τ).
    """
    if aspect == 1.0 and outline == ROUND:
        return 1.0, ()
    tau = 2.0 * np.pi * np.arange(SAMPLES) / SAMPLES
    speed = np.hypot(*Profile(1.0, aspect, 0.0, outline).slopes(tau))
    mean, *cosines = np.fft.rfft(speed).real / SAMPLES
    terms = ((k, 2.0 * float(c) / k) for k, c in enumerate(cosines, start=1))
    return float(mean), tuple((k, c) for k, c in terms if abs(c) * k > SMALLEST_TERM * mean)
