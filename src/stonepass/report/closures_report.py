"""Comparison of closures: a table, a figure, and a map of their errors."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from rich import box
from rich.table import Table

from stonepass.model.closure import linear_closure
from stonepass.report.case_line import case_line
from stonepass.report.style import (
    COLOURS,
    SERIES,
    add_heading,
    angle_label,
    in_style,
    new_figure,
    ordered_colours,
    series,
    tidy,
)
from stonepass.studies.closures import APPROXIMATE, CLOSURES, EXACT, ClosureComparison

__all__ = ["closures_figure", "closures_table", "map_figure"]


def closures_table(found: ClosureComparison) -> Table:
    """Return a table of P_ucr by every closure, with its difference from the direct model."""
    case = found.case
    table = Table(
        box=box.SIMPLE_HEAD,
        title=f"ξ = {case.size_ratio:.4g}, η = {case.wall_ratio:.4g} · "
        f"friction {case.stone.friction:g} · {case.ureter.material.name}",
        title_justify="left",
    )
    for name in ("closure", "kPa", "difference from direct"):
        table.add_column(name, justify="left" if name == "closure" else "right")
    for name, text in CLOSURES.items():
        pressure, error = found.pressures[name], found.error(name)
        shown = "–" if error is None or name == EXACT else f"{error:+.1%}"
        table.add_row(text, "–" if pressure is None else f"{pressure / 1e3:.4g}", shown)
    return table


@in_style
def closures_figure(found: ClosureComparison) -> Figure:
    """Draw the radius of the tube over the opening angle: direct states, series and Eq. 15."""
    figure = new_figure(6.4, 4.4)
    add_heading(figure, case_line(found.case))
    axes = figure.add_subplot()
    if found.opening_curve is not None and found.series is not None:
        alpha, radius = found.opening_curve.arrays
        xi, first = found.case.size_ratio, float(alpha[0])
        fine = np.linspace(first, np.pi / 2, 200)
        width = found.case.stone.shape.width(fine)
        axes.plot(
            np.degrees(fine),
            linear_closure(width, float(width[0]), xi),
            **series(1, marker=False),
            label="Eq. 15, linear in the stone's width",
        )
        axes.plot(
            np.degrees(fine),
            found.series(width, float(width[0]), xi),
            **series(0, marker=False),
            label=f"series, order {len(found.series.coefficients)}",
        )
        axes.plot(np.degrees(alpha), radius, "o", color=COLOURS["ink"], ms=4, label="direct states")
        axes.legend()
    axes.set(
        xlabel=angle_label(sphere=found.case.stone.shape.spherical, name="α"),
        ylabel="inner radius upstream $r_a$ / $R_a$",
    )
    axes.set_title("Closure: width of the tube when the wall is open up to α")
    tidy(axes)
    return figure


@in_style
def map_figure(found: Sequence[ClosureComparison]) -> Figure:
    """Draw the error of each closure over ξ: a panel for each η, a shade for each friction."""
    walls = sorted({each.case.wall_ratio for each in found})
    names = list(APPROXIMATE)
    figure = new_figure(3.1 * len(walls) + 0.6, 2.2 * len(names) + 1.2)
    rows = figure.subfigures(len(names), 1, squeeze=False)[:, 0]
    for name, row in zip(names, rows, strict=True):
        row.suptitle(CLOSURES[name], x=0.01, ha="left", fontweight="bold")
        panels = row.subplots(1, len(walls), sharey=True, squeeze=False)[0]
        for axes, eta in zip(panels, walls, strict=True):
            _draw_errors(axes, [each for each in found if each.case.wall_ratio == eta], name, found)
            axes.set_title(f"η = {eta:.3g}", fontsize=9, fontweight="normal")
            if name == names[-1]:
                axes.set_xlabel("size ratio ξ")
        panels[0].set_ylabel("error (% of direct)")
    handles, labels = figure.subfigs[0].axes[0].get_legend_handles_labels()
    add_heading(
        figure,
        "Error of the critical pressure against that of the direct push-through model. "
        f"{found[0].case.ureter.material.name}; each row of panels is one closure, each column one "
        "wall ratio η, each line one coefficient of friction μ.",
    )
    figure.legend(handles, labels, loc="outside lower center", ncols=len(labels))
    return figure


def _draw_errors(
    axes: Axes,
    found: Sequence[ClosureComparison],
    name: str,
    everything: Sequence[ClosureComparison],
) -> None:
    """Draw the errors of one closure for one wall, a line for each friction."""
    frictions = sorted({each.case.stone.friction for each in everything})
    axes.axhline(0.0, color=COLOURS["grey"], linewidth=0.8)
    for k, (mu, colour) in enumerate(zip(frictions, ordered_colours(len(frictions)), strict=True)):
        mine = [each for each in found if each.case.stone.friction == mu]
        mine.sort(key=lambda each: each.case.size_ratio)
        errors = [each.error(name) for each in mine]
        axes.plot(
            [each.case.size_ratio for each in mine],
            [np.nan if e is None else 100.0 * e for e in errors],
            marker=SERIES[k % len(SERIES)][2],
            markersize=3,
            color=colour,
            label=f"μ = {mu:g}",
        )
    tidy(axes)
