"""The picture of the beam model: sphere and deflected wall, contact pressure, balance of forces."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stonepass.errors import BadInput
from stonepass.model.answer import Answer
from stonepass.model.models.elastic_foundation import BeamState
from stonepass.report.balance import draw_balance
from stonepass.report.stone import draw_radii, draw_stone
from stonepass.report.style import COLOURS, in_style, new_figure, tidy

__all__ = ["beam_figure"]


@in_style
def beam_figure(answer: Answer) -> Figure:
    """Draw the wall as a beam above, contact pressure and force balance below."""
    beam = answer.contact
    if not isinstance(beam, BeamState):
        raise BadInput("figure", answer.outcome.name, "asked for where there is a contact to draw")
    figure = new_figure(8.4, 6.2)
    rows = figure.add_gridspec(2, 2, height_ratios=(1.1, 1.0))
    _wall(figure.add_subplot(rows[0, :]), beam)
    _contact(figure.add_subplot(rows[1, 0]), answer, beam)
    _balance(figure.add_subplot(rows[1, 1]), answer, beam)
    return figure


def _wall(axes: Axes, beam: BeamState) -> None:
    """Sphere, and the beam as a point load deflects it: δ e^(−βz) (cos βz + sin βz)."""
    xi, h = beam.case.size_ratio, beam.case.wall_ratio - 1.0
    z = np.linspace(-4.0, 4.0, 801)
    phase = beam.decay * np.abs(z)
    lift = (xi - 1.0) * np.exp(-phase) * (np.cos(phase) + np.sin(phase))
    for half in (1.0, -1.0):
        axes.fill_between(
            z, half * (1.0 + lift), half * (1.0 + h + lift), color=COLOURS["blue"], alpha=0.25, lw=0
        )
        axes.plot(z, half * (1.0 + lift), color=COLOURS["blue"], linewidth=1.2)
    draw_stone(axes, beam.case)
    draw_radii(axes, beam.case, (beam.contact_angle, beam.downstream_angle))
    axes.set(xlim=(-4.0, 4.0), ylim=(-1.15 * (xi + h), 1.15 * (xi + h)), aspect="equal")
    axes.set(xlabel="z / inner radius   (urine comes from the left)", ylabel="r / inner radius")
    axes.set_title("The wall as a beam on springs, deflected by a point load")
    axes.spines[["top", "right"]].set_visible(False)


def _contact(axes: Axes, answer: Answer, beam: BeamState) -> None:
    theta = np.linspace(beam.contact_angle, beam.downstream_angle, 400)
    pressure = beam.pressure_at(theta) / 1e3
    axes.fill_between(np.degrees(theta), pressure, color=COLOURS["blue"], alpha=0.15, linewidth=0)
    axes.plot(np.degrees(theta), pressure, color=COLOURS["blue"])
    if answer.critical_angle is not None:
        axes.axvline(np.degrees(answer.critical_angle), color=COLOURS["orange"], linewidth=1.0)
    axes.set(
        xlabel="θ from the upstream axis (°)", ylabel="pressure on the stone (kPa)", ylim=(0, None)
    )
    axes.set_title("Contact pressure (Hertz)")
    tidy(axes)


def _balance(axes: Axes, answer: Answer, beam: BeamState) -> None:
    xi = beam.case.size_ratio
    alpha = np.linspace(beam.contact_angle, np.pi / 2, 300)
    y = np.minimum(xi * np.cos(alpha), beam.half_length)
    push = beam.urine_pressure(y) * (1.0 - (y / xi) ** 2)
    draw_balance(axes, answer, alpha, beam.friction(y) / (np.pi * xi**2), push)
