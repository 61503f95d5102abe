"""One patient: measurements of stone and ureter from imaging, each with its uncertainty."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from pydantic import Field, create_model

from stonepass.caution import Caution, caution
from stonepass.clinic.cohorts import PLACES, place_meant
from stonepass.errors import BadInput, refuse_unknown, require
from stonepass.inputs.build import build_load, build_method, in_words
from stonepass.inputs.catalogue import all_inputs
from stonepass.inputs.material_file import find_material
from stonepass.inputs.sections import FileSection, section_model, section_values
from stonepass.inputs.shape_file import read_shape
from stonepass.io.toml_file import read_toml
from stonepass.materials.protocol import Material
from stonepass.model.answer import Model
from stonepass.model.case import Case
from stonepass.model.load import Load
from stonepass.model.models.seated_balance import SeatedBalance
from stonepass.model.numerics import Numerics
from stonepass.model.shape import ASPECT, Shape
from stonepass.model.stone import DIAMETER, FRICTION, SIZE_RATIO, Stone
from stonepass.model.ureter import Ureter
from stonepass.studies.uncertain_quantity import UncertainQuantity, measured_length, measured_number
from stonepass.units import Length, Pressure, pressure

__all__ = ["INPUTS", "Patient", "read_patient"]

STIFFNESS = (0.05, 20.0)
LIMIT = (100.0, 1e5)  # Pa
SAMPLES = (256, 65_536)
LARGEST_SEED = 2**32
LONGEST_TITLE = 120  # characters
# Quantities that are not measured in a patient, and the values assumed if the file has none.
ASSUMED_FRICTION, ASSUMED_STIFFNESS = "0.05 to 0.5", "1 ± 0.3"
# Names in the file of inputs whose sections are those of a case file.
SHARED_WORDS = {
    each.title: f"'{key}'"
    for key, each in all_inputs().items()
    if each.section in ("load", "method")
}
# Every number that may be uncertain, by its name in the file.
INPUTS = {
    "stone_diameter": "stone diameter",
    "friction": "friction",
    "inner_diameter": "inner diameter",
    "outer_diameter": "outer diameter",
    "wall_thickness": "wall thickness",
    "stiffness": "stiffness",
    "dilated_inner_diameter": "dilated inner diameter",
    "dilated_outer_diameter": "dilated outer diameter",
}


@dataclass(frozen=True)
class Patient:
    """The measurements of one patient.

    Attributes
    ----------
    measured : dict of str to UncertainQuantity
        Quantities by the names in `INPUTS`, lengths in m: the diameter of the stone across the
        ureter; friction; the inner diameter of the ureter where nothing dilates it, with the outer
        diameter or the wall thickness; the stiffness over that of the material; and, if it was
        measured, the diameters of the dilated segment above the stone.
    material : Material
    limit : Pressure
        Maximum tolerable urine pressure.
    place : str or None
        Place of the stone, one of `cohorts.PLACES`.
    shape : Shape
    load : Load
    model : Model
    numerics : Numerics
    samples, seed : int
    assumed : tuple of Caution
        Cautions about values that the file does not have and that are assumed.
    title : str
        Name of the case for the report.
    """

    measured: Mapping[str, UncertainQuantity]
    material: Material
    limit: Pressure
    place: str | None = None
    shape: Shape = field(default_factory=Shape)
    load: Load = field(default_factory=Load)
    model: Model = field(default_factory=SeatedBalance)
    numerics: Numerics = field(default_factory=Numerics)
    samples: int = 4096
    seed: int = 1
    assumed: tuple[Caution, ...] = ()
    title: str = ""

    @property
    def dilated(self) -> bool:
        """Whether the segment above the stone was measured."""
        return "dilated_inner_diameter" in self.measured

    def with_limit(self, limit: str | Pressure) -> Patient:
        """Return the same patient with another pressure limit."""
        return replace(self, limit=_limit(limit))

    def case(self) -> Case:
        """Return the case at the measured values with the material's own stiffness.

        Its confining pressure is divided by the stiffness s, so the critical pressure of the
        patient is s times that of this case.
        """
        value = {name: each.value for name, each in self.measured.items()}
        inner = value["inner_diameter"]
        outer = value.get("outer_diameter", inner + 2.0 * value.get("wall_thickness", 0.0))
        ureter = Ureter(Length(inner), Length(outer), self.material)
        stone = Stone(Length(value["stone_diameter"]), value["friction"], shape=self.shape)
        outside = Pressure(self.load.confining_pressure / value["stiffness"])
        return Case(stone, ureter, replace(self.load, confining_pressure=outside),
                    self.model, self.numerics)  # fmt: skip


class _Stone(FileSection):
    diameter: str
    friction: str = ASSUMED_FRICTION
    place: str | None = None
    aspect: float | None = None
    shape: str | None = None


class _Ureter(FileSection):
    inner_diameter: str
    outer_diameter: str | None = None
    wall_thickness: str | None = None
    material: str = "ureter"
    stiffness: str = ASSUMED_STIFFNESS


class _Dilated(FileSection):
    inner_diameter: str
    outer_diameter: str | None = None


class _Assessment(FileSection):
    limit: str
    title: str = ""
    samples: int = 4096
    seed: int = 1


class _OwnSections(FileSection):
    stone: _Stone
    ureter: _Ureter
    assessment: _Assessment
    dilated: _Dilated | None = None


# The sections that a patient's file shares with a case file follow from the declared inputs.
_SHARED: dict[str, Any] = {
    name: (section_model(name), Field(default_factory=section_model(name)))
    for name in ("load", "method")
}
_PatientFile = create_model("_PatientFile", __base__=_OwnSections, **_SHARED)


def read_patient(path: str | Path) -> Patient:
    """Read the file of a patient; relative paths of materials and shapes start at its folder.

    Raises
    ------
    BadInput
        The file has an unknown key (the nearest known one is named), lacks a key, or has a length
        without uncertainty or unit, or a value out of bounds.
    """
    path = Path(path)
    parsed = read_toml(path, _PatientFile)
    try:
        return _patient(parsed, path.parent)
    except BadInput as problem:
        raise in_words(problem, SHARED_WORDS).within(path.name) from problem


def _patient(parsed: Any, folder: Path) -> Patient:
    stone, ureter, dilated = parsed.stone, parsed.ureter, parsed.dilated
    walls = [ureter.outer_diameter, ureter.wall_thickness]
    if sum(wall is not None for wall in walls) != 1:
        state = "missing" if walls == [None, None] else "given twice"
        raise BadInput(
            "wall of the ureter", state, "given once, as outer_diameter or wall_thickness"
        )
    texts = {
        "stone_diameter": stone.diameter,
        "inner_diameter": ureter.inner_diameter,
        "outer_diameter": ureter.outer_diameter,
        "wall_thickness": ureter.wall_thickness,
        "dilated_inner_diameter": None if dilated is None else dilated.inner_diameter,
        "dilated_outer_diameter": None if dilated is None else dilated.outer_diameter,
    }
    measured = {
        name: measured_length(text, INPUTS[name], DIAMETER)
        for name, text in texts.items()
        if text is not None
    }
    measured["friction"] = measured_number(stone.friction, "friction", FRICTION)
    measured["stiffness"] = measured_number(ureter.stiffness, "stiffness", STIFFNESS, factor=True)
    _check(measured)
    _check_place(stone.place)
    low, high = SAMPLES
    count = parsed.assessment.samples
    require(low <= count <= high, "samples", count, f"a whole number from {low} to {high}")
    seed = parsed.assessment.seed
    require(0 <= seed < LARGEST_SEED, "seed", seed, f"from 0 to {LARGEST_SEED - 1}")
    assumed = [
        caution(code)
        for code, given, default in (
            ("friction_assumed", stone.friction, ASSUMED_FRICTION),
            ("stiffness_assumed", ureter.stiffness, ASSUMED_STIFFNESS),
        )
        if given == default  # the assumed values may be written out in the file
    ]
    values = section_values(parsed.method, "method")
    model, numerics = build_method(values, folder)
    patient = Patient(
        measured=measured,
        material=find_material(ureter.material, folder),
        limit=_limit(parsed.assessment.limit),
        place=stone.place,
        shape=_shape(stone, folder),
        load=build_load(section_values(parsed.load, "load")),
        model=model,
        numerics=numerics,
        samples=count,
        seed=seed,
        assumed=tuple(assumed),
        title=_title(parsed.assessment.title),
    )
    patient.case()  # refuses measured values that no case can have
    return patient


def _check_place(place: str | None) -> None:
    """Refuse an unknown place, with the place that was probably meant."""
    if place is None or place in PLACES:
        return
    meant = place_meant(place)
    if not meant:
        refuse_unknown("place", place, list(PLACES))
    raise BadInput("place", place, "one of " + ", ".join(PLACES), f"did you mean '{meant}'")


def _title(text: str) -> str:
    require(len(text) <= LONGEST_TITLE, "title", text, f"at most {LONGEST_TITLE} characters long")
    return " ".join(text.split())


def _limit(value: str | Pressure) -> Pressure:
    limit = pressure(value, "limit")
    require(LIMIT[0] <= limit <= LIMIT[1], "limit", value, "0.1 kPa to 100 kPa")
    return limit


def _check(measured: Mapping[str, UncertainQuantity]) -> None:
    size = measured["stone_diameter"].value / measured["inner_diameter"].value
    low, high = SIZE_RATIO
    require(low <= size <= high, "stone diameter over inner diameter", round(size, 4),
            f"{low:g} to {high:g}")  # fmt: skip


def _shape(stone: _Stone, folder: Path) -> Shape:
    if stone.shape is not None and stone.aspect is not None:
        raise BadInput("aspect", stone.aspect, "left out beside a shape, which has its own")
    if stone.shape is not None:
        return read_shape(folder / stone.shape)
    aspect = 1.0 if stone.aspect is None else stone.aspect
    require(ASPECT[0] <= aspect <= ASPECT[1], "aspect", aspect, f"{ASPECT[0]:g} to {ASPECT[1]:g}")
    return Shape(aspect)
