"""``stonepass invitro``: measured critical pressures against the model, and their friction."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from stonepass.about import DISCLAIMER
from stonepass.cli.options import Cache, Json, NoCache, Workers, cache_folder

__all__ = ["command"]


def command(
    data: Annotated[
        Path,
        typer.Argument(metavar="DATA.csv", help="xi, eta, confining_kPa, pressure_kPa[, sd_kPa]."),
    ],
    material: Annotated[
        str, typer.Option("--material", metavar="NAME|FILE", help="Wall of the tubes.")
    ],
    friction: Annotated[
        float | None,
        typer.Option("--friction", help="Compare at this friction.  [default: the one that fits]"),
    ] = None,
    confinement: Annotated[
        str, typer.Option("--confinement", help="hydrostatic (a water bath) or dead.")
    ] = "hydrostatic",
    model: Annotated[str, typer.Option("--model", help="paper or direct.")] = "paper",
    seating: Annotated[
        str | None,
        typer.Option(
            "--seating",
            metavar="pressed|frictionless|growing",
            help="How the stones came to their place. Model 'paper' only.  [default: pressed]",
        ),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option("--out", metavar="OUT.csv", help="Write points and answers as CSV."),
    ] = None,
    figure: Annotated[
        Path | None,
        typer.Option("--figure", metavar="OUT.svg", help="Draw curves and points (svg, png, pdf)."),
    ] = None,
    json: Json = False,
    cache: Cache = None,
    no_cache: NoCache = False,
    workers: Workers = None,
) -> int:
    """Compare a series of measured critical pressures with the model, and fit its friction.

    Exit code 0 where every point has an answer.
    """
    from stonepass.cli.terminal import FIGURES, counting, print_json, show, warn, writable

    writable(out, (".csv",))
    writable(figure, FIGURES)
    from stonepass.bench.comparison import Setting, size_curves
    from stonepass.bench.invitro import fit_friction
    from stonepass.inputs.build import build_method
    from stonepass.inputs.material_file import find_material
    from stonepass.inputs.measured_pressures import read_points
    from stonepass.model.load import Load
    from stonepass.model.stone import Stone
    from stonepass.records.invitro import invitro_record, series_warnings, write_invitro
    from stonepass.report.invitro_report import invitro_table
    from stonepass.studies.case_solver import JobSolver
    from stonepass.studies.executor import CORES, process_pool

    if friction is not None:
        Stone(size_ratio=1.0, friction=friction)  # refused before the work where it is none
    Load(confinement=confinement)
    values = {"method.model": model, "method.seating": seating}
    chosen, numerics = build_method({key: v for key, v in values.items() if v is not None})
    setting = Setting(find_material(material), confinement, chosen, numerics)
    points = read_points(data)
    folder = cache_folder(cache, no_cache)
    with process_pool(workers or CORES) as pool, counting("solving") as progress:
        solver = JobSolver(pool, folder, progress)
        found = fit_friction(points, setting, friction, solver)
        curves = [] if figure is None else size_curves(found.comparison, setting, solver)
    if json:
        print_json(invitro_record(found, data.name).to_dict())
    else:
        show(*(f"This fit does not hold: {each}." for each in found.objections))
        warn(each for each in series_warnings(found) if each not in found.objections)
        show(*invitro_table(found), DISCLAIMER)
    if out is not None:
        write_invitro(found, out)
    if figure is not None:
        from stonepass.report.invitro_figure import invitro_figure
        from stonepass.report.style import save

        save(invitro_figure(found, curves), figure)
    return 0 if all(answer.outcome.answered for answer in found.comparison.answers) else 1
