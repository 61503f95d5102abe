"""``stonepass invitro``: measured critical pressures compared with those of the model."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from stonepass.about import DISCLAIMER
from stonepass.cli.help import MODEL_PANEL, OUTPUT, QUESTION, epilog
from stonepass.cli.options import (
    Cache,
    Json,
    NoCache,
    Workers,
    cache_folder,
    complete_material,
    model_input,
    option_for,
)
from stonepass.inputs.catalogue import all_inputs
from stonepass.model.models.registry import MODELS

__all__ = ["EPILOG", "command"]

INPUTS = all_inputs()
MODEL_INPUT = model_input([name for name, model in MODELS.items() if model.NEEDS_ELEMENTS])
SECONDS_OF_A_POINT = {"paper": 25.0, "direct": 100.0}  # one process, an empty cache
EPILOG = epilog(
    (
        (
            "invitro examples/latex_series.csv --material latex --figure series.svg",
            "the friction that fits ten measured points, with a figure",
        ),
        (
            "invitro examples/latex_series.csv --material latex --friction 0.475",
            "the same points beside the model with this friction",
        ),
    ),
    "0 every point has an answer; 1 some point has none; 2 the request was refused; 3 an error of "
    "the program",
)


def command(
    data: Annotated[
        Path,
        typer.Argument(
            metavar="DATA.csv",
            help="Measured points, in the columns xi, eta, confining_kPa, pressure_kPa and, if "
            "known, sd_kPa.",
            rich_help_panel=QUESTION,
        ),
    ],
    material: Annotated[
        str,
        typer.Option(
            "--material",
            metavar="NAME|FILE",
            help="Material of the tubes: catalogue name, law.toml or file.py:function.",
            rich_help_panel=QUESTION,
            autocompletion=complete_material,
        ),
    ],
    friction: Annotated[
        float | None,
        option_for(INPUTS["stone.friction"], QUESTION, default="the one that fits best"),
    ] = None,
    confinement: Annotated[
        str, option_for(INPUTS["load.confinement"], QUESTION, default="hydrostatic")
    ] = "hydrostatic",
    model: Annotated[str, option_for(MODEL_INPUT, MODEL_PANEL)] = MODEL_INPUT.default,
    seating: Annotated[str | None, option_for(INPUTS["method.seating"], MODEL_PANEL)] = None,
    out: Annotated[
        Path | None,
        typer.Option(
            "--out",
            metavar="OUT.csv",
            help="Write measured and computed pressures as CSV.",
            rich_help_panel=OUTPUT,
        ),
    ] = None,
    figure: Annotated[
        Path | None,
        typer.Option(
            "--figure",
            metavar="OUT.svg",
            help="Draw the points and the curves of the model (svg, png or pdf).",
            rich_help_panel=OUTPUT,
        ),
    ] = None,
    json: Json = False,
    cache: Cache = None,
    no_cache: NoCache = False,
    workers: Workers = None,
) -> int:
    """Compare measured critical pressures with the model, and fit the friction coefficient.

    Every point is solved for several friction coefficients and stiffnesses, which takes minutes
    the first time.
    """
    from stonepass.cli.terminal import (
        FIGURES,
        announce,
        counting,
        print_json,
        show,
        warn,
        writable,
        wrote,
    )

    writable(out, (".csv",))
    writable(figure, FIGURES)
    from stonepass.inputs.build import build_method
    from stonepass.inputs.material_file import find_material
    from stonepass.inputs.measured_pressures import read_points
    from stonepass.model.load import Load
    from stonepass.model.stone import Stone

    if friction is not None:
        Stone(size_ratio=1.0, friction=friction)  # a value out of bounds is refused before the work
    Load(confinement=confinement)
    values = {"method.model": model, "method.seating": seating}
    chosen, numerics = build_method({key: v for key, v in values.items() if v is not None})
    wall, points = find_material(material), read_points(data)
    from stonepass.bench.comparison import SeriesSetting, size_curves
    from stonepass.bench.invitro import fit_friction
    from stonepass.records.invitro import invitro_record, series_warnings, write_invitro
    from stonepass.report.invitro_report import invitro_table
    from stonepass.studies.case_solver import JobSolver
    from stonepass.studies.executor import CORES, process_pool

    setting = SeriesSetting(wall, confinement, chosen, numerics)
    folder = cache_folder(cache, no_cache)
    count = workers or CORES
    seconds = SECONDS_OF_A_POINT.get(chosen.NAME, 0.0) * len(points) / count
    announce(f"fitting {len(points)} measured points", seconds, remembers=not no_cache)
    with process_pool(count) as pool, counting("solving the points") as progress:
        solver = JobSolver(pool, folder, progress)
        found = fit_friction(points, setting, friction, solver)
        curves = [] if figure is None else size_curves(found.comparison, setting, solver)
    if json:
        print_json(invitro_record(found, data.name).to_dict())
    else:
        show(*(f"The fit cannot be used: {each}." for each in found.objections))
        warn(each for each in series_warnings(found) if each not in found.objections)
        show(*invitro_table(found), DISCLAIMER)
    if out is not None:
        write_invitro(found, out)
    if figure is not None:
        from stonepass.report.invitro_figure import invitro_figure
        from stonepass.report.style import save

        save(invitro_figure(found, curves), figure)
    wrote(out, figure)
    return 0 if all(answer.outcome.answered for answer in found.comparison.answers) else 1
