"""``stonepass curve``: critical pressure over a range of size ratios."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from stonepass.cli.help import OUTPUT, QUESTION, epilog
from stonepass.cli.options import (
    STONE_SIZE,
    Cache,
    Json,
    NoCache,
    Settings,
    Workers,
    cache_folder,
    takes_settings,
)
from stonepass.errors import BadInput

__all__ = ["EPILOG", "command", "size_range"]

MOST_POINTS = 10_000
EPILOG = epilog(
    (
        (
            "curve --eta 1.3 --xi 1:1.3:0.05 --figure curve.svg",
            "the critical pressure of seven sizes as a table and as a picture",
        ),
        (
            "curve --inner 3.5mm --outer 4.55mm --xi 1.1:1.2:0.1 --accuracy fast --out curve.csv",
            "two sizes, solved on coarse meshes, also as CSV",
        ),
    ),
    "0 every size has an answer; 1 some size has none; 2 the request was refused; 3 an error of "
    "the program",
)


@takes_settings(*STONE_SIZE)
def command(
    settings: Settings,
    xi: Annotated[
        str,
        typer.Option(
            "--xi",
            metavar="FROM:TO:STEP",
            help="Size ratios (stone diameter over inner diameter), e.g. 1:1.3:0.05.",
            rich_help_panel=QUESTION,
        ),
    ],
    json: Json = False,
    out: Annotated[
        Path | None,
        typer.Option(
            "--out", metavar="C.csv", help="Write the curve as CSV.", rich_help_panel=OUTPUT
        ),
    ] = None,
    figure: Annotated[
        Path | None,
        typer.Option(
            "--figure",
            metavar="C.svg",
            help="Draw the curve (svg, png or pdf).",
            rich_help_panel=OUTPUT,
        ),
    ] = None,
    cache: Cache = None,
    no_cache: NoCache = False,
    workers: Workers = None,
) -> int:
    """Compute the critical pressure for a range of stone sizes.

    Give --inner and --outer; or --eta; or a case file, whose stone may have any size.
    """
    sizes = size_range(xi)
    from stonepass.cli.terminal import FIGURES, counting, print_json, show, warn, writable, wrote

    writable(out, (".csv",))
    writable(figure, FIGURES)
    from stonepass.records.curve import curve_records, write_curve
    from stonepass.studies.curve import Curve
    from stonepass.studies.executor import CORES, process_pool
    from stonepass.studies.study import run_study

    case = settings.sizeless_case(sizes[-1])
    case.with_size_ratio(sizes[0])  # both ends are checked before the first solve
    folder = cache_folder(cache, no_cache)
    count = workers or min(CORES, max(1, len(sizes) // 6))  # a process takes seconds to start
    with process_pool(count) as pool, counting("solving for every size") as progress:
        answers = run_study(Curve(case, sizes), pool, folder, progress)
    if json:
        print_json([each.to_dict() for each in curve_records(answers)])
    else:
        from stonepass.report.table import curve_table, grouped_warnings

        show(curve_table(answers))
        warn(grouped_warnings(answers))
    if out is not None:
        write_curve(answers, out)
    if figure is not None:
        from stonepass.report.curve_figure import curve_figure
        from stonepass.report.style import save

        save(curve_figure(answers), figure)
    wrote(out, figure)
    return 0 if all(answer.outcome.answered for answer in answers) else 1


def size_range(text: str) -> list[float]:
    """Read ``FROM:TO:STEP`` with both ends included.

    >>> size_range("1:1.02:0.01")
    [1.0, 1.01, 1.02]
    """
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
