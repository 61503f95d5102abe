"""The picture of a friction coefficient: paths, profiles, both baselines (paper, Fig. 3)."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Rectangle

from stonepass.report.style import (
    COLOURS,
    add_heading,
    in_style,
    new_figure,
    ordered_colours,
    series,
    tidy,
)
from stonepass.surface.friction_result import SurfaceFriction

__all__ = ["draw_baseline", "friction_figure"]

MICRO = 1e6
ALONG, HEIGHT = "distance along the path (µm)", "height (µm)"
SHOWN = 1200  # largest number of drawn pixels along the longer side
# Length of the drawn tangent, and step of its difference quotient, over the profile's length.
TANGENT, NEAR = 0.08, 1e-4


@in_style
def friction_figure(found: SurfaceFriction) -> Figure:
    """Draw the four panels: surface with paths, profiles, mean and deviation with baselines."""
    figure = new_figure(9.2, 6.8)
    add_heading(
        figure,
        f"Friction coefficient μ = {found.friction:.3g}, from the steepest slopes k₀ and k₁ of two "
        f"baselines (Eq. 18) along {len(found.paths)} paths",
    )
    grid = figure.add_gridspec(2, 2)
    shades = ordered_colours(len(found.paths))
    picture, profiles = figure.add_subplot(grid[0, 0]), figure.add_subplot(grid[0, 1])
    _picture(picture, found, shades)
    x = found.distance * MICRO
    for k, (row, shade) in enumerate(zip(found.profiles, shades, strict=True)):
        label = "each path" if k == 0 else None
        profiles.plot(x, row * MICRO, color=shade, linewidth=0.7, label=label)
    profiles.plot(x, found.mean * MICRO, color=COLOURS["ink"], linewidth=1.8, label="mean")
    profiles.set_title("Profiles along the paths")
    mean, rest = figure.add_subplot(grid[1, 0]), figure.add_subplot(grid[1, 1])
    draw_baseline(mean, found, 0)
    draw_baseline(rest, found, 1)
    mean.set_title(f"Mean profile: k₀ = {found.k0:.3f}")
    rest.set_title(f"Deviation: k₁ = {found.k1:.3f}, so μ = {found.friction:.3f}")
    profiles.set(xlabel=ALONG, ylabel=HEIGHT)
    for axes in (profiles, mean, rest):
        axes.margins(x=0.0)
        low, high = axes.get_ylim()
        axes.set_ylim(low, high + 0.3 * (high - low))  # the legend stands above the curves
        axes.legend(loc="upper left", ncols=2, fontsize=7.5, columnspacing=1.0)
        tidy(axes)
    return figure


def _picture(axes: Axes, found: SurfaceFriction, shades: Sequence[Any]) -> None:
    picture = found.picture
    assert picture.pixel is not None
    across, down = (each * MICRO for each in picture.pixel)
    rows, columns = picture.values.shape
    step = max(1, math.ceil(max(rows, columns) / SHOWN))
    extent = (-0.5 * across, (columns - 0.5) * across, (rows - 0.5) * down, -0.5 * down)
    axes.imshow(picture.values[::step, ::step], cmap="gray", extent=extent, interpolation="nearest")
    for k, (path, shade) in enumerate(zip(found.paths, shades, strict=True)):
        axes.plot([path.x0 * across, path.x1 * across], [path.y0 * down, path.y1 * down],
                  color=shade, linewidth=1.6)  # fmt: skip
        axes.annotate(f"{k + 1}", (path.x1 * across, path.y1 * down), xytext=(4, 0),
                      textcoords="offset points", va="center", fontsize=8)  # fmt: skip
    area = picture.area
    if (area.left, area.top, area.right, area.bottom) != (0, 0, columns, rows):
        axes.add_patch(
            Rectangle(
                ((area.left - 0.5) * across, (area.top - 0.5) * down),
                (area.right - area.left) * across,
                (area.bottom - area.top) * down,
                fill=False,
                color=COLOURS["orange"],
                linewidth=1.0,
                linestyle="--",
                label="area that was analysed",
            )
        )
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.18))
    axes.set(xlabel="x (µm)", ylabel="y (µm)", xlim=extent[:2], ylim=extent[2:])
    axes.set_title("Surface and paths")


def draw_baseline(axes: Axes, found: SurfaceFriction, which: int) -> None:
    """Draw the mean profile (0) or the deviation (1), its baseline and the steepest tangent."""
    heights = (found.mean, found.deviation)[which]
    baseline = (found.baseline, found.deviation_baseline)[which]
    fitted = baseline.at(found.distance)
    x = found.distance * MICRO
    names = ("mean profile", "deviation from the baseline")
    axes.plot(x, heights * MICRO, color=COLOURS["ink"], linewidth=0.8, label=names[which])
    axes.plot(x, fitted * MICRO, **series(1, marker=False),
              label=f"baseline, order {baseline.order}")  # fmt: skip
    looked_at, slopes = baseline.slopes()
    at = looked_at[int(np.argmax(slopes))]
    ends = at + TANGENT * found.distance[-1] * np.array([-0.5, 0.5])
    near = at + NEAR * found.distance[-1] * np.array([-0.5, 0.5])
    rise = np.diff(baseline.at(near)) / np.diff(near)
    axes.plot(ends * MICRO, (baseline.at(np.array([at])) + rise * (ends - at)) * MICRO,
              color=COLOURS["blue"], linewidth=2.0, label="steepest tangent")  # fmt: skip
    label: str | None = "margin, not searched"
    for edges in ((0.0, looked_at[0]), (looked_at[-1], found.distance[-1])):
        axes.axvspan(*(edge * MICRO for edge in edges), color=COLOURS["grey"], alpha=0.15, lw=0,
                     label=label)  # fmt: skip
        label = None
    axes.set(xlabel=ALONG, ylabel=HEIGHT)
