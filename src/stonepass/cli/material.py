"""``stonepass material``: list, show and check material laws."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer

from stonepass.cli.app import SETTINGS
from stonepass.cli.help import QUESTION, PanelCommand, PanelGroup, epilog
from stonepass.cli.options import complete_material

if TYPE_CHECKING:
    from stonepass.materials.protocol import Law

__all__ = ["app"]

app = typer.Typer(
    cls=PanelGroup,
    help="List, show and check material laws.",
    epilog="'stonepass material COMMAND --help' explains a command, with examples.",
    **SETTINGS,
)

ONE_SIDED = 1e-4  # relative difference of a modulus in tension and in compression that is shown
LISTED = "0 listed; 3 an error of the program"
SHOWN = "0 shown; 2 the request was refused; 3 an error of the program"
CHECKED = (
    "0 the law describes a stable solid; 2 it does not (the message says why), or the request was "
    "refused; 3 an error of the program"
)

Name = Annotated[
    str,
    typer.Argument(
        metavar="NAME",
        help="Catalogue name, law.toml or file.py:function.",
        rich_help_panel=QUESTION,
        autocompletion=complete_material,
    ),
]


def _epilog(example: str, meaning: str, exit_codes: str = SHOWN) -> str:
    return epilog(((f"material {example}", meaning),), exit_codes)


@app.command(
    "list", cls=PanelCommand, epilog=_epilog("list", "the materials of the catalogue", LISTED)
)
def list_materials() -> int:
    """List the materials of the catalogue."""
    from rich import box
    from rich.table import Table

    from stonepass.cli.terminal import show
    from stonepass.materials.catalogue import CATALOGUE

    table = Table(box=box.SIMPLE_HEAD)
    for column in ("name", "law", "stretches", "verified"):
        table.add_column(column)
    for entry in CATALOGUE.values():
        low, high = entry.strain_range
        table.add_row(
            entry.name, type(entry.law).__name__, f"{low:g}–{high:g}", entry.verified.split(";")[0]
        )
    show(table)
    return 0


@app.command(
    "laws",
    cls=PanelCommand,
    epilog=_epilog("laws", "every law with its constants, their units and bounds", LISTED),
)
def list_laws() -> int:
    """List the material laws with their constants, for law files and fits."""
    from rich import box
    from rich.table import Table

    from stonepass.cli.terminal import show
    from stonepass.materials.constants import constants_of
    from stonepass.materials.known_laws import COMPOSED, KNOWN_LAWS

    table = Table(box=box.SIMPLE_HEAD)
    for column in ("law", "constant", "unit", "must be", "meaning"):
        table.add_column(column)
    for name, law in KNOWN_LAWS.items():
        for k, each in enumerate(constants_of(law)):
            unit = {"1": "–", "rad": "deg or rad"}.get(each.unit, each.unit)
            shown = each.name if each.default is None else f"{each.name} (may be left out)"
            table.add_row("" if k else name, shown, unit, each.allowed, each.meaning)
    table.add_row(COMPOSED, "fibres", "–", "a table", "a law with its constants")
    table.add_row("", "matrix", "–", "a table", "a law with its constants, whose energy is added")
    show(table)
    return 0


@app.command(
    "show",
    cls=PanelCommand,
    epilog=_epilog("show ureter", "constants and source of the default wall"),
)
def show_material(name: Name) -> int:
    """Show the constants of a material and the source that they come from."""
    from stonepass.cli.terminal import show
    from stonepass.inputs.material_file import find_material

    entry = find_material(name)
    low, high = entry.strain_range
    rows = {
        **_rows_of(entry.law),
        "stretches": f"{low:g} to {high:g} (circumferential)",
        "source": entry.source,
        "test": entry.test,
        "verified": entry.verified,
    }
    width = max(map(len, rows))
    show(entry.name, *(f"  {key:<{width}}  {value}" for key, value in rows.items()))
    return 0


@app.command(
    "secant",
    cls=PanelCommand,
    epilog=_epilog("secant ureter --stretch 1.3", "both moduli up to a stretch of 1.3"),
)
def secant_of_material(
    name: Name,
    stretch: Annotated[
        float,
        typer.Option(
            "--stretch",
            metavar="NUMBER",
            help="Stretch at which the secants end, e.g. 1.3.",
            rich_help_panel=QUESTION,
        ),
    ],
) -> int:
    """Show the secant moduli of a material as the model 'beam' uses them.

    E1 is the circumferential modulus and E2 the longitudinal one.
    """
    from stonepass.cli.terminal import show
    from stonepass.inputs.material_file import find_material
    from stonepass.materials.composition import fibres_of
    from stonepass.materials.secant import secant_moduli
    from stonepass.materials.stability import check

    entry = find_material(name)
    check(entry)
    rows = {"whole law": entry.law, "without the ground matrix": fibres_of(entry.law)}
    if rows["whole law"] == rows["without the ground matrix"]:
        rows.pop("without the ground matrix")
    lines = []
    for what, law in rows.items():
        hoop, axial = secant_moduli(law, stretch)
        lines.append(f"  {what:<26}  E1 {hoop / 1e6:.4g} MPa, E2 {axial / 1e6:.4g} MPa")
    show(f"{entry.name}: nominal plane-strain secants from rest to {stretch:g}", *lines)
    return 0


@app.command(
    "check",
    cls=PanelCommand,
    epilog=_epilog(
        "check examples/soft_ureter.toml", "whether a law file describes a stable solid", CHECKED
    ),
)
def check_material(name: Name) -> int:
    """Check that a material describes a stable solid."""
    from stonepass.cli.terminal import show, warn
    from stonepass.inputs.material_file import find_material
    from stonepass.materials.stability import check, one_sided_moduli
    from stonepass.model.states.law_trial import check_in_engine
    from stonepass.model.validity import law_cautions

    entry = find_material(name)
    state = check(entry)
    check_in_engine(entry)
    names = ("circumferential modulus", "axial modulus", "circumferential, length held")
    sides = zip(one_sided_moduli(entry.law, 1.0), one_sided_moduli(entry.law, -1.0), strict=True)
    rows = {name: _modulus(*both) for name, both in zip(names, sides, strict=True)}
    rows["r-z shear modulus"] = _modulus(state.shear, state.shear)
    warn(law_cautions(entry))
    show(
        f"{entry.name}: free of stress at rest, strongly elliptic over its strain range at axial "
        "stretch 1, and equal in the finite elements and in NumPy.",
        *(f"  {what:<26}   {value}" for what, value in rows.items()),
    )
    return 0


def _rows_of(law: Law, part: str = "") -> dict[str, str]:
    """Return the name and the constants of a law, and those of the laws inside a composed one."""
    from stonepass.materials.composition import Composed
    from stonepass.materials.constants import constants_of, shown_constant

    rows = {f"{part}law": type(law).__name__}
    if isinstance(law, Composed):
        return (
            rows | _rows_of(law.fibres, f"{part}fibres.") | _rows_of(law.matrix, f"{part}matrix.")
        )
    constants = {
        f"{part}{each.name}": shown_constant(getattr(law, each.name), each)
        for each in constants_of(law)
    }
    return rows | constants


def _modulus(tension: float, compression: float) -> str:
    """Write one modulus, or two for a law whose fibres bear tension only."""
    if abs(tension - compression) <= ONE_SIDED * max(tension, compression):
        return f"{tension / 1e6:.4g} MPa"
    return f"{tension / 1e6:.4g} MPa in tension, {compression / 1e6:.4g} MPa in compression"
