"""``stonepass size``: the largest stone that moves at a pressure limit."""

from __future__ import annotations

import time
from typing import Annotated

from stonepass.cli.help import QUESTION, epilog
from stonepass.cli.options import (
    STONE_SIZE,
    Cache,
    Json,
    NoCache,
    Settings,
    cache_folder,
    option_for,
    takes_settings,
)
from stonepass.errors import BadInput
from stonepass.model.pressure_limit import PRESSURE_LIMIT

__all__ = ["EPILOG", "command"]

EPILOG = epilog(
    (
        (
            "size --inner 3.5mm --outer 4.55mm --limit 12kPa",
            "the diameter of the largest stone that moves at 12 kPa",
        ),
        (
            "size --eta 1.3 --limit 90mmHg --friction 0.2",
            "the same as a ratio to the inner diameter",
        ),
    )
)


@takes_settings(*STONE_SIZE)
def command(
    settings: Settings,
    limit: Annotated[
        str,
        option_for(PRESSURE_LIMIT, QUESTION),
    ],
    json: Json = False,
    cache: Cache = None,
    no_cache: NoCache = False,
) -> int:
    """Find the critical size: the largest stone that moves at the pressure limit.

    Give --inner and --outer; or --eta; or a case file, whose stone may have any size.
    """
    case = settings.sizeless_case()
    from stonepass.cli.terminal import print_json, remembered, show, warn, working
    from stonepass.model.size import critical_size
    from stonepass.studies.jobs import state_solver

    began = time.monotonic()
    with working("searching the critical size") as step:
        try:
            answer = critical_size(
                case,
                limit,
                progress=lambda size_ratio: step(f"size ratio {size_ratio:.4f}"),
                states=state_solver(cache_folder(cache, no_cache)),
            )
        except BadInput as problem:
            raise problem.named("--limit") if problem.argument == "limit" else problem from None
    if json:
        from stonepass.records.size import size_record

        print_json(size_record(answer).to_dict())
    else:
        from stonepass.report.table import size_message, size_tables

        show(*size_tables(answer), f"{answer.outcome.name}: {size_message(answer)}")
        warn(answer.warnings)
        if answer.at_size is not None:
            remembered(answer.at_size.seconds, time.monotonic() - began)
    return 0 if answer.outcome.answered else 1
