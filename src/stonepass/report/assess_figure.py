"""The pictures of an assessment: fractions over pressure, sensitivity, cohorts beside them."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stonepass.clinic.assessment import Assessment
from stonepass.clinic.cohorts import COHORTS
from stonepass.clinic.pressure_limits import LIMITS
from stonepass.report.style import COLOURS, in_style, new_figure, tidy

__all__ = ["cohorts_figure", "pressures_figure", "sensitivity_figure"]

HIGHEST = 20e3  # Pa, of the axis, or twice the limit
SHADES = {"Jendeberg 2017": "orange", "Coll 2002": "green", "Miller & Kane 1999": "pink",
          "Hübner 1993": "grey"}  # fmt: skip
WIDEST = 10.0  # mm, of the axis


@in_style
def pressures_figure(found: Assessment) -> Figure:
    """Draw the fraction of samples with P_ucr below a pressure, with limits and the present P_u."""
    figure = new_figure(7.2, 2.8)
    axes = figure.add_subplot()
    samples, limit = found.samples, found.patient.limit
    assert samples is not None
    highest = max(HIGHEST, 2.0 * limit)
    grid = np.linspace(0.0, highest, 801)
    fractions = [samples.below(float(pressure)) for pressure in grid[1:]]
    low = np.array([found.loose, *(each.low for each in fractions)])
    high = np.array([found.loose, *(each.high for each in fractions)])
    if np.any(high - low > 0.005):
        axes.fill_between(grid / 1e3, 100 * low, 100 * high, color=COLOURS["blue"], alpha=0.2,
                          linewidth=0, label="not decided")  # fmt: skip
    axes.plot(grid / 1e3, 100 * low, color=COLOURS["blue"], label="critical pressure is below")
    for k, known in enumerate(LIMITS):
        axes.axvline(known.pressure / 1e3, color=COLOURS["grey"], linewidth=0.7, linestyle=":",
                     label="_" if k else "published pressures")  # fmt: skip
    axes.axvline(limit / 1e3, color=COLOURS["orange"], label=f"limit, {limit / 1e3:g} kPa")
    if found.at_present is not None:
        ordered = np.sort(found.at_present.pressure)
        above = 100.0 * (1.0 - np.searchsorted(ordered, grid, side="right") / len(ordered))
        axes.plot(grid / 1e3, above, color=COLOURS["green"], linestyle="--",
                  label="present pressure is above")  # fmt: skip
    axes.set(xlabel="urine pressure (kPa)", ylabel="fraction of samples (%)", ylim=(0, 101),
             xlim=(0, highest / 1e3))  # fmt: skip
    figure.legend(fontsize=8, loc="outside right upper")
    tidy(axes)
    return figure


@in_style
def sensitivity_figure(found: Assessment) -> Figure:
    """Draw what the spread of P_ucr comes from."""
    indices = found.sensitivity
    figure = new_figure(7.2, 0.5 + 0.27 * max(len(indices), 1))
    axes = figure.add_subplot()
    names = [each.name for each in indices][::-1]
    totals = [100.0 * each.total for each in indices][::-1]
    bars = axes.barh(names, totals, color=COLOURS["blue"], height=0.6)
    axes.bar_label(bars, fmt="%.0f %%", padding=4, fontsize=8)
    axes.set(xlim=(0, max([*totals, 50.0]) * 1.12))
    axes.xaxis.set_visible(False)
    axes.spines[["top", "right", "bottom"]].set_visible(False)
    axes.tick_params(left=False)
    return figure


@in_style
def cohorts_figure(found: Assessment) -> Figure:
    """Draw the fraction that passed by size in cohorts, and the model's below the limit."""
    figure = new_figure(7.2, 3.1)
    axes = figure.add_subplot()
    stone = found.patient.measured["stone_diameter"]
    spread = (stone.high - stone.low) / 2.0 if stone.sd is None else stone.sd
    axes.axvspan(1e3 * (stone.value - spread), 1e3 * (stone.value + spread), color=COLOURS["stone"],
                 alpha=0.5, linewidth=0, label="this stone")  # fmt: skip
    for cohort in COHORTS:
        if cohort.name in SHADES:
            _draw_cohort(axes, cohort.name, COLOURS[SHADES[cohort.name]])
    if found.by_size:
        size = np.array([each for each, _ in found.by_size])
        low = 100.0 * np.array([each.low for _, each in found.by_size])
        high = 100.0 * np.array([each.high for _, each in found.by_size])
        axes.fill_between(size, low, high, color=COLOURS["blue"], alpha=0.2, linewidth=0)
        axes.plot(size, low, color=COLOURS["blue"], linewidth=2.0,
                  label="model: moves below the limit")  # fmt: skip
    axes.set(xlabel="stone diameter (mm)", ylabel="fraction (%)", ylim=(0, 102), xlim=(0, WIDEST))
    figure.legend(fontsize=8, loc="outside right upper")
    tidy(axes)
    return figure


def _draw_cohort(axes: Axes, name: str, colour: str) -> None:
    cohort = next(each for each in COHORTS if each.name == name)
    label = f"passed: {name}"
    for rate in cohort.by_size:
        if rate.passed is not None:
            ends = (rate.low, min(rate.high, WIDEST))
            axes.plot(ends, [100.0 * rate.passed] * 2, color=colour, linewidth=2.2, label=label,
                      solid_capstyle="butt")  # fmt: skip
            label = "_"
