"""``stonepass compare``: the results of CalculiX for an input deck, beside our own."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from stonepass.cli.options import Json, Settings, takes_settings
from stonepass.export.checks import checked_value
from stonepass.export.input_options import FINE
from stonepass.export.words import as_flag

__all__ = ["command"]


@takes_settings("method.closure", "method.series_order", "method.opening_curve", models=("paper",))
def command(
    settings: Settings,
    results: Annotated[
        Path, typer.Option("--results", metavar="JOB.dat", help="Results that CalculiX wrote.")
    ],
    fine: Annotated[
        float | None, typer.Option("--fine", help="The value of --fine of the export.")
    ] = None,
    json: Json = False,
    figure: Annotated[
        Path | None,
        typer.Option("--figure", metavar="C.svg", help="Draw both pressures (svg, png or pdf)."),
    ] = None,
) -> int:
    """Read the results of CalculiX for an exported input deck and put them beside our own.

    Give the same case as for the export. Exit code 0 where both have a critical pressure.
    """
    from stonepass.cli.terminal import FIGURES, print_json, show, warn, working, writable
    from stonepass.export.comparison import Comparison, compare
    from stonepass.export.results import read_contact
    from stonepass.export.seating import seating

    writable(figure, FIGURES)
    case = settings.case()
    mesh = None if fine is None else checked_value(FINE, fine, as_flag)
    contact = read_contact(seating(case, mesh), results)
    with working("solving for the wall"):
        found = compare(case, contact)
    if not isinstance(found, Comparison):
        show(f"{found.outcome.name}: {found.message}")
        return 1
    from stonepass.records.compare import compare_record
    from stonepass.report.compare_report import compare_figure, compare_table

    if json:
        print_json(compare_record(found).to_dict())
    else:
        show(compare_table(found))
        warn(found.answer.warnings)
    if figure is not None:
        from stonepass.report.style import save

        save(compare_figure(found), figure)
    return 0 if found.answer.outcome.answered and found.pressure is not None else 1
