"""``stonepass fit``: constants of a law from a bench's data."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from stonepass.about import DISCLAIMER
from stonepass.cli.options import Json

if TYPE_CHECKING:
    from stonepass.bench.law_fit import Data

__all__ = ["app"]

app = typer.Typer(help="Fit the constants of a law to bench data.", rich_markup_mode=None)

File = Annotated[Path, typer.Argument(metavar="DATA.csv")]
Law = Annotated[str, typer.Option("--law", help="See 'stonepass material laws'.")]
Fix = Annotated[
    list[str] | None,
    typer.Option("--fix", metavar="NAME=VALUE", help="A constant that is known, e.g. G=12kPa."),
]
Free = Annotated[
    list[str] | None,
    typer.Option("--free", metavar="NAME", help="Fit a constant that otherwise keeps its default."),
]
Out = Annotated[
    Path | None, typer.Option("--out", metavar="LAW.toml", help="Write the law, for --material.")
]
Drawn = Annotated[
    Path | None,
    typer.Option("--figure", metavar="OUT.svg", help="Draw data, law and residuals."),
]


Relative = Annotated[
    bool,
    typer.Option(
        "--relative/--absolute",
        help="Errors in proportion to what was measured, or equal.  [default: absolute]",
    ),
]


@app.command("tensile")
def tensile(
    data: File,
    law: Law,
    width: Annotated[
        str | None, typer.Option("--width", metavar="LENGTH", help="Of the strip, for force_N.")
    ] = None,
    thickness: Annotated[
        str | None, typer.Option("--thickness", metavar="LENGTH", help="Of the strip.")
    ] = None,
    section: Annotated[
        str | None,
        typer.Option("--section", metavar="AREA", help="Of the strip, e.g. 12mm2, for force_N."),
    ] = None,
    gauge_length: Annotated[
        str | None,
        typer.Option("--gauge-length", metavar="LENGTH", help="At rest, for extension_mm."),
    ] = None,
    fix: Fix = None,
    free: Free = None,
    relative: Relative = False,
    out: Out = None,
    figure: Drawn = None,
    json: Json = False,
) -> int:
    """Fit to strips: stretch or extension_mm, nominal_stress_kPa or force_N[, axis]."""
    from stonepass.bench.test_data import read_tension
    from stonepass.units import area, length

    sizes = {
        key: None if text is None else length(text, option)
        for key, option, text in (
            ("width", "--width", width),
            ("thickness", "--thickness", thickness),
            ("gauge_length", "--gauge-length", gauge_length),
        )
    }
    across = None if section is None else area(section, "--section")
    asked = {"file": data.name, **{f"{key}_m": size for key, size in sizes.items()}}
    inputs = {**asked, "section_m2": across}
    read = read_tension(data, **sizes, section=across)
    return _fit(read, law, fix, free, relative, out, figure, json, inputs)


@app.command("inflation")
def inflation(
    data: File,
    law: Law,
    inner: Annotated[
        str, typer.Option("--inner", metavar="LENGTH", help="Inner diameter of the tube at rest.")
    ],
    outer: Annotated[
        str, typer.Option("--outer", metavar="LENGTH", help="Outer diameter of the tube at rest.")
    ],
    fix: Fix = None,
    free: Free = None,
    relative: Relative = False,
    out: Out = None,
    figure: Drawn = None,
    json: Json = False,
) -> int:
    """Fit to a tube under pressure: pressure_kPa, inner_ or outer_diameter_mm[, axial_stretch]."""
    from stonepass.bench.test_data import read_inflation
    from stonepass.model.ureter import Ureter

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
    from stonepass.cli.terminal import FIGURES, print_json, show, warn, working, writable
    from stonepass.records.fit import fit_record
    from stonepass.report.fit_report import fit_table

    writable(out, (".toml",))
    writable(figure, FIGURES)
    with working("fitting"):
        name = Path(inputs["file"]).stem
        found = fit_law(data, law, _given(law, fix or []), name, relative=relative, free=free or ())
    if json:
        print_json(fit_record(found, inputs | {"relative": relative}).to_dict())
    else:
        warn(found.warnings)  # before the numbers, which they may speak against
        show(fit_table(found), DISCLAIMER)
    if figure is not None:
        from stonepass.report.fit_figure import fit_figure
        from stonepass.report.style import save

        save(fit_figure(found), figure)
    if found.unstable:
        warn([f"these constants, {found.told}, are not a solid: {found.unstable}"])
        if out is not None:
            warn([f"{out} is not written, since the law is not stable"])
        return 1
    if out is not None:
        from stonepass.inputs.material_file import write_law

        write_law(found.material, out)
    return 0


def _given(law: str, fix: list[str]) -> dict[str, float]:
    from stonepass.errors import BadInput, refuse_unknown
    from stonepass.materials.constants import read_constant
    from stonepass.materials.known_laws import constants_by_name, known_law

    known_law(law, "--law")
    declared, found = constants_by_name(law), {}
    for text in fix:
        name, separator, value = (part.strip() for part in text.partition("="))
        if not separator:
            raise BadInput("--fix", text, "written NAME=VALUE")
        if name not in declared:
            refuse_unknown(f"--fix, constant of law '{law}'", name, list(declared))
        found[name] = read_constant(value, declared[name], f"--fix {name}")
    return found
