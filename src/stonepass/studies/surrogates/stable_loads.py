"""The largest confining pressures of a box: thin walls buckle before the largest one is reached.

A confining pressure can make the tube itself buckle axisymmetrically, without a stone. A model then
has no answer. Close to this load the contact varies fast with all inputs, and some stones have no
seated state. A surrogate therefore ends at a fraction of the load at which the tube buckles.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Float

__all__ = ["StableLoads"]


@array_dataclass
@dataclass(frozen=True)
class StableLoads:
    """The largest load factor that a surrogate covers, as a function of the wall ratio.

    Attributes
    ----------
    wall_ratio : array (n)
        Wall ratios η in ascending order.
    factor : array (n)
        Largest factor on the confining pressure of the surrogate's case, 0 to 1. It is interpolated
        linearly.
    narrowest : float
        Smallest lumen r_a/R_a of the tubes under these loads, without stone and urine pressure.
    """

    wall_ratio: Float[np.ndarray, " n"]
    factor: Float[np.ndarray, " n"]
    narrowest: float

    def __call__(self, wall_ratio: Float[np.ndarray, " m"]) -> Float[np.ndarray, " m"]:
        """Return the largest load factors for m wall ratios."""
        return np.interp(wall_ratio, self.wall_ratio, self.factor)
