"""The picture of a push-through state: the loaded wall, the urine, the pressure on the stone."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stonepass.errors import BadInput, Outcome
from stonepass.fe.axisymmetric.wall_values import Field
from stonepass.model.answer import Answer
from stonepass.model.states.loaded_state import PushedState
from stonepass.report.section import draw_section
from stonepass.report.stone import draw_radii
from stonepass.report.style import COLOURS, angle_label, in_style, new_figure, tidy

__all__ = ["draw_pressure", "draw_wall", "push_figure"]

ARROWS = 7  # along the wall upstream
ARROW, LEAST_ROOM = 0.22, 0.1  # length of an arrow, and room that one needs, in inner radii
URINE = COLOURS["green"]


@in_style
def push_figure(answer: Answer) -> Figure:
    """Draw the loaded wall above, and the pressure on the stone below."""
    pushed = answer.contact
    if not isinstance(pushed, PushedState) or pushed.wall is None:
        raise BadInput(
            "figure", answer.outcome.name, "asked for where there is a loaded state to draw"
        )
    figure = new_figure(8.4, 6.6)
    rows = figure.add_gridspec(2, 1, height_ratios=(1.3, 1.0))
    axes = figure.add_subplot(rows[0])
    draw_wall(axes, pushed, pushed.peak_contact_pressure)
    what = "Stone about to move" if answer.outcome is Outcome.MOVES else "Urine about to pass"
    axes.set_title(f"{what}: radial compression in the loaded wall")
    draw_pressure(
        figure.add_subplot(rows[1]), pushed, getattr(answer.detail, "leak_pressure", None)
    )
    return figure


def draw_wall(axes: Axes, pushed: PushedState, top: float) -> None:
    """Draw the section with the urine upstream; `top` in Pa ends the colours."""
    wall = pushed.wall
    assert wall is not None, "asked for where the wall was kept"
    theta = np.linspace(0.0, pushed.contact_angle, 181)
    stone, along = (pushed.case.size_ratio * x for x in pushed.case.stone.shape.meridian(theta))
    edge = float(along[-1])
    draw_section(axes, wall, pushed.case, top)
    left, _ = axes.get_xlim()
    r, z = _inner_wall(wall)
    wet = (z < edge) & (z > left - 0.5)
    for half in (1.0, -1.0):
        axes.fill_between(z[wet], 0.0, half * r[wet], color=URINE, alpha=0.12, linewidth=0)
        for at in np.linspace(left + 0.15, edge - 0.12, ARROWS):
            rim = 0.985 * float(np.interp(at, z, r))
            room = rim - float(np.interp(at, along, stone, left=0.0))
            if room < LEAST_ROOM:
                continue
            axes.annotate(
                "",
                (at, half * rim),
                (at, half * (rim - min(ARROW, 0.9 * room))),
                arrowprops={"arrowstyle": "-|>", "color": URINE, "lw": 0.9},
            )
    draw_radii(axes, pushed.case, (pushed.contact_angle, pushed.downstream_angle))
    axes.annotate(
        f"$P_u$ = {pushed.urine_pressure / 1e3:.4g} kPa",
        (left + 0.15, 0.0),
        va="center",
        color=URINE,
    )


def draw_pressure(axes: Axes, pushed: PushedState, leak_pressure: float | None) -> None:
    """Draw the pressure on the stone over θ."""
    theta = np.unique(np.concatenate([np.linspace(0.0, np.pi, 721), pushed.theta]))
    pressure = pushed.pressure_at(theta) / 1e3
    degrees = np.degrees(theta)
    wet = theta <= pushed.contact_angle
    axes.fill_between(degrees[wet], pressure[wet], color=URINE, alpha=0.2, linewidth=0)
    axes.plot(degrees[wet], pressure[wet], color=URINE, label="urine")
    inside = (theta >= pushed.contact_angle) & (theta <= pushed.downstream_angle)
    axes.fill_between(
        degrees[inside], pressure[inside], color=COLOURS["blue"], alpha=0.15, linewidth=0
    )
    axes.plot(degrees[inside], pressure[inside], color=COLOURS["blue"], label="wall")
    seal = np.degrees(pushed.seal_angle)
    axes.plot(
        seal,
        pushed.peak_contact_pressure / 1e3,
        marker="o",
        color=COLOURS["orange"],
        linestyle="none",
        label=f"seal, {seal:.0f}°",
    )
    if leak_pressure is not None:
        axes.axhline(
            leak_pressure / 1e3,
            color=COLOURS["grey"],
            linewidth=0.9,
            linestyle=":",
            label=f"leak pressure, {leak_pressure / 1e3:.3g} kPa",
        )
    axes.set(
        xlabel=angle_label(sphere=pushed.case.stone.shape.spherical),
        ylabel="pressure on the stone (kPa)",
        xlim=(0.0, 180.0),
        ylim=(0.0, None),
    )
    axes.set_title("Pressure on the stone")
    axes.legend(fontsize=8, loc="upper left", frameon=True, edgecolor="none", framealpha=0.9)
    tidy(axes)


def _inner_wall(wall: Field) -> tuple[np.ndarray, np.ndarray]:
    """Deformed r and z of the inner wall, sorted along the tube."""
    inner = wall.R == 1.0
    z, order = np.unique(wall.z[inner], return_index=True)
    return wall.r[inner][order], z
