"""The picture of a series: curves and points, and what it tells of friction and stiffness."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stonepass.bench.comparison import SizeCurve
from stonepass.bench.invitro import LARGEST, SMALLEST, STIFFNESS, InVitro, JointFit
from stonepass.report.style import COLOURS, add_mmhg_axis, in_style, new_figure, tidy

__all__ = ["invitro_figure"]

GRID = 241  # a side of the region's picture
SHADES = ("blue", "orange", "green", "pink", "grey")
LINES = ("-", "--", "-.", ":")
MARKS = ("o", "s", "^", "D")
AROUND = 1.12  # the joint region's picture reaches that far beyond it


@in_style
def invitro_figure(found: InVitro, curves: Sequence[SizeCurve]) -> Figure:
    """Draw points and curves on the left; on the right the joint 95 % region where there is one."""
    joint = found.joint
    figure = new_figure(9.6 if joint else 5.4, 4.0)
    left = figure.add_subplot(1, 2 if joint else 1, 1)
    _draw_series(left, found, curves)
    if joint is not None:
        _draw_region(figure.add_subplot(1, 2, 2), found, joint)
    return figure


def _draw_series(axes: Axes, found: InVitro, curves: Sequence[SizeCurve]) -> None:
    points = found.comparison.points
    walls = sorted({point.wall_ratio for point in points})
    loads = sorted({float(point.confining_pressure) for point in points})
    for wall in walls:
        for load in loads:
            colour = COLOURS[SHADES[walls.index(wall) % len(SHADES)]]
            k = loads.index(load) % len(LINES)
            some = [p for p in points if (p.wall_ratio, p.confining_pressure) == (wall, load)]
            if not some:
                continue
            name = f"η = {wall:g}" + (
                rf", $P_{{out}}$ {load / 1e3:g} kPa" if len(loads) > 1 else ""
            )
            axes.errorbar(
                [point.size_ratio for point in some],
                [point.pressure / 1e3 for point in some],
                yerr=[0.0 if point.sd is None else point.sd / 1e3 for point in some],
                fmt=MARKS[k],
                markersize=4.5,
                capsize=2,
                color=colour,
                markerfacecolor=colour if k == 0 else "white",
                label=name,
            )
            for curve in curves:
                if (curve.wall_ratio, curve.confining_pressure) == (wall, load):
                    axes.plot(curve.size_ratio, curve.pressure / 1e3, LINES[k], color=colour)
    axes.set(xlabel="size ratio ξ", ylabel="critical pressure (kPa)", ylim=(0, None))
    axes.set_title(f"Measured, and the model at friction {found.comparison.friction:.3g}")
    axes.legend(fontsize=7.5, loc="upper left")
    tidy(axes)
    add_mmhg_axis(axes)


def _draw_region(axes: Axes, found: InVitro, joint: JointFit) -> None:
    friction = np.geomspace(SMALLEST, LARGEST, GRID)
    stiffness = np.geomspace(*STIFFNESS, GRID)
    misfit = np.asarray(joint.misfit(friction[None, :], stiffness[:, None]))
    inside = misfit <= joint.level
    axes.contourf(
        friction, stiffness, misfit, levels=[0.0, joint.level], colors=[COLOURS["blue"]],
        alpha=0.25,
    )  # fmt: skip
    axes.contour(friction, stiffness, misfit, levels=[joint.level], colors=COLOURS["blue"],
                 linewidths=0.9)  # fmt: skip
    axes.plot(joint.friction.value, joint.stiffness.value, "o", color=COLOURS["blue"],
              label="both fitted, joint 95 % region")  # fmt: skip
    here = found.friction.value
    axes.axhline(1.0, color=COLOURS["grey"], linewidth=0.8, linestyle=":")
    for set_limits, grid, known, own in (
        (axes.set_xlim, friction, inside.any(axis=0), here),
        (axes.set_ylim, stiffness, inside.any(axis=1), 1.0),
    ):
        some = np.array([*grid[known], own])
        set_limits(some.min() / AROUND, some.max() * AROUND)
    # An end that the series does not bound runs out of the picture.
    first, last = axes.get_xlim()
    low = first if found.friction.low is None else found.friction.low
    high = last if found.friction.high is None else found.friction.high
    axes.plot([low, high], [1.0, 1.0], color=COLOURS["orange"], linewidth=1.8)
    axes.plot(here, 1.0, "s", color=COLOURS["orange"], label="friction alone, 95 %")
    axes.set(xlabel="friction", ylabel="stiffness, times the material's")
    axes.set_title("What the series can tell")
    axes.legend(fontsize=7.5, loc="upper right")
    tidy(axes)
