"""The shape of a stone: the meridian of a convex body of revolution, divided by its radius R_s."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from stonepass.array_types import Float
from stonepass.caution import Caution, caution
from stonepass.errors import BadInput, require
from stonepass.fe.axisymmetric.profile import ROUND, Profile

__all__ = ["ASPECT", "Shape"]

ASPECT = (0.5, 2.0)
ROUGH = 0.01  # deviation above which an answer carries a warning, in R_s
WIDEST = 1e-9  # tolerance of the conditions g = 1 and ρ′ = 0 at θ = π/2
Angles = Float[np.ndarray, "*n"]
FINE = np.linspace(0.0, np.pi, 721)


@dataclass(frozen=True)
class Shape:
    """The meridian of a stone: half-width ρ as a function of the axial coordinate z.

    Both coordinates are divided by R_s. z points downstream, and the stone is widest (ρ = 1) at
    z = 0. The meridian is given by the parametric angle θ from the upstream axis, with
    g(θ) = Σ outline[k] cos kθ:

        ρ = sin θ/g(θ),    z = −aspect × cos θ/g(θ).

    If g = 1, the stone is a spheroid. If in addition aspect = 1, it is a sphere, and θ is the angle
    at its centre. See "Stones that are not spheres" in docs/theory.md.

    Attributes
    ----------
    aspect : float
        κ, the axial scale in the formula. For a spheroid it is the length divided by the diameter.
        For a shape that was fitted to points it is close to that ratio.
    outline : tuple of float
        Coefficients of g, with g(π/2) = 1, g′(π/2) = 0, and g + g″ > 0 (convexity). The length
        divided by the diameter, κ (1/g(0) + 1/g(π))/2, must be from 0.5 to 2.
    deviation : float
        Largest distance between the shape and the points to which it was fitted, divided by R_s. It
        is measured along rays from the centre of the widest cross-section, after division of z by
        κ. It is 0 for a shape that was not fitted.
    reference : str
        File from which the shape was read; empty if it was not read from a file.

    Raises
    ------
    BadInput
        A number is out of bounds, the stone is not widest at θ = π/2, or it is not convex.

    Examples
    --------
    >>> rho, z = Shape(1.5).meridian(np.array([0.0, np.pi / 2]))
    >>> rho.tolist(), (z.round(12) + 0.0).tolist()
    ([0.0, 1.0], [-1.5, 0.0])
    """

    aspect: float = 1.0
    outline: tuple[float, ...] = ROUND
    deviation: float = field(default=0.0, compare=False)
    reference: str = field(default="", compare=False)

    def __repr__(self) -> str:
        if self.spheroidal:
            return f"Shape({self.aspect:g})"
        source = f" of {self.reference}" if self.reference else ""
        return f"<Shape{source}: length over diameter {self.length:.4g}>"

    def __post_init__(self) -> None:
        require(0.0 < self.aspect < np.inf, "aspect", self.aspect, "a number above zero")
        require(len(self.outline) > 0, "outline of the stone", "empty", "at least one number")
        object.__setattr__(self, "outline", tuple(float(c) for c in self.outline))
        widest = np.array(np.pi / 2)
        middle, tilt = float(self.width(widest)), float(self.slopes(widest)[0])
        require(
            abs(middle - 1.0) < WIDEST and abs(tilt) < WIDEST,
            "outline of the stone",
            f"g = {1.0 / middle:.6g} with slope {0.0 - round(tilt, 9):.3g} at θ = 90°",
            "1 with slope 0 there, because the stone is widest at this angle",
        )
        low, high = ASPECT
        length = round(self.length, 6)
        require(low <= length <= high, "aspect", length, f"a number from {low:g} to {high:g}")
        at = _dent(self.outline)
        if at is not None:
            raise BadInput("shape of the stone", f"dented at θ = {np.degrees(at):.0f}°", "convex")

    @property
    def symmetric(self) -> bool:
        """True if the halves upstream and downstream of the widest place are mirror images."""
        return self._profile.symmetric

    @property
    def spheroidal(self) -> bool:
        """True if the stone is a spheroid."""
        return self.outline == ROUND

    @property
    def spherical(self) -> bool:
        """True if the stone is a sphere; then θ is the angle at its centre."""
        return self.spheroidal and self.aspect == 1.0

    @property
    def length(self) -> float:
        """Length along the ureter divided by the diameter across it."""
        _, (upstream, downstream) = self.meridian(np.array([0.0, np.pi]))
        return float(downstream - upstream) / 2.0

    @property
    def reach(self) -> float:
        """Axial distance from the widest place to the farther pole, divided by R_s."""
        _, poles = self.meridian(np.array([0.0, np.pi]))
        return float(np.max(np.abs(poles)))

    def warnings(self) -> list[Caution]:
        """Return a caution if the shape deviates noticeably from the points it was fitted to."""
        if self.deviation <= ROUGH:
            return []
        return [caution("shape_deviation", deviation=self.deviation)]

    def turned(self) -> Shape:
        """Return the stone with its upstream and downstream ends exchanged."""
        return replace(self, outline=self._profile.turned().outline, reference="")

    def meridian(self, theta: Angles) -> tuple[Angles, Angles]:
        """Return ρ/R_s and z/R_s at the angles θ in rad."""
        return self._profile.meridian(theta)

    def slopes(self, theta: Angles) -> tuple[Angles, Angles]:
        """Return dρ/dθ and dz/dθ, divided by R_s, at the angles θ in rad."""
        return self._profile.slopes(theta)

    def width(self, theta: Angles) -> Angles:
        """Return ρ/R_s at the angles θ in rad; it is sin θ for a sphere."""
        return self.meridian(theta)[0]

    @property
    def _profile(self) -> Profile:
        return Profile(1.0, self.aspect, 0.0, self.outline)


def _dent(outline: tuple[float, ...]) -> float | None:
    """Return the θ in rad at which g + g″ is smallest if it is not positive there, else None."""
    k = np.arange(len(outline))
    curvature = np.cos(FINE[:, None] * k) @ (np.array(outline) * (1.0 - k**2))
    lowest = int(np.argmin(curvature))
    return None if curvature[lowest] > 0.0 else float(FINE[lowest])
