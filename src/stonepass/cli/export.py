"""``stonepass export``: the same case for another finite-element program, or to look at."""

from __future__ import annotations

import shlex
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from stonepass.cli.options import Settings, takes_settings
from stonepass.errors import BadInput, refuse_unknown
from stonepass.io.text_file import write_text

if TYPE_CHECKING:
    from stonepass.model.case import Case

__all__ = ["command"]

FORMATS = ("inp", "feb", "vtu")
ENDINGS = tuple(f".{each}" for each in FORMATS)


@takes_settings()
def command(
    settings: Settings,
    out: Annotated[Path, typer.Option("--out", metavar="FILE", help="Where to write it.")],
    format: Annotated[
        str | None,
        typer.Option(
            "--format",
            help="inp: CalculiX or Abaqus; feb: FEBio; vtu: our solved wall.  "
            "[default: the ending of --out]",
        ),
    ] = None,
    flavour: Annotated[
        str | None,
        typer.Option("--flavour", help="Of a deck: calculix or abaqus.  [default: calculix]"),
    ] = None,
    element: Annotated[
        str | None, typer.Option("--element", help="Of a deck: CAX8 or CAX8R.  [default: CAX8]")
    ] = None,
    fine: Annotated[
        float | None,
        typer.Option(
            "--fine",
            help="Deck, model: elements in the contact, in inner radii.  [default: 0.025 or less]",
        ),
    ] = None,
) -> int:
    """Write the seated state as a deck or model for another program, or as a solved wall.

    Lengths are in millimetres, with an inner radius of 1 mm where only ratios are given; stresses
    in a deck or model in kPa, in a VTU in Pa. Give the stone as for pressure.
    """
    if format is None and out.suffix.lower() not in ENDINGS:
        raise BadInput("ending of --out", out.name, "one of " + ", ".join(ENDINGS),
                       "or give a --format")  # fmt: skip
    kind = out.suffix.lower().removeprefix(".") if format is None else format
    if kind not in FORMATS:
        refuse_unknown("--format", kind, list(FORMATS))
    for name, value in (("--flavour", flavour), ("--element", element)):
        if value is not None and kind != "inp":
            raise BadInput(name, value, f"left out with --format {kind}", "it is of a deck")
    if fine is not None and kind == "vtu":
        raise BadInput("--fine", fine, "left out with --format vtu", "--accuracy sets its mesh")
    from stonepass.cli.terminal import show, writable

    writable(out, (f".{kind}",))
    case = settings.case()
    if kind == "vtu":
        return _write_wall(case, out)
    from stonepass.export.seating import seating

    model = seating(case, fine)
    if kind == "feb":
        from stonepass.export.feb import write_feb

        text, way_on = write_feb(model), f"run it with: febio4 -i {shlex.quote(out.name)}"
    else:
        from stonepass.export.inp import write_inp

        chosen = "CAX8" if element is None else element
        text = write_inp(model, chosen, "calculix" if flavour is None else flavour)
        job = shlex.quote(out.stem)
        way_on = (
            f"run it with: abaqus job={job} input={shlex.quote(out.name)}"
            if flavour == "abaqus"
            else f"run it with: ccx {job}; then: stonepass compare … {job}.dat"
        )
    write_text(out, text)
    size = f"{len(model.wall.cells)} elements, {model.length:.4g} R_a of travel"
    show(f"{out.name}: {size}; {way_on}")
    return 0


def _write_wall(case: Case, out: Path) -> int:
    """Solve, and write the wall with its stress."""
    from stonepass.cli.terminal import show, warn, working
    from stonepass.model.critical import solve
    from stonepass.units import METRE_PER_MM

    if case.method.model == "beam":
        raise BadInput(
            "model", "beam", "'paper' or 'direct' for a VTU", "a beam has no solved wall"
        )
    with working("solving for the wall"):
        answer = solve(case)
    warn(answer.warnings)
    if answer.state is None or answer.state.wall is None:
        show(f"{answer.outcome.name}: {answer.message}")
        warn(["there is no solved wall, so nothing was written"])
        return 1
    from stonepass.export.vtu import write_vtu

    diameter = case.ureter.inner_diameter
    radius = 1.0 if diameter is None else diameter / 2.0 / METRE_PER_MM
    half = answer.pushed is None and case.stone.shape.symmetric
    write_vtu(out, answer.state.wall, mirrored=half, inner_radius=radius)
    show(f"{out.name}: {answer.state.wall.r.size} points of the meridian, turned round the axis")
    return 0
