"""``stonepass push``: a held stone under rising urine pressure."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from stonepass.cli.closures import CLOSURE_CHOICES
from stonepass.cli.options import (
    Cache,
    Json,
    NoCache,
    Settings,
    cache_folder,
    takes_settings,
)

if TYPE_CHECKING:
    from stonepass.studies.rising import Rising

__all__ = ["command"]


@takes_settings(*CLOSURE_CHOICES, models=("paper", "direct"))
def command(
    settings: Settings,
    json: Json = False,
    to: Annotated[
        str | None,
        typer.Option("--to", metavar="PRESSURE", help="Highest pressure.  [default: the critical]"),
    ] = None,
    steps: Annotated[int, typer.Option("--steps", help="Number of pressures, 0 included.")] = 13,
    out: Annotated[
        Path | None, typer.Option("--out", metavar="P.csv", help="Write the states as CSV.")
    ] = None,
    figure: Annotated[
        Path | None,
        typer.Option("--figure", metavar="P.svg", help="Draw the states (svg, png or pdf)."),
    ] = None,
    animation: Annotated[
        Path | None, typer.Option("--animation", metavar="P.gif", help="Show the pressure rising.")
    ] = None,
    cache: Cache = None,
    no_cache: NoCache = False,
) -> int:
    """Raise the urine pressure on a held stone, up to where it would move.

    Shows force, opening and contact pressure, and how far the last is from the seated one, which
    the paper takes for it. Give the stone as for pressure.
    """
    from stonepass.cli.terminal import FIGURES, print_json, show, warn, working, writable

    writable(out, (".csv",))
    writable(figure, FIGURES)
    writable(animation, (".gif",))
    from stonepass.records.rising import rising_record
    from stonepass.report.rising_report import rising_table
    from stonepass.studies.rising import RisingPressure
    from stonepass.studies.study import run_study
    from stonepass.units import pressure

    top = None if to is None else pressure(to, "--to")
    study = RisingPressure(settings.case(method__model="paper"), top, steps, settings.wetted)
    folder = cache_folder(cache, no_cache)
    with working("raising the pressure"):
        rising = run_study(study, cache_folder=folder)
    if json:
        print_json(rising_record(rising).to_dict())
    else:
        show(rising_table(rising), f"{rising.critical.outcome.name}: {rising.critical.message}")
    unwritten = not rising.states and any((out, figure, animation))
    warn(
        [
            *rising.critical.warnings,
            *([rising.reason] if rising.reason else []),
            *(["no state was found, so nothing was written"] if unwritten else []),
        ]
    )
    if rising.states:
        with working("drawing"):
            _write(rising, out, figure, animation)
    complete = len(rising.states) in (0, steps)
    return 0 if complete and rising.critical.outcome.answered else 1


def _write(rising: Rising, out: Path | None, figure: Path | None, animation: Path | None) -> None:
    from stonepass.records.rising import write_rising
    from stonepass.report.rising_report import rising_figure, save_animation
    from stonepass.report.style import save

    if out is not None:
        write_rising(rising, out)
    if figure is not None:
        save(rising_figure(rising), figure)
    if animation is not None:
        save_animation(rising, animation)
