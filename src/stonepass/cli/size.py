"""``stonepass size``: the largest stone that moves at a pressure limit."""

from __future__ import annotations

from typing import Annotated

import typer

from stonepass.cli.options import Json, Settings, takes_settings

__all__ = ["command"]


@takes_settings("stone", "xi")
def command(
    settings: Settings,
    limit: Annotated[
        str,
        typer.Option("--limit", metavar="PRESSURE", help="Bearable urine pressure, e.g. 12kPa."),
    ],
    json: Json = False,
) -> int:
    """Find the critical size: the largest stone that moves at the pressure limit.

    Give --eta, or --inner and --outer, or CASE.toml (its stone's size is ignored).
    """
    ureter, load, method = settings.ureter(), settings.load(), settings.method()
    from stonepass.cli.terminal import print_json, show, warn, working
    from stonepass.model.size import critical_size
    from stonepass.records.answer import size_record

    with working("searching the critical size"):
        answer = critical_size(
            ureter, limit, settings.friction_value(), load, method, shape=settings.shape_value()
        )
    if json:
        print_json(size_record(answer))
    else:
        from stonepass.report.table import size_table

        show(size_table(answer), f"{answer.outcome.name}: {answer.message}")
        warn(answer.warnings)
    return 0 if answer.outcome.answered else 1
