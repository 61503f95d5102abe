"""The box of inputs that a surrogate covers, its coordinates, and the cases it is fitted to.

The size of the stone enters by its oversize over the lumen, ξ/ξ_lumen − 1, so that the smallest
stone of the box is as large as the lumen under every confining pressure. The width of the contact
is proportional to the square root of the oversize for small stones, and the indentation of the wall
depends on the logarithm of this width. The load enters by the lumen that it leaves.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Bool, Float
from stonepass.errors import require
from stonepass.model.case import Case
from stonepass.model.stone import FRICTION, SIZE_RATIO
from stonepass.model.ureter import WALL_RATIO
from stonepass.studies.conditions import Conditions, joined, lumen_ratios, urine_pressures
from stonepass.studies.surrogates.polynomial import SparsePolynomial, chebyshev_products
from stonepass.studies.surrogates.stable_loads import StableLoads

__all__ = [
    "HELD_OUT",
    "SLACK",
    "Box",
    "Setting",
    "fit_lumen",
    "opening_pressure",
]

SMALLEST_FRICTION = 0.01  # smallest friction coefficient of a sampled case
FIRST = 0.04  # smallest root of the relative oversize of a sampled case
SHIFT = 0.1  # added to this root before the logarithm is taken
AT_ZERO = 0.15  # part of the range of the load's coordinate that stands for no confining pressure
LUMEN_DEGREES = (20, 14)  # degrees of the lumen in wall ratio and load factor
SEED = 20221  # seed of the sampled cases
SLACK = 1e-9  # relative distance outside the box that counts as inside: that of rounded quotients
HELD_OUT = 1024  # first case of the sequence that is left to checks


@dataclass(frozen=True)
class Box:
    """The range of the inputs of a surrogate.

    The smallest size ratio is that of the lumen, and the confining pressure extends from 0 to that
    of the case of the surrogate.

    Attributes
    ----------
    size_ratio : float
        Largest size ratio ξ, above 1.
    wall_ratio : (float, float)
        Smallest and largest wall ratio η.
    friction : (float, float)
        Smallest and largest friction coefficient μ_f.

    Raises
    ------
    BadInput
        A range is empty or out of the bounds of a case.
    """

    size_ratio: float = 1.6
    wall_ratio: tuple[float, float] = (1.1, 4.0)
    friction: tuple[float, float] = (0.0, 1.0)

    def __post_init__(self) -> None:
        most = SIZE_RATIO[1]
        inside = 1.0 < self.size_ratio <= most
        require(inside, "largest size ratio", self.size_ratio, f"above 1 and at most {most:g}")
        for name, given, bounds in (
            ("wall ratio", self.wall_ratio, WALL_RATIO),
            ("friction", self.friction, FRICTION),
        ):
            inside = len(given) == 2 and bounds[0] <= given[0] < given[1] <= bounds[1]
            allowed = f"a rising pair from {bounds[0]:g} to {bounds[1]:g}"
            require(inside, f"range of the {name}", given, allowed)

    def contains(self, asked: Conditions) -> Bool[np.ndarray, " n"]:
        """Return which of n conditions are inside the box; the lower end of the size is ignored.

        Conditions outside by the rounding of a quotient are inside; `clipped` moves them there.
        """
        return (
            (asked.size_ratio <= self.size_ratio * (1.0 + SLACK))
            & _between(asked.wall_ratio, self.wall_ratio)
            & _between(asked.friction, self.friction)
            & _between(asked.load_factor, (0.0, 1.0))
        )

    def clipped(self, asked: Conditions) -> Conditions:
        """Return n conditions moved to the nearest ones inside the box."""
        return Conditions(
            np.minimum(asked.size_ratio, self.size_ratio),
            np.clip(asked.wall_ratio, *self.wall_ratio),
            np.clip(asked.friction, *self.friction),
            np.clip(asked.load_factor, 0.0, 1.0),
        )

    def wall_coordinate(self, at: Conditions) -> Float[np.ndarray, " n"]:
        """Return the coordinate of the wall of n conditions: ln(η − 1), scaled to 0 to 1."""
        low, high = (edge - 1.0 for edge in self.wall_ratio)
        return np.log((at.wall_ratio - 1.0) / low) / np.log(high / low)

    def sample(self, case: Case, stable: StableLoads, count: int, first: int = 0) -> Conditions:
        """Return conditions that fill the box, from a scrambled Sobol sequence with a fixed seed.

        Points near the faces of the box are drawn more often, because polynomials are least
        accurate there. If the case has a confining pressure, about one condition in five has none.

        Parameters
        ----------
        case : Case
            Its material and load are used.
        stable : StableLoads
            The largest load factors of the conditions.
        count : int
            Number n of conditions.
        first : int
            Number of conditions at the beginning of the sequence that are left out.
        """
        from scipy.stats import qmc  # takes a second to load

        loaded = case.load.confining_pressure > 0.0
        sequence = qmc.Sobol(4 if loaded else 3, seed=SEED)
        drawn = sequence.random(1 << (first + count - 1).bit_length())[first : first + count]
        unit = 0.5 * drawn + 0.25 * (1.0 - np.cos(np.pi * drawn))
        low, high = (edge - 1.0 for edge in self.wall_ratio)
        wall = 1.0 + np.exp(np.log(low) + unit[:, 1] * np.log(high / low))
        least = max(self.friction[0], SMALLEST_FRICTION)
        friction = least + (self.friction[1] - least) * unit[:, 2]
        factor = np.zeros(count)
        if loaded:
            factor = np.maximum(0.0, (unit[:, 3] - AT_ZERO) / (1.0 - AT_ZERO)) * stable(wall)
        lumen = lumen_ratios(case, wall, factor)
        root = FIRST + (1.0 - FIRST) * unit[:, 0]
        size = lumen * (1.0 + root**2 * (self.size_ratio / lumen - 1.0))
        return Conditions(size, wall, friction, factor)

    def setting(
        self, case: Case, asked: Conditions, lumen: Float[np.ndarray, " n"], narrowest: float
    ) -> Setting:
        """Return n conditions with the lumen and the coordinates in the box.

        Parameters
        ----------
        case : Case
            Its confining pressure belongs to the load factor 1.
        asked : Conditions
            Conditions inside the box.
        lumen : array (n)
            Inner radius ratio of the tube under the load, without stone and urine pressure.
        narrowest : float
            The smallest lumen in the box, see `StableLoads`.
        """
        over = np.maximum(asked.size_ratio / lumen - 1.0, 0.0)
        widest = np.maximum(self.size_ratio / lumen - 1.0, np.finfo(float).tiny)
        root = np.minimum(np.sqrt(over / widest), 1.0)
        size = np.log((np.maximum(root, FIRST) + SHIFT) / (FIRST + SHIFT))
        size /= np.log((1.0 + SHIFT) / (FIRST + SHIFT))
        low, high = (edge**0.5 for edge in self.friction)
        friction = (np.sqrt(asked.friction) - low) / (high - low)
        narrowed = (1.0 - lumen) / max(1.0 - narrowest, np.finfo(float).tiny)
        unit = np.stack([size, self.wall_coordinate(asked), friction, narrowed], axis=1)
        confining = asked.load_factor * case.load.confining_pressure
        return Setting(asked, confining, lumen, root, np.clip(unit, 0.0, 1.0))


@array_dataclass
@dataclass(frozen=True)
class Setting:
    """Conditions of n cases, with the quantities that follow from them in closed form.

    Attributes
    ----------
    conditions : Conditions
        Size ratio, wall ratio, friction and load factor.
    confining : array (n)
        Confining pressure P_out in Pa.
    lumen : array (n)
        Inner radius ratio of the tube under the load, without stone and urine pressure.
    root : array (n)
        Square root of the oversize ξ/ξ_lumen − 1, divided by its value for the largest stone.
    unit : array (n, 4)
        Coordinates in the box, between 0 and 1: ln(root + 0.1), with `root` not below its smallest
        sampled value; ln(η − 1); √μ_f; and 1 − lumen.
    """

    conditions: Conditions
    confining: Float[np.ndarray, " n"]
    lumen: Float[np.ndarray, " n"]
    root: Float[np.ndarray, " n"]
    unit: Float[np.ndarray, "n 4"]

    def where(self, chosen: Bool[np.ndarray, " n"]) -> Setting:
        """Return the rows for which `chosen` is true."""
        return Setting(
            self.conditions.where(chosen),
            self.confining[chosen],
            self.lumen[chosen],
            self.root[chosen],
            self.unit[chosen],
        )

    def joined(self, other: Setting) -> Setting:
        """Return the rows of this setting, followed by those of another one."""
        return Setting(
            joined(self.conditions, other.conditions),
            np.concatenate([self.confining, other.confining]),
            np.concatenate([self.lumen, other.lumen]),
            np.concatenate([self.root, other.root]),
            np.concatenate([self.unit, other.unit]),
        )


def opening_pressure(case: Case, at: Setting) -> Float[np.ndarray, " n"]:
    """Return the urine pressure in Pa that opens the tube to the width of the stone.

    The ground matrix of the law is included, so that the pressure vanishes at the size of the
    lumen.

    Parameters
    ----------
    case : Case
        Its material and the kind of its load are used.
    at : Setting
    """
    asked = at.conditions
    return urine_pressures(case, asked.size_ratio, asked.wall_ratio, asked.load_factor)


def fit_lumen(case: Case, box: Box) -> SparsePolynomial:
    """Return the lumen r_a/R_a as a polynomial of the second and fourth coordinate of a box.

    The values are those of the far field, at the Chebyshev points of both coordinates.

    Parameters
    ----------
    case : Case
        Its material and load are used.
    box : Box
    """
    grids = [(1.0 + np.cos(np.pi * (np.arange(n + 1) + 0.5) / (n + 1))) / 2.0
             for n in LUMEN_DEGREES]  # fmt: skip
    first, second = (each.ravel() for each in np.meshgrid(*grids, indexing="ij"))
    low, high = (edge - 1.0 for edge in box.wall_ratio)
    wall = 1.0 + low * (high / low) ** first
    values = lumen_ratios(case, wall, second)
    degrees = np.array([(i, j) for i in range(LUMEN_DEGREES[0] + 1)
                        for j in range(LUMEN_DEGREES[1] + 1)])  # fmt: skip
    points = np.stack([first, second], axis=1)
    coefficients = np.linalg.solve(chebyshev_products(points, degrees).T, values)
    return SparsePolynomial(degrees, coefficients[:, None])


def _between(
    values: Float[np.ndarray, " n"], bounds: tuple[float, float]
) -> Bool[np.ndarray, " n"]:
    low, high = bounds
    return (values >= low * (1.0 - SLACK)) & (values <= high * (1.0 + SLACK))
