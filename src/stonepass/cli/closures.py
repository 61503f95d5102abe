"""``stonepass closures``: the closures of the paper's model compared with the direct model."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from stonepass.cli.curve import size_range
from stonepass.cli.help import OUTPUT, QUESTION, epilog
from stonepass.cli.options import (
    Cache,
    Json,
    NoCache,
    Settings,
    Workers,
    cache_folder,
    option_for,
    takes_settings,
)
from stonepass.errors import BadInput, Misplaced
from stonepass.inputs.catalogue import all_inputs, option_of

if TYPE_CHECKING:
    from stonepass.model.case import Case
    from stonepass.studies.closures import ClosureComparison, ClosureMap

__all__ = ["CLOSURE_CHOICES", "EPILOG", "command"]

ORDER = all_inputs()["method.series_order"]
MOST_CASES = 2_000
SECONDS_OF_A_CASE = 10.0  # one process, an empty cache; the direct model takes most of it
# Options of the paper's model that the comparison varies or sets itself.
CLOSURE_CHOICES = (
    "method.as_printed",
    "method.closure_start",
    "method.closure",
    "method.series_order",
    "method.opening_curve",
)
# Inputs that have options of their own in a map.
VARIED = (
    "stone.diameter",
    "ureter.inner_diameter",
    "ureter.outer_diameter",
    "ureter.wall_thickness",
    "stone.size_ratio",
    "ureter.wall_ratio",
    "stone.friction",
)
EPILOG = epilog(
    (
        (
            "closures --xi 1.2 --eta 1.5 --material latex --friction 0.475",
            "one stone: the critical pressure by every closure, beside the direct model",
        ),
        (
            "closures --material latex --map 1.1:1.3:0.1 --map-eta 1.5 --map-friction 0.3,0.5 "
            "--figure map.svg",
            "six stones: the errors of the closures as a figure",
        ),
    )
)


@takes_settings(*CLOSURE_CHOICES, models=("paper", "direct"))
def command(
    settings: Settings,
    json: Json = False,
    order: Annotated[int, option_for(ORDER, QUESTION)] = ORDER.default,
    sizes: Annotated[
        str | None,
        typer.Option(
            "--map",
            metavar="FROM:TO:STEP",
            help="Compare many stones with these size ratios, instead of one stone.",
            rich_help_panel=QUESTION,
        ),
    ] = None,
    walls: Annotated[
        str,
        typer.Option(
            "--map-eta",
            metavar="A,B,…",
            help="Wall ratios of the map.",
            rich_help_panel=QUESTION,
        ),
    ] = "1.3,1.5,2,3.4",
    frictions: Annotated[
        str,
        typer.Option(
            "--map-friction",
            metavar="A,B,…",
            help="Friction coefficients of the map.",
            rich_help_panel=QUESTION,
        ),
    ] = "0.1,0.3,0.5,0.8",
    out: Annotated[
        Path | None,
        typer.Option(
            "--out", metavar="C.csv", help="Write all pressures as CSV.", rich_help_panel=OUTPUT
        ),
    ] = None,
    figure: Annotated[
        Path | None,
        typer.Option(
            "--figure",
            metavar="C.svg",
            help="Draw the closure of one stone, or the errors of a map (svg, png or pdf).",
            rich_help_panel=OUTPUT,
        ),
    ] = None,
    cache: Cache = None,
    no_cache: NoCache = False,
    workers: Workers = None,
) -> int:
    """Compare the closures of the paper's model with the direct model.

    A closure is the assumption about the shape of the wall that opens above the stone. Give one
    stone by a case file, by --stone, --inner and --outer, or by --xi and --eta; or many stones by
    --map.
    """
    from stonepass.cli.terminal import FIGURES, print_json, show, warn, working, writable, wrote

    writable(out, (".csv",))
    writable(figure, FIGURES)
    if sizes is not None:
        for key in VARIED:
            if key in settings.given:
                raise Misplaced(option_of(key), "--map", "", "use the options --map-…")
        grid = (
            size_range(sizes),
            _numbers(walls, "--map-eta"),
            _numbers(frictions, "--map-friction"),
        )
        cases = _cases(settings, *grid)
        from stonepass.studies.closures import ClosureMap

        study = ClosureMap(cases, order, settings.wetted)
        compared = _compared(study, cache_folder(cache, no_cache), workers)
        return _show_map(compared, out, figure, json)
    case = settings.case(method__model="paper")
    from stonepass.records.closures import closures_record, write_map
    from stonepass.report.closures_report import closures_figure, closures_table
    from stonepass.report.style import save
    from stonepass.studies.closures import ClosureMap
    from stonepass.studies.study import run_study

    one = ClosureMap([case], order, settings.wetted)
    with working("solving by every closure and by the direct model"):
        (found,) = run_study(one, cache_folder=cache_folder(cache, no_cache))
    if json:
        print_json(closures_record(found).to_dict())
    else:
        show(closures_table(found))
    warn([*found.warnings, *([] if found.outcome.answered else [found.message])])
    if out is not None:
        write_map([found], out)
    if figure is not None:
        save(closures_figure(found), figure)
    wrote(out, figure)
    return 0 if found.outcome.answered else 1


def _cases(
    settings: Settings, sizes: list[float], walls: list[float], frictions: list[float]
) -> list[Case]:
    from stonepass.model.stone import Stone
    from stonepass.model.ureter import Ureter

    count = len(sizes) * len(walls) * len(frictions)
    if count > MOST_CASES:
        raise BadInput("map", f"{count} cases", f"at most {MOST_CASES}", "use fewer values")
    base = settings.case(
        method__model="paper", stone__size_ratio=sizes[0], ureter__wall_ratio=walls[0]
    )
    return [
        replace(
            base,
            stone=Stone(size_ratio=xi, friction=mu, shape=base.stone.shape),
            ureter=Ureter(wall_ratio=eta, material=base.ureter.material),
        )
        for eta in walls
        for mu in frictions
        for xi in sizes
    ]


def _compared(
    study: ClosureMap, folder: Path | None, workers: int | None
) -> list[ClosureComparison]:
    from stonepass.cli.terminal import announce, counting
    from stonepass.studies.executor import CORES, process_pool
    from stonepass.studies.study import run_study

    cases = len(study.cases)
    count = workers or min(CORES, max(1, cases // 4))  # a process takes seconds to start
    announce(
        f"solving {cases} cases by every closure and by the direct model",
        SECONDS_OF_A_CASE * cases / count,
        remembers=folder is not None,
    )
    with process_pool(count) as pool, counting("solving the cases") as progress:
        return run_study(study, pool, folder, progress)


def _show_map(
    found: list[ClosureComparison], out: Path | None, figure: Path | None, json: bool
) -> int:
    from stonepass.cli.terminal import print_json, show, wrote
    from stonepass.records.closures import closures_record, write_map
    from stonepass.report.closures_report import map_figure
    from stonepass.report.style import save

    if json:
        print_json([closures_record(each).to_dict() for each in found])
    else:
        show(*_spreads(found))
    if out is not None:
        write_map(found, out)
    if figure is not None:
        save(map_figure(found), figure)
    wrote(out, figure)
    return 0


def _spreads(found: list[ClosureComparison]) -> list[str]:
    """Return a line for each closure with the range of its errors in the cases it answers."""
    from stonepass.studies.closures import APPROXIMATE, CLOSURES

    lines = []
    for name in APPROXIMATE:
        errors = [error for each in found if (error := each.error(name)) is not None]
        if errors:
            spread = f"{min(errors):+.1%} to {max(errors):+.1%} from the direct model"
            lines.append(f"{CLOSURES[name]}: {spread} ({len(errors)} cases)")
    return lines


def _numbers(text: str, option: str) -> list[float]:
    try:
        return [float(part) for part in text.split(",")]
    except ValueError as problem:
        raise BadInput(option, text, "numbers separated by commas, e.g. 1.3,1.5,2") from problem
