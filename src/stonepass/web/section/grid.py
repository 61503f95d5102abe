"""Solved sections over size ratio and wall ratio, and their interpolation.

A section consists of the outlines of the wall as displacements of points of the unloaded wall, the
contact angle, and the contact pressure along the contact. The displacements are divided by ξ − 1,
and the pressure by √(ξ − 1), so that they vary slowly with the size of the stone. They are
interpolated linearly in ln(ξ − 1) and in ln(η − 1).
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

__all__ = ["PLACES", "STATIONS", "Section", "SectionGrid", "digest", "grid_of"]

# Places along the unloaded tube in inner radii at which the outlines are stored, and places along
# half of the contact, from its edge (0) to the equator (1), at which the pressure is stored.
PLACES = 6.0 * np.linspace(0.0, 1.0, 45) ** 1.5
STATIONS = np.sin(np.pi / 2.0 * np.linspace(0.0, 1.0, 21))
FOLDER = "solved"
NAMES = ("inner_z", "inner_r", "outer_z", "outer_r", "angle", "pressure")


@array_dataclass
@dataclass(frozen=True)
class Section:
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


@array_dataclass
@dataclass(frozen=True)
class SectionGrid:
    """Solved sections of one material.

    Attributes
    ----------
    size_ratio : array (k)
        Rising size ratios, above 1.
    wall_ratio : array (l)
        Rising wall ratios.
    values : dict of str to array (k, l, …)
        The scaled parts of the sections by name.
    """

    size_ratio: Float[np.ndarray, " k"]
    wall_ratio: Float[np.ndarray, " l"]
    values: dict[str, np.ndarray]

    def covers(self, size_ratio: float, wall_ratio: float) -> bool:
        """Return True if there is a section: interpolated, or of a stone that is not held.

        Between the lumen and the smallest solved size there is none.
        """
        low, high = self.wall_ratio[[0, -1]]
        smallest, largest = self.size_ratio[[0, -1]]
        sized = size_ratio <= 1.0 or smallest <= size_ratio <= largest
        return bool(sized and low <= wall_ratio <= high)

    def section(self, size_ratio: float, wall_ratio: float) -> Section:
        """Return the interpolated section of a stone that is larger than the lumen.

        Parameters
        ----------
        size_ratio, wall_ratio : float
            A size and a wall that the grid covers, the size above 1.
        """
        over = size_ratio - 1.0
        i, s = _place(np.log(self.size_ratio - 1.0), np.log(over))
        j, t = _place(np.log(self.wall_ratio - 1.0), np.log(wall_ratio - 1.0))
        found = {
            name: (1.0 - s) * ((1.0 - t) * each[i, j] + t * each[i, j + 1])
            + s * ((1.0 - t) * each[i + 1, j] + t * each[i + 1, j + 1])
            for name, each in self.values.items()
        }
        inner_z, inner_r = PLACES + over * found["inner_z"], 1.0 + over * found["inner_r"]
        # Interpolated points must not lie in the stone.
        outward = np.maximum(1.0, size_ratio / np.hypot(inner_z, inner_r))
        return Section(
            outward * inner_z,
            outward * inner_r,
            PLACES + over * found["outer_z"],
            wall_ratio + over * found["outer_r"],
            np.pi / 2.0 - np.sqrt(over) * float(found["angle"]),
            np.sqrt(over) * found["pressure"],
        )


def scaled(section: Section, size_ratio: float, wall_ratio: float) -> dict[str, Any]:
    """Return the parts of a solved section as a `SectionGrid` stores them."""
    over = size_ratio - 1.0
    return {
        "inner_z": (section.inner_z - PLACES) / over,
        "inner_r": (section.inner_r - 1.0) / over,
        "outer_z": (section.outer_z - PLACES) / over,
        "outer_r": (section.outer_r - wall_ratio) / over,
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
        return SectionGrid(stored["size_ratio"], stored["wall_ratio"], values)


def _place(nodes: Float[np.ndarray, " n"], at: float) -> tuple[int, float]:
    """Return the interval of rising nodes in which a number lies, and its place in it, 0 to 1."""
    k = int(np.clip(np.searchsorted(nodes, at) - 1, 0, len(nodes) - 2))
    return k, float(np.clip((at - nodes[k]) / (nodes[k + 1] - nodes[k]), 0.0, 1.0))
