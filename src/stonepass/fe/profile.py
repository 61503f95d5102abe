"""The meridian of a rigid spheroid: gap, normal and arc length, for arrays and symbols alike."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from jaxtyping import Float

__all__ = ["Profile"]

TERMS = 24  # of the arc length's Fourier series: 1e-12 at aspect 2, where they fall as 3⁻ᵏ


@dataclass(frozen=True)
class Profile:
    """A spheroid of half-width `radius` and half-length `aspect` × radius, by its meridian.

    Its centre has the axial coordinate 0 and the radial one `offset`; with 0 it lies on the axis.
    `aspect` 1 is a sphere. Points are given by r and z, `xp` is the namespace of their functions.
    """

    radius: Any
    aspect: float = 1.0
    offset: Any = 0.0

    def gap(self, r: Any, z: Any, xp: Any = np) -> Any:
        """Distance from the meridian, to first order in it: F/|∇F|, positive outside.

        F = √(a² + z²/κ²) − radius with a = r − offset; exact on a sphere.
        """
        a, s = r - self.offset, z / self.aspect
        size = xp.sqrt(a * a + s * s)
        if self.aspect == 1.0:
            return size - self.radius
        return (size - self.radius) * size / self._steepness(a, s, xp)

    def normal(self, r: Any, z: Any, xp: Any = np) -> tuple[Any, Any]:
        """Unit normal (radial, axial), outwards; (−axial, radial) is the tangent, downstream."""
        a, s = r - self.offset, z / self.aspect
        steepness = self._steepness(a, s, xp)
        return a / steepness, s / self.aspect / steepness

    def along(self, r: Any, z: Any, xp: Any = np) -> Any:
        """Arc length from the equator over the radius: where on the meridian a point lies.

        On a sphere the angle at the centre. Else ∫ √(sin² t + κ² cos² t) dt up to the parametric
        angle t = atan(z/κa), by the Fourier series of the root.
        """
        t = xp.arctan(z / self.aspect / (r - self.offset))
        if self.aspect == 1.0:
            return t
        mean, *terms = _root_series(self.aspect)
        return mean * t + sum(c * xp.sin(2.0 * k * t) for k, c in enumerate(terms, start=1))

    def parametric(self, r: Any, z: Any) -> Any:
        """Parametric angle from the axis, upstream 0: r = radius sin τ, z = −κ radius cos τ."""
        return np.arctan2(r, -z / self.aspect)

    def _steepness(self, a: Any, s: Any, xp: Any) -> Any:
        """|∇F| × √(a² + z²/κ²)."""
        s = s / self.aspect
        return xp.sqrt(a * a + s * s)


@lru_cache(maxsize=64)
def _root_series(aspect: float) -> tuple[float, ...]:
    """Mean of √(sin² t + κ² cos² t), then the coefficients of sin 2kt in its integral."""
    t = np.pi * np.arange(256) / 256.0
    root: Float[np.ndarray, " n"] = np.hypot(np.sin(t), aspect * np.cos(t))
    cosines = [2.0 * float((root * np.cos(2 * k * t)).mean()) / (2 * k) for k in range(1, TERMS)]
    return float(root.mean()), *cosines
