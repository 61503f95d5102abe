"""``stonepass sensitivity``: which uncertain inputs the critical pressure and size depend on."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from stonepass.cli.help import OUTPUT, QUESTION, SOLVER, epilog
from stonepass.cli.options import Cache, Json, NoCache, Workers, cache_folder, option_for
from stonepass.errors import BadInput
from stonepass.model.pressure_limit import PRESSURE_LIMIT
from stonepass.studies.seed import SEED

if TYPE_CHECKING:
    from stonepass.studies.sensitivity.study import SensitivityStudy

__all__ = ["EPILOG", "command"]

SECONDS = 1.5  # one finite-element case in one process, an empty cache
EPILOG = epilog(
    (
        (
            "sensitivity examples/uncertain_stone.toml --figure sensitivity.svg",
            "Sobol' indices and a tornado of the thin wall, as tables and as a picture",
        ),
        (
            "sensitivity examples/uncertain_stone.toml --method morris --limit 8kPa --json",
            "elementary effects, and another pressure limit, as JSON",
        ),
    ),
    "0 the study has a result; 1 no case has a critical pressure; 2 the request was refused; 3 an "
    "error of the program",
)


def command(
    study_file: Annotated[
        Path,
        typer.Argument(
            metavar="STUDY.toml",
            help="Study: a case file whose section [uncertain] has ranges and distributions.",
            rich_help_panel=QUESTION,
        ),
    ],
    method: Annotated[
        str | None,
        typer.Option(
            "--method",
            metavar="sobol|morris",
            help="Sobol' indices or elementary effects.  [default: morris if every case needs "
            "finite elements, else sobol]",
            rich_help_panel=QUESTION,
        ),
    ] = None,
    limit: Annotated[
        str | None,
        option_for(
            PRESSURE_LIMIT, QUESTION, meaning="Pressure limit, e.g. 12kPa; adds the critical size."
        ),
    ] = None,
    samples: Annotated[
        int | None,
        typer.Option(
            "--samples",
            metavar="INTEGER",
            help="Base samples (a power of two) or trajectories.  [default: 1024 or 10]",
            rich_help_panel=QUESTION,
        ),
    ] = None,
    seed: Annotated[int | None, option_for(SEED, QUESTION)] = None,
    surrogate: Annotated[
        str | None,
        typer.Option(
            "--surrogate",
            metavar="NAME|S.json",
            help="Take the critical pressures from a surrogate: a material or a file.",
            rich_help_panel=SOLVER,
        ),
    ] = None,
    sweep: Annotated[
        Path | None,
        typer.Option(
            "--sweep",
            metavar="DIR",
            help="Interpolate the results of a sweep over the uncertain inputs.",
            rich_help_panel=SOLVER,
        ),
    ] = None,
    json: Json = False,
    csv: Annotated[
        Path | None,
        typer.Option(
            "--csv",
            metavar="S.csv",
            help="Write a table with one row for each input.",
            rich_help_panel=OUTPUT,
        ),
    ] = None,
    figure: Annotated[
        Path | None,
        typer.Option(
            "--figure",
            metavar="S.svg",
            help="Draw indices and tornado (svg, png or pdf).",
            rich_help_panel=OUTPUT,
        ),
    ] = None,
    cache: Cache = None,
    no_cache: NoCache = False,
    workers: Workers = None,
) -> int:
    """Find which uncertain inputs the critical pressure and the critical size depend on.

    The file is a case file with a section [uncertain], e.g. "stone.friction" = "0.05 to 0.5". The
    result has Sobol' indices or elementary effects with confidence intervals, and a tornado in kPa
    and, with a pressure limit, in mm of critical size.
    """
    from stonepass.cli.terminal import FIGURES, counting, print_json, show, warn, writable, wrote

    writable(csv, (".csv",))
    writable(figure, FIGURES)
    given = {
        "method": method,
        "limit": limit,
        "samples": samples,
        "seed": seed,
        "surrogate": surrogate,
        "sweep": None if sweep is None else str(sweep),
    }
    study = _study(study_file, given)
    from stonepass.report.presentation import save
    from stonepass.studies.executor import CORES, process_pool
    from stonepass.studies.sensitivity.sensitivity import sensitivity

    folder = cache_folder(cache, no_cache)
    count = workers or min(CORES, _processes(study))
    _announce(study, count, remembers=folder is not None)
    with process_pool(count) as pool, counting("evaluating the cases") as progress:
        try:
            found = sensitivity(study, executor=pool, cache_folder=folder, progress=progress)
        except BadInput as problem:
            name = {"surrogate": "surrogate", "folder": "sweep"}.get(problem.argument)
            if name is None:
                raise
            in_file = f"in {study_file.name}, 'sensitivity.{name}'"
            raise problem.named(in_file if given[name] is None else f"--{name}") from problem
    if json:
        print_json(found.to_dict())
    else:
        from stonepass.report.sensitivity_report import sensitivity_parts

        show(*sensitivity_parts(found))
        warn(found.warnings)
    for path in (csv, figure):
        if path is not None:
            save(found, path)
    wrote(csv, figure)
    return 0 if found.answered else 1


def _study(path: Path, given: Mapping[str, object]) -> SensitivityStudy:
    """Read the study; options that were given replace the settings of the file."""
    from stonepass.studies.sensitivity.study_file import read_sensitivity

    try:
        return read_sensitivity(path, **given)
    except BadInput as problem:
        name = problem.argument.rpartition(", ")[2]
        if name in given and given[name] is not None:
            raise problem.named(f"--{name}") from problem
        raise


def _processes(study: SensitivityStudy) -> int:
    """Return how many processes are worth their start."""
    if study.surrogate is not None or study.sweep is not None:
        return 1
    return max(1, study.cases // (6 if study.needs_elements else 4000))


def _announce(study: SensitivityStudy, workers: int, *, remembers: bool) -> None:
    from stonepass.cli.terminal import announce

    if study.needs_elements:
        cases = study.cases + 2 * len(study.uncertain.inputs)
        announce(f"solving about {cases} cases", SECONDS * cases / workers, remembers=remembers)
