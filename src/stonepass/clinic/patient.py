"""One patient: the measured quantities of stone and ureter with their uncertainties."""

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
from stonepass.model.pressure_limit import read_limit
from stonepass.model.shape import ASPECT, Shape
from stonepass.model.stone import DIAMETER, FRICTION, SIZE_RATIO, Stone
from stonepass.model.ureter import Ureter
from stonepass.studies.seed import SEED, check_seed
from stonepass.studies.stiffness_input import STIFFNESS_BOUNDS
from stonepass.studies.uncertain_quantity import UncertainQuantity, measured_length, measured_number
from stonepass.units import Length, Pressure, Quantity

__all__ = ["INPUTS", "SHARED_WORDS", "Patient", "PatientFile", "patient_of", "read_patient"]

SAMPLES = (256, 65_536)  # smallest and largest number of samples
LONGEST_TITLE = 120  # largest number of characters of a title
# Values that are assumed if the file does not give friction and stiffness, which are not measured
# in patients.
ASSUMED_FRICTION, ASSUMED_STIFFNESS = "0.05 to 0.5", "1 ± 0.3"
# Names in the patient file, by title, of the inputs that it has in common with case files.
SHARED_WORDS = {
    each.title: f"'{key}'"
    for key, each in all_inputs().items()
    if each.section in ("load", "method")
}
# Names in messages of all quantities that may be uncertain, by their key.
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
    """The measured quantities of one patient, and the settings of the assessment.

    Attributes
    ----------
    measured : mapping of str to UncertainQuantity
        The uncertain quantities by the keys of `INPUTS`, lengths in m. They are the diameter of the
        stone across the ureter, the friction coefficient, the inner diameter and either the outer
        diameter or the wall thickness of the undilated ureter, and the relative stiffness (a factor
        on that of the material). The diameters of the dilated segment above the stone are optional.
    material : Material
        Material of the wall.
    limit : Pressure
        Maximum tolerable urine pressure in Pa, 100 Pa to 100 kPa.
    place : str or None
        Place of the stone in the ureter, one of `cohorts.PLACES`; None if it is unknown.
    shape : Shape
        Shape of the stone.
    load : Load
        Confining pressure and pre-stretch.
    model : Model
        Model of the critical pressure.
    numerics : Numerics
        Accuracy and length of the tube.
    samples : int
        Number of Monte Carlo samples, 256 to 65536.
    seed : int
        Seed of the samples, 0 to 2³² − 1.
    assumed : tuple of Caution
        Warnings about quantities that the file does not give.
    title : str
        Name of the case, at most 120 characters; may be empty.

    References
    ----------
    docs/assess.md, "The file".
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
    seed: int = SEED.default
    assumed: tuple[Caution, ...] = ()
    title: str = ""

    @property
    def dilated(self) -> bool:
        """True if the segment above the stone was measured."""
        return "dilated_inner_diameter" in self.measured

    def with_limit(self, limit: str | Pressure | Quantity) -> Patient:
        """Return the patient with another pressure limit, in Pa or as text with a unit."""
        return replace(self, limit=read_limit(limit))

    def case(self) -> Case:
        """Return the case at the measured values, with the stiffness of the material.

        The confining pressure is divided by the measured relative stiffness s, so that the critical
        pressure of the patient is s times that of this case (docs/theory.md, "A stiffer wall").
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
    seed: int = SEED.default


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
PatientFile = create_model("PatientFile", __base__=_OwnSections, **_SHARED)


def read_patient(path: str | Path) -> Patient:
    """Read a patient file.

    Parameters
    ----------
    path : str or Path
        A TOML file. Relative paths of materials and shapes in it start at its folder.

    Raises
    ------
    BadInput
        A key is unknown (the message names the nearest known one) or missing, a length has no
        uncertainty or no unit, or a value is out of bounds. The message names the file and the key.

    References
    ----------
    docs/assess.md, "The file".
    """
    path = Path(path)
    parsed = read_toml(path, PatientFile)
    try:
        return patient_of(parsed, path.parent)
    except BadInput as problem:
        raise in_words(problem, SHARED_WORDS).within(path.name) from problem


def patient_of(parsed: Any, folder: Path = Path()) -> Patient:
    """Return the patient that a parsed file describes.

    Parameters
    ----------
    parsed : PatientFile
        The sections of a patient file.
    folder : Path, optional
        Folder in which relative paths of materials and shapes start.

    Raises
    ------
    BadInput
        A value is out of bounds, or two values contradict each other. The message names the input
        by its title.
    """
    stone, ureter, dilated = parsed.stone, parsed.ureter, parsed.dilated
    walls = [ureter.outer_diameter, ureter.wall_thickness]
    if sum(wall is not None for wall in walls) != 1:
        state = "missing" if walls == [None, None] else "given twice"
        raise BadInput(
            "wall of the ureter", state, "given as either outer_diameter or wall_thickness"
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
    measured["stiffness"] = measured_number(
        ureter.stiffness, "stiffness", STIFFNESS_BOUNDS, factor=True
    )
    _check(measured)
    _check_place(stone.place)
    low, high = SAMPLES
    count = parsed.assessment.samples
    require(low <= count <= high, "samples", count, f"a whole number from {low} to {high}")
    seed = parsed.assessment.seed
    check_seed(seed)
    assumed = [
        caution(code)
        for code, given, default in (
            ("friction_assumed", stone.friction, ASSUMED_FRICTION),
            ("stiffness_assumed", ureter.stiffness, ASSUMED_STIFFNESS),
        )
        if given == default  # the file may contain the assumed value, too
    ]
    values = section_values(parsed.method, "method")
    model, numerics = build_method(values, folder)
    patient = Patient(
        measured=measured,
        material=find_material(ureter.material, folder),
        limit=read_limit(parsed.assessment.limit),
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
    patient.case()  # checks the measured values
    return patient


def _check_place(place: str | None) -> None:
    """Refuse an unknown place; the message suggests the place that was probably meant."""
    if place is None or place in PLACES:
        return
    meant = place_meant(place)
    if not meant:
        refuse_unknown("place", place, list(PLACES))
    raise BadInput("place", place, "one of " + ", ".join(PLACES), f"did you mean '{meant}'")


def _title(text: str) -> str:
    require(len(text) <= LONGEST_TITLE, "title", text, f"at most {LONGEST_TITLE} characters long")
    return " ".join(text.split())


def _check(measured: Mapping[str, UncertainQuantity]) -> None:
    size = measured["stone_diameter"].value / measured["inner_diameter"].value
    low, high = SIZE_RATIO
    require(low <= size <= high, "stone diameter over inner diameter", round(size, 4),
            f"{low:g} to {high:g}")  # fmt: skip


def _shape(stone: _Stone, folder: Path) -> Shape:
    if stone.shape is not None and stone.aspect is not None:
        raise BadInput("aspect", stone.aspect, "left out if a shape is given")
    if stone.shape is not None:
        return read_shape(folder / stone.shape)
    aspect = 1.0 if stone.aspect is None else stone.aspect
    require(ASPECT[0] <= aspect <= ASPECT[1], "aspect", aspect, f"{ASPECT[0]:g} to {ASPECT[1]:g}")
    return Shape(aspect)
