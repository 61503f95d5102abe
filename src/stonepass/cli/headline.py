"""``stonepass headline``: the paper's two critical sizes, computed, beside the published ones."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from stonepass.about import DISCLAIMER
from stonepass.cli.options import Cache, NoCache, Workers, cache_folder

__all__ = ["command"]


def command(
    figure: Annotated[
        Path, typer.Option("--figure", metavar="OUT.svg", help="Where to draw it (svg, png, pdf).")
    ] = Path("headline.svg"),
    cache: Cache = None,
    no_cache: NoCache = False,
    workers: Workers = None,
) -> int:
    """Compute the paper's headline: critical sizes of the thin and the thick ureter at 12 kPa."""
    from stonepass.cli.terminal import FIGURES, counting, show, warn, writable
    from stonepass.paper.headline import Headline
    from stonepass.paper.headline_report import confining_table, headline_figure, headline_table
    from stonepass.report.style import save
    from stonepass.report.table import grouped_warnings
    from stonepass.studies.executor import CORES, process_pool
    from stonepass.studies.study import run_study

    writable(figure, FIGURES)
    folder = cache_folder(cache, no_cache)
    with process_pool(workers or CORES) as pool, counting("cases") as progress:
        walls = run_study(Headline(), pool, folder, progress)
    show(headline_table(walls), confining_table(walls), DISCLAIMER)
    for wall in walls:
        warn(grouped_warnings(wall.confined))
    save(headline_figure(walls), figure)
    show(f"Figure: {figure}")
    return 0 if all(wall.size.outcome.answered for wall in walls) else 1
