"""``stonepass headline``: the two critical sizes that the paper reports, computed here."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from stonepass.about import DISCLAIMER
from stonepass.cli.help import OUTPUT, epilog
from stonepass.cli.options import Cache, NoCache, Workers, cache_folder

__all__ = ["EPILOG", "command"]

EPILOG = epilog(
    (("headline --figure headline.svg", "both critical sizes beside the published ones"),)
)


def command(
    figure: Annotated[
        Path,
        typer.Option(
            "--figure",
            metavar="OUT.svg",
            help="Figure to write (svg, png or pdf).",
            rich_help_panel=OUTPUT,
        ),
    ] = Path("headline.svg"),
    cache: Cache = None,
    no_cache: NoCache = False,
    workers: Workers = None,
) -> int:
    """Compute the two critical sizes that the paper reports.

    They are those of the thinnest and of the thickest ureter at a urine pressure of 12 kPa. The
    cases are solved in parallel.
    """
    from stonepass.cli.durations import estimated_seconds
    from stonepass.cli.terminal import FIGURES, announce, counting, show, warn, writable, wrote
    from stonepass.paper.headline import Headline
    from stonepass.paper.headline_report import confining_table, headline_figure, headline_table
    from stonepass.report.style import save
    from stonepass.report.table import grouped_warnings
    from stonepass.studies.executor import CORES, process_pool
    from stonepass.studies.study import run_study

    writable(figure, FIGURES)
    folder = cache_folder(cache, no_cache)
    count = workers or CORES
    study = Headline()
    what = f"solving {len(study.jobs())} cases on {count} {'core' if count == 1 else 'cores'}"
    announce(what, estimated_seconds(study.jobs(), count), remembers=not no_cache)
    with process_pool(count) as pool, counting("solving the cases") as progress:
        walls = run_study(study, pool, folder, progress)
    show(headline_table(walls), confining_table(walls), DISCLAIMER)
    for wall in walls:
        warn(grouped_warnings(wall.confined))
    save(headline_figure(walls), figure)
    wrote(figure)
    return 0 if all(wall.size.outcome.answered for wall in walls) else 1
