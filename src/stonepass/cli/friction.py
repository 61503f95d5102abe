"""``stonepass friction``: the friction coefficient of a stone from an image of its surface."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from stonepass.about import DISCLAIMER
from stonepass.cli.help import OUTPUT, QUESTION, epilog
from stonepass.cli.options import Json, option_for
from stonepass.declaration import inputs_of
from stonepass.surface.analysis import CRYSTAL, HEIGHT_RANGE, PATHS, PIXEL_SIZE, Analysis

if TYPE_CHECKING:
    from stonepass.surface.paths import StraightPath
    from stonepass.units import Length

__all__ = ["EPILOG", "command"]

ANALYSIS = "Analysis of the surface"
CHOICES = inputs_of(Analysis)
EPILOG = epilog(
    (
        (
            "friction examples/known_slopes.png --pixel 0.5um --height-range 24.8um",
            "the coefficient from a picture whose grey is height",
        ),
        (
            "friction examples/crystals.x3p --figure friction.svg",
            "the coefficient from a measured height map, with the profiles as a figure",
        ),
    ),
    "0 estimated; 2 the request was refused; 3 an error of the program",
)


def command(
    image: Annotated[
        Path,
        typer.Argument(
            metavar="IMAGE",
            help="Picture (TIFF, PNG, JPEG) or height map (X3P, SUR, AL3D and others).",
            rich_help_panel=QUESTION,
        ),
    ],
    pixel: Annotated[str | None, option_for(PIXEL_SIZE, QUESTION)] = None,
    height_range: Annotated[str | None, option_for(HEIGHT_RANGE, QUESTION)] = None,
    crystal: Annotated[str | None, option_for(CRYSTAL, QUESTION)] = None,
    paths: Annotated[int | None, option_for(PATHS, ANALYSIS)] = None,
    path: Annotated[
        list[str] | None,
        typer.Option(
            "--path",
            metavar="X0,Y0,X1,Y1",
            help="Ends of a profile in pixels. May be repeated.",
            rich_help_panel=ANALYSIS,
        ),
    ] = None,
    area: Annotated[
        str | None,
        typer.Option(
            "--area",
            metavar="LEFT,TOP,RIGHT,BOTTOM",
            help="Part of the image that shows the surface, in pixels.",
            rich_help_panel=ANALYSIS,
        ),
    ] = None,
    baseline_order: Annotated[int, option_for(CHOICES["baseline_order"], ANALYSIS)] = (
        Analysis.baseline_order
    ),
    deviation_order: Annotated[
        int | None, option_for(CHOICES["deviation_order"], ANALYSIS)
    ] = Analysis.deviation_order,
    level: Annotated[bool, option_for(CHOICES["level"], ANALYSIS)] = Analysis.level,
    margin: Annotated[float, option_for(CHOICES["margin"], ANALYSIS)] = Analysis.margin,
    json: Json = False,
    figure: Annotated[
        Path | None,
        typer.Option(
            "--figure",
            metavar="OUT.svg",
            help="Draw the image, the profiles and their slopes (svg, png or pdf).",
            rich_help_panel=OUTPUT,
        ),
    ] = None,
) -> int:
    """Estimate the friction coefficient from the slopes of a stone's surface, by Eq. 18.

    The image is read in a separate process with limited time and memory, since it may come from
    an unknown source.
    """
    from stonepass.cli.terminal import FIGURES, print_json, show, warn, working, writable, wrote

    writable(figure, FIGURES)
    scale = _height_range(height_range, crystal)
    lines = _paths(paths, path)
    from stonepass.surface.friction import surface_friction
    from stonepass.surface.sandboxed import read_in_sandbox
    from stonepass.surface.surface_image import read_area
    from stonepass.units import length

    size = None if pixel is None else length(pixel, "--pixel")
    part = None if area is None else read_area(area, "--area")
    with working("reading the image"):
        picture = read_in_sandbox(image, area=part)
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
        wrote(figure)
    return 0


def _height_range(height_range: str | None, crystal: str | None) -> Length | None:
    from stonepass.errors import BadInput
    from stonepass.surface.height_range import crystal_height
    from stonepass.units import length

    if height_range is not None and crystal is not None:
        raise BadInput("combination of --height-range and --crystal", "ambiguous", "one of the two")
    if crystal is not None:
        return crystal_height(crystal, "--crystal")
    return None if height_range is None else length(height_range, "--height-range")


def _paths(count: int | None, given: list[str] | None) -> int | list[StraightPath]:
    from stonepass.errors import BadInput
    from stonepass.surface.paths import read_path

    if count is not None and given:
        raise BadInput("combination of --paths and --path", "ambiguous", "one of the two")
    if given:
        return [read_path(text, "--path") for text in given]
    return PATHS.default if count is None else count
