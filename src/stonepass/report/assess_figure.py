"""The figures of an assessment: fractions over pressure, sensitivity, comparison with cohorts.

All are narrow, with the legend below, so that they stay legible on a phone.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stonepass.clinic.assessment import Assessment
from stonepass.clinic.cohorts import COHORTS, Row
from stonepass.clinic.pressure_limits import LIMITS
from stonepass.report.style import COLOURS, in_style, new_figure, tidy
from stonepass.units import PASCAL_PER

__all__ = ["cohorts_figure", "pressures_figure", "sensitivity_figure", "sizes_figure"]

WIDTH = 5.0  # inches
HIGHEST = 20e3  # Pa, end of the pressure axis unless twice the limit is more
LARGEST = 10.0  # mm, end of the axis of stone diameters
ROW = 0.4  # inches of a row of the comparison with cohorts
UNDECIDED = 0.005  # smallest fraction of undecided samples that is drawn


@in_style
def pressures_figure(found: Assessment) -> Figure:
    """Draw the fraction of samples whose critical pressure is below a urine pressure.

    If the dilated segment was measured, the fraction whose present pressure is above is drawn too.
    """
    figure = new_figure(WIDTH, 3.9)
    axes = figure.add_subplot()
    samples, limit = found.samples, found.patient.limit
    assert samples is not None
    highest = max(HIGHEST, 2.0 * limit)
    grid = np.linspace(0.0, highest, 801)
    fractions = [samples.below(float(pressure)) for pressure in grid[1:]]
    low = np.array([found.loose, *(each.low for each in fractions)])
    high = np.array([found.loose, *(each.high for each in fractions)])
    axes.plot(grid / 1e3, 100 * low, color=COLOURS["blue"], linewidth=2.0,
              label="critical pressure is below")  # fmt: skip
    if np.any(high - low > UNDECIDED):
        axes.fill_between(grid / 1e3, 100 * low, 100 * high, color=COLOURS["blue"], alpha=0.2,
                          linewidth=0, label="undecided by the model")  # fmt: skip
    if found.at_present is not None:
        ordered = np.sort(found.at_present.pressure)
        above = 100.0 * (1.0 - np.searchsorted(ordered, grid, side="right") / len(ordered))
        axes.plot(grid / 1e3, above, color=COLOURS["green"], linestyle="--", linewidth=2.0,
                  label="present pressure is above")  # fmt: skip
    axes.axvline(limit / 1e3, color=COLOURS["orange"], linewidth=1.5,
                 label=f"limit, {limit / 1e3:g} kPa")  # fmt: skip
    for k, known in enumerate(LIMITS):
        axes.axvline(known.pressure / 1e3, color=COLOURS["grey"], linewidth=0.8, linestyle=":",
                     label="_" if k else "published pressures")  # fmt: skip
    axes.set(xlabel="urine pressure (kPa)", ylabel="samples (%)", ylim=(0, 101),
             xlim=(0, highest / 1e3))  # fmt: skip
    tidy(axes)
    _mmhg_above(axes)
    figure.legend(fontsize=8, loc="outside lower center", ncols=2)
    return figure


def _mmhg_above(axes: Axes) -> None:
    """Add an axis in mmHg above axes whose horizontal axis is in kPa."""
    factor = PASCAL_PER["kPa"] / PASCAL_PER["mmHg"]

    def to_mmhg(kilopascals: Any) -> Any:
        return kilopascals * factor

    def to_kpa(mmhg: Any) -> Any:
        return mmhg / factor

    axes.secondary_xaxis("top", functions=(to_mmhg, to_kpa)).set_xlabel("urine pressure (mmHg)")


@in_style
def sensitivity_figure(found: Assessment) -> Figure:
    """Draw Sobol' total index of every uncertain input."""
    indices = found.sensitivity
    figure = new_figure(WIDTH, 0.4 + 0.3 * max(len(indices), 1))
    axes = figure.add_subplot()
    names = [each.name for each in indices][::-1]
    totals = [100.0 * each.total for each in indices][::-1]
    bars = axes.barh(names, totals, color=COLOURS["blue"], height=0.6)
    axes.bar_label(bars, fmt="%.0f %%", padding=4)
    axes.set(xlim=(0, max([*totals, 50.0]) * 1.15))
    axes.xaxis.set_visible(False)
    axes.spines[["top", "right", "bottom"]].set_visible(False)
    axes.tick_params(left=False)
    return figure


@in_style
def cohorts_figure(found: Assessment) -> Figure:
    """Draw the fraction that passed in every cohort with such stones, beside the model's fraction.

    Bars are 95 % intervals, as far as the number of stones of a class is known.
    """
    rows = [row for row in found.cohorts if row.passed is not None]
    figure = new_figure(WIDTH, 1.1 + ROW * max(len(rows), 1))
    axes = figure.add_subplot()
    for k, row in enumerate(rows):
        _draw_row(axes, found, row, -float(k))
    axes.plot([], [], "o", color=COLOURS["ink"], label="passed in the cohort, 95 % interval")
    axes.plot([], [], "D", color=COLOURS["blue"], label="model: critical pressure below the limit")
    axes.set(xlim=(0, 100), ylim=(-len(rows) + 0.3, 0.8), xlabel="stones, samples (%)")
    axes.yaxis.set_visible(False)
    axes.spines["left"].set_visible(False)
    tidy(axes)
    figure.legend(fontsize=8, loc="outside lower center", ncols=1)
    return figure


def _draw_row(axes: Axes, found: Assessment, row: Row, y: float) -> None:
    assert row.passed is not None
    count = "" if row.count is None else f", n = {row.count}"
    axes.text(0.5, y + 0.34, f"{row.cohort.name}, {row.group}{count}", fontsize=8, va="center")
    model = found.beside(row)
    if model is not None:
        axes.plot([100 * model.low, 100 * model.high], [y, y], color=COLOURS["blue"], linewidth=5.0,
                  alpha=0.25, solid_capstyle="butt")  # fmt: skip
        middle = 50.0 * (model.low + model.high)
        axes.plot(middle, y, "D", color=COLOURS["blue"], markersize=5)
    if row.interval is not None:
        axes.plot([100.0 * end for end in row.interval], [y, y], color=COLOURS["ink"], lw=1.2)
    axes.plot(100.0 * row.passed, y, "o", color=COLOURS["ink"], markersize=5)


@in_style
def sizes_figure(found: Assessment) -> Figure:
    """Draw the model's fraction below the limit over the stone diameter, and the cohorts' rates."""
    figure = new_figure(WIDTH, 3.4)
    axes = figure.add_subplot()
    stone = found.patient.measured["stone_diameter"]
    spread = (stone.high - stone.low) / 2.0 if stone.sd is None else stone.sd
    axes.axvspan(1e3 * (stone.value - spread), 1e3 * (stone.value + spread), color=COLOURS["stone"],
                 alpha=0.5, linewidth=0, label="this stone")  # fmt: skip
    label = "passed, a size class of a cohort"
    for rate in (rate for cohort in COHORTS for rate in cohort.by_size):
        if rate.passed is not None:
            ends = (rate.low, min(rate.high, LARGEST))
            axes.plot(ends, [100.0 * rate.passed] * 2, color=COLOURS["grey"], linewidth=1.6,
                      alpha=0.8, solid_capstyle="butt", label=label)  # fmt: skip
            label = "_"
    if found.by_size:
        size = np.array([each for each, _ in found.by_size])
        low = 100.0 * np.array([each.low for _, each in found.by_size])
        high = 100.0 * np.array([each.high for _, each in found.by_size])
        axes.fill_between(size, low, high, color=COLOURS["blue"], alpha=0.2, linewidth=0)
        axes.plot(size, low, color=COLOURS["blue"], linewidth=2.0,
                  label="model: critical pressure below the limit")  # fmt: skip
    axes.set(xlabel="stone diameter (mm)", ylabel="stones, samples (%)", ylim=(0, 102),
             xlim=(0, LARGEST))  # fmt: skip
    tidy(axes)
    figure.legend(fontsize=8, loc="outside lower center", ncols=1)
    return figure
