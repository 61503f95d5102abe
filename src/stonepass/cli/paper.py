"""``stonepass paper``: every computed result of the paper, by one command."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from stonepass.about import DISCLAIMER
from stonepass.cli.options import Cache, NoCache, Workers, cache_folder

__all__ = ["command"]


def command(
    parts: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="[PART]...",
            help="fig4 to fig9, friction, sensitivity, claims or all.  [default: all]",
        ),
    ] = None,
    out: Annotated[
        Path, typer.Option("--out", metavar="DIR", help="Folder for pictures, data, index.html.")
    ] = Path("paper"),
    limit: Annotated[
        str, typer.Option("--limit", metavar="PRESSURE", help="Bearable urine pressure.")
    ] = "12kPa",
    points: Annotated[
        Path | None,
        typer.Option(
            "--points",
            metavar="FILE.csv",
            help="Measured pressures for Fig. 6: xi, eta, confining_kPa, pressure_kPa[, sd_kPa].",
        ),
    ] = None,
    cache: Cache = None,
    no_cache: NoCache = False,
    workers: Workers = None,
) -> int:
    """Reproduce the paper: figures (SVG, PNG), data (CSV), and a page of claims beside ours.

    What was solved is remembered, so that a second time takes seconds. Exit code 0 where every
    claim that can be judged is reproduced, else 1.
    """
    from stonepass.cli.terminal import counting, show, warn
    from stonepass.inputs.measured_pressures import read_points
    from stonepass.paper.claims_table import claims_table
    from stonepass.paper.run import chosen, reproduce
    from stonepass.paper.section import Asked
    from stonepass.studies.executor import CORES, process_pool
    from stonepass.units import pressure

    names = chosen(parts or [])
    asked = Asked(pressure(limit, "--limit"), () if points is None else read_points(points))
    folder = cache_folder(cache, no_cache)
    with process_pool(workers or CORES) as pool, counting("solving") as progress:
        sections = reproduce(names, out, asked, pool, folder, progress)
    claims = [claim for section in sections for claim in section.claims]
    if claims:
        show(claims_table(claims))
    show(f"Page: {out / 'index.html'}", DISCLAIMER)
    warned = sum(len(section.warnings) for section in sections)
    if warned:
        warn([f"{warned} kinds of warnings stand behind the answers; the page has them"])
    return 1 if any(claim.holds is False for claim in claims) else 0
