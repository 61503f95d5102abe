"""The opening curve of one stone: opened angle and the tube's radius above it (Eqs 13–14)."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from stonepass.array_types import Float
from stonepass.errors import BadInput, require

__all__ = ["RADIUS", "OpeningCurve"]

RADIUS = (0.1, 10.0)


@dataclass(frozen=True)
class OpeningCurve:
    """α in rad, up to π/2, and r_a/R_a, as rising pressure opens the wall round one stone.

    `reference` is the file they were read from; empty where they were not.
    """

    alpha: tuple[float, ...]
    radius: tuple[float, ...]
    reference: str = field(default="", compare=False)

    def __post_init__(self) -> None:
        angles, radii = len(self.alpha), len(self.radius)
        given = f"{angles} angles and {radii} radii"
        require(angles == radii > 0, "opening_curve", given, "one radius for each angle")
        low, high = RADIUS
        for k, (alpha, radius) in enumerate(zip(self.alpha, self.radius, strict=True), start=1):
            degrees = round(float(np.degrees(alpha)), 6)
            if not 0.0 < alpha <= np.pi / 2:
                raise BadInput(f"alpha of pair {k}", f"{degrees:g}°", "above 0° and at most 90°")
            require(low <= radius <= high, f"radius ratio of pair {k}", radius, f"{low} to {high}")

    @property
    def arrays(self) -> tuple[Float[np.ndarray, " pairs"], Float[np.ndarray, " pairs"]]:
        """Both columns."""
        return np.array(self.alpha), np.array(self.radius)
