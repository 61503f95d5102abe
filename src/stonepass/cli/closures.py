"""``stonepass closures``: closures, a fitted series and energy against the direct push-through."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated

import typer

from stonepass.cli.curve import size_range
from stonepass.cli.options import BEAM_OPTIONS, CLOSURE_OPTIONS, Json, Settings, takes_settings
from stonepass.errors import BadInput

__all__ = ["command"]

MOST_CASES = 2_000


@takes_settings("model", *CLOSURE_OPTIONS, *BEAM_OPTIONS)
def command(
    settings: Settings,
    json: Json = False,
    order: Annotated[int, typer.Option("--order", help="Of the fitted series, 1 to 8.")] = 3,
    sizes: Annotated[
        str | None,
        typer.Option(
            "--map", metavar="FROM:TO:STEP", help="Map over these size ratios instead of one stone."
        ),
    ] = None,
    walls: Annotated[
        str, typer.Option("--map-eta", metavar="A,B,…", help="Wall ratios of the map.")
    ] = "1.3,1.5,2,3.4",
    frictions: Annotated[
        str, typer.Option("--map-friction", metavar="A,B,…", help="Friction of the map.")
    ] = "0.1,0.3,0.5,0.8",
    out: Annotated[
        Path | None, typer.Option("--out", metavar="C.csv", help="Write the map as CSV.")
    ] = None,
    figure: Annotated[
        Path | None,
        typer.Option("--figure", metavar="C.svg", help="Draw closure or map (svg, png or pdf)."),
    ] = None,
) -> int:
    """Compare critical pressures by every closure with the direct push-through.

    Give one stone as for pressure, or --map for many; --eta and --xi are then not needed.
    """
    from stonepass.cli.terminal import FIGURES, print_json, show, warn, working, writable

    writable(out, (".csv",))
    writable(figure, FIGURES)
    from stonepass.report.style import save

    if sizes is not None:
        for name in ("stone", "inner", "outer", "xi", "eta", "friction"):
            if getattr(settings, name) is not None:
                raise BadInput(f"--{name}", "given", "left out beside --map", "use --map-…")
        grid = (
            size_range(sizes),
            _numbers(walls, "--map-eta"),
            _numbers(frictions, "--map-friction"),
        )
        return _map(settings, grid, order, out, figure, json)
    from stonepass.report.closures_report import (
        closures_figure,
        closures_record,
        closures_table,
        write_map,
    )
    from stonepass.studies.closures import compare_closures

    case = settings.case()
    with working("comparing closures"):
        found = compare_closures(case, order)
    if out is not None:
        write_map([found], out)
    if figure is not None:
        save(closures_figure(found), figure)
    if json:
        print_json(closures_record(found))
    else:
        show(closures_table(found))
    warn([*found.warnings, *([] if found.outcome.answered else [found.message])])
    return 0 if found.outcome.answered else 1


def _map(
    settings: Settings,
    grid: tuple[list[float], list[float], list[float]],
    order: int,
    out: Path | None,
    figure: Path | None,
    json: bool,
) -> int:
    sizes, walls, frictions = grid
    from stonepass.cli.terminal import counting, print_json, show
    from stonepass.model.case import Case, Stone, Ureter
    from stonepass.report.closures_report import closures_record, map_figure, write_map
    from stonepass.report.style import save
    from stonepass.studies.closures import CLOSURES, closure_map

    count = len(sizes) * len(walls) * len(frictions)
    if count > MOST_CASES:
        raise BadInput("map", f"{count} cases", f"at most {MOST_CASES}", "use fewer values")
    material = settings.material_value()
    cases = [
        Case(
            Stone(size_ratio=xi, friction=mu, shape=settings.shape_value()),
            Ureter(wall_ratio=eta, material=material),
            settings.load(),
            settings.method(),
        )
        for eta in walls
        for mu in frictions
        for xi in sizes
    ]
    with counting("cases") as progress:
        workers = min(os.cpu_count() or 1, max(1, count // 4))
        found = closure_map(cases, progress, workers, order)
    if out is not None:
        write_map(found, out)
    if figure is not None:
        save(map_figure(found), figure)
    if json:
        print_json([closures_record(each) for each in found])
        return 0
    for name, text in CLOSURES.items():
        errors = [error for each in found if (error := each.error(name)) is not None]
        if name != "direct" and errors:
            show(f"{text}: {min(errors):+.1%} to {max(errors):+.1%} of direct, {len(errors)} cases")
    return 0


def _numbers(text: str, option: str) -> list[float]:
    try:
        return [float(part) for part in text.split(",")]
    except ValueError as problem:
        raise BadInput(option, text, "numbers with commas between, e.g. 1.3,1.5,2") from problem
