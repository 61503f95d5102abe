"""A picture of the wall turned round its axis, with a quarter cut away."""

from __future__ import annotations

import numpy as np
from matplotlib import colormaps
from matplotlib.colors import Normalize
from matplotlib.figure import Figure
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from stonepass.array_types import Float
from stonepass.export.meridian import SEGMENTS, meridian
from stonepass.fe.axisymmetric.wall_values import Field
from stonepass.model.problem import Problem
from stonepass.report.style import COLOURS, in_style, new_figure

__all__ = ["revolved_figure"]

CUT = 0.75  # of a turn that the picture shows
LIGHT = np.array([-0.45, 0.9, 0.25])
STONE_RINGS = 40


@in_style
def revolved_figure(wall: Field, case: Problem, top: float, extent: float = 3.0) -> Figure:
    """Draw wall and stone in space, coloured by radial compression in Pa from 0 to `top`."""
    mirrored = case.stone.shape.symmetric
    half = meridian(wall, mirrored=mirrored)
    r, z = half.r, half.z
    quads = half.quads[np.abs(z[half.quads]).max(axis=1) <= extent]
    compression = -half.stress["stress_rr"]
    colours = colormaps["magma_r"](Normalize(0.0, top)(compression[quads].mean(axis=1)))
    ends = (np.pi, np.pi + 2.0 * np.pi * CUT)  # the gap is towards the eye, above
    angles = np.linspace(*ends, round(SEGMENTS * CUT) * 2 + 1)
    faces: list[Float[np.ndarray, "faces 4 3"]] = []
    shades: list[Float[np.ndarray, "faces 4"]] = []
    for cut in ends:
        faces.append(_in_space(r[quads], z[quads], np.full(4, cut)))
        shades.append(colours)
    sides = [
        (half.R, float(half.R.min())),
        (half.R, float(half.R.max())),
        (half.Z, float(half.Z[quads].min())),
        (half.Z, float(half.Z[quads].max())),
    ]
    for along_which, at in sides:
        edge = half.edges(quads, along_which, at)
        face, shade = _revolved(r[edge], z[edge], angles)
        values = np.repeat(compression[edge].mean(axis=1), len(angles) - 1)
        colour = colormaps["magma_r"](Normalize(0.0, top)(values))
        colour[:, :3] *= shade[:, None]
        faces.append(face)
        shades.append(colour)
    rho, along = case.stone.shape.meridian(np.linspace(0.0, np.pi, STONE_RINGS))
    line = np.c_[rho[:-1], rho[1:]], np.c_[along[:-1], along[1:]]
    round_it = np.linspace(0.0, 2.0 * np.pi, SEGMENTS + 1)
    face, shade = _revolved(case.size_ratio * line[0], case.size_ratio * line[1], round_it)
    stone = np.tile(_rgba(COLOURS["stone"]), (len(face), 1))
    stone[:, :3] *= shade[:, None]
    faces.append(face)
    shades.append(stone)
    figure = new_figure(6.4, 4.2)
    axes = figure.add_subplot(projection="3d", computed_zorder=False)
    everything = np.concatenate(faces)[:, :, [2, 0, 1]]  # the tube lies along x
    axes.add_collection3d(
        Poly3DCollection(everything, facecolors=np.concatenate(shades), edgecolors="none",
                         linewidths=0.0, antialiaseds=False, rasterized=True)
    )  # fmt: skip
    size = 1.05 * float(r.max())
    axes.set(xlim=(-extent, extent), ylim=(-size, size), zlim=(-size, size))
    axes.set_box_aspect((extent / size, 1.0, 1.0), zoom=1.3)
    axes.view_init(elev=24.0, azim=-62.0)
    axes.set_axis_off()
    return figure


def _in_space(
    r: Float[np.ndarray, "faces 4"], z: Float[np.ndarray, "faces 4"], t: Float[np.ndarray, " 4"]
) -> Float[np.ndarray, "faces 4 3"]:
    return np.stack([r * np.cos(t), r * np.sin(t), z], axis=2)


def _revolved(
    r: Float[np.ndarray, "edges 2"],
    z: Float[np.ndarray, "edges 2"],
    angles: Float[np.ndarray, " n"],
) -> tuple[Float[np.ndarray, "faces 4 3"], Float[np.ndarray, " faces"]]:
    """Edges turned through the angles: faces, and how brightly each is lit."""
    low, high = angles[:-1], angles[1:]
    t = np.stack([low, high, high, low], axis=1)
    order = [0, 0, 1, 1]
    R = np.repeat(r[:, order], len(low), axis=0)
    Z = np.repeat(z[:, order], len(low), axis=0)
    T = np.tile(t, (len(r), 1))
    faces = np.stack([R * np.cos(T), R * np.sin(T), Z], axis=2)
    normal = np.cross(faces[:, 2] - faces[:, 0], faces[:, 3] - faces[:, 1])
    size = np.linalg.norm(normal, axis=1)
    lit = np.abs(normal @ (LIGHT / np.linalg.norm(LIGHT))) / np.where(size > 0.0, size, 1.0)
    return faces, 0.7 + 0.3 * lit


def _rgba(colour: str) -> Float[np.ndarray, " 4"]:
    return np.array([*(int(colour[k : k + 2], 16) / 255.0 for k in (1, 3, 5)), 1.0])
