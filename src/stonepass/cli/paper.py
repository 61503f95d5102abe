"""``stonepass paper``: all computed results of the paper."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from stonepass.about import DISCLAIMER
from stonepass.cli.help import OUTPUT, QUESTION, epilog
from stonepass.cli.options import Cache, NoCache, Workers, cache_folder, option_for
from stonepass.model.pressure_limit import PRESSURE_LIMIT

__all__ = ["EPILOG", "command"]

EPILOG = epilog(
    (
        ("paper fig5 --out paper", "the finite-element meshes of the two ureters, as in Fig. 5"),
        ("paper", "all figures, data and claims; takes long the first time"),
    ),
    "0 every claim that can be judged is reproduced; 1 some claim is not; 2 the request was "
    "refused; 3 an error of the program",
)


def command(
    parts: Annotated[
        list[str] | None,
        typer.Argument(
            metavar="[PART]...",
            help="fig4 to fig9, friction, sensitivity, claims, or all.  [default: all]",
            rich_help_panel=QUESTION,
        ),
    ] = None,
    out: Annotated[
        Path,
        typer.Option(
            "--out",
            metavar="DIR",
            help="Folder for figures, data and the page index.html.",
            rich_help_panel=OUTPUT,
        ),
    ] = Path("paper"),
    limit: Annotated[
        str,
        option_for(PRESSURE_LIMIT, QUESTION, default="12kPa"),
    ] = "12kPa",
    points: Annotated[
        Path | None,
        typer.Option(
            "--points",
            metavar="FILE.csv",
            help="Measured pressures for Fig. 6, in the columns xi, eta, confining_kPa, "
            "pressure_kPa and, if known, sd_kPa.",
            rich_help_panel=QUESTION,
        ),
    ] = None,
    cache: Cache = None,
    no_cache: NoCache = False,
    workers: Workers = None,
) -> int:
    """Reproduce the figures and claims of the paper.

    The folder has the figures (SVG, PNG), their data (CSV), and a page that compares every claim
    with the computed result. Solved states are kept, so that a repetition takes seconds.
    """
    from stonepass.cli.durations import estimated_seconds
    from stonepass.cli.terminal import announce, counting, show, warn, wrote
    from stonepass.inputs.measured_pressures import read_points
    from stonepass.model.pressure_limit import read_limit
    from stonepass.paper.claims_table import claims_table
    from stonepass.paper.run import PARTS, chosen, reproduce
    from stonepass.paper.section import Asked
    from stonepass.studies.executor import CORES, process_pool

    names = chosen(parts or [])
    asked = Asked(read_limit(limit, "--limit"), () if points is None else read_points(points))
    folder = cache_folder(cache, no_cache)
    count = workers or CORES
    jobs = {job for name in names for job in PARTS[name].jobs(asked)}
    what = f"solving {len(jobs)} cases for {', '.join(names)}"
    announce(what, estimated_seconds(jobs, count), remembers=not no_cache)
    with process_pool(count) as pool, counting("solving the cases") as progress:
        sections = reproduce(names, out, asked, pool, folder, progress)
    claims = [claim for section in sections for claim in section.claims]
    if claims:
        show(claims_table(claims))
    show(DISCLAIMER)
    wrote(out / "index.html")
    warned = sum(len(section.warnings) for section in sections)
    if warned:
        warn([f"the answers have {warned} kinds of warnings, which the page lists"])
    return 1 if any(claim.holds is False for claim in claims) else 0
