"""The inputs that a sweep varies: their keys, the columns of their values, and how text is read."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from stonepass.declaration import Kind, read_declared
from stonepass.errors import BadInput, refuse_unknown
from stonepass.inputs.case_record import describe_material
from stonepass.inputs.catalogue import all_inputs
from stonepass.inputs.material_file import find_material
from stonepass.inputs.opening_curve_file import find_opening_curve
from stonepass.inputs.shape_file import find_shape
from stonepass.materials.constants import ConstantDeclaration, constants_of, read_constant
from stonepass.materials.protocol import Material
from stonepass.model.opening_curve import OpeningCurve
from stonepass.model.shape import Shape

__all__ = ["MATERIAL", "VariedInput", "described", "plain", "varied_input", "with_constants"]

MATERIAL = "ureter.material"
_READERS = {
    Kind.MATERIAL: find_material,
    Kind.SHAPE: find_shape,
    Kind.OPENING_CURVE: find_opening_curve,
}
_UNITS = {Kind.LENGTH: "m", Kind.PRESSURE: "Pa"}
_TYPES = {Kind.FLAG: "bool", Kind.WHOLE: "int64"} | dict.fromkeys(
    (Kind.LENGTH, Kind.PRESSURE, Kind.NUMBER), "double"
)


@dataclass(frozen=True)
class VariedInput:
    """An input that differs between the cases of a sweep.

    Attributes
    ----------
    key : str
        Key in a case file, e.g. ``stone.size_ratio``, or ``ureter.material.C10`` for a constant of
        the law.
    column : str
        Name of the column of its values in tables; the unit is part of the name.
    type : {"double", "int64", "bool", "string"}
        Type of the column.
    unit : {"m", "Pa", "rad", ""}
        SI unit of a number; empty for a dimensionless number, a text or a flag.
    constant : ConstantDeclaration, optional
        The declaration of a constant of the law; None for any other input.
    """

    key: str
    column: str
    type: str
    unit: str
    constant: ConstantDeclaration | None = None

    @property
    def numeric(self) -> bool:
        """True if the values are real numbers, so that they can be sampled."""
        return self.type == "double"

    def read(self, value: Any, folder: Path | None = None) -> Any:
        """Return a value in SI units, or the material, shape or opening curve that it names.

        Parameters
        ----------
        value : object
            A value as it stands in a case file. Numbers of a law or of the wall are given as text
            with a unit if they have one.
        folder : Path, optional
            Folder in which relative paths start.

        Raises
        ------
        BadInput
            The value has the wrong kind or unit, or is out of its declared bounds.
        """
        if self.constant is not None:
            number = read_constant(value, self.constant, self.key)
            if not self.constant.allows(number):
                raise BadInput(self.key, value, self.constant.allowed)
            return number
        declaration = all_inputs()[self.key].declaration
        if declaration.kind in _READERS:
            return _READERS[declaration.kind](value, folder)
        return read_declared(declaration, self.key, value)

    def from_number(self, number: float) -> Any:
        """Return a number in SI units as a value of this input, checked against its bounds.

        Raises
        ------
        BadInput
            The input is no number, or the number is out of its declared bounds.
        """
        if not self.numeric:
            raise BadInput(self.key, number, "an input whose values are real numbers")
        if self.constant is not None:
            allowed = self.constant.allows(number)
            if not allowed:
                raise BadInput(self.key, number, self.constant.allowed)
            return number
        declaration = all_inputs()[self.key].declaration
        return read_declared(declaration, self.key, number, si=True)


def varied_input(key: str, materials: Iterable[Material]) -> VariedInput:
    """Return the input with a key.

    Parameters
    ----------
    key : str
        A key of a case file, or ``ureter.material.NAME`` for a constant of the law.
    materials : iterable of Material
        The materials of the sweep, whose laws declare the constants.

    Raises
    ------
    BadInput
        There is no input with this key; the message names the nearest one.
    """
    known = all_inputs()
    if key in known:
        kind = known[key].declaration.kind
        stem, unit = known[key].title.replace(" ", "_"), _UNITS.get(kind, "")
        return VariedInput(key, _column(stem, unit), _TYPES.get(kind, "string"), unit)
    constants = {
        f"{MATERIAL}.{each.name}": each
        for material in materials
        for each in constants_of(material.law)
    }
    if key not in constants:
        refuse_unknown("key", key, [*known, *constants])
    found = constants[key]
    unit = "" if found.unit == "1" else found.unit
    return VariedInput(key, _column(found.name, unit), "double", unit, found)


def _column(stem: str, unit: str) -> str:
    return f"{stem}_{unit}" if unit else stem


def with_constants(material: Material, constants: dict[str, float]) -> Material:
    """Return a material with other constants of its law.

    Parameters
    ----------
    material : Material
        The material; its strain range is kept.
    constants : dict of str to float
        Values in SI units by the names of the constants.

    Raises
    ------
    BadInput
        The law has no such constant, or its constants contradict each other.
    """
    declared = [each.name for each in constants_of(material.law)]
    for name in constants:
        if name not in declared:
            refuse_unknown(f"constant of material '{material.name}'", name, declared or ["none"])
    law = replace(material.law, **constants)  # type: ignore[type-var]
    return replace(material, law=law, name=f"{material.name}, varied", reference="")


def plain(value: Any) -> Any:
    """Return a value as a cell of a table: a number, a flag, or the name of what has many numbers.

    A number is returned as the built-in type, without the class of its unit.
    """
    if isinstance(value, bool | str):
        return value
    if isinstance(value, int):
        return value
    if isinstance(value, float):
        return float(value)
    if isinstance(value, Material):
        return value.name
    if isinstance(value, Shape):
        return value.reference or f"aspect {value.aspect:g}"
    if isinstance(value, OpeningCurve):
        return value.reference or f"{len(value.alpha)} points"
    return str(value)


def described(value: Any) -> Any:
    """Return a value as JSON with everything that an answer depends on."""
    if isinstance(value, Material):
        return describe_material(value)
    if isinstance(value, Shape):
        return {"aspect": value.aspect, "outline": list(value.outline)}
    if isinstance(value, OpeningCurve):
        return {"alpha_rad": list(value.alpha), "radius_ratio": list(value.radius)}
    return plain(value)
