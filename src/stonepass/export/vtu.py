"""Writer of the solved wall, rotated about its axis, as a VTU file for ParaView."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory

import meshio
import numpy as np

from stonepass.array_types import Float
from stonepass.export.meridian import SEGMENTS, meridian
from stonepass.fe.axisymmetric.wall_values import Field
from stonepass.io.text_file import write_file

__all__ = ["vtu_file", "write_vtu"]


def vtu_file(wall: Field, *, mirrored: bool, inner_radius: float = 1.0) -> bytes:
    """Return a VTU file of the deformed wall with displacements and Cauchy stresses.

    The wall consists of hexahedra; its axis is z.

    Parameters
    ----------
    wall : Field
        Solved wall of half a tube or of a whole one.
    mirrored : bool
        True if the wall is half a tube, whose mirror image is to be added.
    inner_radius : float
        Inner radius R_a in the unit of length of the file.

    Returns
    -------
    bytes
        Content of the file. Stresses are in Pa, tension positive, with the cylindrical components
        rr, tt (circumferential), zz and rz.

    References
    ----------
    docs/export.md.
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
    mesh = meshio.Mesh(turned(half.r, half.z), [("hexahedron", cells)], point_data=data)
    with TemporaryDirectory() as folder:  # meshio can write VTU only to a named file
        file = Path(folder) / "wall.vtu"
        mesh.write(file)
        return file.read_bytes()


def write_vtu(path: Path, wall: Field, *, mirrored: bool, inner_radius: float = 1.0) -> None:
    """Write the VTU file of a solved wall.

    Parameters
    ----------
    path : Path
        The file to be written.
    wall, mirrored, inner_radius
        As for `vtu_file`.

    Raises
    ------
    BadInput
        The file cannot be written.
    """
    write_file(path, vtu_file(wall, mirrored=mirrored, inner_radius=inner_radius))
