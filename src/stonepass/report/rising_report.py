"""A held stone under rising urine pressure: table, figure and animation."""

from __future__ import annotations

import io
import math
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image
from rich import box
from rich.table import Table

from stonepass.errors import BadInput
from stonepass.io.text_file import write_file
from stonepass.model.energy_balance import advance_force
from stonepass.model.states.loaded_state import PushedState
from stonepass.report.push_figure import draw_pressure, draw_wall
from stonepass.report.style import COLOURS, angle_label, in_style, new_figure, tidy
from stonepass.report.table import case_title, significant
from stonepass.studies.rising import Rising

__all__ = ["rising_figure", "rising_table", "save_animation"]

NO_FORCE = 1e-2  # Pa; less than the solver tells from none
CURVES = 5  # contact pressures drawn
FRAME, LAST_FRAME = 170, 1500  # milliseconds
RESOLUTION = 90  # dots per inch


def rising_table(rising: Rising) -> Table:
    """Return a table of a held stone with one row for each urine pressure."""
    table = Table(box=box.SIMPLE_HEAD, title=case_title(rising.critical.case), title_justify="left")
    for name in (
        "urine kPa",
        "net force kPa",
        "contact",
        "seal",
        "peak kPa",
        "upstream radius ratio",
        "deviation from seated",
    ):
        table.add_column(name, justify="right")
    for state, deviation in zip(rising.states, rising.deviation, strict=True):
        table.add_row(
            significant(state.urine_pressure / 1e3),
            significant(0.0 if abs(state.net_force) < NO_FORCE else state.net_force / 1e3),
            f"{math.degrees(state.contact_angle):.1f}–{math.degrees(state.downstream_angle):.1f}°",
            f"{math.degrees(state.seal_angle):.1f}°",
            significant(state.peak_contact_pressure / 1e3),
            f"{state.upstream_radius:.4f}",
            "–" if math.isnan(deviation) else f"{deviation:.0%}",
        )
    return table


@in_style
def rising_figure(rising: Rising) -> Figure:
    """Net force, opening, contact pressure against the seated one, and how far it deviates."""
    figure = new_figure(8.4, 6.4)
    grid = figure.subplots(2, 2)
    pressures = np.array([state.urine_pressure for state in rising.states]) / 1e3
    _force(grid[0, 0], rising, pressures)
    _opening(grid[0, 1], rising, pressures)
    _contact(grid[1, 0], rising)
    axes = grid[1, 1]
    axes.plot(pressures, 100.0 * rising.deviation, "o-", color=COLOURS["blue"], ms=3)
    axes.set(xlabel="urine pressure (kPa)", ylabel="mean deviation (%)", ylim=(0.0, None))
    axes.set_title("How far σ is from the seated σ⁰")
    tidy(axes)
    return figure


def save_animation(rising: Rising, path: Path) -> None:
    """Write the states one after the other as a GIF that stays on the last."""
    if path.suffix.lower() != ".gif":
        raise BadInput("animation", str(path), "a file name ending in .gif")
    top = max(state.peak_contact_pressure for state in rising.states)
    first, *others = (_frame(state, top) for state in rising.states)
    drawn = io.BytesIO()
    first.save(
        drawn,
        format="gif",
        save_all=True,
        append_images=others,
        duration=[FRAME] * len(others) + [LAST_FRAME],
        loop=0,
    )
    write_file(path, drawn.getvalue(), "animation")


@in_style
def _frame(state: PushedState, top: float) -> Image.Image:
    figure = new_figure(7.6, 6.0)
    rows = figure.add_gridspec(2, 1, height_ratios=(1.3, 1.0))
    wall, pressure = figure.add_subplot(rows[0]), figure.add_subplot(rows[1])
    draw_wall(wall, state, top)
    wall.set_title("A held stone: radial compression in the loaded wall")
    draw_pressure(pressure, state, None)
    pressure.set_ylim(0.0, 1.05 * top / 1e3)
    figure.set_dpi(RESOLUTION)
    canvas = FigureCanvasAgg(figure)
    canvas.draw()  # type: ignore[no-untyped-call]
    pixels: Any = canvas.buffer_rgba()  # type: ignore[no-untyped-call]
    return Image.fromarray(np.asarray(pixels)).convert("RGB").quantize()


def _force(axes: Axes, rising: Rising, pressures: np.ndarray) -> None:
    case = rising.critical.case
    forces = [state.net_force / 1e3 for state in rising.states]
    axes.axhline(0.0, color=COLOURS["grey"], linewidth=0.8)
    axes.plot(pressures, forces, "o-", color=COLOURS["blue"], ms=3, label="net force N")
    gained = [advance_force(case, state.urine_pressure) for state in rising.states]
    work = [state.friction_work for state in rising.states]
    balance = [
        np.nan if gain is None else (gain - lost) / 1e3
        for gain, lost in zip(gained, work, strict=True)
    ]
    axes.plot(pressures, balance, color=COLOURS["orange"], lw=1.0, ls="--", label="I − D, energy")
    if rising.critical.pressure:
        axes.axvline(rising.critical.pressure / 1e3, color=COLOURS["grey"], lw=0.8, ls=":")
    axes.set(xlabel="urine pressure (kPa)", ylabel=r"force / ($\pi R_s^2$)  (kPa)")
    axes.set_title("Force on the stone")
    axes.legend(fontsize=8)
    tidy(axes)


def _opening(axes: Axes, rising: Rising, pressures: np.ndarray) -> None:
    for name, colour, angles in (
        ("contact begins", COLOURS["blue"], [s.contact_angle for s in rising.states]),
        ("seal", COLOURS["orange"], [s.seal_angle for s in rising.states]),
        ("contact ends", COLOURS["green"], [s.downstream_angle for s in rising.states]),
    ):
        axes.plot(pressures, np.degrees(angles), "o-", color=colour, ms=3, label=name)
    axes.set(xlabel="urine pressure (kPa)", ylabel="θ (°)")
    axes.set_title("Where wall and stone touch")
    axes.legend(fontsize=8)
    tidy(axes)


def _contact(axes: Axes, rising: Rising) -> None:
    chosen = np.unique(np.linspace(0, len(rising.states) - 1, CURVES).round().astype(int))
    for share, k in zip(np.linspace(0.25, 1.0, len(chosen)), chosen, strict=True):
        state = rising.states[k]
        axes.plot(
            np.degrees(state.theta),
            state.contact_pressure / 1e3,
            color=COLOURS["blue"],
            alpha=float(share),
            label=f"{state.urine_pressure / 1e3:.3g} kPa",
        )
    if rising.seated is not None:
        theta = np.linspace(rising.seated.contact_angle, rising.seated.downstream_angle, 400)
        axes.plot(
            np.degrees(theta),
            rising.seated.pressure_at(theta) / 1e3,
            color=COLOURS["ink"],
            linestyle="--",
            linewidth=1.0,
            label="seated, σ⁰",
        )
    axes.set(
        xlabel=angle_label(sphere=rising.critical.case.stone.shape.spherical),
        ylabel="contact pressure (kPa)",
        ylim=(0, None),
    )
    axes.set_title("Contact pressure")
    axes.legend(fontsize=7)
    tidy(axes)
