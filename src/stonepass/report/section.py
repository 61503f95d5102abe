"""The meridian section of a stretched wall and its stone, upstream left."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.tri import Triangulation

from stonepass.array_types import Int
from stonepass.fe.axisymmetric.wall_values import Field
from stonepass.model.problem import Problem
from stonepass.report.stone import draw_stone

__all__ = ["draw_section", "element_rim"]


def draw_section(
    axes: Axes, wall: Field, case: Problem, top: float, sides: Sequence[float] = (1.0,)
) -> None:
    """Draw wall and stone, coloured by radial compression in Pa from 0 to `top`.

    `wall` is drawn once for each of `sides`: -1 mirrors a half tube at the stone's equator.
    """
    extent = 2.2 * case.size_ratio * case.stone.shape.reach + 0.6
    shown = np.abs(wall.z).min(axis=1) < extent
    z, r, compression = wall.z[shown], wall.r[shown], -wall.stress_rr[shown] / 1e3
    images = [(side, half) for side in sides for half in (1.0, -1.0)]  # above and below the axis
    x = np.concatenate([side * z for side, _ in images])
    y = np.concatenate([half * r for _, half in images])
    triangles, rim = _triangles(x.shape[1]), element_rim(x.shape[1])
    corners = (np.arange(len(x))[:, None, None] * x.shape[1] + triangles).reshape(-1, 3)
    # One mesh of all elements, since each artist costs; neighbours share no corner, so that a
    # jump of the stress between them stays one.
    image = axes.tripcolor(
        Triangulation(x.ravel(), y.ravel(), corners),
        np.tile(compression, (len(images), 1)).ravel(),
        shading="gouraud",
        cmap="magma_r",
        vmin=0.0,
        vmax=top / 1e3,
        rasterized=True,
    )
    outlines = LineCollection(list(np.stack([x[:, rim], y[:, rim]], axis=-1)), colors="white",
                              linewidths=0.25, alpha=0.6)  # fmt: skip
    axes.add_collection(outlines, autolim=False)
    draw_stone(axes, case)
    height = float(wall.r.max()) * 1.06
    axes.set(xlim=(-extent, extent), ylim=(-height, height), aspect="equal")
    axes.set(xlabel="z / inner radius   (urine comes from the left)", ylabel="r / inner radius")
    axes.spines[["top", "right"]].set_visible(False)
    bar = axes.figure.colorbar(image, ax=axes, shrink=0.85, pad=0.01)
    bar.set_label(r"$-\sigma_{rr}$  (kPa)")
    bar.outline.set_visible(False)


def element_rim(points: int) -> Int[np.ndarray, " rim"]:
    """Which of an element's points lie on its rim, in order and closed."""
    grid = _grid(points)
    return np.r_[grid[0], grid[1:, -1], grid[-1, -2::-1], grid[-2::-1, 0]]


def _triangles(points: int) -> Int[np.ndarray, "triangles 3"]:
    """Triangles between an element's points."""
    grid = _grid(points)
    a, b, c, d = grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]
    return np.concatenate([np.stack(t, axis=-1).reshape(-1, 3) for t in ((a, b, c), (a, c, d))])


def _grid(points: int) -> Int[np.ndarray, "n n"]:
    """Numbers of an element's points, in their square."""
    return np.arange(points).reshape(round(np.sqrt(points)), -1)
