"""``stonepass compare``: results of CalculiX and of stonepass for the same case."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from stonepass.cli.help import OUTPUT, QUESTION, epilog
from stonepass.cli.options import Cache, Json, NoCache, Settings, cache_folder, takes_settings
from stonepass.export.checks import checked_value
from stonepass.export.input_options import FINE
from stonepass.export.words import as_flag

__all__ = ["EPILOG", "command"]

EPILOG = epilog(
    (
        (
            "export --xi 1.2 --eta 1.5 --material latex --out case.inp",
            "first: write the input deck, and run it with 'ccx case'",
        ),
        (
            "compare --xi 1.2 --eta 1.5 --material latex --results case.dat",
            "then: compare contact angle, contact pressure and critical pressure",
        ),
    ),
    "0 both programs have a critical pressure; 1 one of them has none; 2 the request was refused; "
    "3 an error of the program",
)


@takes_settings("method.closure", "method.series_order", "method.opening_curve", models=("paper",))
def command(
    settings: Settings,
    results: Annotated[
        Path,
        typer.Option(
            "--results",
            metavar="JOB.dat",
            help="File of results that CalculiX wrote.",
            rich_help_panel=QUESTION,
        ),
    ],
    fine: Annotated[
        float | None,
        typer.Option(
            "--fine",
            metavar="NUMBER",
            help="The value of --fine that was used for the export.",
            rich_help_panel=QUESTION,
        ),
    ] = None,
    json: Json = False,
    figure: Annotated[
        Path | None,
        typer.Option(
            "--figure",
            metavar="C.svg",
            help="Draw the contact pressures of both programs (svg, png or pdf).",
            rich_help_panel=OUTPUT,
        ),
    ] = None,
    cache: Cache = None,
    no_cache: NoCache = False,
) -> int:
    """Compare the results of CalculiX for an exported input deck with those of stonepass.

    Give the same case as for the export.
    """
    from stonepass.cli.terminal import FIGURES, print_json, show, warn, working, writable, wrote
    from stonepass.export.comparison import DeckComparison, compare
    from stonepass.export.results import read_contact
    from stonepass.export.seating import seating
    from stonepass.studies.jobs import state_solver

    writable(figure, FIGURES)
    case = settings.case()
    mesh = None if fine is None else checked_value(FINE, fine, as_flag)
    contact = read_contact(seating(case, mesh), results)
    with working("solving the finite-element model"):
        found = compare(case, contact, state_solver(cache_folder(cache, no_cache)))
    if not isinstance(found, DeckComparison):
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
        wrote(figure)
    return 0 if found.answer.outcome.answered and found.pressure is not None else 1
