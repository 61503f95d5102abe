"""``stonepass surrogate``: build, check, show and evaluate surrogates of the models."""

from __future__ import annotations

import shlex
from pathlib import Path
from typing import Annotated, Any

import typer

from stonepass.cli.app import SETTINGS
from stonepass.cli.help import OUTPUT, QUESTION, SOLVER, PanelCommand, PanelGroup, epilog
from stonepass.cli.options import (
    Cache,
    Json,
    NoCache,
    Settings,
    Workers,
    cache_folder,
    option_for,
    takes_settings,
)
from stonepass.errors import BadInput
from stonepass.inputs.catalogue import all_inputs
from stonepass.studies.stiffness_input import STIFFNESS

__all__ = ["app"]

app = typer.Typer(
    cls=PanelGroup,
    help="Build, check and evaluate surrogates: polynomials that replace the finite elements.",
    epilog="'stonepass surrogate COMMAND --help' explains a command, with examples.",
    **SETTINGS,
)

MOST_REASONS = 5  # conditions outside a surrogate whose reason is told
DONE = "0 done; 2 the request was refused; 3 an error of the program"
# The inputs that vary in the box of a surrogate.
VARIED = ("stone.diameter", "stone.size_ratio", "stone.friction", "ureter.inner_diameter",
          "ureter.outer_diameter", "ureter.wall_ratio", "ureter.wall_thickness")  # fmt: skip
# The default box, see `studies.surrogates.box.Box`.
LARGEST_XI, ETA_RANGE, FRICTION_RANGE = 1.6, "1.1:4", "0:1"
COLUMNS = ("size_ratio", "wall_ratio", "friction", "confining_pressure_kPa")
TINY, HUGE = 1e-6, 1e6
BOUNDS = {"size_ratio": (TINY, HUGE), "wall_ratio": (1.0, HUGE), "friction": (0.0, HUGE),
          "confining_pressure_kPa": (0.0, HUGE)}  # fmt: skip
INPUTS = all_inputs()
FRICTION = INPUTS["stone.friction"]
OPTIONS = {"size_ratio": "--xi", "wall_ratio": "--eta", "friction": "--friction",
           "confining_pressure": "--confining", "stiffness": "--stiffness"}  # fmt: skip

Name = Annotated[
    str,
    typer.Argument(
        metavar="NAME",
        help="Material of a surrogate of the package, or the JSON file of a surrogate.",
        rich_help_panel=QUESTION,
    ),
]
ModelName = Annotated[
    str,
    typer.Option("--model", help="Model of a surrogate of the package.", rich_help_panel=QUESTION),
]


def _epilog(example: str, meaning: str, exit_codes: str = DONE) -> str:
    return epilog(((f"surrogate {example}", meaning),), exit_codes)


def _build(
    settings: Settings,
    out: Annotated[
        Path,
        typer.Option(
            "--out",
            metavar="S.json",
            help="Write the surrogate to this file and its numbers to S.npz.",
            rich_help_panel=OUTPUT,
        ),
    ],
    largest_xi: Annotated[
        float,
        typer.Option(
            "--largest-xi", help="Largest size ratio of the box.", rich_help_panel=QUESTION
        ),
    ] = LARGEST_XI,
    eta_range: Annotated[
        str,
        typer.Option(
            "--eta-range",
            metavar="FROM:TO",
            help="Wall ratios of the box.",
            rich_help_panel=QUESTION,
        ),
    ] = ETA_RANGE,
    friction_range: Annotated[
        str,
        typer.Option(
            "--friction-range",
            metavar="FROM:TO",
            help="Friction coefficients of the box.",
            rich_help_panel=QUESTION,
        ),
    ] = FRICTION_RANGE,
    effort: Annotated[
        float,
        typer.Option(
            "--effort", help="Factor on the number of solved cases.", rich_help_panel=SOLVER
        ),
    ] = 1.0,
    cache: Cache = None,
    no_cache: NoCache = False,
    workers: Workers = None,
) -> int:
    """Build a surrogate; --confining is the largest confining pressure of its box.

    Several hundred to some thousand cases are solved. An interrupted command goes on where it
    stopped, because the solved states are in the cache folder.
    """
    from stonepass.cli.terminal import counting, writable, wrote
    from stonepass.studies.case_solver import JobSolver
    from stonepass.studies.executor import CORES, process_pool
    from stonepass.studies.surrogates.box import Box
    from stonepass.studies.surrogates.build import build_surrogate
    from stonepass.studies.surrogates.store import save_surrogate

    writable(out, (".json",))
    if not 0.0 < effort <= 100.0:
        raise BadInput("--effort", effort, "above 0 and at most 100")
    box = Box(
        largest_xi, _pair("--eta-range", eta_range), _pair("--friction-range", friction_range)
    )
    case = settings.case(stone__size_ratio=1.2, ureter__wall_ratio=box.wall_ratio[1])
    folder = cache_folder(cache, no_cache)
    with process_pool(workers or CORES) as pool, counting("solving the cases") as progress:
        built = build_surrogate(case, box, JobSolver(pool, folder, progress), effort)
    save_surrogate(built, out)
    _describe(built)
    wrote(out, out.with_suffix(".npz"))
    return 0


app.command(
    "build",
    cls=PanelCommand,
    epilog=_epilog(
        "build --material latex --confining 10kPa --out latex.json",
        "a surrogate of the paper's model up to this confining pressure; takes half an hour",
    ),
)(takes_settings(*VARIED, models=("paper", "direct"), choose_model=True)(_build))


@app.command(
    "check",
    cls=PanelCommand,
    epilog=_epilog(
        "check latex.json --cases 300", "solve 300 other cases and write the errors to the file"
    ),
)
def check(
    name: Annotated[
        Path,
        typer.Argument(
            metavar="S.json", help="JSON file of a surrogate.", rich_help_panel=QUESTION
        ),
    ],
    cases: Annotated[
        int,
        typer.Option("--cases", help="Number of solved cases.", rich_help_panel=QUESTION),
    ] = 300,
    cache: Cache = None,
    no_cache: NoCache = False,
    workers: Workers = None,
) -> int:
    """Measure the error of a surrogate with cases that were not used to build it."""
    from stonepass.cli.terminal import counting, wrote
    from stonepass.studies.case_solver import JobSolver
    from stonepass.studies.executor import CORES, process_pool
    from stonepass.studies.surrogates.check import check_surrogate, with_check
    from stonepass.studies.surrogates.store import load_surrogate, save_surrogate

    if name.suffix != ".json":
        raise BadInput("S.json", name, "the JSON file of a surrogate")
    surrogate, folder = load_surrogate(name), cache_folder(cache, no_cache)
    with process_pool(workers or CORES) as pool, counting("solving the cases") as progress:
        found = check_surrogate(surrogate, JobSolver(pool, folder, progress), cases)
    checked = with_check(surrogate, found)
    save_surrogate(checked, name)
    _describe(checked)
    wrote(name)
    return 0


@app.command(
    "list", cls=PanelCommand, epilog=_epilog("list", "the surrogates that come with the package")
)
def list_surrogates() -> int:
    """List the surrogates that come with the package."""
    from rich import box
    from rich.table import Table

    from stonepass.cli.terminal import show
    from stonepass.studies.surrogates.store import load_surrogate, shipped_surrogates

    table = Table(box=box.SIMPLE_HEAD)
    for column in ("material", "model", "largest confining pressure", "largest error"):
        table.add_column(column)
    for material, model in shipped_surrogates():
        found = load_surrogate(material, model)
        largest = found.about.get("check", {}).get("largest")
        load = found.case.load.confining_pressure / 1e3
        error = "not measured" if largest is None else f"{100.0 * largest:.2g} %"
        table.add_row(material, model, f"{load:g} kPa", error)
    show(table)
    return 0


@app.command(
    "show", cls=PanelCommand, epilog=_epilog("show ureter", "box, origin and measured errors")
)
def show_surrogate(name: Name, model: ModelName = "paper") -> int:
    """Show the box of a surrogate, how it was built, and its measured errors."""
    from stonepass.studies.surrogates.store import load_surrogate

    _describe(load_surrogate(name, model))
    return 0


@app.command(
    "evaluate",
    cls=PanelCommand,
    epilog=epilog(
        (
            ("surrogate evaluate ureter --xi 1.15 --eta 1.3 --friction 0.5",
             "one answer with its claimed error, without finite elements"),
            ("surrogate evaluate latex --points points.csv --out answers.csv",
             "one answer per row of a table with the columns size_ratio, wall_ratio and friction"),
        ),
        "0 every condition has an answer; 1 some condition has none; 2 the request was refused; 3 "
        "an error of the program",
    ),
)  # fmt: skip
def evaluate(
    name: Name,
    model: ModelName = "paper",
    xi: Annotated[float | None, option_for(INPUTS["stone.size_ratio"], QUESTION)] = None,
    eta: Annotated[float | None, option_for(INPUTS["ureter.wall_ratio"], QUESTION)] = None,
    friction: Annotated[float | None, option_for(FRICTION, QUESTION)] = None,
    confining: Annotated[
        str | None, option_for(INPUTS["load.confining_pressure"], QUESTION)
    ] = None,
    stiffness: Annotated[float, option_for(STIFFNESS, QUESTION)] = STIFFNESS.default,
    points: Annotated[
        Path | None,
        typer.Option(
            "--points",
            metavar="P.csv",
            help="Table of conditions in the columns size_ratio, wall_ratio, friction and, if "
            "needed, confining_pressure_kPa.",
            rich_help_panel=QUESTION,
        ),
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(
            "--out", metavar="A.csv", help="Write the answers as CSV.", rich_help_panel=OUTPUT
        ),
    ] = None,
    json: Json = False,
) -> int:
    """Evaluate a surrogate for one condition, or for a table of conditions."""
    from stonepass.cli.terminal import print_json, show, writable, wrote
    from stonepass.records.surrogate import surrogate_records
    from stonepass.report.surrogate_table import answers_table
    from stonepass.studies.surrogates.store import load_surrogate

    writable(out, (".csv",))
    if out is not None and points is not None and out.resolve() == points.resolve():
        raise BadInput("--out", str(out), "another file than that of --points")
    asked = _conditions(xi, eta, friction, confining, points)
    surrogate = load_surrogate(name, model)
    try:
        found = surrogate.evaluate(**asked, stiffness=stiffness)
    except BadInput as problem:
        raise problem.named(OPTIONS.get(problem.argument, problem.argument)) from problem
    if json:
        print_json([each.to_dict() for each in surrogate_records(found)])
    else:
        show(answers_table(found), *_reasons(surrogate, found))
    if out is not None:
        found.save(out)
    wrote(out)
    return 0 if found.answered.all() else 1


def _reasons(surrogate: Any, found: Any) -> list[str]:
    """Return why the first conditions that the surrogate does not cover are outside."""
    from stonepass.studies.surrogates.outside import why_outside

    rows = [int(row) for row in found.outside.nonzero()[0][:MOST_REASONS]]
    named = "" if len(found.outside) == 1 else "Row {}: "
    told = (f"{named.format(row + 1)}{why_outside(surrogate, found, row)}." for row in rows)
    return [each[0].upper() + each[1:] for each in told]


def _conditions(
    xi: float | None,
    eta: float | None,
    friction: float | None,
    confining: str | None,
    points: Path | None,
) -> dict[str, Any]:
    """Return the inputs of `Surrogate.evaluate`."""
    from stonepass.units import pressure

    if points is None:
        for option, value in (("--xi", xi), ("--eta", eta)):
            if value is None:
                raise BadInput(option, "missing", "given", "or give a table with --points")
        outside = float(pressure("0 kPa" if confining is None else confining, "--confining"))
        return {"size_ratio": [xi], "wall_ratio": [eta], "confining_pressure": [outside],
                "friction": [FRICTION.default if friction is None else friction]}  # fmt: skip
    given = {"--xi": xi, "--eta": eta, "--friction": friction, "--confining": confining}
    for option, unwanted in given.items():
        if unwanted is not None:
            raise BadInput(option, unwanted, "left out, because --points has all conditions")
    from stonepass.io.csv_file import read_columns

    read = read_columns(points, COLUMNS[:3], COLUMNS[3:], BOUNDS)
    *others, load = (read.get(name) for name in COLUMNS)
    return dict(zip(("size_ratio", "wall_ratio", "friction"), others, strict=True)) | {
        "confining_pressure": 0.0 if load is None else 1e3 * load
    }


def _pair(option: str, text: str) -> tuple[float, float]:
    """Read ``FROM:TO``."""
    try:
        first, last = (float(part) for part in text.split(":"))
    except ValueError:
        raise BadInput(option, text, "two rising numbers FROM:TO, e.g. 1.1:4") from None
    return first, last


def _describe(surrogate: Any) -> None:
    """Print the table of a surrogate and the command that builds it."""
    from stonepass.cli.terminal import show
    from stonepass.report.surrogate_table import surrogate_table

    try:
        told = ["This command builds it:", f"  {_build_command(surrogate)}"]
    except BadInput:  # its wall or its stone has no name
        told = ["It was built from a case file."]
    show(surrogate_table(surrogate), *told)


def _build_command(surrogate: Any) -> str:
    """Return the command that builds a surrogate of the same model over the same box."""
    from stonepass.inputs.command_options import command_options

    box, case = surrogate.box, surrogate.case
    words = ["stonepass", "surrogate", "build", *command_options(case, VARIED)]
    if box.size_ratio != LARGEST_XI:
        words += ["--largest-xi", f"{box.size_ratio:g}"]
    for option, bounds, default in (
        ("--eta-range", box.wall_ratio, ETA_RANGE),
        ("--friction-range", box.friction, FRICTION_RANGE),
    ):
        text = ":".join(f"{bound:g}" for bound in bounds)
        words += [option, text] if text != default else []
    return shlex.join([*words, "--out", "S.json"])
