"""The picture of a push-through state: the loaded wall, the urine, the pressure on the stone."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.figure import Figure

from stonepass.errors import BadInput, Outcome
from stonepass.fe.axisymmetric.wall_values import Field
from stonepass.model.answer import Answer
from stonepass.model.states.loaded_state import PushedState
from stonepass.report.case_line import case_line, length_unit
from stonepass.report.section import add_colour_bar, draw_section, wall_surface
from stonepass.report.stone import draw_radii, mark_angle
from stonepass.report.style import COLOURS, add_heading, angle_label, in_style, new_figure, tidy

__all__ = ["draw_pressure", "draw_wall", "push_figure"]

ARROWS = 7  # number of arrows along the wall upstream
ARROW, LEAST_ROOM = 0.28, 0.1  # length of an arrow and smallest room for one, in inner radii
SHORTEST = 0.05  # fraction of the full length; shorter arrows are not drawn
URINE = COLOURS["green"]


@in_style
def push_figure(answer: Answer) -> Figure:
    """Draw the loaded wall above, and the pressure on the stone below."""
    pushed = answer.contact
    if not isinstance(pushed, PushedState) or pushed.wall is None:
        raise BadInput(
            "figure", answer.outcome.name, "asked for where there is a loaded state to draw"
        )
    figure = new_figure(8.4, 6.8)
    add_heading(figure, case_line(answer.case, answer.model))
    rows = figure.add_gridspec(2, 1, height_ratios=(1.3, 1.0))
    axes = figure.add_subplot(rows[0])
    add_colour_bar(axes, draw_wall(axes, pushed, pushed.peak_contact_pressure))
    what = "Stone about to move" if answer.outcome is Outcome.MOVES else "Urine about to pass"
    axes.set_title(f"{what}: radial compression in the loaded wall")
    draw_pressure(
        figure.add_subplot(rows[1]), pushed, getattr(answer.detail, "leak_pressure", None)
    )
    return figure


def draw_wall(
    axes: Axes,
    pushed: PushedState,
    top: float,
    full: float | None = None,
    height: float | None = None,
) -> ScalarMappable:
    """Draw the section with the urine upstream and the seal.

    Parameters
    ----------
    axes : Axes
    pushed : PushedState
        A state that keeps its stress field.
    top : float
        Radial compression in Pa at the end of the colour scale.
    full : float, optional
        Urine pressure in Pa at which arrows have their full length; by default that of the state.
    height : float, optional
        Half the height of the axes in inner radii; by default that of the wall.

    Returns
    -------
    ScalarMappable
        For the colour bar.
    """
    wall, case = pushed.wall, pushed.case
    assert wall is not None, "asked for where the wall was kept"
    scale = length_unit(case)[0]
    image = draw_section(axes, wall, case, top, height=height)
    _draw_urine(axes, pushed, wall, pushed.urine_pressure if full is None else full)
    draw_radii(axes, case, (pushed.contact_angle, pushed.downstream_angle))
    mark_angle(axes, case, pushed.contact_angle, "α")
    rho, along = case.stone.shape.meridian(np.array(pushed.seal_angle))
    at = scale * case.size_ratio * float(along), scale * case.size_ratio * float(rho)
    axes.plot([at[0], at[0]], [at[1], -at[1]], "o", color=COLOURS["orange"], markersize=5,
              markeredgecolor="white", markeredgewidth=0.7)  # fmt: skip
    axes.annotate("seal", at, xytext=(0, -16), textcoords="offset points", ha="center",
                  color=COLOURS["orange"], fontsize=8)  # fmt: skip
    axes.annotate(
        f"$P_u$ = {pushed.urine_pressure / 1e3:.4g} kPa",
        (axes.get_xlim()[0] + 0.15 * scale, 0.0),
        va="center",
        color=URINE,
    )
    return image


def _draw_urine(axes: Axes, pushed: PushedState, wall: Field, full: float) -> None:
    """Fill the lumen upstream, with arrows on the wall whose length grows with the pressure."""
    case, scale = pushed.case, length_unit(pushed.case)[0]
    theta = np.linspace(0.0, pushed.contact_angle, 181)
    stone, along = (case.size_ratio * x for x in case.stone.shape.meridian(theta))
    edge, left = float(along[-1]), axes.get_xlim()[0] / scale
    z, r = wall_surface(wall, 1.0)
    wet = np.linspace(left, edge, 181)
    length = ARROW * pushed.urine_pressure / full if full > 0.0 else 0.0
    for half in (1.0, -1.0):
        axes.fill_between(
            scale * wet, 0.0, half * scale * np.interp(wet, z, r), color=URINE, alpha=0.12, lw=0
        )
        for at in np.linspace(left + 0.15, edge - 0.12, ARROWS):
            rim = 0.985 * float(np.interp(at, z, r))
            room = rim - float(np.interp(at, along, stone, left=0.0))
            if room < LEAST_ROOM or length < SHORTEST * ARROW:
                continue
            tail = half * (rim - min(length, 0.9 * room))
            axes.annotate(
                "",
                (scale * at, scale * half * rim),
                (scale * at, scale * tail),
                arrowprops={
                    "arrowstyle": "-|>",
                    "color": URINE,
                    "lw": 0.9,
                    "mutation_scale": 4.0 + 6.0 * length / ARROW,
                    "shrinkA": 0.0,
                    "shrinkB": 0.0,
                },
            )


def draw_pressure(
    axes: Axes, pushed: PushedState, leak_pressure: float | None, top: float | None = None
) -> None:
    """Draw the pressure on the stone over θ; `top` in Pa is the highest that the axis shows."""
    theta = np.unique(np.concatenate([np.linspace(0.0, np.pi, 721), pushed.theta]))
    pressure = pushed.pressure_at(theta) / 1e3
    degrees = np.degrees(theta)
    highest = max(top or pushed.peak_contact_pressure, leak_pressure or 0.0) / 1e3
    wet = theta <= pushed.contact_angle
    inside = (theta >= pushed.contact_angle) & (theta <= pushed.downstream_angle)
    for where, colour, line in ((wet, URINE, "-."), (inside, COLOURS["blue"], "-")):
        axes.fill_between(degrees[where], pressure[where], color=colour, alpha=0.15, linewidth=0)
        axes.plot(degrees[where], pressure[where], color=colour, linestyle=line)
    axes.annotate(f"urine, {pushed.urine_pressure / 1e3:.3g} kPa",
                  (2.0, pushed.urine_pressure / 1e3), xytext=(0, 4), textcoords="offset points",
                  color=URINE)  # fmt: skip
    seal, peak = np.degrees(pushed.seal_angle), pushed.peak_contact_pressure / 1e3
    axes.plot(seal, peak, marker="o", color=COLOURS["orange"])
    axes.annotate(f"seal, {seal:.0f}°, {peak:.3g} kPa", (seal, peak), xytext=(0, 7),
                  textcoords="offset points", color=COLOURS["orange"], ha="center")  # fmt: skip
    axes.annotate("contact", (seal, 0.0), xytext=(0, 6), textcoords="offset points",
                  color=COLOURS["blue"], ha="center", fontsize=8)  # fmt: skip
    if leak_pressure is not None:
        leak = leak_pressure / 1e3
        axes.axhline(leak, color=COLOURS["ink"], linewidth=0.9, linestyle=":")
        axes.annotate(f"leak pressure, {leak:.3g} kPa", (179.0, leak), xytext=(0, 4), ha="right",
                      textcoords="offset points")  # fmt: skip
    axes.set(
        xlabel=angle_label(sphere=pushed.case.stone.shape.spherical),
        ylabel="pressure on the stone (kPa)",
        xlim=(0.0, 180.0),
        ylim=(0.0, 1.2 * highest),
        xticks=range(0, 181, 30),
    )
    axes.set_title("Pressure on the stone")
    tidy(axes)
