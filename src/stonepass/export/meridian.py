"""The solved wall as points and quadrilaterals of its meridian plane, with stresses."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Float, Int
from stonepass.fe.axisymmetric.wall_values import STRESSES, Field

__all__ = ["SEGMENTS", "Meridian", "meridian"]

SEGMENTS = 48  # number of segments around the axis of a wall that is rotated about it


@array_dataclass
@dataclass(frozen=True)
class Meridian:
    """Points in the meridian plane of the wall with stresses, and quadrilaterals between them.

    Each finite element has four quadrilaterals.

    Attributes
    ----------
    R, Z : array (points)
        Radial and axial coordinates in the reference configuration, in inner radii.
    r, z : array (points)
        Radial and axial coordinates of the deformed wall, in inner radii.
    stress : dict of str to array (points)
        Components of the Cauchy stress in Pa by name, tension positive.
    quads : array (quads, 4)
        Indices of the corners of each quadrilateral.
    """

    R: Float[np.ndarray, " points"]
    Z: Float[np.ndarray, " points"]
    r: Float[np.ndarray, " points"]
    z: Float[np.ndarray, " points"]
    stress: dict[str, Float[np.ndarray, " points"]]
    quads: Int[np.ndarray, "quads 4"]


def meridian(wall: Field, *, mirrored: bool) -> Meridian:
    """Return the meridian of a solved wall.

    Parameters
    ----------
    wall : Field
        Solved wall of half a tube or of a whole one.
    mirrored : bool
        True if the wall is half a tube, whose mirror image is to be added.
    """
    count = round(np.sqrt(wall.r.shape[1]))
    kept = np.array([0, count // 2, count - 1])
    some = (kept[:, None] * count + kept[None, :]).ravel()
    corner = np.array([[0, 3, 4, 1], [1, 4, 5, 2], [3, 6, 7, 4], [4, 7, 8, 5]])
    quads = (corner[None] + 9 * np.arange(len(wall.r))[:, None, None]).reshape(-1, 4)
    R, Z, r, z = (getattr(wall, name)[:, some].ravel() for name in ("R", "Z", "r", "z"))
    stress = {name: getattr(wall, name)[:, some].ravel() for name in STRESSES}
    if not mirrored:
        return Meridian(R, Z, r, z, stress, quads)
    sign = {name: -1.0 if name == "stress_rz" else 1.0 for name in STRESSES}
    return Meridian(
        np.tile(R, 2),
        np.concatenate([Z, -Z]),
        np.tile(r, 2),
        np.concatenate([z, -z]),
        {name: np.concatenate([each, sign[name] * each]) for name, each in stress.items()},
        np.concatenate([quads, quads[:, ::-1] + len(r)]),
    )
