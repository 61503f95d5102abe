"""Jobs about uploaded files: the constants of a wall, and the friction of a surface."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from stonepass.bench.law_fit import fit_law
from stonepass.bench.test_files import read_inflation, read_tension
from stonepass.inputs.material_file import material_table
from stonepass.materials.constants import fixed_constant
from stonepass.materials.known_laws import constants_by_name
from stonepass.model.ureter import Ureter
from stonepass.records.fit import fit_record
from stonepass.records.friction import friction_record
from stonepass.report.fit_figure import fit_figure
from stonepass.report.friction_figure import friction_figure
from stonepass.report.html import svg_of
from stonepass.surface.friction import surface_friction
from stonepass.surface.height_range import crystal_height
from stonepass.surface.paths import StraightPath
from stonepass.surface.sandboxed import read_in_sandbox
from stonepass.surface.surface_image import PixelArea
from stonepass.units import Length, length
from stonepass.units import area as read_area
from stonepass.web.api_words import UPLOAD, api_words
from stonepass.web.jobs.bodies import FitJob, FrictionJob
from stonepass.web.jobs.context import Context, Done

__all__ = ["TASKS"]

NAME = "fitted wall"  # name of the fitted material


def _fit(request: Mapping[str, Any], context: Context) -> Done:
    """Return the record of the fit, its figure, and the table of the material for a case."""
    body = FitJob.model_validate(request)
    assert context.file is not None
    known = constants_by_name(body.law)
    fixed = {name: fixed_constant(text, known[name], name) for name, text in body.fix.items()}
    inputs: dict[str, Any] = {"file": UPLOAD, "relative": body.relative}
    context.tell(0, 0, "Fitting the constants.")
    if body.test == "inflation":
        assert body.inner is not None
        assert body.outer is not None
        tube = Ureter(body.inner, body.outer)
        inputs["inner_diameter_m"] = tube.inner_diameter
        inputs["outer_diameter_m"] = tube.outer_diameter
        read: Any = read_inflation(context.file, tube)
    else:
        sizes = {
            name: None if text is None else length(text, name)
            for name, text in (
                ("width", body.width),
                ("thickness", body.thickness),
                ("gauge_length", body.gauge_length),
            )
        }
        across = None if body.section is None else read_area(body.section, "section")
        inputs |= {f"{name}_m": size for name, size in sizes.items()} | {"section_m2": across}
        read = read_tension(context.file, **sizes, section=across)
    found = fit_law(read, body.law, fixed, NAME, relative=body.relative, free=body.free)
    return Done(
        _in_api_words(fit_record(found, inputs).to_dict())
        | {
            "material": None if found.unstable else material_table(found.material),
            "figure_svg": svg_of(fit_figure(found)),
        }
    )


def _friction(request: Mapping[str, Any], context: Context) -> Done:
    """Return the record of the friction coefficient and its figure."""
    body = FrictionJob.model_validate(request)
    assert context.file is not None
    context.tell(0, 0, "Reading the picture.")
    numbers = context.area if body.area is None else body.area
    area = None if numbers is None else PixelArea(*numbers)
    picture = read_in_sandbox(context.file, area=area)
    if body.pixel is not None:
        picture = picture.with_pixel(length(body.pixel, "pixel"))
    context.tell(0, 0, "Computing the slopes of the surface.")
    found = surface_friction(
        picture,
        _height_range(body),
        [StraightPath(*each) for each in body.path] or body.paths,
        body.baseline_order,
        body.deviation_order,
        body.level,
        body.margin,
    )
    figure = svg_of(friction_figure(found))
    record = _in_api_words(friction_record(found, UPLOAD).to_dict())
    record["notes"] = [api_words(note) for note in record["notes"]]
    return Done(record | {"figure_svg": figure})


def _in_api_words(record: dict[str, Any]) -> dict[str, Any]:
    """Return a record whose warnings name keys of the API instead of options."""
    told = [each | {"sentence": api_words(each["sentence"])} for each in record["warnings"]]
    return record | {"warnings": told}


def _height_range(body: FrictionJob) -> Length | None:
    if body.crystal is not None:
        return crystal_height(body.crystal)
    return None if body.height_range is None else length(body.height_range, "height_range")


TASKS = {"fit": _fit, "friction": _friction}
