"""Solved sections over size of the stone, wall ratio and confining pressure, interpolated.

A section consists of the outlines of the wall, the contact angle, and the contact pressure along
the contact. The outlines are stored as displacements from the tube without a stone under the same
load. They are divided by ξ − ξ_lumen, the excess of the size ratio over the lumen, and angle and
pressure by its square root, so that all of them vary slowly with the size of the stone. They are
interpolated linearly in ln(ξ − ξ_lumen), in ln(η − 1) and in the confining pressure. The sizes are
fractions of the way from the lumen to the largest size, and the pressures are fractions of the
largest pressure that the wall bears.
"""

from __future__ import annotations

import hashlib
import json
from dataclasses import dataclass
from functools import lru_cache
from importlib.resources import files
from typing import Any

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Float
from stonepass.inputs.case_record import describe_material
from stonepass.materials.catalogue import CATALOGUE
from stonepass.model.far_field import lumen_ratio
from stonepass.model.problem import Problem

__all__ = [
    "PLACES",
    "STATIONS",
    "FreeTube",
    "SeatedSection",
    "SectionGrid",
    "digest",
    "free_tube",
    "grid_of",
    "scaled",
]

# Places along the unloaded tube in inner radii at which the outlines are stored, and places along
# half of the contact, from its edge (0) to the equator (1), at which the pressure is stored.
PLACES = 6.0 * np.linspace(0.0, 1.0, 45) ** 1.5
STATIONS = np.sin(np.pi / 2.0 * np.linspace(0.0, 1.0, 21))
FOLDER = "solved"
NAMES = ("inner_z", "inner_r", "outer_z", "outer_r", "angle", "pressure")


@array_dataclass
@dataclass(frozen=True)
class SeatedSection:
    """A section: half of it, from the equator of the stone downstream; lengths in inner radii.

    Attributes
    ----------
    inner_z, inner_r, outer_z, outer_r : array (n)
        Inner and outer surface of the wall.
    contact_angle : float
        Contact angle α₀ in rad.
    pressure : array (m)
        Contact pressure in Pa at `STATIONS`, from the edge of the contact to the equator.
    """

    inner_z: Float[np.ndarray, " n"]
    inner_r: Float[np.ndarray, " n"]
    outer_z: Float[np.ndarray, " n"]
    outer_r: Float[np.ndarray, " n"]
    contact_angle: float
    pressure: Float[np.ndarray, " m"]


@dataclass(frozen=True)
class FreeTube:
    """The tube far from the stone, under its load; radii in inner radii of the unloaded tube.

    Attributes
    ----------
    inner, outer : float
        Radii of both surfaces; the inner one is the lumen ratio.
    """

    inner: float
    outer: float


def free_tube(problem: Problem) -> FreeTube | None:
    """Return the tube of a problem without its stone; None if the load closes it."""
    inner = lumen_ratio(problem.wall_ratio, problem.ureter.material.law, problem.load)
    if inner is None:
        return None
    section = (problem.wall_ratio**2 - 1.0) / problem.load.prestretch  # kept, times π
    return FreeTube(inner, float(np.sqrt(inner**2 + section)))


@array_dataclass
@dataclass(frozen=True)
class SectionGrid:
    """Solved sections of one material.

    Attributes
    ----------
    fraction : array (k)
        Rising sizes as (ξ − ξ_lumen)/(`largest` − ξ_lumen), above 0.
    wall_ratio : array (l)
        Rising wall ratios.
    part : array (m)
        Rising confining pressures as fractions of the largest one of the wall, from 0 to 1.
    walls, loads : array (n)
        Rising wall ratios, and the largest confining pressures in Pa at them.
    largest : float
        Largest size ratio ξ.
    values : dict of str to array (k, l, m, …)
        The scaled parts of the sections by name.
    """

    fraction: Float[np.ndarray, " k"]
    wall_ratio: Float[np.ndarray, " l"]
    part: Float[np.ndarray, " m"]
    walls: Float[np.ndarray, " n"]
    loads: Float[np.ndarray, " n"]
    largest: float
    values: dict[str, np.ndarray]

    def covers(self, size_ratio: float, wall_ratio: float, confining: float) -> bool:
        """Return True if there is a section: interpolated, or of a stone that is not held.

        Parameters
        ----------
        size_ratio, wall_ratio : float
        confining : float
            Confining pressure in Pa.
        """
        low, high = self.wall_ratio[[0, -1]]
        sized = size_ratio <= self.largest and low <= wall_ratio <= high
        return bool(sized and confining <= self.largest_load(wall_ratio))

    def largest_load(self, wall_ratio: float) -> float:
        """Return the largest confining pressure in Pa of the sections of a wall."""
        return float(np.interp(wall_ratio, self.walls, self.loads))

    def section(
        self, size_ratio: float, wall_ratio: float, confining: float, tube: FreeTube
    ) -> SeatedSection:
        """Return the interpolated section of a stone that is larger than the lumen.

        Closer to the lumen than the smallest solved size (0.4 % of the way to the largest one) the
        scaled parts are constant.

        Parameters
        ----------
        size_ratio, wall_ratio : float
            A size and a wall that the grid covers.
        confining : float
            Confining pressure in Pa.
        tube : FreeTube
            The tube under this pressure; its lumen is smaller than the stone.
        """
        over = size_ratio - tube.inner
        load = confining / self.largest_load(wall_ratio)
        places = (
            _place(np.log(self.fraction), np.log(over / (self.largest - tube.inner))),
            _place(np.log(self.wall_ratio - 1.0), np.log(wall_ratio - 1.0)),
            _place(self.part, load),
        )
        found = {name: _interpolated(each, places) for name, each in self.values.items()}
        inner_z, inner_r = PLACES + over * found["inner_z"], tube.inner + over * found["inner_r"]
        # Interpolated points must not lie in the stone.
        outward = np.maximum(1.0, size_ratio / np.hypot(inner_z, inner_r))
        return SeatedSection(
            outward * inner_z,
            outward * inner_r,
            PLACES + over * found["outer_z"],
            tube.outer + over * found["outer_r"],
            np.pi / 2.0 - np.sqrt(over) * float(found["angle"]),
            np.sqrt(over) * found["pressure"],
        )


def scaled(section: SeatedSection, size_ratio: float, tube: FreeTube) -> dict[str, Any]:
    """Return the parts of a solved section as a `SectionGrid` stores them."""
    over = size_ratio - tube.inner
    return {
        "inner_z": (section.inner_z - PLACES) / over,
        "inner_r": (section.inner_r - tube.inner) / over,
        "outer_z": (section.outer_z - PLACES) / over,
        "outer_r": (section.outer_r - tube.outer) / over,
        "angle": (np.pi / 2.0 - section.contact_angle) / np.sqrt(over),
        "pressure": section.pressure / np.sqrt(over),
    }


def digest(material: str) -> str:
    """Return a digest of the constants of a material of the catalogue."""
    text = json.dumps(describe_material(CATALOGUE[material]), sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()


@lru_cache(maxsize=8)
def grid_of(material: str) -> SectionGrid | None:
    """Return the solved sections of a material; None if the package has none of its constants."""
    path = files(__package__) / FOLDER / f"{material}.npz"
    if not path.is_file() or material not in CATALOGUE:
        return None
    with path.open("rb") as file, np.load(file, allow_pickle=False) as stored:
        if str(stored["digest"]) != digest(material):
            return None
        values = {name: stored[name].astype(float) for name in NAMES}
        return SectionGrid(
            stored["fraction"],
            stored["wall_ratio"],
            stored["part"],
            stored["walls"],
            stored["loads"],
            float(stored["largest"]),
            values,
        )


def _place(nodes: Float[np.ndarray, " n"], at: float) -> tuple[int, float]:
    """Return the interval of rising nodes in which a number lies, and its place in it, 0 to 1."""
    k = int(np.clip(np.searchsorted(nodes, at) - 1, 0, len(nodes) - 2))
    return k, float(np.clip((at - nodes[k]) / (nodes[k + 1] - nodes[k]), 0.0, 1.0))


def _interpolated(values: Any, places: tuple[tuple[int, float], ...]) -> Any:
    """Interpolate linearly along the first axes; `places` are intervals and places in them."""
    for k, at in places:
        values = (1.0 - at) * values[k] + at * values[k + 1]
    return values
