"""``stonepass fit``: the constants of a material law from tensile and inflation tests."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stonepass.about import DISCLAIMER
from stonepass.bench.specimen_inputs import RELATIVE, SIZES, read_sizes
from stonepass.cli.app import SETTINGS
from stonepass.cli.help import OUTPUT, QUESTION, PanelCommand, PanelGroup, epilog
from stonepass.cli.options import Json, option_for
from stonepass.declaration import inputs_of
from stonepass.model.ureter import Ureter

if TYPE_CHECKING:
    from stonepass.bench.law_fit import Data

__all__ = ["app"]

app = typer.Typer(
    cls=PanelGroup,
    help="Fit the constants of a material law to laboratory tests.",
    epilog="'stonepass fit COMMAND --help' shows the options of a test, with examples.",
    **SETTINGS,
)
TUBE = inputs_of(Ureter)
INNER, OUTER = "Inner diameter of the tube at rest.", "Outer diameter of the tube at rest."
EXIT_CODES = (
    "0 fitted; 1 the fitted constants describe no stable solid; 2 the request was refused; 3 an "
    "error of the program"
)

File = Annotated[
    Path,
    typer.Argument(metavar="DATA.csv", help="Measured data.", rich_help_panel=QUESTION),
]
Law = Annotated[
    str,
    typer.Option(
        "--law",
        metavar="NAME",
        help="Material law; 'stonepass material laws' lists them.",
        rich_help_panel=QUESTION,
        autocompletion=lambda incomplete: _law_names(),
    ),
]
Fix = Annotated[
    list[str] | None,
    typer.Option(
        "--fix",
        metavar="NAME=VALUE",
        help="A constant that is known, e.g. G=12kPa. May be repeated.",
        rich_help_panel=QUESTION,
    ),
]
Free = Annotated[
    list[str] | None,
    typer.Option(
        "--free",
        metavar="NAME",
        help="Fit a constant that otherwise keeps its default. May be repeated.",
        rich_help_panel=QUESTION,
    ),
]
Out = Annotated[
    Path | None,
    typer.Option(
        "--out",
        metavar="LAW.toml",
        help="Write the fitted law as a file that --material reads.",
        rich_help_panel=OUTPUT,
    ),
]
Drawn = Annotated[
    Path | None,
    typer.Option(
        "--figure",
        metavar="OUT.svg",
        help="Draw data, law and residuals (svg, png or pdf).",
        rich_help_panel=OUTPUT,
    ),
]
Relative = Annotated[bool, option_for(RELATIVE, QUESTION)]


@app.command(
    "tensile",
    cls=PanelCommand,
    epilog=epilog(
        (
            (
                "fit tensile examples/latex_tensile.csv --law neo-hookean --width 10mm "
                "--thickness 1.2mm",
                "the modulus of latex from forces on a strip",
            ),
            (
                "fit tensile examples/ureter_tensile.csv --law fung --fix G=12kPa "
                "--fix a1122=0.1856 --out law.toml",
                "three constants of a ureter, two others being known",
            ),
        ),
        EXIT_CODES,
    ),
)
def tensile(
    data: File,
    law: Law,
    width: Annotated[str | None, option_for(SIZES["width"], QUESTION)] = None,
    thickness: Annotated[str | None, option_for(SIZES["thickness"], QUESTION)] = None,
    section: Annotated[str | None, option_for(SIZES["section"], QUESTION)] = None,
    gauge_length: Annotated[str | None, option_for(SIZES["gauge_length"], QUESTION)] = None,
    fix: Fix = None,
    free: Free = None,
    relative: Relative = False,
    out: Out = None,
    figure: Drawn = None,
    json: Json = False,
) -> int:
    """Fit a law to tensile tests of strips.

    The columns of the data are stretch or extension_mm, then nominal_stress_kPa or force_N, and
    axis (circumferential or axial) if strips were cut along both directions.
    """
    from stonepass.bench.test_files import read_tension

    words = {name: each.declaration.option for name, each in SIZES.items()}
    sizes = read_sizes(
        words, width=width, thickness=thickness, section=section, gauge_length=gauge_length
    )
    lengths = ("width", "thickness", "gauge_length")
    inputs = {
        "file": data.name,
        **{f"{name}_m": sizes[name] for name in lengths},
        "section_m2": sizes["section"],
    }
    read = read_tension(data, **sizes)
    return _fit(read, law, fix, free, relative, out, figure, json, inputs)


@app.command(
    "inflation",
    cls=PanelCommand,
    epilog=epilog(
        (
            (
                "fit inflation examples/ureter_inflation.csv --law demiray --inner 3.5mm "
                "--outer 4.55mm",
                "constants from the diameters of a tube under pressure",
            ),
        ),
        EXIT_CODES,
    ),
)
def inflation(
    data: File,
    law: Law,
    inner: Annotated[str, option_for(TUBE["inner_diameter"], QUESTION, meaning=INNER)],
    outer: Annotated[str, option_for(TUBE["outer_diameter"], QUESTION, meaning=OUTER)],
    fix: Fix = None,
    free: Free = None,
    relative: Relative = False,
    out: Out = None,
    figure: Drawn = None,
    json: Json = False,
) -> int:
    """Fit a law to inflation tests of a tube.

    The columns of the data are pressure_kPa, then inner_diameter_mm or outer_diameter_mm, and
    axial_stretch if the tube was stretched along its axis.
    """
    from stonepass.bench.test_files import read_inflation

    tube = Ureter(inner, outer)
    inputs = {
        "file": data.name,
        "inner_diameter_m": tube.inner_diameter,
        "outer_diameter_m": tube.outer_diameter,
    }
    return _fit(read_inflation(data, tube), law, fix, free, relative, out, figure, json, inputs)


def _fit(
    data: Data,
    law: str,
    fix: list[str] | None,
    free: list[str] | None,
    relative: bool,
    out: Path | None,
    figure: Path | None,
    json: bool,
    inputs: dict[str, Any],
) -> int:
    from stonepass.bench.law_fit import fit_law
    from stonepass.cli.terminal import FIGURES, print_json, show, warn, working, writable, wrote
    from stonepass.records.fit import fit_record
    from stonepass.report.fit_report import fit_table

    writable(out, (".toml",))
    writable(figure, FIGURES)
    with working("fitting the constants"):
        name = Path(inputs["file"]).stem
        found = fit_law(data, law, _given(law, fix or []), name, relative=relative, free=free or ())
    if json:
        print_json(fit_record(found, inputs | {"relative": relative}).to_dict())
    else:
        warn(found.warnings)  # first, since some of them say that the numbers cannot be used
        show(fit_table(found), DISCLAIMER)
    if figure is not None:
        from stonepass.report.fit_figure import fit_figure
        from stonepass.report.style import save

        save(fit_figure(found), figure)
        wrote(figure)
    if found.unstable:
        warn([f"the constants {found.told} describe no stable solid: {found.unstable}"])
        if out is not None:
            warn([f"{out} is not written, since the law is not stable"])
        return 1
    if out is not None:
        from stonepass.inputs.material_file import write_law

        write_law(found.material, out)
        wrote(out)
    return 0


def _given(law: str, fix: list[str]) -> dict[str, float]:
    from stonepass.errors import BadInput, refuse_unknown
    from stonepass.materials.constants import fixed_constant
    from stonepass.materials.known_laws import constants_by_name, known_law

    known_law(law, "--law")
    declared = constants_by_name(law)
    found: dict[str, float] = {}
    for text in fix:
        name, separator, value = (part.strip() for part in text.partition("="))
        if not separator:
            raise BadInput("--fix", text, "written as NAME=VALUE")
        if name not in declared:
            refuse_unknown(f"--fix, constant of law '{law}'", name, list(declared))
        if name in found:
            raise BadInput(f"--fix {name}", "given twice", "given once")
        found[name] = fixed_constant(value, declared[name], f"--fix {name}")
    return found


def _law_names() -> list[str]:
    """Return the names of the laws, for the completion of a shell."""
    from stonepass.materials.known_laws import KNOWN_LAWS

    return list(KNOWN_LAWS)
