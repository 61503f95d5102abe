"""The picture of a curve: critical pressure over size ratio."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stonepass.errors import Outcome
from stonepass.model.answer import Answer
from stonepass.report.case_line import case_line
from stonepass.report.style import (
    COLOURS,
    SERIES,
    add_heading,
    add_mmhg_axis,
    in_style,
    mark_unanswered,
    new_figure,
    series,
    tidy,
)

__all__ = ["curve_figure", "draw_curve", "frame_curve"]


@in_style
def curve_figure(answers: Sequence[Answer]) -> Figure:
    """Draw one curve; size ratios without an answer are marked at the top of the axes."""
    figure = new_figure(6.4, 4.4)
    axes = figure.add_subplot()
    first = answers[0]
    add_heading(figure, case_line(first.case, first.model, with_stone=False))
    draw_curve(axes, answers, 0, "critical pressure")
    frame_curve(axes)
    inner = first.case.ureter.inner_diameter
    if inner is not None:
        _add_diameter_axis(axes, 1e3 * inner)
    axes.legend(loc="upper left")
    return figure


def draw_curve(axes: Axes, answers: Sequence[Answer], k: int, label: str) -> None:
    """Add curve number `k`: answers with error bars, and crosses at sizes without an answer."""
    sizes = [answer.case.size_ratio for answer in answers]
    pressures = [np.nan if a.pressure is None else a.pressure / 1e3 for a in answers]
    axes.plot(sizes, pressures, **series(k), markersize=3, label=label)
    errors = [(a.error.critical_pressure or 0.0) / 1e3 if a.error else 0.0 for a in answers]
    if any(errors):
        axes.errorbar(
            sizes,
            pressures,
            yerr=errors,
            fmt="none",
            ecolor=COLOURS["grey"],
            elinewidth=1.0,
            capsize=2.5,
            label=None if k else "± discretisation error",
        )
    for outcome in (Outcome.BEYOND_CLOSURE, Outcome.NO_SOLUTION):
        lost = [a.case.size_ratio for a in answers if a.outcome is outcome]
        mark_unanswered(axes, lost, f"no answer: {outcome.name}", COLOURS[SERIES[k][0]])


def _add_diameter_axis(axes: Axes, inner: float) -> None:
    """Put a scale of the stone's diameter above the size ratio; `inner` is in mm."""

    def to_diameter(ratio: Any) -> Any:
        return ratio * inner

    def to_ratio(diameter: Any) -> Any:
        return diameter / inner

    top = axes.secondary_xaxis("top", functions=(to_diameter, to_ratio))
    top.set_xlabel("stone diameter (mm)")


def frame_curve(axes: Axes) -> None:
    """Label the axes of a curve."""
    axes.set(xlabel="size ratio ξ = stone / inner diameter", ylabel="critical pressure (kPa)")
    axes.set_ylim(bottom=0.0)
    tidy(axes)
    add_mmhg_axis(axes)
