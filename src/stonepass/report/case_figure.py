"""The picture of one case: the seated wall, its contact pressure, the balance of forces."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stonepass.errors import BadInput
from stonepass.fe.axisymmetric.wall_values import Field
from stonepass.model.answer import Answer
from stonepass.model.force_balance import drive, resistance
from stonepass.model.models.seated_balance import SeatedBalance, SeatedBalanceDetail
from stonepass.model.states.seated_state import SeatedState
from stonepass.report.balance import draw_balance, draw_critical_angle
from stonepass.report.case_line import case_line
from stonepass.report.section import add_colour_bar, draw_section
from stonepass.report.stone import draw_radii, mark_angle
from stonepass.report.style import (
    COLOURS,
    add_heading,
    angle_label,
    in_style,
    new_figure,
    series,
    tidy,
)

__all__ = ["case_figure"]


@in_style
def case_figure(answer: Answer) -> Figure:
    """Draw the seated wall above, contact pressure and force balance below."""
    seated = answer.contact
    if not isinstance(seated, SeatedState) or seated.wall is None:
        raise BadInput(
            "figure", answer.outcome.name, "asked for where there is a seated state to draw"
        )
    figure = new_figure(8.4, 6.8)
    add_heading(figure, case_line(answer.case, answer.model))
    rows = figure.add_gridspec(2, 2, height_ratios=(1.15, 1.0))
    _wall(figure.add_subplot(rows[0, :]), seated, seated.wall)
    _contact(figure.add_subplot(rows[1, 0]), answer, seated)
    _balance(figure.add_subplot(rows[1, 1]), answer, seated)
    return figure


def _wall(axes: Axes, seated: SeatedState, wall: Field) -> None:
    """Draw the meridian section, upstream left, coloured by the radial compression."""
    case, alpha = seated.case, seated.contact_angle
    sides = (-1.0, 1.0) if case.stone.shape.symmetric else (1.0,)
    add_colour_bar(axes, draw_section(axes, wall, case, seated.peak_contact_pressure, sides))
    draw_radii(axes, case, (alpha, seated.downstream_angle))
    mark_angle(axes, case, alpha, r"$\alpha_0$")
    axes.set_title("Seated stone: radial compression in the wall")


def _contact(axes: Axes, answer: Answer, seated: SeatedState) -> None:
    degrees, pressure = np.degrees(seated.theta), seated.contact_pressure / 1e3
    axes.fill_between(degrees, pressure, color=COLOURS["blue"], alpha=0.15, linewidth=0)
    axes.plot(degrees, pressure, **series(0, marker=False), label="contact pressure σ")
    if np.any(seated.friction_traction != 0.0):
        axes.plot(degrees, np.abs(seated.friction_traction) / 1e3, color=COLOURS["ink"],
                  linestyle=":", linewidth=1.2,
                  label="friction while seated (kinks: load increments)")  # fmt: skip
    draw_critical_angle(axes, answer, pressure.max())
    axes.set(
        xlabel=angle_label(sphere=answer.case.stone.shape.spherical),
        ylabel="stress on the stone (kPa)",
        ylim=(0, 1.42 * pressure.max()),  # the legend stands above the curves
    )
    axes.legend(loc="upper center")
    axes.set_title("Contact pressure")
    tidy(axes)


def _balance(axes: Axes, answer: Answer, seated: SeatedState) -> None:
    model, detail = answer.model, answer.detail
    assert isinstance(model, SeatedBalance)
    assert isinstance(detail, SeatedBalanceDetail)
    forces = resistance(seated, as_printed=model.as_printed)
    alpha = np.linspace(seated.contact_angle, np.pi / 2, 300)
    opened = np.asarray(detail.closure.pressure(seated, alpha))
    push = drive(opened, seated.case.stone.shape.width(alpha))
    draw_balance(axes, answer, alpha, forces.total(alpha), push, forces.friction(alpha))
