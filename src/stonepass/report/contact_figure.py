"""The picture of any contact: its pressure over the angle on the stone."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stonepass.model.answer import Answer
from stonepass.report.case_line import case_line
from stonepass.report.style import COLOURS, add_heading, angle_label, in_style, new_figure, tidy

__all__ = ["contact_figure", "draw_contact"]


@in_style
def contact_figure(answer: Answer) -> Figure:
    """Draw the contact pressure in kPa over θ from the upstream axis."""
    figure = new_figure(6.4, 4.0)
    add_heading(figure, case_line(answer.case, answer.model))
    axes = figure.add_subplot()
    draw_contact(axes, answer)
    axes.set_title("Contact pressure")
    return figure


def draw_contact(axes: Axes, answer: Answer) -> None:
    """Draw the contact pressure of an answer that has a contact, and label the axes."""
    contact = answer.contact
    assert contact is not None
    theta = np.linspace(contact.contact_angle, contact.downstream_angle, 400)
    pressure = contact.pressure_at(theta) / 1e3
    axes.fill_between(np.degrees(theta), pressure, color=COLOURS["blue"], alpha=0.15, linewidth=0)
    axes.plot(np.degrees(theta), pressure, color=COLOURS["blue"], label="contact pressure σ")
    axes.set(
        xlabel=angle_label(sphere=answer.case.stone.shape.spherical),
        ylabel="pressure on the stone (kPa)",
        ylim=(0, None),
    )
    tidy(axes)
