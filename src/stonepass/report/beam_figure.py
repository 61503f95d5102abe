"""The picture of the beam model: sphere and deflected wall, contact pressure, balance of forces."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stonepass.errors import BadInput
from stonepass.model.answer import Answer
from stonepass.model.models.elastic_foundation import BeamState
from stonepass.report.balance import draw_balance, draw_critical_angle
from stonepass.report.case_line import case_line, length_unit
from stonepass.report.stone import draw_radii, draw_stone, frame_section, mark_angle
from stonepass.report.style import (
    COLOURS,
    add_heading,
    angle_label,
    in_style,
    new_figure,
    series,
    tidy,
)

__all__ = ["beam_figure"]

EXTENT = 3.4  # drawn to each side of the stone's centre, in radii of the stone
NOTE = """Blue: the wall deflected by a point load,
to scale. This curve cuts into the stone,
since a point load has no length. The
contact (dashed) is that of Hertz."""


@in_style
def beam_figure(answer: Answer) -> Figure:
    """Draw the wall as a beam above, contact pressure and force balance below."""
    beam = answer.contact
    if not isinstance(beam, BeamState):
        raise BadInput("figure", answer.outcome.name, "asked for where there is a contact to draw")
    figure = new_figure(8.4, 6.6)
    add_heading(figure, case_line(answer.case, answer.model))
    rows = figure.add_gridspec(2, 2, height_ratios=(1.1, 1.0))
    _wall(figure.add_subplot(rows[0, :]), beam)
    _contact(figure.add_subplot(rows[1, 0]), answer, beam)
    _balance(figure.add_subplot(rows[1, 1]), answer, beam)
    return figure


def _wall(axes: Axes, beam: BeamState) -> None:
    """Draw the sphere and the deflection under a point load, δ e^(−βz) (cos βz + sin βz)."""
    xi, h = beam.case.size_ratio, beam.case.wall_ratio - 1.0
    scale = length_unit(beam.case)[0]
    extent = EXTENT * xi * scale
    z = np.linspace(-EXTENT * xi, EXTENT * xi, 801)
    phase = beam.decay * np.abs(z)
    lift = (xi - 1.0) * np.exp(-phase) * (np.cos(phase) + np.sin(phase))
    inner, outer = scale * (1.0 + lift), scale * (1.0 + h + lift)
    draw_stone(axes, beam.case)
    for half in (1.0, -1.0):
        axes.fill_between(scale * z, half * inner, half * outer, color=COLOURS["blue"], alpha=0.25,
                          linewidth=0)  # fmt: skip
        axes.plot(scale * z, half * inner, color=COLOURS["blue"], linewidth=1.2)
        axes.plot(scale * z, half * outer, color=COLOURS["blue"], linewidth=0.7)
    axes.annotate(NOTE, (0.98 * extent, 0.0), ha="right", va="center", fontsize=7.5)
    draw_radii(axes, beam.case, (beam.contact_angle, beam.downstream_angle))
    mark_angle(axes, beam.case, beam.contact_angle, r"$\alpha_0$")
    frame_section(axes, beam.case, extent, 1.15 * scale * (xi + h))
    axes.set_title("The wall as a beam on springs")


def _contact(axes: Axes, answer: Answer, beam: BeamState) -> None:
    theta = np.linspace(beam.contact_angle, beam.downstream_angle, 400)
    pressure = beam.pressure_at(theta) / 1e3
    axes.fill_between(np.degrees(theta), pressure, color=COLOURS["blue"], alpha=0.15, linewidth=0)
    axes.plot(np.degrees(theta), pressure, **series(0, marker=False),
              label="contact pressure σ")  # fmt: skip
    draw_critical_angle(axes, answer, pressure.max())
    axes.set(xlabel=angle_label(sphere=True), ylabel="stress on the stone (kPa)",
             ylim=(0, 1.3 * pressure.max()))  # fmt: skip
    axes.legend(loc="upper center")
    axes.set_title("Contact pressure (Hertz)")
    tidy(axes)


def _balance(axes: Axes, answer: Answer, beam: BeamState) -> None:
    xi = beam.case.size_ratio
    alpha = np.linspace(beam.contact_angle, np.pi / 2, 300)
    y = np.minimum(xi * np.cos(alpha), beam.half_length)
    push = beam.urine_pressure(y) * (1.0 - (y / xi) ** 2)
    draw_balance(axes, answer, alpha, beam.friction(y) / (np.pi * xi**2), push)
