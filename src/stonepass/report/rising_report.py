"""A held stone under rising urine pressure: table, figure and animation."""

from __future__ import annotations

import io
import math
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image
from rich import box
from rich.table import Table

from stonepass.errors import BadInput
from stonepass.io.text_file import write_file
from stonepass.model.energy_balance import advance_force
from stonepass.report.case_line import case_line
from stonepass.report.push_figure import draw_pressure, draw_wall
from stonepass.report.section import COLOUR_MAP, add_colour_bar, section_height
from stonepass.report.style import (
    COLOURS,
    add_heading,
    angle_label,
    in_style,
    new_figure,
    ordered_colours,
    series,
    tidy,
)
from stonepass.report.table import case_title, significant
from stonepass.studies.rising import Rising

__all__ = ["animation_frames", "rising_figure", "rising_table", "save_animation"]

NO_FORCE = 1e-2  # Pa; smaller forces are rounding errors and are shown as 0
CURVES = 5  # number of contact pressures that are drawn
FRAME, LAST_FRAME = 500, 2500  # durations in milliseconds
RESOLUTION = 90  # dots per inch
SHADES, OF_COMPRESSION = 256, 96  # colours of the palette, and those of the compression
NEARLY_WHITE = 248  # lighter colours become white, the background of the figure


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
    """Draw net force, opening, contact pressure, and its deviation from the seated state."""
    figure = new_figure(8.4, 6.8)
    add_heading(figure, case_line(rising.critical.case, rising.critical.model))
    grid = figure.subplots(2, 2)
    pressures = np.array([state.urine_pressure for state in rising.states]) / 1e3
    _force(grid[0, 0], rising, pressures)
    _opening(grid[0, 1], rising, pressures)
    _contact(grid[1, 0], rising)
    axes = grid[1, 1]
    axes.plot(pressures, 100.0 * rising.deviation, **series(0), ms=3)
    axes.set(xlabel="urine pressure (kPa)", ylabel="mean |σ − σ⁰| / mean σ⁰ (%)", ylim=(0.0, None))
    axes.set_title("Deviation of σ from the seated σ⁰")
    tidy(axes)
    return figure


def save_animation(rising: Rising, path: Path) -> None:
    """Write the states one after the other as a GIF that pauses at the last state.

    All frames have the same axes, the same scale of colours and the same palette.
    """
    if path.suffix.lower() != ".gif":
        raise BadInput("animation", str(path), "a file name ending in .gif")
    frames = animation_frames(rising)
    palette = _palette(frames)
    first, *others = (frame.quantize(palette=palette, dither=Image.Dither.NONE) for frame in frames)
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
def animation_frames(rising: Rising) -> list[Image.Image]:
    """Draw each state into the same axes."""
    top = max(state.peak_contact_pressure for state in rising.states)
    full = max(state.urine_pressure for state in rising.states)
    height = section_height([state.wall for state in rising.states if state.wall is not None])
    figure = new_figure(7.6, 6.2)
    figure.set_dpi(RESOLUTION)
    add_heading(figure, case_line(rising.critical.case, rising.critical.model))
    rows = figure.add_gridspec(2, 1, height_ratios=(1.3, 1.0))
    wall, pressure = figure.add_subplot(rows[0]), figure.add_subplot(rows[1])
    canvas = FigureCanvasAgg(figure)
    frames: list[Image.Image] = []
    for state in rising.states:
        for axes in (wall, pressure):
            axes.clear()
        image = draw_wall(wall, state, top, full, height)
        wall.set_title("A held stone: radial compression in the loaded wall")
        draw_pressure(pressure, state, None, top)
        if not frames:  # the layout is made once, so that axes and labels do not move
            add_colour_bar(wall, image)
            figure.draw_without_rendering()
            figure.set_layout_engine("none")
        canvas.draw()  # type: ignore[no-untyped-call]
        pixels: Any = canvas.buffer_rgba()  # type: ignore[no-untyped-call]
        frames.append(Image.fromarray(np.array(pixels)).convert("RGB"))
    return frames


def _palette(frames: list[Image.Image]) -> Image.Image:
    """Return a palette of white, the colours of the compression, and those of three frames."""
    chosen = [frames[0], frames[len(frames) // 2], frames[-1]]
    width, height = frames[0].size
    together = Image.new("RGB", (width, len(chosen) * height))
    for k, frame in enumerate(chosen):
        together.paste(frame, (0, k * height))
    found = together.quantize(SHADES - OF_COMPRESSION, method=Image.Quantize.MEDIANCUT)
    shades = np.array(found.getpalette()).reshape(-1, 3)[: SHADES - OF_COMPRESSION]
    shades[shades.min(axis=1) > NEARLY_WHITE] = 255
    scale = colormaps[COLOUR_MAP](np.linspace(0.0, 1.0, OF_COMPRESSION), bytes=True)[:, :3]
    found.putpalette(np.concatenate([shades, scale]).ravel().tolist())
    return found


def _force(axes: Axes, rising: Rising, pressures: np.ndarray) -> None:
    case = rising.critical.case
    forces = [state.net_force / 1e3 for state in rising.states]
    axes.axhline(0.0, color=COLOURS["grey"], linewidth=0.8)
    axes.plot(pressures, forces, **series(0), ms=4, label="by integration over the stone")
    gained = [advance_force(case, state.urine_pressure) for state in rising.states]
    work = [state.friction_work for state in rising.states]
    balance = [
        np.nan if gain is None else (gain - lost) / 1e3
        for gain, lost in zip(gained, work, strict=True)
    ]
    axes.plot(pressures, balance, **series(1, marker=False), lw=1.2,
              label="by the energy balance")  # fmt: skip
    if rising.critical.pressure:
        critical = rising.critical.pressure / 1e3
        axes.axvline(critical, color=COLOURS["ink"], lw=1.0, ls=":")
        axes.annotate(f"$P_{{ucr}}$ = {critical:.4g} kPa", (critical, 0.04), rotation=90,
                      xycoords=("data", "axes fraction"), xytext=(-3, 0), ha="right", va="bottom",
                      textcoords="offset points", fontsize=8)  # fmt: skip
    axes.set(xlabel="urine pressure (kPa)", ylabel=r"net force / ($\pi R_s^2$)  (kPa)")
    axes.set_title("Force on the held stone, positive downstream")
    axes.legend(loc="upper left", bbox_to_anchor=(0.0, 0.92))
    tidy(axes)


def _opening(axes: Axes, rising: Rising, pressures: np.ndarray) -> None:
    for k, (name, angles) in enumerate(
        (
            ("contact begins", [s.contact_angle for s in rising.states]),
            ("seal", [s.seal_angle for s in rising.states]),
            ("contact ends", [s.downstream_angle for s in rising.states]),
        )
    ):
        axes.plot(pressures, np.degrees(angles), **series(k), ms=4)
        axes.annotate(name, (pressures[-1], np.degrees(angles[-1])), xytext=(0, 6), ha="right",
                      textcoords="offset points", color=series(k)["color"])  # fmt: skip
    axes.margins(y=0.12)
    shape = rising.critical.case.stone.shape
    axes.set(xlabel="urine pressure (kPa)", ylabel=angle_label(sphere=shape.spherical))
    axes.set_title("Where wall and stone touch")
    tidy(axes)


def _contact(axes: Axes, rising: Rising) -> None:
    chosen = np.unique(np.linspace(0, len(rising.states) - 1, CURVES).round().astype(int))
    for colour, k in zip(ordered_colours(len(chosen))[::-1], chosen, strict=True):
        state = rising.states[k]
        axes.plot(
            np.degrees(state.theta),
            state.contact_pressure / 1e3,
            color=colour,
            label=f"$P_u$ = {state.urine_pressure / 1e3:.3g} kPa",
        )
    if rising.seated is not None:
        theta = np.linspace(rising.seated.contact_angle, rising.seated.downstream_angle, 400)
        axes.plot(
            np.degrees(theta),
            rising.seated.pressure_at(theta) / 1e3,
            color=COLOURS["ink"],
            linestyle="--",
            linewidth=1.0,
            label="seated (paper), σ⁰",
        )
    axes.set(
        xlabel=angle_label(sphere=rising.critical.case.stone.shape.spherical),
        ylabel="contact pressure (kPa)",
        ylim=(0, None),
    )
    axes.set_title("Contact pressure")
    axes.legend(fontsize=7, loc="lower center")
    tidy(axes)
