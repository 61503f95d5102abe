"""Comparison of closures: a table, a figure, and a map of their errors."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.figure import Figure
from rich import box
from rich.table import Table

from stonepass.model.closure import linear_closure
from stonepass.report.style import COLOURS, in_style, new_figure, tidy
from stonepass.studies.closures import CLOSURES, ClosureComparison

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
        shown = "–" if error is None or name == "direct" else f"{error:+.1%}"
        table.add_row(text, "–" if pressure is None else f"{pressure / 1e3:.4g}", shown)
    return table


@in_style
def closures_figure(found: ClosureComparison) -> Figure:
    """How wide the tube is when the wall has opened to α: direct states, series, Eq. 15."""
    figure = new_figure(6.0, 4.2)
    axes = figure.add_subplot()
    if found.opening_curve is not None and found.series is not None:
        alpha, radius = found.opening_curve.arrays
        xi, first = found.case.size_ratio, float(alpha[0])
        fine = np.linspace(first, np.pi / 2, 200)
        width = found.case.stone.shape.width(fine)
        axes.plot(
            np.degrees(fine),
            linear_closure(width, float(width[0]), xi),
            color=COLOURS["orange"],
            label="Eq. 15, linear in the stone's width",
        )
        axes.plot(
            np.degrees(fine),
            found.series(width, float(width[0]), xi),
            color=COLOURS["blue"],
            label=f"series, order {len(found.series.coefficients)}",
        )
        axes.plot(np.degrees(alpha), radius, "o", color=COLOURS["ink"], ms=4, label="direct states")
        axes.legend()
    axes.set(
        xlabel="angle α up to which the wall is open (°)", ylabel="inner radius of the tube / $R_a$"
    )
    axes.set_title("Closure: the tube above the stone")
    tidy(axes)
    return figure


@in_style
def map_figure(found: Sequence[ClosureComparison]) -> Figure:
    """Error of each closure against direct over ξ, a panel for each η, friction by shade."""
    walls = sorted({each.case.wall_ratio for each in found})
    frictions = sorted({each.case.stone.friction for each in found})
    names = [name for name in CLOSURES if name not in ("direct",)]
    figure = new_figure(3.1 * len(walls) + 0.6, 2.0 * len(names) + 0.6)
    grid = figure.subplots(len(names), len(walls), sharex=True, sharey="row", squeeze=False)
    colours = [COLOURS[name] for name in ("green", "blue", "orange", "pink", "grey", "ink")]
    for i, name in enumerate(names):
        for j, eta in enumerate(walls):
            axes = grid[i, j]
            axes.axhline(0.0, color=COLOURS["grey"], linewidth=0.8)
            for k, mu in enumerate(frictions):
                mine = [
                    each
                    for each in found
                    if (each.case.wall_ratio, each.case.stone.friction) == (eta, mu)
                ]
                mine.sort(key=lambda each: each.case.size_ratio)
                errors = [each.error(name) for each in mine]
                axes.plot(
                    [each.case.size_ratio for each in mine],
                    [np.nan if e is None else 100.0 * e for e in errors],
                    marker="o",
                    markersize=2.5,
                    color=colours[k % len(colours)],
                    label=f"friction {mu:g}",
                )
            if i == 0:
                axes.set_title(f"η = {eta:.3g}")
            if j == 0:
                axes.set_ylabel(f"{name}\n(% of direct)")
            if i == len(names) - 1:
                axes.set_xlabel("size ratio ξ")
            tidy(axes)
    grid[0, -1].legend(fontsize=7)
    figure.suptitle(
        f"Critical pressure against the direct model: {found[0].case.ureter.material.name}"
    )
    return figure
