"""The opening curve of one stone: contact angle and radius of the tube upstream (Eqs 13–14)."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from stonepass.array_types import Float
from stonepass.errors import BadInput, require

__all__ = ["RADIUS", "OpeningCurve"]

RADIUS = (0.1, 10.0)


@dataclass(frozen=True)
class OpeningCurve:
    """Points of the relation between the contact angle α and the radius r_a of the tube upstream.

    The points describe how the wall opens round one stone while the urine pressure rises. The
    series closure is fitted to them.

    Attributes
    ----------
    alpha : tuple of float
        Contact angles α in rad, above 0 and at most π/2.
    radius : tuple of float
        Radius ratios r_a/R_a, one for each angle, from 0.1 to 10.
    reference : str
        File from which the points were read; empty if they were not read from a file.

    Raises
    ------
    BadInput
        The numbers of angles and radii differ or are zero, or a number is out of bounds.
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
        """Angles α in rad and radius ratios r_a/R_a as two arrays (pairs,)."""
        return np.array(self.alpha), np.array(self.radius)
