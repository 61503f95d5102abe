"""Results of CalculiX and of stonepass for the same case: table and figure."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure
from rich import box
from rich.table import Table

from stonepass.export.comparison import Comparison
from stonepass.report.style import COLOURS, angle_label, in_style, new_figure, tidy
from stonepass.report.table import case_title, significant

__all__ = ["compare_figure", "compare_table"]

KPA = 1e3


def compare_table(found: Comparison) -> Table:
    """Return a table of the numbers of both programs and their relative differences."""
    table = Table(box=box.SIMPLE_HEAD, title=case_title(found.answer.case))
    table.add_column("")
    for name in ("stonepass", "discretisation error", "CalculiX", "difference"):
        table.add_column(name, justify="right")
    ours, theirs, error = found.seated, found.contact, found.answer.error
    angle = np.degrees(ours.contact_angle), np.degrees(theirs.contact_angle)
    table.add_row(
        "contact angle",
        f"{angle[0]:.2f}°",
        "" if error is None else f"{np.degrees(error.contact_angle):.2f}°",
        f"{angle[1]:.2f}°",
        f"{angle[1] - angle[0]:+.2f}°",
    )
    rows = (
        (
            "contact pressure, 90°",
            ours.equator_contact_pressure,
            None if error is None else error.equator_contact_pressure,
            theirs.equator_contact_pressure,
        ),
        (
            "critical pressure",
            found.answer.pressure,
            None if error is None else error.critical_pressure,
            found.pressure,
        ),
    )
    for name, mine, uncertain, other in rows:
        table.add_row(
            name,
            *(_kpa(value) for value in (mine, uncertain, other)),
            f"{other / mine - 1.0:+.2%}" if mine and other is not None else "–",
        )
    return table


def _kpa(pressure: float | None) -> str:
    return "–" if pressure is None else f"{significant(pressure / KPA)} kPa"


@in_style
def compare_figure(found: Comparison) -> Figure:
    """Draw the contact pressure of both programs over the angle."""
    figure = new_figure(6.4, 3.6)
    axes = figure.add_subplot()
    for contact, colour, label, width in (
        (found.seated, COLOURS["blue"], "stonepass", 1.8),
        (found.contact, COLOURS["orange"], "CalculiX", 1.2),
    ):
        axes.plot(np.degrees(contact.theta), contact.contact_pressure / KPA, color=colour,
                  label=label, linewidth=width)  # fmt: skip
    axes.set(
        xlabel=angle_label(sphere=found.answer.case.stone.shape.spherical),
        ylabel="contact pressure in kPa",
        ylim=(0.0, None),
    )
    axes.legend()
    tidy(axes)
    return figure
