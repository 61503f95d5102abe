"""``stonepass headline``: the paper's two critical sizes, computed, beside the published ones."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated

import typer

from stonepass.about import DISCLAIMER

__all__ = ["command"]


def command(
    figure: Annotated[
        Path, typer.Option("--figure", metavar="OUT.svg", help="Where to draw it (svg, png, pdf).")
    ] = Path("headline.svg"),
) -> int:
    """Compute the paper's headline: critical sizes of the thin and the thick ureter at 12 kPa."""
    from stonepass.cli.terminal import FIGURES, counting, show, warn, writable
    from stonepass.paper.headline import headline
    from stonepass.paper.headline_report import confining_table, headline_figure, headline_table
    from stonepass.report.style import save
    from stonepass.report.table import grouped_warnings

    writable(figure, FIGURES)
    with counting("cases") as progress:
        walls = headline(progress, workers=os.cpu_count() or 1)
    save(headline_figure(walls), figure)
    show(headline_table(walls), confining_table(walls), f"Figure: {figure}", DISCLAIMER)
    for wall in walls:
        warn(grouped_warnings(wall.confined))
    return 0 if all(wall.size.outcome.answered for wall in walls) else 1
