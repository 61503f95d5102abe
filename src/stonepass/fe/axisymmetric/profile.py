"""The meridian of a rigid, convex stone: gap, normal and arc length, for arrays and symbols."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.polynomial import chebyshev

from stonepass.array_types import Float

__all__ = ["ROUND", "Profile"]

ROUND = (1.0,)  # the outline of a spheroid
SAMPLES = 1024  # of the meridian, for the series of its arc length
SMALLEST_TERM = 1e-13  # of that series, relative to its mean


@dataclass(frozen=True)
class Profile:
    """A convex body of revolution of half-width `radius`, by its meridian; z is downstream.

    With a = r − `offset`, s = z/`aspect` and the parametric angle τ from the upstream axis,
    cos τ = −s/√(a² + s²), the meridian is

        √(a² + s²) g(τ) = radius,    g(τ) = Σ outline[k] cos kτ,    g(π/2) = 1, g′(π/2) = 0:

    r = offset + radius sin τ/g, z = −aspect × radius cos τ/g, widest at z = 0, convex where
    g + g″ > 0. With g = 1 it is a spheroid of half-length aspect × radius, with aspect 1 too a
    sphere. The body's axis is that of the tube where `offset` is 0. Points are given by r and z,
    `xp` is the namespace of their functions.
    """

    radius: Any
    aspect: float = 1.0
    offset: Any = 0.0
    outline: tuple[float, ...] = ROUND

    @property
    def symmetric(self) -> bool:
        """Whether the halves up- and downstream of z = 0 are mirror images."""
        return not any(self.outline[1::2])

    def turned(self) -> Profile:
        """Return the mirror image: the other way round along the axis."""
        return replace(self, outline=tuple(c * (-1) ** k for k, c in enumerate(self.outline)))

    def gap(self, r: Any, z: Any, xp: Any = np) -> Any:
        """Distance from the meridian, to first order in it: (G − radius)/|∇G|, positive outside.

        G = √(a² + s²) g; exact on a sphere.
        """
        a, s = r - self.offset, z / self.aspect
        size = xp.sqrt(a * a + s * s)
        if self.aspect == 1.0 and self.outline == ROUND:
            return size - self.radius
        g, _ = self._outline(-1.0 * s / size)
        n_r, n_z = self._gradient(a / size, -1.0 * s / size)
        return (size * g - self.radius) / xp.sqrt(n_r * n_r + n_z * n_z)

    def normal(self, r: Any, z: Any, xp: Any = np) -> tuple[Any, Any]:
        """Unit normal (radial, axial), outwards; (−axial, radial) is the tangent, downstream."""
        a, s = r - self.offset, z / self.aspect
        size = xp.sqrt(a * a + s * s)
        n_r, n_z = self._gradient(a / size, -1.0 * s / size)
        steepness = xp.sqrt(n_r * n_r + n_z * n_z)
        return n_r / steepness, n_z / steepness

    def along(self, r: Any, z: Any, xp: Any = np) -> Any:
        """Arc length from the widest place over the radius: where on the meridian a point lies.

        On a sphere the angle at the centre; else the integral of the Fourier series of ds/dτ.
        """
        t = xp.arctan(z / self.aspect / (r - self.offset))  # τ − π/2
        mean, terms = _arc_series(self.aspect, self.outline)
        turned = (c * (xp.sin(k * t + k * np.pi / 2) - np.sin(k * np.pi / 2)) for k, c in terms)
        return mean * t + sum(turned)

    def parametric(self, r: Any, z: Any) -> Any:
        """Parametric angle τ from the upstream axis, of a body whose axis is that of the tube."""
        return np.arctan2(r, -z / self.aspect)

    def meridian(
        self, tau: Float[np.ndarray, "*n"]
    ) -> tuple[Float[np.ndarray, "*n"], Float[np.ndarray, "*n"]]:
        """Half-width ρ and axial coordinate z at the parametric angles τ, over the radius."""
        x, y = np.cos(tau), np.sin(tau)
        g, _ = self._outline(x)
        return np.asarray(y / g), np.asarray(-self.aspect * x / g)

    def slopes(
        self, tau: Float[np.ndarray, "*n"]
    ) -> tuple[Float[np.ndarray, "*n"], Float[np.ndarray, "*n"]]:
        """dρ/dτ and dz/dτ over the radius."""
        x, y = np.cos(tau), np.sin(tau)
        n_r, n_z = self._gradient(y, x)
        g, _ = self._outline(x)
        # The tangent is perpendicular to ∇G; its length follows from G = radius.
        slopes = -self.aspect * n_z / g**2, self.aspect * n_r / g**2
        return np.asarray(slopes[0]), np.asarray(slopes[1])

    def _outline(self, x: Any) -> tuple[Any, Any]:
        """g and dg/dx at x = cos τ."""
        if len(self.outline) == 1:
            return self.outline[0], 0.0
        return _series(self.outline, x), _series(tuple(chebyshev.chebder(self.outline)), x)

    def _gradient(self, y: Any, x: Any) -> tuple[Any, Any]:
        """∂G/∂r and ∂G/∂z on the ray with y = sin τ, x = cos τ."""
        if len(self.outline) == 1:
            return self.outline[0] * y, -self.outline[0] / self.aspect * x
        g, slope = self._outline(x)
        return y * (g - x * slope), -1.0 / self.aspect * (x * g + y * y * slope)


def _series(coefficients: tuple[float, ...], x: Any) -> Any:
    """Chebyshev series Σ c_k T_k(x) by Clenshaw's rule, of arrays or symbols."""
    ahead, beyond = 0.0, 0.0
    for c in coefficients[:0:-1]:
        ahead, beyond = float(c) + 2.0 * x * ahead - beyond, ahead
    return float(coefficients[0]) + x * ahead - beyond


@lru_cache(maxsize=64)
def _arc_series(
    aspect: float, outline: tuple[float, ...]
) -> tuple[float, tuple[tuple[int, float], ...]]:
    """Mean of ds/dτ over the radius, then k and the coefficient of sin kτ in its integral."""
    if aspect == 1.0 and outline == ROUND:
        return 1.0, ()
    tau = 2.0 * np.pi * np.arange(SAMPLES) / SAMPLES
    speed = np.hypot(*Profile(1.0, aspect, 0.0, outline).slopes(tau))
    mean, *cosines = np.fft.rfft(speed).real / SAMPLES
    terms = ((k, 2.0 * float(c) / k) for k, c in enumerate(cosines, start=1))
    return float(mean), tuple((k, c) for k, c in terms if abs(c) * k > SMALLEST_TERM * mean)
