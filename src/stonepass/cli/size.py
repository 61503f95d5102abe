"""``stonepass size``: the largest stone that moves at a pressure limit."""

from __future__ import annotations

from typing import Annotated

import typer

from stonepass.cli.options import STONE_SIZE, Json, Settings, takes_settings

__all__ = ["command"]


@takes_settings(*STONE_SIZE)
def command(
    settings: Settings,
    limit: Annotated[
        str,
        typer.Option(
            "--limit", metavar="PRESSURE", help="Maximum tolerable urine pressure, e.g. 12kPa."
        ),
    ],
    json: Json = False,
) -> int:
    """Find the critical size: the largest stone that moves at the pressure limit.

    Give --eta, or --inner and --outer, or CASE.toml (its stone's size is ignored).
    """
    case = settings.sizeless_case()
    from stonepass.cli.terminal import print_json, show, warn, working
    from stonepass.model.size import critical_size

    with working("searching the critical size"):
        answer = critical_size(
            case.ureter,
            limit,
            case.stone.friction,
            case.load,
            case.model,
            case.numerics,
            shape=case.stone.shape,
        )
    if json:
        from stonepass.records.size import size_record

        print_json(size_record(answer).to_dict())
    else:
        from stonepass.report.table import size_table

        show(size_table(answer), f"{answer.outcome.name}: {answer.message}")
        warn(answer.warnings)
    return 0 if answer.outcome.answered else 1
