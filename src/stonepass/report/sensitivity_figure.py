"""The picture of a sensitivity study: indices with their intervals, and a tornado in kPa and in mm.

Each panel has its own order of the inputs, the most important one at the top.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from stonepass.report.case_line import case_line
from stonepass.report.style import COLOURS, add_heading, in_style, new_figure, tidy
from stonepass.studies.sensitivity.estimate import Effects, IndexEstimate, Indices
from stonepass.studies.sensitivity.sensitivity import Sensitivity
from stonepass.studies.sensitivity.tornado import Bar, Tornado

__all__ = ["draw_indices", "draw_tornado", "explain_tornado", "sensitivity_figure"]

WIDTH = 6.6  # inches
ROW, MARGIN = 0.34, 1.05  # inches of one input, and of title and axis of a panel
LEGEND = 22.0  # points between the axes and their title, in which there is room for a legend
HEADING = 0.5  # inches
GAP = 0.06  # between the panels, as a fraction of their height
THICK, SHADE = 0.62, 0.85  # thickness of a bar in rows, and its opacity
LOW, HIGH = COLOURS["blue"], COLOURS["orange"]


@in_style
def sensitivity_figure(found: Sensitivity) -> Figure:
    """Draw the indices of the critical pressure, and the tornado of pressure and of size."""
    tornados = [each for each in (found.pressures, found.sizes) if each is not None]
    rows = [len(found.main.inputs)] if found.main.inputs else []
    rows += [len(each.bars) for each in tornados]
    heights = [MARGIN + ROW * count for count in rows]
    figure = new_figure(WIDTH, HEADING + sum(heights))
    case = found.study.uncertain.median_case
    add_heading(figure, f"All inputs at their medians: {case_line(case, case.model)}")
    engine: Any = figure.get_layout_engine()
    engine.set(hspace=GAP)
    panels = figure.subplots(len(rows), 1, squeeze=False, height_ratios=heights)[:, 0]
    if found.main.inputs:
        draw_indices(panels[0], found)
    for axes, tornado in zip(panels[-len(tornados) :], tornados, strict=True):
        draw_tornado(axes, found, tornado)
    explain_tornado(panels[-len(tornados)])
    return figure


def draw_indices(axes: Axes, found: Sensitivity) -> None:
    """Draw the sensitivity of the main response to each input with its confidence interval."""
    main = found.main
    inputs, places = main.inputs, np.arange(len(main.inputs))
    if isinstance(inputs[0], Indices):
        first = [each.first for each in inputs if isinstance(each, Indices)]
        total = [each.importance for each in inputs]
        _draw_estimates(axes, total, places - 0.13, "o", COLOURS["blue"], "total index")
        _draw_estimates(axes, first, places + 0.17, "D", COLOURS["orange"], "first order (alone)")
        axes.set_xlim(min(0.0, *(each.low for each in first)), max(_highest(total), 0.05) * 1.05)
        axes.set_xlabel(f"part of the variance of {_short(main.response.title)}, 95 % intervals")
    else:
        effects = [each for each in inputs if isinstance(each, Effects)]
        means = [each.mean_absolute for each in effects]
        _draw_estimates(axes, means, places, "o", COLOURS["blue"], "mean |effect| μ*")
        axes.plot([each.spread for each in effects], places, "x", color=COLOURS["orange"],
                  label="standard deviation σ")  # fmt: skip
        axes.set_xlim(0.0, max(_highest(means), *(each.spread for each in effects)) * 1.05)
        unit = f" ({main.response.unit})" if main.response.unit else ""
        axes.set_xlabel(f"effect on {_short(main.response.title)}{unit}, 95 % intervals")
    axes.axvline(0.0, color=COLOURS["grey"], linewidth=0.8)
    _name_rows(axes, [found.title(each.key) for each in inputs])
    axes.set_title(f"Sensitivity of {main.response.title}", pad=LEGEND)
    _add_legend(axes)


def _draw_estimates(
    axes: Axes,
    estimates: Sequence[IndexEstimate],
    places: np.ndarray,
    marker: str,
    colour: str,
    label: str,
) -> None:
    axes.errorbar(
        [each.value for each in estimates], places,
        xerr=[each.half_width for each in estimates],
        fmt=marker, color=colour, markersize=5, elinewidth=1.4, capsize=3, label=label,
    )  # fmt: skip


def _highest(estimates: Sequence[IndexEstimate]) -> float:
    return max(each.high for each in estimates)


def _short(title: str) -> str:
    return title.removeprefix("the outcome that ")


def draw_tornado(axes: Axes, found: Sensitivity, tornado: Tornado) -> None:
    """Draw the results at the 5 % and at the 95 % quantile of each input.

    A result that does not exist is a cross at the edge of the axes, with its outcome.
    """
    values = [end.value for bar in tornado.bars for end in (bar.low, bar.high)]
    values += [tornado.centre.value]
    known = [each for each in values if each is not None]
    limit = "" if tornado.limit is None else f" at {tornado.limit / 1e3:.4g} kPa"
    axes.set_title(f"{tornado.quantity.capitalize()}{limit}, one input at a time")
    axes.set_xlabel(f"{tornado.quantity} ({tornado.unit})")
    _name_rows(axes, [found.title(bar.key) for bar in tornado.bars])
    if not known:
        return
    low, high = min(known), max(known)
    pad = 0.16 * (high - low) or 0.1 * abs(high) or 1.0
    axes.set_xlim(low - pad, high + pad)
    centre = tornado.centre.value
    if centre is not None:
        axes.axvline(centre, color=COLOURS["ink"], linewidth=1.0, zorder=3)
    for place, bar in enumerate(tornado.bars):
        _draw_bar(axes, found, bar, place, centre)


def explain_tornado(axes: Axes) -> None:
    """Explain the colours of all tornado panels, between the title and the first one."""
    axes.set_title(axes.get_title(loc="left") or axes.get_title(), pad=LEGEND)
    _add_legend(
        axes,
        handles=[
            Line2D(
                [], [], color=COLOURS["ink"], linewidth=1.0, label="all inputs at their medians"
            ),
            Patch(color=LOW, alpha=SHADE, label="at the 5 % quantile"),
            Patch(color=HIGH, alpha=SHADE, label="at the 95 % quantile"),
        ],
    )


def _add_legend(axes: Axes, **options: Any) -> None:
    """Add a legend in one line above the axes, to the left and below the title."""
    axes.legend(
        loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=3, borderaxespad=0.2, borderpad=0.2,
        columnspacing=1.4, handlelength=1.6, **options,
    )  # fmt: skip


def _draw_bar(axes: Axes, found: Sensitivity, bar: Bar, place: int, centre: float | None) -> None:
    """Draw both ends of one input, each as a bar from the centre with the value of the input."""
    uncertain, ends = found.study.uncertain[bar.key], (bar.low, bar.high)
    known = [end.value for end in ends if end.value is not None]
    for end, colour in zip(ends, (LOW, HIGH), strict=True):
        assert end.input is not None
        text = uncertain.show(end.input)
        if end.value is None:
            _mark_missing(axes, place, f"{text}: {end.outcome}", colour)
            continue
        start = centre if centre is not None else end.value
        axes.barh(place, end.value - start, left=start, height=THICK, color=colour, alpha=SHADE)
        left = end.value < start or (end.value == min(known) and end.value != max(known))
        axes.annotate(
            text, (end.value, place), (-3 if left else 3, 0), textcoords="offset points",
            ha="right" if left else "left", va="center", fontsize=7.5,
        )  # fmt: skip


def _mark_missing(axes: Axes, place: int, text: str, colour: str) -> None:
    axes.plot(0.985, place, "x", color=colour, transform=axes.get_yaxis_transform(), clip_on=False)
    axes.annotate(text, (0.97, place), xycoords=axes.get_yaxis_transform(), ha="right",
                  va="center", fontsize=7.5, color=colour)  # fmt: skip


def _name_rows(axes: Axes, names: Sequence[str]) -> None:
    axes.set_yticks(range(len(names)), names)
    axes.set_ylim(len(names) - 0.5, -0.5)
    tidy(axes)
    axes.grid(axis="y", visible=False)
    axes.tick_params(axis="y", length=0)
    axes.spines["left"].set_visible(False)
