"""The headline as tables and a figure."""

from __future__ import annotations

from collections.abc import Sequence

from matplotlib.figure import Figure
from rich import box
from rich.table import Table

from stonepass.paper.headline import Wall
from stonepass.paper.inputs import FRICTION, LIMIT
from stonepass.paper.published import PUBLISHED_MARK, draw_critical_size
from stonepass.report.curve_figure import draw_curve, frame_curve
from stonepass.report.style import COLOURS, add_heading, in_style, new_figure, series

__all__ = ["confining_table", "headline_figure", "headline_table"]


def headline_table(walls: Sequence[Wall]) -> Table:
    """Return a table of the critical pressures of both walls and of their critical sizes."""
    table = Table(
        box=box.SIMPLE_HEAD,
        title=f"Critical pressure (kPa), human ureter, friction {FRICTION:g}",
        title_justify="left",
    )
    table.add_column("size ratio ξ", justify="right")
    for wall in walls:
        table.add_column(f"η = {wall.wall_ratio:.2f}", justify="right")
    for row in zip(*(wall.curve for wall in walls), strict=True):
        cells = [a.outcome.name if a.pressure is None else f"{a.pressure / 1e3:.2f}" for a in row]
        table.add_row(f"{row[0].case.size_ratio:.2f}", *cells)
    table.add_section()
    table.add_row(f"ξ_cr at {LIMIT / 1e3:g} kPa", *(_ratio(w.size.size_ratio) for w in walls))
    table.add_row("published", *(f"{wall.published:.2f}" for wall in walls))
    table.add_row("deviation", *(_ratio(wall.deviation, sign="+") for wall in walls))
    return table


def confining_table(walls: Sequence[Wall]) -> Table:
    """Return a table of the critical pressure under confining pressure at the published sizes."""
    table = Table(
        box=box.SIMPLE_HEAD,
        title="Critical pressure (kPa) under confining pressure, dead load",
        title_justify="left",
    )
    table.add_column("P_out", justify="right")
    for wall in walls:
        table.add_column(f"η = {wall.wall_ratio:.2f}, ξ = {wall.published:.2f}", justify="right")
        table.add_column("change", justify="right")
    for row in zip(*(wall.confined for wall in walls), strict=True):
        cells = [f"{row[0].case.load.confining_pressure / 1e3:g} kPa"]
        for answer, wall in zip(row, walls, strict=True):
            base = wall.confined[0].pressure
            if answer.pressure is None or base is None:
                cells += [answer.outcome.name, "–"]
            else:
                cells += [f"{answer.pressure / 1e3:.2f}", f"{(answer.pressure - base) / 1e3:+.2f}"]
        table.add_row(*cells)
    return table


@in_style
def headline_figure(walls: Sequence[Wall]) -> Figure:
    """Draw P_ucr(ξ) of both walls, the 12 kPa limit and the published critical sizes."""
    figure = new_figure(6.8, 4.8)
    first = walls[0].curve[0]
    material = first.case.ureter.material.name
    add_heading(figure, f"{material} · μ = {FRICTION:g} · model: {first.model.NAME}")
    axes = figure.add_subplot()
    limit = LIMIT / 1e3
    for k, (each, name) in enumerate(zip(walls, ("thin wall", "thick wall"), strict=True)):
        draw_curve(axes, each.curve, k, f"{name}, η = {each.wall_ratio:.1f}")
        draw_critical_size(axes, each.size.size_ratio, each.published, limit, series(k)["color"])
    axes.plot([], [], **PUBLISHED_MARK, label=r"published $\xi_{cr}$ (Liu et al. 2022)")
    axes.axhline(limit, color=COLOURS["grey"], linewidth=0.9, linestyle="--")
    axes.annotate(
        f"pressure limit {limit:g} kPa", (1.0, limit), xytext=(2, 4), textcoords="offset points",
        color=COLOURS["grey"], fontsize=8,
    )  # fmt: skip
    frame_curve(axes)
    axes.set_title("Critical pressure of a stone in the human ureter")
    axes.legend(loc="upper left", bbox_to_anchor=(0.0, 0.97))
    return figure


def _ratio(value: float | None, sign: str = "") -> str:
    return "–" if value is None else f"{value:{sign}.3f}"
