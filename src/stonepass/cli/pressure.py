"""``stonepass pressure``: the critical pressure of one stone in one ureter."""

from __future__ import annotations

import time
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from stonepass.cli.help import OUTPUT, epilog
from stonepass.cli.options import Cache, Json, NoCache, Settings, cache_folder, takes_settings

if TYPE_CHECKING:
    from stonepass.model.answer import Answer
    from stonepass.model.case import Case

__all__ = ["EPILOG", "command"]

EPILOG = epilog(
    (
        (
            "pressure --stone 4.2mm --inner 3.5mm --outer 4.55mm",
            "the critical pressure of this stone in this ureter",
        ),
        (
            "pressure --xi 1.2 --eta 1.3 --friction 0.3 --figure case.svg",
            "the same for ratios of diameters, with a drawing",
        ),
        (
            "pressure examples/thin_ureter.toml --model direct --json",
            "a case file, by the direct model, as JSON",
        ),
    )
)


@takes_settings()
def command(
    settings: Settings,
    json: Json = False,
    profile: Annotated[
        Path | None,
        typer.Option(
            "--profile",
            metavar="OUT.csv",
            help="Write the contact pressure over the angle as CSV.",
            rich_help_panel=OUTPUT,
        ),
    ] = None,
    figure: Annotated[
        Path | None,
        typer.Option(
            "--figure",
            metavar="OUT.svg",
            help="Draw the case (svg, png or pdf).",
            rich_help_panel=OUTPUT,
        ),
    ] = None,
    save: Annotated[
        Path | None,
        typer.Option(
            "--save",
            metavar="CASE.toml",
            help="Write the case as a case file.",
            rich_help_panel=OUTPUT,
        ),
    ] = None,
    cache: Cache = None,
    no_cache: NoCache = False,
) -> int:
    """Find the urine pressure at which a stone starts to move.

    Give a case file; or --stone, --inner and --outer; or --xi and --eta.
    """
    from stonepass.cli.terminal import FIGURES, print_json, remembered, show, warn, writable, wrote

    writable(profile, (".csv",))
    writable(figure, FIGURES)
    writable(save, (".toml",))
    case = settings.case()
    answer, elapsed = _answered(case, cache_folder(cache, no_cache), walls=figure is not None)
    if json:
        from stonepass.records.answer import answer_record

        print_json(answer_record(answer).to_dict())
    else:
        from stonepass.report.table import pressure_tables

        show(*pressure_tables(answer), f"{answer.outcome.name}: {answer.message}")
        warn(answer.warnings)
        remembered(answer.seconds, elapsed)
    warn(_write(answer, profile, figure))
    if save is not None:
        from stonepass.inputs.case_file import write_case

        write_case(case, save)
        wrote(save)
    return 0 if answer.outcome.answered else 1


def _answered(case: Case, folder: Path | None, *, walls: bool) -> tuple[Answer, float]:
    """Return the answer and the seconds it took; with `walls` it keeps its stress field."""
    from stonepass.cli.terminal import working
    from stonepass.model.critical import solve
    from stonepass.studies.jobs import state_solver

    began = time.monotonic()
    with working("solving the finite-element model"):
        answer = solve(case, states=state_solver(folder, walls=walls))
    return answer, time.monotonic() - began


def _write(answer: Answer, profile: Path | None, figure: Path | None) -> list[str]:
    """Write profile and figure; return a warning if there is no contact that they could show."""
    from stonepass.cli.terminal import wrote

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
    wrote(profile, figure)
    return []
