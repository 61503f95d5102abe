"""A case with uncertain inputs, each with a range or a distribution.

The inputs have the keys of a case file, such as ``stone.friction``. A constant of the wall's law
has the key ``ureter.material.NAME``, e.g. ``ureter.material.G``.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from stonepass.array_types import Float
from stonepass.declaration import Kind
from stonepass.errors import BadInput, refuse_unknown
from stonepass.inputs.build import build_case
from stonepass.inputs.case_file import held_values
from stonepass.inputs.catalogue import all_inputs
from stonepass.inputs.material_file import find_material
from stonepass.inputs.overlay import overlay, refuse_pairs
from stonepass.materials.constants import ConstantDeclaration, constants_of, read_constant
from stonepass.model.case import Case
from stonepass.studies.sweeps.varied_input import with_constants
from stonepass.studies.uncertain_quantity import (
    UncertainQuantity,
    measured_angle,
    measured_length,
    measured_number,
    measured_pressure,
)
from stonepass.units import Length, Pressure

__all__ = ["Inputs", "UncertainCase", "UncertainInput", "uncertain_case", "uncertain_values"]

# Values of the uncertain inputs by key, in SI units, for n cases.
Inputs = Mapping[str, Float[np.ndarray, " n"]]

MATERIAL = "ureter.material"
STIFFEST = 1e10  # largest modulus in Pa of an uncertain constant without an upper bound
_KINDS = {Kind.LENGTH: Length, Kind.PRESSURE: Pressure, Kind.NUMBER: float}
# Unit in which a quantity is shown, and its size in SI units.
_UNITS = {Kind.LENGTH: ("mm", 1e-3), Kind.PRESSURE: ("kPa", 1e3), Kind.NUMBER: ("", 1.0)}
_CONSTANT_UNITS = {"Pa": ("kPa", 1e3), "rad": ("°", np.pi / 180.0), "1": ("", 1.0)}


@dataclass(frozen=True)
class UncertainInput:
    """An uncertain input of a case.

    Attributes
    ----------
    key : str
        Key of the input in a case file, or ``ureter.material.NAME`` for a constant of the law.
    title : str
        Name of the input in words.
    quantity : UncertainQuantity
        Range or distribution in SI units.
    unit : str
        Unit in which values are shown; empty for a dimensionless input.
    scale : float
        Size of this unit in SI units.
    """

    key: str
    title: str
    quantity: UncertainQuantity
    unit: str = ""
    scale: float = 1.0

    def quantile(self, fraction: float) -> float:
        """Return one quantile of the input in SI units."""
        return float(self.quantity.quantiles(np.array([fraction]))[0])

    def show(self, value: float) -> str:
        """Return a value, which is given in SI units, as text with its unit."""
        return f"{value / self.scale:.4g} {self.unit}".rstrip()

    def describe(self) -> str:
        """Return range or distribution as text, e.g. ``0.3 ± 0.1``."""
        return self.quantity.describe(self.scale, self.unit)


@dataclass(frozen=True)
class UncertainCase:
    """A case with uncertain inputs.

    Attributes
    ----------
    fixed : mapping of str to value
        Raw values of the other inputs by key, as in a case file.
    inputs : tuple of UncertainInput
        The uncertain inputs, which are independent of one another; none of them is exact.
    folder : Path or None
        Folder in which relative paths start; None for the current folder.

    References
    ----------
    docs/howto/sensitivity.md, "The file".
    """

    fixed: Mapping[str, Any]
    inputs: tuple[UncertainInput, ...]
    folder: Path | None = None

    @property
    def keys(self) -> tuple[str, ...]:
        """Keys of the uncertain inputs."""
        return tuple(each.key for each in self.inputs)

    @property
    def quantities(self) -> dict[str, UncertainQuantity]:
        """Distributions of the uncertain inputs by key."""
        return {each.key: each.quantity for each in self.inputs}

    def __getitem__(self, key: str) -> UncertainInput:
        return next(each for each in self.inputs if each.key == key)

    @cached_property
    def medians(self) -> dict[str, float]:
        """Medians of the uncertain inputs by key, in SI units."""
        return {each.key: each.quantile(0.5) for each in self.inputs}

    @cached_property
    def median_case(self) -> Case:
        """The case in which all uncertain inputs have their medians."""
        return self.case(self.medians)

    def case(self, values: Mapping[str, float]) -> Case:
        """Return the case with these values of the uncertain inputs.

        Parameters
        ----------
        values : mapping of str to float
            A value for every uncertain input by key, in SI units.

        Raises
        ------
        BadInput
            The values describe no possible case, e.g. because the outer diameter is smaller than
            the inner one.
        """
        return build_case(_with_values(self.fixed, values, self.folder), self.folder)


def _with_values(
    fixed: Mapping[str, Any], values: Mapping[str, float], folder: Path | None
) -> dict[str, Any]:
    """Return raw values of a case in which some inputs and constants have values in SI units."""
    raw, constants = dict(fixed), {}
    for key, value in values.items():
        if key.startswith(f"{MATERIAL}."):
            constants[key.removeprefix(f"{MATERIAL}.")] = float(value)
        else:
            raw[key] = _KINDS[all_inputs()[key].declaration.kind](value)
    if constants:
        wall = find_material(raw.get(MATERIAL, "ureter"), folder)
        raw[MATERIAL] = with_constants(wall, constants)
    return raw


def uncertain_case(case: Case, uncertain: Mapping[str, Any]) -> UncertainCase:
    """Declare some inputs of a case uncertain.

    Parameters
    ----------
    case : Case
        The case. Its own values of the uncertain inputs are ignored. If the inner diameter is
        uncertain, the outer diameter of the case is kept, if it has one.
    uncertain : mapping of str to str or UncertainQuantity
        Range or distribution of each uncertain input by its key in a case file, e.g.
        ``{"stone.friction": "0.05 to 0.5", "stone.diameter": "4 mm ± 0.3 mm"}``. ``±`` means one
        standard deviation, and a range is uniformly distributed. A constant of the wall's law has
        the key ``ureter.material.NAME``. An exact quantity (``± 0``) is fixed at its value.

    Returns
    -------
    UncertainCase

    Raises
    ------
    BadInput
        A key is unknown or belongs to no number, a text cannot be read, a value is out of bounds,
        no input is uncertain, or the medians describe no possible case.

    References
    ----------
    docs/howto/sensitivity.md, "The file".

    Examples
    --------
    >>> import stonepass as sp
    >>> case = sp.Case(sp.Stone(size_ratio=1.1), sp.Ureter(wall_ratio=1.3))
    >>> sp.uncertain_case(case, {"stone.friction": "0.05 to 0.5"}).keys
    ('stone.friction',)
    """
    return uncertain_values(held_values(case), uncertain)


def uncertain_values(
    values: Mapping[str, Any],
    uncertain: Mapping[str, Any],
    folder: Path | None = None,
) -> UncertainCase:
    """Make an uncertain case from raw values by key; for the parameters see `uncertain_case`."""
    wall = find_material(values.get(MATERIAL, "ureter"), folder)
    declared = {each.name: each for each in constants_of(wall.law)}
    refuse_pairs(uncertain, {key: f"'{key}'" for key in all_inputs()})
    read = [_input(key, given, declared) for key, given in uncertain.items()]
    exact = {each.key: each.quantity.value for each in read if each.quantity.exact}
    inputs = tuple(each for each in read if each.key not in exact)
    if not inputs:
        raise BadInput("number of uncertain inputs", 0, "at least 1")
    plain = dict.fromkeys(each.key for each in read if not each.key.startswith(f"{MATERIAL}."))
    fixed = {key: value for key, value in overlay(values, plain).items() if key not in plain}
    found = UncertainCase(_with_values(fixed, exact, folder), inputs, folder)
    _ = found.median_case  # checks the values
    return found


def _input(
    key: str,
    given: Any,
    constants: Mapping[str, ConstantDeclaration],
) -> UncertainInput:
    """Read one uncertain input: a declared input of a case, or a constant of the law."""
    section, _, name = key.rpartition(".")
    if section == MATERIAL:
        return _constant(key, name, given, constants)
    known = {
        each: declared
        for each, declared in all_inputs().items()
        if declared.declaration.kind in _KINDS
    }
    if key not in known:
        refuse_unknown("uncertain input", key, [*known, *(f"{MATERIAL}.{n}" for n in constants)])
    declaration = known[key].declaration
    unit, scale = _UNITS[declaration.kind]
    title = known[key].title.replace("_", " ")
    assert declaration.bounds is not None, key
    readers: dict[Kind, Callable[[str, str, tuple[float, float]], UncertainQuantity]] = {
        Kind.LENGTH: measured_length,
        Kind.PRESSURE: measured_pressure,
        Kind.NUMBER: measured_number,
    }
    if isinstance(given, UncertainQuantity):
        return UncertainInput(key, title, given, unit, scale)
    quantity = readers[declaration.kind](_text(key, given), f"'{key}'", declaration.bounds)
    return UncertainInput(key, title, quantity, unit, scale)


def _constant(
    key: str,
    name: str,
    given: Any,
    constants: Mapping[str, ConstantDeclaration],
) -> UncertainInput:
    if name not in constants:
        refuse_unknown("constant of the wall's law", name, list(constants) or ["none"])
    declared = constants[name]
    unit, scale = _CONSTANT_UNITS[declared.unit]
    title = f"constant {name} of the wall"
    if isinstance(given, UncertainQuantity):
        return UncertainInput(key, title, given, unit, scale)
    text, argument = _text(key, given), f"'{key}'"
    low, high = (float(np.clip(end, -STIFFEST, STIFFEST)) for end in (declared.low, declared.high))
    if declared.unit == "Pa":
        quantity = measured_pressure(text, argument, (low, high))
    elif declared.unit == "rad":
        quantity = measured_angle(
            text, argument, (low, high), lambda part: read_constant(part, declared, argument)
        )
    else:
        quantity = measured_number(text, argument, (low, high))
    return UncertainInput(key, title, quantity, unit, scale)


def _text(key: str, given: Any) -> str:
    if not isinstance(given, str):
        raise BadInput(f"'{key}'", given, "text in quotes, such as '0.3 ± 0.1' or '0.05 to 0.5'")
    return given
