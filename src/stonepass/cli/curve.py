"""``stonepass curve``: critical pressure over a range of size ratios."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated

import typer

from stonepass.cli.options import Json, Settings, takes_settings
from stonepass.errors import BadInput

__all__ = ["command", "size_range"]

MOST_POINTS = 10_000


@takes_settings("stone", "xi")
def command(
    settings: Settings,
    xi: Annotated[
        str,
        typer.Option("--xi", metavar="FROM:TO:STEP", help="Size ratios, e.g. 1:1.3:0.01."),
    ],
    json: Json = False,
    out: Annotated[
        Path | None, typer.Option("--out", metavar="C.csv", help="Write the curve as CSV.")
    ] = None,
    figure: Annotated[
        Path | None,
        typer.Option("--figure", metavar="C.svg", help="Draw the curve (svg, png or pdf)."),
    ] = None,
) -> int:
    """Compute critical pressure over size ratio.

    Give --eta, or --inner and --outer, or CASE.toml (its stone's size is ignored). Exit code 0
    where every size ratio has an answer.
    """
    sizes = size_range(xi)
    from stonepass.cli.terminal import FIGURES, counting, print_json, show, warn, writable

    writable(out, (".csv",))
    writable(figure, FIGURES)
    from stonepass.model.case import Case, Stone
    from stonepass.records.answer import curve_rows, write_curve
    from stonepass.studies.curve import curve

    stone = Stone(
        size_ratio=sizes[-1], friction=settings.friction_value(), shape=settings.shape_value()
    )
    case = Case(stone, settings.ureter(), settings.load(), settings.method())
    case.with_size_ratio(sizes[0])  # both ends are checked before the first solve
    with counting("size ratios") as progress:
        workers = min(os.cpu_count() or 1, max(1, len(sizes) // 6))
        answers = curve(case, sizes, progress, workers)
    if out is not None:
        write_curve(answers, out)
    if figure is not None:
        from stonepass.report.curve_figure import curve_figure
        from stonepass.report.style import save

        save(curve_figure(answers), figure)
    if json:
        print_json(curve_rows(answers))
    else:
        from stonepass.report.table import curve_table, grouped_warnings

        show(curve_table(answers))
        warn(grouped_warnings(answers))
    return 0 if all(answer.outcome.answered for answer in answers) else 1


def size_range(text: str) -> list[float]:
    """Read FROM:TO:STEP, both ends included: ``size_range("1:1.02:0.01") == [1.0, 1.01, 1.02]``."""
    allowed = "three rising numbers FROM:TO:STEP, e.g. 1:1.3:0.01"
    try:
        first, last, step = (float(part) for part in text.split(":"))
    except ValueError as problem:
        raise BadInput("--xi", text, allowed) from problem
    if not (0.0 < first <= last < 1e6 and 0.0 < step < 1e6):
        raise BadInput("--xi", text, allowed)
    if (last - first) / step > MOST_POINTS:
        raise BadInput("--xi", text, f"at most {MOST_POINTS} size ratios", "use a larger step")
    count = int((last - first) / step + 1e-9)
    return [round(first + i * step, 12) for i in range(count + 1)]
