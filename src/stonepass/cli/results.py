"""``stonepass results``: the results of a sweep as tables and pictures."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from stonepass.cli.help import OUTPUT, QUESTION, epilog
from stonepass.cli.options import Json

__all__ = ["EPILOG", "command"]

EPILOG = epilog(
    (
        (
            "results study",
            "outcomes and quantiles of the critical pressure of a sweep",
        ),
        (
            "results study --csv study.csv --figure study.png",
            "the same, with all rows as CSV, and a picture of inputs and pressures",
        ),
    ),
    "0 the results were shown; 2 the request was refused; 3 an error of the program",
)


def command(
    folder: Annotated[
        Path,
        typer.Argument(
            metavar="DIR", help="Folder of the results of a sweep.", rich_help_panel=QUESTION
        ),
    ],
    csv: Annotated[
        Path | None,
        typer.Option(
            "--csv", metavar="F.csv", help="Write all rows as CSV.", rich_help_panel=OUTPUT
        ),
    ] = None,
    parquet: Annotated[
        Path | None,
        typer.Option(
            "--parquet",
            metavar="F.parquet",
            help="Write all rows as one parquet file.",
            rich_help_panel=OUTPUT,
        ),
    ] = None,
    netcdf: Annotated[
        Path | None,
        typer.Option(
            "--netcdf",
            metavar="F.nc",
            help="Write labelled arrays as netCDF; the axes of a grid become dimensions.",
            rich_help_panel=OUTPUT,
        ),
    ] = None,
    figure: Annotated[
        Path | None,
        typer.Option(
            "--figure",
            metavar="F.png",
            help="Draw histograms, pairs of inputs, and the critical pressure over each input "
            "(svg, png or pdf).",
            rich_help_panel=OUTPUT,
        ),
    ] = None,
    json: Json = False,
) -> int:
    """Show the results of a sweep: outcomes by model, critical pressures, and varied inputs.

    The sweep may still be running; its finished cases are then shown.
    """
    from stonepass.cli.terminal import FIGURES, print_json, show, warn, writable, wrote

    tables = (csv, parquet, netcdf)
    for path, ending in zip(tables, (".csv", ".parquet", ".nc"), strict=True):
        writable(path, (ending,))
    writable(figure, FIGURES)
    from stonepass.studies.sweeps.results import read_results

    found = read_results(folder)
    if json:
        from stonepass.records.sweep import sweep_record

        print_json(sweep_record(found).to_dict())
    else:
        from stonepass.report.sweep_report import sweep_sentences, sweep_tables, sweep_warnings

        show(*sweep_tables(found), *sweep_sentences(found))
        warn(sweep_warnings(found))
    for path in tables:
        if path is not None:
            found.save(path)
    if figure is not None:
        from stonepass.report.style import save
        from stonepass.report.sweep_figure import sweep_figure

        save(sweep_figure(found), figure)
    wrote(*tables, figure)
    return 0
