"""Table and figure that compare CalculiX and stonepass for one case."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure
from rich import box
from rich.table import Table

from stonepass.export.comparison import DeckComparison
from stonepass.report.case_line import case_line
from stonepass.report.style import (
    COLOURS,
    add_heading,
    angle_label,
    in_style,
    new_figure,
    series,
    tidy,
)
from stonepass.report.table import case_title, significant

__all__ = ["compare_figure", "compare_table"]

KPA = 1e3


def compare_table(found: DeckComparison) -> Table:
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
def compare_figure(found: DeckComparison) -> Figure:
    """Draw the contact pressure of both programs over the angle."""
    figure = new_figure(6.4, 4.0)
    add_heading(figure, case_line(found.answer.case, found.answer.model))
    axes = figure.add_subplot()
    error = found.answer.error
    if error is not None:
        degrees, pressure = np.degrees(found.seated.theta), found.seated.contact_pressure / KPA
        off = error.equator_contact_pressure / KPA
        axes.fill_between(degrees, np.maximum(pressure - off, 0.0), pressure + off, linewidth=0,
                          color=COLOURS["blue"], alpha=0.25,
                          label=f"± discretisation error at 90°, {off:.2g} kPa")  # fmt: skip
    for k, (contact, label) in enumerate(
        ((found.seated, "stonepass"), (found.contact, "CalculiX"))
    ):
        axes.plot(np.degrees(contact.theta), contact.contact_pressure / KPA,
                  **series(k, marker=False), label=label)  # fmt: skip
    axes.set(
        xlabel=angle_label(sphere=found.answer.case.stone.shape.spherical),
        ylabel="contact pressure (kPa)",
        ylim=(0.0, None),
    )
    axes.set_title("Contact pressure of the seated stone, by both programs")
    axes.legend(loc="lower center")
    tidy(axes)
    return figure
