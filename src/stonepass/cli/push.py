"""``stonepass push``: a stone that is held in its place while the urine pressure rises."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from stonepass.cli.closures import CLOSURE_CHOICES
from stonepass.cli.help import OUTPUT, QUESTION, epilog
from stonepass.cli.options import (
    Cache,
    Json,
    NoCache,
    Settings,
    cache_folder,
    option_for,
    takes_settings,
)
from stonepass.studies.rising_inputs import HIGHEST, STEPS

if TYPE_CHECKING:
    from stonepass.studies.rising import Rising

__all__ = ["EPILOG", "command"]

EPILOG = epilog(
    (
        (
            "push --xi 1.2 --eta 1.5 --material latex --animation push.gif",
            "thirteen pressures from zero to the critical one, as a table and as an animation",
        ),
        (
            "push --stone 4.2mm --inner 3.5mm --outer 4.55mm --to 8kPa --steps 5 --out push.csv",
            "five pressures from 0 to 8 kPa, also as CSV",
        ),
    ),
    "0 all states were found; 1 some were not (a warning says why); 2 the request was refused; "
    "3 an error of the program",
)


@takes_settings(*CLOSURE_CHOICES, models=("paper", "direct"))
def command(
    settings: Settings,
    json: Json = False,
    to: Annotated[str | None, option_for(HIGHEST, QUESTION)] = None,
    steps: Annotated[int, option_for(STEPS, QUESTION)] = STEPS.default,
    out: Annotated[
        Path | None,
        typer.Option(
            "--out", metavar="P.csv", help="Write the states as CSV.", rich_help_panel=OUTPUT
        ),
    ] = None,
    figure: Annotated[
        Path | None,
        typer.Option(
            "--figure",
            metavar="P.svg",
            help="Draw the states (svg, png or pdf).",
            rich_help_panel=OUTPUT,
        ),
    ] = None,
    animation: Annotated[
        Path | None,
        typer.Option(
            "--animation",
            metavar="P.gif",
            help="Write an animation of the rising pressure.",
            rich_help_panel=OUTPUT,
        ),
    ] = None,
    cache: Cache = None,
    no_cache: NoCache = False,
) -> int:
    """Follow a held stone while the urine pressure rises from zero.

    The table has the net force on the stone, the range of the contact and the contact pressure. It
    also has the deviation of the contact pressure from that of the seated state, which the paper
    uses at every urine pressure. Give a case file; or --stone, --inner and --outer; or --xi and
    --eta.
    """
    from stonepass.cli.terminal import FIGURES, print_json, show, warn, working, writable

    writable(out, (".csv",))
    writable(figure, FIGURES)
    writable(animation, (".gif",))
    from stonepass.units import pressure

    top = None if to is None else pressure(to, "--to")
    case = settings.case(method__model="paper")
    from stonepass.records.rising import rising_record
    from stonepass.report.rising_report import rising_table
    from stonepass.studies.rising import RisingPressure
    from stonepass.studies.study import run_study

    study = RisingPressure(case, top, steps, settings.wetted)
    folder = cache_folder(cache, no_cache)
    with working("solving for every pressure"):
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
            *(["no state was found, so no file was written"] if unwritten else []),
        ]
    )
    if rising.states:
        with working("writing the files"):
            _write(rising, out, figure, animation)
    complete = len(rising.states) in (0, steps)
    return 0 if complete and rising.critical.outcome.answered else 1


def _write(rising: Rising, out: Path | None, figure: Path | None, animation: Path | None) -> None:
    from stonepass.cli.terminal import wrote
    from stonepass.records.rising import write_rising
    from stonepass.report.rising_report import rising_figure, save_animation
    from stonepass.report.style import save

    if out is not None:
        write_rising(rising, out)
    if figure is not None:
        save(rising_figure(rising), figure)
    if animation is not None:
        save_animation(rising, animation)
    wrote(out, figure, animation)
