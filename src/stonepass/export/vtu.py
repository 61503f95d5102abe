"""The solved wall, turned round its axis, as a VTU file for ParaView."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import meshio
import numpy as np
from jaxtyping import Float, Int

from stonepass.errors import BadInput
from stonepass.fe.axisymmetric.postprocessing import STRESSES, Field

__all__ = ["SEGMENTS", "Meridian", "meridian", "write_vtu"]

SEGMENTS = 48  # round the axis


def write_vtu(path: Path, wall: Field, *, mirrored: bool, inner_radius: float = 1.0) -> None:
    """Write the deformed wall as hexahedra: displacement, and Cauchy stress in Pa.

    Lengths are in units of which the inner radius has `inner_radius`, z along the tube; `mirrored`
    adds the other half of a half tube. Stress components are cylindrical, tension positive: rr,
    tt (hoop), zz, rz.
    """
    half = meridian(wall, mirrored=mirrored)
    quads, count = half.quads, len(half.r)
    angles = 2.0 * np.pi * np.arange(SEGMENTS) / SEGMENTS

    def turned(r: Float[np.ndarray, " n"], z: Float[np.ndarray, " n"]) -> Float[np.ndarray, "m 3"]:
        rings = [np.c_[r * np.cos(t), r * np.sin(t), z] for t in angles]
        return inner_radius * np.concatenate(rings)

    near = quads[None] + count * np.arange(SEGMENTS)[:, None, None]
    far = quads[None] + count * ((np.arange(SEGMENTS) + 1) % SEGMENTS)[:, None, None]
    cells = np.concatenate([far, near], axis=2).reshape(-1, 8)
    data = {name: np.tile(values, SEGMENTS) for name, values in half.stress.items()}
    data["displacement"] = turned(half.r - half.R, half.z - half.Z)
    try:
        mesh = meshio.Mesh(turned(half.r, half.z), [("hexahedron", cells)], point_data=data)
        mesh.write(path)
    except OSError as problem:
        raise BadInput("output file", str(path), f"writable ({problem.strerror})") from problem


@dataclass(frozen=True)
class Meridian:
    """Points of the meridian with stresses, and quadrilaterals between them, four to an element."""

    R: Float[np.ndarray, " points"]
    Z: Float[np.ndarray, " points"]
    r: Float[np.ndarray, " points"]
    z: Float[np.ndarray, " points"]
    stress: dict[str, Float[np.ndarray, " points"]]
    quads: Int[np.ndarray, "quads 4"]

    def edges(
        self, quads: Int[np.ndarray, "quads 4"], along: Float[np.ndarray, " points"], at: float
    ) -> Int[np.ndarray, "edges 2"]:
        """Edges of some quadrilaterals whose points both have the reference coordinate `at`."""
        edges = np.concatenate([quads[:, [k, (k + 1) % 4]] for k in range(4)])
        return edges[np.all(np.abs(along[edges] - at) < 1e-9, axis=1)]


def meridian(wall: Field, *, mirrored: bool) -> Meridian:
    """Sample the wall of a half tube or a whole one; `mirrored` adds the other half."""
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
