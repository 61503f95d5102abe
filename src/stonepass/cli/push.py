"""``stonepass push``: a held stone under rising urine pressure."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from stonepass.cli.options import BEAM_OPTIONS, CLOSURE_OPTIONS, Json, Settings, takes_settings

__all__ = ["command"]


@takes_settings("model", *CLOSURE_OPTIONS, *BEAM_OPTIONS)
def command(
    settings: Settings,
    json: Json = False,
    to: Annotated[
        str | None,
        typer.Option("--to", metavar="PRESSURE", help="Highest pressure.  [default: the critical]"),
    ] = None,
    steps: Annotated[int, typer.Option("--steps", help="Pressures, 0 included.")] = 13,
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
) -> int:
    """Raise the urine pressure on a held stone, up to where it would move.

    Shows force, opening and contact pressure, and how far the last is from the seated one, which
    the paper takes for it. Give the stone as for pressure.
    """
    from stonepass.cli.terminal import FIGURES, print_json, show, warn, working, writable

    writable(out, (".csv",))
    writable(figure, FIGURES)
    writable(animation, (".gif",))
    from stonepass.report.rising_report import (
        rising_figure,
        rising_record,
        rising_table,
        save_animation,
        write_rising,
    )
    from stonepass.report.style import save
    from stonepass.studies.rising import raise_pressure
    from stonepass.units import pressure

    top = None if to is None else pressure(to, "--to")
    case = settings.case()
    with working("raising the pressure"):
        rising = raise_pressure(case, top, steps)
        if rising.states:
            if out is not None:
                write_rising(rising, out)
            if figure is not None:
                save(rising_figure(rising), figure)
            if animation is not None:
                save_animation(rising, animation)
    if json:
        print_json(rising_record(rising))
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
    complete = len(rising.states) in (0, steps)
    return 0 if complete and rising.critical.outcome.answered else 1
