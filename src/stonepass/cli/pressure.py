"""``stonepass pressure``: the critical pressure of one stone in one ureter."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from stonepass.cli.options import Json, Settings, takes_settings

if TYPE_CHECKING:
    from stonepass.model.answer import Answer

__all__ = ["command"]


@takes_settings()
def command(
    settings: Settings,
    json: Json = False,
    profile: Annotated[
        Path | None,
        typer.Option("--profile", metavar="OUT.csv", help="Write contact pressure over angle."),
    ] = None,
    figure: Annotated[
        Path | None,
        typer.Option("--figure", metavar="OUT.svg", help="Draw the case (svg, png or pdf)."),
    ] = None,
    save: Annotated[
        Path | None,
        typer.Option("--save", metavar="CASE.toml", help="Write the case for another time."),
    ] = None,
) -> int:
    """Find the urine pressure at which a stone starts to move.

    Give CASE.toml, or --stone with --inner and --outer, or --xi with --eta.
    """
    from stonepass.cli.terminal import FIGURES, print_json, show, warn, working, writable

    writable(profile, (".csv",))
    writable(figure, FIGURES)
    writable(save, (".toml",))
    case = settings.case()
    from stonepass.model.critical import solve

    with working("solving for the wall"):
        answer = solve(case)
    if json:
        from stonepass.records.answer import answer_record

        print_json(answer_record(answer).to_dict())
    else:
        from stonepass.report.table import pressure_table

        show(pressure_table(answer), f"{answer.outcome.name}: {answer.message}")
        warn(answer.warnings)
    warn(_write(answer, profile, figure))
    if save is not None:
        from stonepass.inputs.case_file import write_case

        write_case(case, save)
    return 0 if answer.outcome.answered else 1


def _write(answer: Answer, profile: Path | None, figure: Path | None) -> list[str]:
    """Write what was asked for; where no stone is seated there is nothing, and that is said."""
    if profile is None and figure is None:
        return []
    if answer.contact is None:
        return ["no stone is seated, so neither profile nor figure was written"]
    if profile is not None:
        from stonepass.records.profile import write_profile

        write_profile(answer.contact, answer.case.stone.shape, profile)
    if figure is not None:
        from stonepass.report.answer_figure import answer_figure
        from stonepass.report.style import save

        save(answer_figure(answer), figure)
    return []
