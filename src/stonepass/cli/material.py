"""``stonepass material``: list, show and check material laws."""

from __future__ import annotations

from typing import Annotated, Any

import typer

__all__ = ["app"]

MODULI = ("C10", "C", "G")

app = typer.Typer(help="List, show and check material laws.", rich_markup_mode=None)

Name = Annotated[
    str, typer.Argument(metavar="NAME", help="Catalogue name, law.toml or file.py:function.")
]


@app.command("list")
def list_materials() -> int:
    """List the catalogue."""
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


@app.command("show")
def show_material(name: Name) -> int:
    """Show a law's constants and where they come from."""
    from dataclasses import asdict, is_dataclass

    from stonepass.cli.terminal import show
    from stonepass.inputs.material_file import find_material

    entry = find_material(name)
    law = entry.law
    constants: dict[str, Any] = (
        asdict(law) if is_dataclass(law) and not isinstance(law, type) else {}
    )
    low, high = entry.strain_range
    rows = {
        "law": type(law).__name__,
        **{key: _constant(key, value) for key, value in constants.items() if key != "function"},
        "stretches": f"{low:g} to {high:g} (circumferential)",
        "source": entry.source,
        "test": entry.test,
        "verified": entry.verified,
    }
    width = max(map(len, rows))
    show(entry.name, *(f"  {key:<{width}}  {value}" for key, value in rows.items()))
    return 0


@app.command("secant")
def secant_of_material(
    name: Name,
    stretch: Annotated[
        float, typer.Option("--stretch", help="Stretch up to which the secants go, e.g. 1.3.")
    ],
) -> int:
    """Show the secant moduli of a law, as the beam model takes them (E1 round, E2 along)."""
    from stonepass.cli.terminal import show
    from stonepass.inputs.material_file import find_material
    from stonepass.materials.secant import secant_moduli
    from stonepass.materials.stability import check

    entry = find_material(name)
    check(entry)
    rows = {"whole law": entry.law, "without the ground matrix": entry.law.without_ground_matrix()}
    if rows["whole law"] == rows["without the ground matrix"]:
        rows.pop("without the ground matrix")
    lines = []
    for what, law in rows.items():
        hoop, axial = secant_moduli(law, stretch)
        lines.append(f"  {what:<26}  E1 {hoop / 1e6:.4g} MPa, E2 {axial / 1e6:.4g} MPa")
    show(f"{entry.name}: nominal plane-strain secants from rest to {stretch:g}", *lines)
    return 0


@app.command("check")
def check_material(name: Name) -> int:
    """Check that a law describes a solid; exit code 2 and the reason where it does not."""
    from stonepass.cli.terminal import show
    from stonepass.inputs.material_file import find_material
    from stonepass.materials.stability import check

    entry = find_material(name)
    state = check(entry)
    show(
        f"{entry.name}: no stress at rest, strongly elliptic over its strain range at axial "
        "stretch 1.",
        f"  circumferential modulus      {state.hoop / 1e6:.4g} MPa",
        f"  axial modulus                {state.axial / 1e6:.4g} MPa",
        f"  circumferential, axis held   {state.plane_hoop / 1e6:.4g} MPa",
        f"  r-z shear modulus            {state.shear / 1e6:.4g} MPa",
    )
    return 0


def _constant(name: str, value: object) -> str:
    if name in MODULI and isinstance(value, float):
        return f"{value / 1e6:g} MPa"
    return f"{value:g}" if isinstance(value, float) else str(value)
