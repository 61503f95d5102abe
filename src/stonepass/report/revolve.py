"""A picture of the wall revolved about its axis, with a quarter cut away."""

from __future__ import annotations

import numpy as np
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Normalize, to_rgba
from matplotlib.figure import Figure
from mpl_toolkits.mplot3d.art3d import Poly3DCollection

from stonepass.array_types import Float
from stonepass.export.meridian import SEGMENTS
from stonepass.fe.axisymmetric.wall_values import Field
from stonepass.model.problem import Problem
from stonepass.report.case_line import case_line
from stonepass.report.section import COLOUR_MAP, add_colour_bar
from stonepass.report.style import COLOURS, add_heading, in_style, new_figure

__all__ = ["revolved_figure"]

CUT = 0.75  # fraction of a revolution that is drawn
LIGHT = np.array([-0.45, 0.9, 0.25])
STONE_RINGS = 40
ENDS = (np.pi, np.pi + 2.0 * np.pi * CUT)  # the gap is above, on the side of the viewer
# An element in which the colour varies by more than SMOOTH is divided FINER times along each side.
FINER, SMOOTH = 4, 0.01

Faces = Float[np.ndarray, "faces 4 3"]
Shades = Float[np.ndarray, "faces 4"]


@in_style
def revolved_figure(wall: Field, case: Problem, top: float, extent: float = 3.0) -> Figure:
    """Draw wall and stone in space, coloured by radial compression in Pa from 0 to `top`."""
    figure = new_figure(6.8, 4.8)
    add_heading(figure, case_line(case))
    mirrored = case.stone.shape.symmetric
    scale = ScalarMappable(Normalize(0.0, top / 1e3), COLOUR_MAP)
    reach = float(np.abs(wall.Z[np.abs(wall.z) <= extent]).max())
    parts = [
        *_cuts(wall, scale, reach, mirrored=mirrored),
        *_surfaces(wall, scale, reach, mirrored=mirrored),
        _stone(case),
    ]
    axes = figure.add_subplot(projection="3d", computed_zorder=False)
    everything = np.concatenate([faces for faces, _ in parts])[:, :, [2, 0, 1]]  # the tube along x
    axes.add_collection3d(
        Poly3DCollection(everything, facecolors=np.concatenate([shades for _, shades in parts]),
                         edgecolors="none", linewidths=0.0, antialiaseds=False, rasterized=True)
    )  # fmt: skip
    size = 1.05 * float(wall.r.max())
    axes.set(xlim=(-extent, extent), ylim=(-size, size), zlim=(-size, size))
    axes.set_box_aspect((extent / size, 1.0, 1.0), zoom=1.1)
    axes.view_init(elev=24.0, azim=-62.0)
    axes.set_axis_off()
    add_colour_bar(axes, scale, shrink=0.7)
    return figure


def _cuts(
    wall: Field, scale: ScalarMappable, reach: float, *, mirrored: bool
) -> list[tuple[Faces, Shades]]:
    """Return the two faces of the cut, with a finer grid where the compression varies."""
    sides = (1.0, -1.0) if mirrored else (1.0,)
    values = np.stack([wall.r, wall.z, wall.Z, -wall.stress_rr / 1e3])
    count = round(np.sqrt(values.shape[2]))
    grids = values.reshape(4, -1, count, count)
    varies = np.ptp(values[3], axis=1) > SMOOTH * np.ptp(scale.get_clim())
    found = []
    for chosen, times in ((varies, FINER), (~varies, 1)):
        r, z, Z, compression = (_quads(_refined(each[chosen], times)) for each in grids)
        inside = np.abs(Z).max(axis=1) <= reach + 1e-9
        shades = scale.to_rgba(compression[inside].mean(axis=1))
        for side in sides:
            for cut in ENDS:
                found.append((_in_space(r[inside], side * z[inside], np.full(4, cut)), shades))
    return found


def _refined(grid: Float[np.ndarray, "elements n n"], times: int) -> Float[np.ndarray, "e m m"]:
    """Return values on a finer grid of each element, by linear interpolation."""
    count = grid.shape[1]
    at = np.linspace(0.0, count - 1.0, (count - 1) * times + 1)
    low = np.minimum(at.astype(int), count - 2)
    part = at - low
    rows = grid[:, low] * (1.0 - part)[:, None] + grid[:, low + 1] * part[:, None]
    return np.asarray(rows[:, :, low] * (1.0 - part) + rows[:, :, low + 1] * part)


def _quads(grid: Float[np.ndarray, "elements m m"]) -> Float[np.ndarray, "quads 4"]:
    """Return values at the corners of the quadrilaterals of each element's grid."""
    corners = (grid[:, :-1, :-1], grid[:, 1:, :-1], grid[:, 1:, 1:], grid[:, :-1, 1:])
    return np.stack([each.ravel() for each in corners], axis=1)


def _surfaces(
    wall: Field, scale: ScalarMappable, reach: float, *, mirrored: bool
) -> list[tuple[Faces, Shades]]:
    """Return inner and outer surface and both ends of the tube, without a quarter."""
    angles = np.linspace(*ENDS, round(SEGMENTS * CUT) * 2 + 1)
    within = np.abs(wall.Z) <= reach + 1e-9
    ends = (reach,) if mirrored else (float(wall.Z[within].min()), float(wall.Z[within].max()))
    lines = [
        *((np.isclose(wall.R, at), wall.Z) for at in (wall.R.min(), wall.R.max())),
        *((np.isclose(wall.Z, at), wall.R) for at in ends),
    ]
    found = []
    for on_line, along in lines:
        chosen = on_line & within
        _, order = np.unique(along[chosen], return_index=True)
        r, z, values = (each[chosen][order] for each in (wall.r, wall.z, -wall.stress_rr / 1e3))
        for side in (1.0, -1.0) if mirrored else (1.0,):
            faces, light = _revolved(_edges(r), _edges(side * z), angles)
            between = (values[:-1] + values[1:]) / 2.0
            shades = scale.to_rgba(np.repeat(between, len(angles) - 1))
            shades[:, :3] *= light[:, None]
            found.append((faces, shades))
    return found


def _edges(line: Float[np.ndarray, " n"]) -> Float[np.ndarray, "edges 2"]:
    """Return pairs of neighbouring values of a line of points."""
    return np.stack([line[:-1], line[1:]], axis=1)


def _stone(case: Problem) -> tuple[Faces, Shades]:
    rho, along = case.stone.shape.meridian(np.linspace(0.0, np.pi, STONE_RINGS))
    r, z = (_edges(case.size_ratio * each) for each in (rho, along))
    faces, light = _revolved(r, z, np.linspace(0.0, 2.0 * np.pi, SEGMENTS + 1))
    shades = np.tile(to_rgba(COLOURS["stone"]), (len(faces), 1))
    shades[:, :3] *= light[:, None]
    return faces, shades


def _in_space(
    r: Float[np.ndarray, "faces 4"], z: Float[np.ndarray, "faces 4"], t: Float[np.ndarray, " 4"]
) -> Float[np.ndarray, "faces 4 3"]:
    return np.stack([r * np.cos(t), r * np.sin(t), z], axis=2)


def _revolved(
    r: Float[np.ndarray, "edges 2"],
    z: Float[np.ndarray, "edges 2"],
    angles: Float[np.ndarray, " n"],
) -> tuple[Float[np.ndarray, "faces 4 3"], Float[np.ndarray, " faces"]]:
    """Return the faces that edges sweep through the angles, and the brightness of each."""
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
