"""The picture of a curve: critical pressure over size ratio."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stonepass.errors import Outcome
from stonepass.model.answer import Answer
from stonepass.report.style import COLOURS, add_mmhg_axis, in_style, new_figure, tidy

__all__ = ["curve_figure", "draw_curve", "frame_curve"]


@in_style
def curve_figure(answers: Sequence[Answer]) -> Figure:
    """Draw one curve; size ratios without an answer are marked on the axis."""
    figure = new_figure(6.0, 4.2)
    axes = figure.add_subplot()
    case = answers[0].case
    label = (
        f"{case.ureter.material.name}, η = {case.wall_ratio:.3g}, friction {case.stone.friction:g}"
    )
    draw_curve(axes, answers, COLOURS["blue"], label)
    frame_curve(axes)
    axes.set_title("Critical pressure")
    axes.legend(loc="upper left")
    return figure


def draw_curve(axes: Axes, answers: Sequence[Answer], colour: str, label: str) -> None:
    """Add the answered part as a line, the rest as crosses at the bottom."""
    axes.plot(
        [a.case.size_ratio for a in answers],
        [np.nan if a.pressure is None else a.pressure / 1e3 for a in answers],
        color=colour,
        marker="o",
        markersize=2.5,
        label=label,
    )
    for outcome in (Outcome.BEYOND_CLOSURE, Outcome.NO_SOLUTION):
        lost = [a.case.size_ratio for a in answers if a.outcome is outcome]
        if lost:
            axes.plot(
                lost, np.zeros(len(lost)), "x", color=colour, clip_on=False, label=outcome.name
            )


def frame_curve(axes: Axes) -> None:
    """Label the axes of a curve."""
    axes.set(xlabel="size ratio ξ = stone / inner diameter", ylabel="critical pressure (kPa)")
    axes.set_ylim(bottom=0.0)
    tidy(axes)
    add_mmhg_axis(axes)
