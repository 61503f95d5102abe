"""The shape of a stone: a convex body of revolution, by its meridian over its radius R_s."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from stonepass.array_types import Float
from stonepass.caution import Caution, caution
from stonepass.errors import BadInput, require
from stonepass.fe.axisymmetric.profile import ROUND, Profile

__all__ = ["ASPECT", "Shape"]

ASPECT = (0.5, 2.0)
ROUGH = 0.01  # deviation that an answer warns of
WIDEST = 1e-9  # how nearly the outline is 1 and level at θ = π/2
Angles = Float[np.ndarray, "*n"]
FINE = np.linspace(0.0, np.pi, 721)


@dataclass(frozen=True)
class Shape:
    """Half-width ρ over the axial coordinate z, both over R_s, widest (ρ = 1) at z = 0.

    By the parametric angle θ from the upstream axis, with g(θ) = Σ outline[k] cos kθ:

        ρ = sin θ/g(θ),    z = −aspect × cos θ/g(θ), z downstream.

    g = 1 is a spheroid, with aspect 1 a sphere, where θ is the angle at the centre.

    Attributes
    ----------
    aspect : float
        κ of the formula: of a spheroid its length over its diameter, and nearly so of a shape that
        was put through points.
    outline : tuple of float
        Coefficients of g; g(π/2) = 1, g′(π/2) = 0, and g + g″ > 0 (convex). The length over the
        diameter, (1/g(0) + 1/g(π)) κ/2, must be 0.5 to 2.
    deviation : float
        Largest distance from the points that the shape was put through, over R_s; along rays from
        the widest place's centre, with z shrunk by κ.
    reference : str
        The file it was read from; empty where it was not.

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
            "1 and level there, where the stone is widest",
        )
        low, high = ASPECT
        length = round(self.length, 6)
        require(low <= length <= high, "aspect", length, f"a number from {low:g} to {high:g}")
        at = _dent(self.outline)
        if at is not None:
            raise BadInput("shape of the stone", f"dented at θ = {np.degrees(at):.0f}°", "convex")

    @property
    def symmetric(self) -> bool:
        """Whether the halves up- and downstream of the widest place are mirror images."""
        return self._profile.symmetric

    @property
    def spheroidal(self) -> bool:
        """Whether it is a spheroid."""
        return self.outline == ROUND

    @property
    def spherical(self) -> bool:
        """Whether it is a sphere, of which θ is the angle at the centre."""
        return self.spheroidal and self.aspect == 1.0

    @property
    def length(self) -> float:
        """Length along the ureter over the diameter across it."""
        _, (upstream, downstream) = self.meridian(np.array([0.0, np.pi]))
        return float(downstream - upstream) / 2.0

    @property
    def reach(self) -> float:
        """Distance from the widest place to the farther pole, over R_s."""
        _, poles = self.meridian(np.array([0.0, np.pi]))
        return float(np.max(np.abs(poles)))

    def warnings(self) -> list[Caution]:
        """A caution where the shape is only nearly that of its points."""
        if self.deviation <= ROUGH:
            return []
        return [caution("shape_deviation", deviation=self.deviation)]

    def turned(self) -> Shape:
        """The same stone the other way round."""
        return replace(self, outline=self._profile.turned().outline, reference="")

    def meridian(self, theta: Angles) -> tuple[Angles, Angles]:
        """ρ/R_s and z/R_s at θ in rad."""
        return self._profile.meridian(theta)

    def slopes(self, theta: Angles) -> tuple[Angles, Angles]:
        """dρ/dθ and dz/dθ over R_s at θ in rad."""
        return self._profile.slopes(theta)

    def width(self, theta: Angles) -> Angles:
        """ρ/R_s at θ in rad; sin θ of a sphere."""
        return self.meridian(theta)[0]

    @property
    def _profile(self) -> Profile:
        return Profile(1.0, self.aspect, 0.0, self.outline)


def _dent(outline: tuple[float, ...]) -> float | None:
    """θ in rad where g + g″ ≤ 0 is lowest; None where the shape is convex."""
    k = np.arange(len(outline))
    curvature = np.cos(FINE[:, None] * k) @ (np.array(outline) * (1.0 - k**2))
    lowest = int(np.argmin(curvature))
    return None if curvature[lowest] > 0.0 else float(FINE[lowest])
