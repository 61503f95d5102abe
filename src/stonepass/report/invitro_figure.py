"""The picture of a series: points and curves, and the fitted friction and stiffness."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stonepass.bench.comparison import SizeCurve
from stonepass.bench.invitro import LARGEST, SMALLEST, STIFFNESS, InVitro, JointFit
from stonepass.report.style import (
    COLOURS,
    SERIES,
    add_heading,
    add_mmhg_axis,
    in_style,
    new_figure,
    tidy,
)

__all__ = ["invitro_figure"]

COARSE, FINE = 241, 301  # points along a side of the grids on which the region is found and drawn
AROUND = 1.12  # factor by which the axes extend beyond the joint region


@in_style
def invitro_figure(found: InVitro, curves: Sequence[SizeCurve]) -> Figure:
    """Draw points and curves on the left, and the joint 95 % region, if any, on the right."""
    joint = found.joint
    figure = new_figure(9.6 if joint else 5.4, 4.4)
    setting = found.setting
    add_heading(
        figure, f"Spheres in tubes of {setting.material.name} · model: {setting.model.NAME}"
    )
    left = figure.add_subplot(1, 2 if joint else 1, 1)
    _draw_series(left, found, curves)
    if joint is not None:
        _draw_region(figure.add_subplot(1, 2, 2), found, joint)
    return figure


def _draw_series(axes: Axes, found: InVitro, curves: Sequence[SizeCurve]) -> None:
    """Draw the points with their standard deviation, and the model's curve of each series."""
    points = found.comparison.points
    walls = sorted({point.wall_ratio for point in points})
    loads = sorted({float(point.confining_pressure) for point in points})
    for wall in walls:
        for load in loads:
            some = [p for p in points if (p.wall_ratio, p.confining_pressure) == (wall, load)]
            if not some:
                continue
            colour = COLOURS[SERIES[walls.index(wall) % len(SERIES)][0]]
            _, line, mark = SERIES[loads.index(load) % len(SERIES)]
            axes.errorbar(
                [point.size_ratio for point in some],
                [point.pressure / 1e3 for point in some],
                yerr=[0.0 if point.sd is None else point.sd / 1e3 for point in some],
                fmt=mark,
                markersize=4.5,
                capsize=2,
                color=colour,
                markerfacecolor=colour if load == loads[0] else "white",
            )
            for curve in curves:
                if (curve.wall_ratio, curve.confining_pressure) == (wall, load):
                    axes.plot(curve.size_ratio, curve.pressure / 1e3, linestyle=line, color=colour)
            name = f"η = {wall:g}"
            if len(loads) > 1:
                name += rf", $P_{{out}}$ = {load / 1e3:g} kPa"
            axes.plot([], [], color=colour, linestyle=line, marker=mark, markersize=4.5, label=name,
                      markerfacecolor=colour if load == loads[0] else "white")  # fmt: skip
    axes.set(xlabel="size ratio ξ", ylabel="critical pressure (kPa)", ylim=(0, None))
    axes.set_title("Marks: measured; lines: model")
    title = f"model at μ = {found.comparison.friction:.3g}"
    axes.legend(loc="lower right", fontsize=7.5, title=title, title_fontsize=7.5, alignment="left")
    tidy(axes)
    add_mmhg_axis(axes)


def _draw_region(axes: Axes, found: InVitro, joint: JointFit) -> None:
    """Draw the joint 95 % region of friction and stiffness, and the interval of friction."""
    limits = _limits(found, joint)
    friction, stiffness = (np.linspace(*ends, FINE) for ends in limits)
    misfit = np.asarray(joint.misfit(friction[None, :], stiffness[:, None]))
    axes.contourf(
        friction, stiffness, misfit, levels=[0.0, joint.level], colors=[COLOURS["blue"]],
        alpha=0.25,
    )  # fmt: skip
    axes.contour(friction, stiffness, misfit, levels=[joint.level], colors=COLOURS["blue"],
                 linewidths=0.9)  # fmt: skip
    axes.plot(joint.friction.value, joint.stiffness.value, "o", color=COLOURS["blue"],
              label="both fitted, with their joint 95 % region")  # fmt: skip
    axes.axhline(1.0, color=COLOURS["grey"], linewidth=0.8, linestyle=":")
    axes.set(xlim=limits[0], ylim=limits[1])
    # An interval that is open on one side is drawn up to the edge of the axes.
    low = limits[0][0] if found.friction.low is None else found.friction.low
    high = limits[0][1] if found.friction.high is None else found.friction.high
    axes.plot([low, high], [1.0, 1.0], color=COLOURS["orange"], linewidth=1.8)
    axes.plot(found.friction.value, 1.0, "s", color=COLOURS["orange"],
              label="friction alone, with its 95 % interval")  # fmt: skip
    axes.set(xlabel="friction μ", ylabel="stiffness over that of the material")
    axes.set_title("Friction and stiffness that fit")
    axes.legend(fontsize=7.5, loc="upper right")
    tidy(axes)


def _limits(found: InVitro, joint: JointFit) -> list[tuple[float, float]]:
    """Return ranges of friction and stiffness that contain the region and both estimates."""
    friction = np.geomspace(SMALLEST, LARGEST, COARSE)
    stiffness = np.geomspace(*STIFFNESS, COARSE)
    inside = np.asarray(joint.misfit(friction[None, :], stiffness[:, None])) <= joint.level
    limits = []
    for grid, known, points in (
        (friction, inside.any(axis=0), (joint.friction.value, found.friction.value)),
        (stiffness, inside.any(axis=1), (joint.stiffness.value, 1.0)),
    ):
        some = np.array([*grid[known], *points])
        limits.append((float(some.min()) / AROUND, float(some.max()) * AROUND))
    return limits
