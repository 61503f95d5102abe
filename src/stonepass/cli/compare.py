"""``stonepass compare``: what CalculiX found for a deck, beside our own."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from stonepass.cli.options import BEAM_OPTIONS, Json, Settings, takes_settings

__all__ = ["command"]


@takes_settings("model", "wetted", "closure", "series_order", "pairs", *BEAM_OPTIONS)
def command(
    settings: Settings,
    results: Annotated[
        Path, typer.Option("--results", metavar="JOB.dat", help="What CalculiX wrote.")
    ],
    fine: Annotated[float | None, typer.Option("--fine", help="As it was exported.")] = None,
    json: Json = False,
    figure: Annotated[
        Path | None,
        typer.Option("--figure", metavar="C.svg", help="Draw both pressures (svg, png or pdf)."),
    ] = None,
) -> int:
    """Read CalculiX's results of an exported deck and put them beside our own.

    Give the case as it was exported. Exit code 0 where both have a critical pressure.
    """
    from stonepass.cli.terminal import FIGURES, print_json, show, warn, working, writable
    from stonepass.export.comparison import Comparison, compare
    from stonepass.export.results import read_contact
    from stonepass.export.seating import seating

    writable(figure, FIGURES)
    case = settings.case()
    contact = read_contact(seating(case, fine), results)
    with working("solving for the wall"):
        found = compare(case, contact)
    if not isinstance(found, Comparison):
        show(f"{found.outcome.name}: {found.message}")
        return 1
    from stonepass.report.compare_report import compare_figure, compare_record, compare_table

    if figure is not None:
        from stonepass.report.style import save

        save(compare_figure(found), figure)
    if json:
        print_json(compare_record(found))
    else:
        show(compare_table(found))
        warn(found.answer.warnings)
    return 0 if found.answer.outcome.answered and found.pressure is not None else 1
