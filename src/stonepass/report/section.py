"""The meridian section of a stretched wall and its stone, upstream left."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.collections import LineCollection
from matplotlib.tri import Triangulation

from stonepass.array_types import Float, Int
from stonepass.fe.axisymmetric.wall_values import Field
from stonepass.model.problem import Problem
from stonepass.report.case_line import length_unit
from stonepass.report.stone import draw_stone, frame_section
from stonepass.report.style import COLOURS

__all__ = [
    "COLOUR_MAP",
    "add_colour_bar",
    "draw_section",
    "element_rim",
    "section_height",
    "wall_surface",
]

COLOUR_MAP = "magma_r"  # colours of the compression; their lightness is monotonic
MARGIN = 1.06  # height of the axes over that of the wall


def draw_section(
    axes: Axes,
    wall: Field,
    case: Problem,
    top: float,
    sides: Sequence[float] = (1.0,),
    height: float | None = None,
) -> ScalarMappable:
    """Draw wall and stone, coloured by radial compression.

    Parameters
    ----------
    axes : Axes
    wall : Field
    case : Problem
        The case, whose lengths determine the unit of the axes (`length_unit`).
    top : float
        Compression in Pa at the end of the colour scale, which begins at 0.
    sides : sequence of float
        The wall is drawn once for each; -1 mirrors a half tube at the stone's equator.
    height : float, optional
        Half the height of the axes in inner radii; by default that of `section_height`.

    Returns
    -------
    ScalarMappable
        For `add_colour_bar`.
    """
    scale = length_unit(case)[0]
    extent = 2.2 * case.size_ratio * case.stone.shape.reach + 0.6
    shown = np.abs(wall.z).min(axis=1) < extent
    z, r, compression = wall.z[shown], wall.r[shown], -wall.stress_rr[shown] / 1e3
    images = [(side, half) for side in sides for half in (1.0, -1.0)]  # above and below the axis
    x = scale * np.concatenate([side * z for side, _ in images])
    y = scale * np.concatenate([half * r for _, half in images])
    triangles, rim = _triangles(x.shape[1]), element_rim(x.shape[1])
    corners = (np.arange(len(x))[:, None, None] * x.shape[1] + triangles).reshape(-1, 3)
    # All elements are drawn as one mesh, which is faster. Neighbours share no corner, so that a
    # jump of the stress between them is not smoothed.
    image = axes.tripcolor(
        Triangulation(x.ravel(), y.ravel(), corners),
        np.tile(compression, (len(images), 1)).ravel(),
        shading="gouraud",
        cmap=COLOUR_MAP,
        vmin=0.0,
        vmax=top / 1e3,
        rasterized=True,
    )
    mesh = LineCollection(list(np.stack([x[:, rim], y[:, rim]], axis=-1)), colors=COLOURS["grey"],
                          linewidths=0.25, alpha=0.35, rasterized=True)  # fmt: skip
    axes.add_collection(mesh, autolim=False)
    _outline(axes, wall, scale, images)
    draw_stone(axes, case)
    half_height = section_height([wall]) if height is None else height
    frame_section(axes, case, scale * extent, scale * half_height)
    return image


def section_height(walls: Sequence[Field]) -> float:
    """Return half the height of axes, in inner radii, that show all walls."""
    return MARGIN * max(float(wall.r.max()) for wall in walls)


def add_colour_bar(axes: Any, image: ScalarMappable, shrink: float = 0.85) -> None:
    """Draw the colour scale of the compression to the right of axes, or of an array of axes."""
    figure = np.ravel(axes)[0].figure
    bar = figure.colorbar(image, ax=axes, shrink=shrink, pad=0.01)
    bar.set_label(r"radial compression $-\sigma_{rr}$ (kPa)")
    bar.outline.set_visible(False)


def wall_surface(
    wall: Field, radius: float
) -> tuple[Float[np.ndarray, " n"], Float[np.ndarray, " n"]]:
    """Return deformed z and r of the surface with reference radius `radius`, along the tube."""
    on_it = np.isclose(wall.R, radius)
    _, order = np.unique(wall.Z[on_it], return_index=True)
    return wall.z[on_it][order], wall.r[on_it][order]


def element_rim(points: int) -> Int[np.ndarray, " rim"]:
    """Return the indices of the points on the rim of an element, as a closed loop."""
    grid = _grid(points)
    return np.r_[grid[0], grid[1:, -1], grid[-1, -2::-1], grid[-2::-1, 0]]


def _outline(axes: Axes, wall: Field, scale: float, images: Sequence[tuple[float, float]]) -> None:
    """Draw the inner and the outer surface of the wall."""
    for radius in (wall.R.min(), wall.R.max()):
        z, r = wall_surface(wall, radius)
        for side, half in images:
            axes.plot(scale * side * z, scale * half * r, color=COLOURS["grey"], linewidth=0.7)


def _triangles(points: int) -> Int[np.ndarray, "triangles 3"]:
    """Return triangles between the points of an element."""
    grid = _grid(points)
    a, b, c, d = grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]
    return np.concatenate([np.stack(t, axis=-1).reshape(-1, 3) for t in ((a, b, c), (a, c, d))])


def _grid(points: int) -> Int[np.ndarray, "n n"]:
    """Return the indices of the points of an element as a square array."""
    return np.arange(points).reshape(round(np.sqrt(points)), -1)
