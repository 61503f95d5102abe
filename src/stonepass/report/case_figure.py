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
from stonepass.report.balance import draw_balance
from stonepass.report.section import draw_section
from stonepass.report.stone import draw_radii
from stonepass.report.style import COLOURS, angle_label, in_style, new_figure, tidy

__all__ = ["case_figure"]


@in_style
def case_figure(answer: Answer) -> Figure:
    """Draw the seated wall above, contact pressure and force balance below."""
    seated = answer.contact
    if not isinstance(seated, SeatedState) or seated.wall is None:
        raise BadInput(
            "figure", answer.outcome.name, "asked for where there is a seated state to draw"
        )
    figure = new_figure(8.4, 6.6)
    rows = figure.add_gridspec(2, 2, height_ratios=(1.15, 1.0))
    _wall(figure.add_subplot(rows[0, :]), seated, seated.wall)
    _contact(figure.add_subplot(rows[1, 0]), answer, seated)
    _balance(figure.add_subplot(rows[1, 1]), answer, seated)
    return figure


def _wall(axes: Axes, seated: SeatedState, wall: Field) -> None:
    """The meridian section, upstream left, coloured by the radial compression of the wall."""
    case, alpha = seated.case, seated.contact_angle
    sides = (-1.0, 1.0) if case.stone.shape.symmetric else (1.0,)
    draw_section(axes, wall, case, seated.peak_contact_pressure, sides)
    draw_radii(axes, case, (alpha, seated.downstream_angle))
    axes.annotate(
        rf"$\alpha_0$ = {np.degrees(alpha):.1f}°",
        (-0.12 * case.size_ratio * case.stone.aspect, 0.0),
        ha="right",
        va="center",
    )
    axes.set_title("Seated stone: radial compression in the wall")


def _contact(axes: Axes, answer: Answer, seated: SeatedState) -> None:
    degrees, pressure = np.degrees(seated.theta), seated.contact_pressure / 1e3
    axes.fill_between(degrees, pressure, color=COLOURS["blue"], alpha=0.15, linewidth=0)
    axes.plot(degrees, pressure, color=COLOURS["blue"], label="pressure σ")
    if np.any(seated.friction_traction != 0.0):
        traction = np.abs(seated.friction_traction) / 1e3
        axes.plot(
            degrees, traction, color=COLOURS["grey"], linewidth=0.9, label="friction while seated"
        )
        axes.legend(fontsize=8, loc="center")
    if answer.critical_angle is not None:
        axes.axvline(np.degrees(answer.critical_angle), color=COLOURS["orange"], linewidth=1.0)
        axes.annotate(
            f"opens to {np.degrees(answer.critical_angle):.1f}°",
            (np.degrees(answer.critical_angle), 0.97),
            xycoords=("data", "axes fraction"),
            xytext=(-4, 0),
            textcoords="offset points",
            ha="right",
            va="top",
            color=COLOURS["orange"],
        )
    axes.set(
        xlabel=angle_label(sphere=answer.case.stone.shape.spherical),
        ylabel="stress on the stone (kPa)",
        ylim=(0, None),
    )
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
