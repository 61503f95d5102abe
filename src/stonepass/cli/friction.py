"""``stonepass friction``: the friction coefficient of a stone from a micrograph of its surface."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from stonepass.about import DISCLAIMER
from stonepass.cli.options import Json

if TYPE_CHECKING:
    from stonepass.surface.paths import StraightPath
    from stonepass.surface.surface_image import Area
    from stonepass.units import Length

__all__ = ["command"]


def command(
    image: Annotated[
        Path, typer.Argument(metavar="IMAGE", help="TIFF, PNG, JPEG, or a height map.")
    ],
    pixel: Annotated[
        str | None,
        typer.Option("--pixel", metavar="LENGTH", help="Size of a pixel; wins over the file's."),
    ] = None,
    height_range: Annotated[
        str | None,
        typer.Option(
            "--height-range", metavar="LENGTH", help="Height from black to white, e.g. 35um."
        ),
    ] = None,
    crystal: Annotated[
        str | None,
        typer.Option(
            "--crystal",
            metavar="LENGTH",
            help="Edge of the cubic crystals; height range is sqrt(3) of it.",
        ),
    ] = None,
    paths: Annotated[
        int | None,
        typer.Option("--paths", help="Horizontal paths, evenly spaced.  [default: 6]"),
    ] = None,
    path: Annotated[
        list[str] | None,
        typer.Option("--path", metavar="X0,Y0,X1,Y1", help="A path in pixels; may be repeated."),
    ] = None,
    area: Annotated[
        str | None,
        typer.Option(
            "--area", metavar="LEFT,TOP,RIGHT,BOTTOM", help="Part that is surface, in pixels."
        ),
    ] = None,
    baseline_order: Annotated[
        int, typer.Option("--baseline-order", help="Half waves of the mean profile's baseline.")
    ] = 8,
    deviation_order: Annotated[
        int | None,
        typer.Option(
            "--deviation-order", help="Of the deviation's baseline.  [default: twice as many]"
        ),
    ] = None,
    level: Annotated[
        bool,
        typer.Option(
            "--level", help="Subtract the least-squares plane first: the tilt of a specimen."
        ),
    ] = False,
    margin: Annotated[
        float,
        typer.Option(
            "--margin",
            metavar="WAVES",
            help="Ends of the paths where the steepest slope is not looked for, in shortest waves "
            "of each baseline, 0 to 2; a quarter of the path at most.",
        ),
    ] = 0.5,
    json: Json = False,
    figure: Annotated[
        Path | None,
        typer.Option("--figure", metavar="OUT.svg", help="Draw the four panels (svg, png, pdf)."),
    ] = None,
) -> int:
    """Estimate the friction coefficient from the slopes of a stone's surface (Eq. 18).

    The file is read in a process of its own, within limits of time and memory.
    """
    from stonepass.cli.terminal import FIGURES, print_json, show, warn, working, writable

    writable(figure, FIGURES)
    scale = _height_range(height_range, crystal)
    lines = _paths(paths, path)
    from stonepass.surface.friction import surface_friction
    from stonepass.surface.untrusted import read_untrusted
    from stonepass.units import length

    size = None if pixel is None else length(pixel, "--pixel")
    part = None if area is None else _area(area)
    with working("reading the picture"):
        picture = read_untrusted(image, area=part)
        if size is not None:
            picture = picture.with_pixel(size)
        found = surface_friction(
            picture, scale, lines, baseline_order, deviation_order, level, margin
        )
    from stonepass.records.friction import friction_record
    from stonepass.report.friction_report import friction_table

    name = image.name.encode(errors="replace").decode()
    if json:
        print_json(friction_record(found, name).to_dict())
    else:
        show(friction_table(found, name), DISCLAIMER)
        warn(found.warnings)
    if figure is not None:
        from stonepass.report.friction_figure import friction_figure
        from stonepass.report.style import save

        save(friction_figure(found), figure)
    return 0


def _height_range(height_range: str | None, crystal: str | None) -> Length | None:
    from stonepass.errors import BadInput, require
    from stonepass.surface.friction import CRYSTAL_DIAGONAL, RELIEF
    from stonepass.units import Length, length

    if height_range is not None and crystal is not None:
        raise BadInput("combination of --height-range and --crystal", "ambiguous", "one of the two")
    if crystal is not None:
        edge = length(crystal, "--crystal")
        require(RELIEF[0] < edge <= RELIEF[1] / 2, "--crystal", crystal, "1 nm to 5 mm")
        return Length(CRYSTAL_DIAGONAL * edge)
    return None if height_range is None else length(height_range, "--height-range")


def _paths(count: int | None, given: list[str] | None) -> int | list[StraightPath]:
    from stonepass.errors import BadInput
    from stonepass.surface.paths import read_path

    if count is not None and given:
        raise BadInput("combination of --paths and --path", "ambiguous", "one of the two")
    if given:
        return [read_path(text) for text in given]
    return 6 if count is None else count


def _area(text: str) -> Area:
    from stonepass.errors import BadInput
    from stonepass.surface.surface_image import Area

    parts = text.split(",")
    whole = all(part.strip().isdecimal() and len(part) < 9 for part in parts)
    if len(parts) != 4 or not whole:
        raise BadInput("--area", text, "four whole numbers LEFT,TOP,RIGHT,BOTTOM in pixels")
    return Area(*(int(part) for part in parts))
