"""Units at the doors: text such as "4.5 mm" or "90 mmHg" to SI floats and back.

Inside the package every number is an SI float. `Length` and `Pressure` are floats that remember
what they are, so that a value which came through the door once may pass again, while a bare
number, whose unit nobody stated, is refused.
"""

from __future__ import annotations

import math
import re
from functools import lru_cache
from typing import Any, TypeAlias, TypeVar

import numpy as np

from stonepass.array_types import Float
from stonepass.errors import BadInput

__all__ = ["Length", "Pressure", "Values", "format_length", "format_pressure", "length", "pressure"]

# A number or an array of numbers; functions of it work elementwise.
Values: TypeAlias = float | Float[np.ndarray, "..."]

PASCAL_PER = {"kPa": 1e3, "mmHg": 133.322387415, "cmH2O": 98.0665}
METRE_PER_MM = 1e-3


class Length(float):
    """A length in metres."""


class Pressure(float):
    """A pressure, stress or modulus in pascals."""


Q = TypeVar("Q", Length, Pressure)

_EXAMPLES = {Length: "'4.2 mm'", Pressure: "'12 kPa', '90 mmHg' or '122 cmH2O'"}
_WORDS = {Length: "a length", Pressure: "a pressure"}
_SI = {Length: "meter", Pressure: "pascal"}
# Usual units, so that pint, which takes 0.3 s to import, is not loaded for them.
_USUAL = {
    "meter": {"m": 1.0, "cm": 0.01, "mm": 1e-3, "um": 1e-6, "µm": 1e-6, "μm": 1e-6},
    "pascal": {
        "Pa": 1.0, "hPa": 100.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9, "bar": 1e5, "mbar": 100.0,
        "centimeter_H2O": 98.06649999999999, "millimeter_Hg": 133.322387415,
    },
}  # fmt: skip
_TEXT = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*([A-Za-zµμ%°/][^\s]*)\s*")
_NAME = r"[A-Za-zµμ°%][A-Za-z0-9_µμ°%]{0,29}(?:(?:\*\*|\^)-?\d)?"
_UNIT = re.compile(rf"{_NAME}(?:[*/·]{_NAME}){{0,5}}")
LONGEST = 100  # characters of a number with its unit
# Pint knows "cmH2O" as centimetre_H2O; these spellings reach it under its own name.
_SPELLINGS = {"cmH2O": "centimeter_H2O", "cmH₂O": "centimeter_H2O", "mmHg": "millimeter_Hg"}


def length(value: Any, argument: str = "length") -> Length:
    """Read a length, e.g. ``length("4.2 mm") == 0.0042``.

    Raises
    ------
    BadInput
        A bare number, a unit that is not a length, or a value that is not finite.
    """
    return _read(value, argument, Length)


def pressure(value: Any, argument: str = "pressure") -> Pressure:
    """Read a pressure or modulus, e.g. ``pressure("12 kPa") == 12000.0``.

    Raises
    ------
    BadInput
        A bare number, a unit that is not a pressure, or a value that is not finite.
    """
    return _read(value, argument, Pressure)


def format_length(value: float) -> str:
    """Write metres in millimetres for a person: ``format_length(0.0042) == '4.2 mm'``."""
    return f"{value / METRE_PER_MM:.12g} mm"


def format_pressure(value: float) -> str:
    """Write pascals in kilopascals: ``format_pressure(12000.0) == '12 kPa'``."""
    return f"{value / PASCAL_PER['kPa']:.12g} kPa"


def _read(value: Any, argument: str, kind: type[Q]) -> Q:
    if isinstance(value, kind):
        return value
    word, example = _WORDS[kind], _EXAMPLES[kind]
    if not isinstance(value, str):
        raise BadInput(argument, value, f"{word} with its unit", f"write it like {example}")
    match = _TEXT.fullmatch(value) if len(value) <= LONGEST else None
    if match is None:
        raise BadInput(argument, value, f"{word} with its unit", f"write it like {example}")
    number, unit = float(match[1]), match[2]
    si = number * _factor(unit, argument, value, kind)
    if not math.isfinite(si):
        raise BadInput(argument, value, f"a finite {word.split()[-1]}")
    # 15 digits: 4.2 mm is 0.0042 m, not 0.004200000000000001 m.
    return kind(f"{si:.15g}")


def _factor(unit: str, argument: str, value: str, kind: type[Q]) -> float:
    scale = _si_factor(_SPELLINGS.get(unit, unit), _SI[kind])
    if scale is None:
        word, example = _WORDS[kind], _EXAMPLES[kind]
        raise BadInput(argument, value, f"{word}", f"write it like {example}")
    return scale


@lru_cache(maxsize=64)
def _si_factor(unit: str, si: str) -> float | None:
    """SI units in one `unit`, or None where `unit` is unknown or of another dimension."""
    for dimension, factors in _USUAL.items():
        if unit in factors:
            return factors[unit] if dimension == si else None
    if not _UNIT.fullmatch(unit):  # mm**9**9**9 keeps pint busy for good
        return None
    registry = _registry()
    try:
        return float(registry.Quantity(1.0, unit).to(si).magnitude)
    except Exception:  # pint raises a dozen kinds for text that is not this unit
        return None


@lru_cache(maxsize=1)
def _registry() -> Any:
    return _pint().UnitRegistry()


def _pint() -> Any:
    """Pint costs 0.3 s to import, so it is loaded with the first value that has a unit."""
    import pint

    return pint
