"""One person: what imaging says of stone and ureter, each number with its uncertainty."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from stonepass.clinic.cohorts import PLACES
from stonepass.errors import BadInput, refuse_unknown, require
from stonepass.inputs.case_file import FileSection, LoadSection, MethodSection
from stonepass.inputs.material_file import find_material
from stonepass.inputs.shape_file import read_shape
from stonepass.io.toml_file import read_toml
from stonepass.materials.protocol import Material
from stonepass.model.case import DIAMETER, FRICTION, SIZE_RATIO, Case, Load, Method, Stone, Ureter
from stonepass.model.shape import ASPECT, Shape
from stonepass.studies.uncertain_quantity import UncertainQuantity, measured_length, measured_number
from stonepass.units import Length, Pressure, pressure

__all__ = ["INPUTS", "Patient", "read_patient"]

STIFFNESS = (0.05, 20.0)
LIMIT = (100.0, 1e5)  # Pa
SAMPLES = (256, 65_536)
LARGEST_SEED = 2**32
# What nobody measures in a person, and what stands in where the file is silent.
ASSUMED_FRICTION, ASSUMED_STIFFNESS = "0.05 to 0.5", "1 ± 0.3"
WHY_FRICTION = (
    "friction is taken from 0.05 to 0.5: nobody has measured it between a stone and a ureter; "
    "wet tissue lies far below the paper's 0.5, which is estimated from a dry crystal's slopes"
)
WHY_STIFFNESS = (
    "the wall's stiffness is taken to be 1 ± 0.3 times the material's: how much people differ "
    "is not published"
)
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
    """What is known of one person.

    Attributes
    ----------
    measured : dict of str to UncertainQuantity
        By the names in `INPUTS`: the stone's diameter across the ureter, friction, inner and either
        outer diameter or wall thickness of the ureter where nothing dilates it, stiffness as a
        factor on the material's, and, where the segment above the stone was measured, its
        diameters. Lengths in m.
    material : Material
    limit : Pressure
        Bearable urine pressure.
    place : str or None
        In `cohorts.PLACES`.
    shape : Shape
    load : Load
    method : Method
    samples, seed : int
    assumed : tuple of str
        What the file leaves to us, in sentences.
    """

    measured: Mapping[str, UncertainQuantity]
    material: Material
    limit: Pressure
    place: str | None = None
    shape: Shape = field(default_factory=Shape)
    load: Load = field(default_factory=Load)
    method: Method = field(default_factory=Method)
    samples: int = 4096
    seed: int = 1
    assumed: tuple[str, ...] = ()

    @property
    def dilated(self) -> bool:
        """Whether the segment above the stone was measured."""
        return "dilated_inner_diameter" in self.measured

    def with_limit(self, limit: str | Pressure) -> Patient:
        """Return the same person with another pressure limit."""
        return replace(self, limit=_limit(limit))

    def case(self) -> Case:
        """The case at the measured values; s P_ucr of it is that of a wall s times as stiff."""
        value = {name: each.value for name, each in self.measured.items()}
        inner = value["inner_diameter"]
        outer = value.get("outer_diameter", inner + 2.0 * value.get("wall_thickness", 0.0))
        ureter = Ureter(Length(inner), Length(outer), self.material)
        stone = Stone(Length(value["stone_diameter"]), value["friction"], shape=self.shape)
        outside = Pressure(self.load.confining_pressure / value["stiffness"])
        return Case(stone, ureter, replace(self.load, confining_pressure=outside), self.method)


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
    samples: int = 4096
    seed: int = 1


class _PatientFile(FileSection):
    stone: _Stone
    ureter: _Ureter
    assessment: _Assessment
    dilated: _Dilated | None = None
    load: LoadSection = LoadSection()
    method: MethodSection = MethodSection()


def read_patient(path: str | Path) -> Patient:
    """Read a person's file; files of materials and shapes are looked for beside it.

    Raises
    ------
    BadInput
        Naming the file and the key: an unknown key (with the nearest known one), a missing one, a
        length without its uncertainty or unit, values that no ureter has.
    """
    path = Path(path)
    parsed = read_toml(path, _PatientFile)
    try:
        return _person(parsed, path.parent)
    except BadInput as problem:
        raise problem.within(path.name) from problem


def _person(parsed: _PatientFile, folder: Path) -> Patient:
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
    if stone.place is not None and stone.place not in PLACES:
        refuse_unknown("place", stone.place, list(PLACES))
    low, high = SAMPLES
    count = parsed.assessment.samples
    require(low <= count <= high, "samples", count, f"a whole number from {low} to {high}")
    seed = parsed.assessment.seed
    require(0 <= seed < LARGEST_SEED, "seed", seed, f"from 0 to {LARGEST_SEED - 1}")
    assumed = [
        why
        for why, given, default in (
            (WHY_FRICTION, stone.friction, ASSUMED_FRICTION),
            (WHY_STIFFNESS, ureter.stiffness, ASSUMED_STIFFNESS),
        )
        if given == default  # written out or not, nobody measured it
    ]
    person = Patient(
        measured=measured,
        material=find_material(ureter.material, folder),
        limit=_limit(parsed.assessment.limit),
        place=stone.place,
        shape=_shape(stone, folder),
        load=Load(**parsed.load.model_dump()),
        method=parsed.method.method(folder),
        samples=count,
        seed=seed,
        assumed=tuple(assumed),
    )
    person.case()  # refuses what the measured values themselves cannot be
    return person


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
