"""Units at the doors: text such as "4.5 mm" or "90 mmHg" to SI floats and back.

Inside the package every number is an SI float. `Length` and `Pressure` are floats that remember
what they are, so that a value which came through the door once may pass again, while a bare
number, whose unit nobody stated, is refused.
"""

from __future__ import annotations

import math
import re
from typing import Any, Protocol, TypeAlias, TypeVar, runtime_checkable

import numpy as np

from stonepass.array_types import Float
from stonepass.errors import BadInput

__all__ = [
    "Area",
    "Length",
    "Pressure",
    "Quantity",
    "Values",
    "area",
    "exact_length",
    "exact_pressure",
    "format_length",
    "format_pressure",
    "length",
    "pressure",
    "text_pattern",
    "unit_ratio",
]

# A number or an array of numbers; functions of it work elementwise.
Values: TypeAlias = float | Float[np.ndarray, "..."]

PASCAL_PER = {"kPa": 1e3, "mmHg": 133.322387415, "cmH2O": 98.0665}
METRE_PER_MM = 1e-3


class Length(float):
    """A length in metres."""


class Pressure(float):
    """A pressure, stress or modulus in pascals."""


class Area(float):
    """An area in square metres."""


@runtime_checkable
class Quantity(Protocol):
    """A quantity of pint (``pint.Quantity``), which need not be installed otherwise."""

    @property
    def magnitude(self) -> Any:
        """The number, in the quantity's own unit."""

    @property
    def units(self) -> Any:
        """The unit."""

    def m_as(self, units: Any) -> Any:
        """Return the number in another unit."""


Q = TypeVar("Q", Length, Pressure, Area)

_EXAMPLES = {
    Length: "'4.2 mm'",
    Pressure: "'12 kPa', '90 mmHg' or '122 cmH2O'",
    Area: "'12 mm2'",
}
_WORDS = {Length: "a length", Pressure: "a pressure", Area: "an area"}
_SI = {Length: "meter", Pressure: "pascal", Area: "meter ** 2"}
# SI units in one unit. The list is closed: of a large vocabulary of units too many short words are
# lengths or pressures by chance, such as "px", 1/96 inch.
_FACTORS = {
    Length: {
        "m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "µm": 1e-6, "μm": 1e-6, "nm": 1e-9,
        "in": 0.0254, "inch": 0.0254,
        "Fr": 1e-3 / 3.0, "Ch": 1e-3 / 3.0,  # French gauge, Charrière: a diameter of 1/3 mm
    },
    Pressure: {
        "Pa": 1.0, "hPa": 100.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9, "bar": 1e5, "mbar": 100.0,
        "mmHg": 133.322387415, "Torr": 101325.0 / 760.0, "torr": 101325.0 / 760.0,
        "cmH2O": 98.0665, "cmH₂O": 98.0665, "mmH2O": 9.80665, "mmH₂O": 9.80665,
        "atm": 101325.0, "psi": 6894.757293168361,
        "N/m2": 1.0, "kN/m2": 1e3, "MN/m2": 1e6, "N/cm2": 1e4, "N/mm2": 1e6,
        "kgf/cm2": 98066.5, "dyn/cm2": 0.1,
    },
    Area: {"m2": 1.0, "cm2": 1e-4, "mm2": 1e-6},
}  # fmt: skip
_SHOWN = {
    Length: "m, cm, mm, um, nm, in or Fr",
    Pressure: "Pa, kPa, MPa, bar, mbar, mmHg, Torr, cmH2O, atm, psi, N/mm2, kN/m2 or kgf/cm2",
    Area: "m2, cm2 or mm2",
}
_TEXT = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*([A-Za-zµμ%°/][^\s]*)\s*")
_DECIMAL_COMMA = re.compile(r"\s*[-+]?\d+,\d+\s*[A-Za-zµμ][^\s]*\s*")
_THOUSANDS_COMMA = re.compile(r"[-+]?[1-9]\d{0,2},\d{3}\s*[A-Za-zµμ][^\s]*")
LONGEST = 100  # characters of a number with its unit


def length(value: Any, argument: str = "length") -> Length:
    """Read a length, e.g. ``length("4.2 mm") == 0.0042``.

    Parameters
    ----------
    value : str, Length or pint.Quantity
        Text is a number and a unit: m, cm, mm, um, nm, in or Fr.
    argument : str
        How the caller names the value in an error message.

    Returns
    -------
    Length
        A float in m.

    Raises
    ------
    BadInput
        A bare number, a unit that is not a length, or a value that is not finite.
    """
    return _read(value, argument, Length)


def pressure(value: Any, argument: str = "pressure") -> Pressure:
    """Read a pressure or modulus, e.g. ``pressure("12 kPa") == 12000.0``.

    Parameters
    ----------
    value : str, Pressure or pint.Quantity
        Text is a number and a unit: Pa, kPa, MPa, mmHg, cmH2O, bar and others.
    argument : str
        How the caller names the value in an error message.

    Returns
    -------
    Pressure
        A float in Pa.

    Raises
    ------
    BadInput
        A bare number, a unit that is not a pressure, or a value that is not finite.
    """
    return _read(value, argument, Pressure)


def area(value: Any, argument: str = "area") -> Area:
    """Read an area, e.g. ``area("12 mm2") == 1.2e-05``.

    Parameters
    ----------
    value : str, Area or pint.Quantity
        Text is a number and a unit: m2, cm2 or mm2.
    argument : str
        How the caller names the value in an error message.

    Returns
    -------
    Area
        A float in m².

    Raises
    ------
    BadInput
        A bare number, a unit that is not an area, or a value that is not finite.
    """
    return _read(value, argument, Area)


def format_length(value: float) -> str:
    """Write metres in millimetres for a person: ``format_length(0.0042) == '4.2 mm'``."""
    return f"{value / METRE_PER_MM:.12g} mm"


def format_pressure(value: float) -> str:
    """Write pascals in kilopascals: ``format_pressure(12000.0) == '12 kPa'``."""
    return f"{value / PASCAL_PER['kPa']:.12g} kPa"


def exact_length(value: float) -> str:
    """Write metres so that `length` reads the same number: in mm if this is exact, otherwise in m.

    >>> exact_length(0.0042), exact_length(0.0014 / 3.0)
    ('4.2 mm', '0.00046666666666666666 m')
    """
    return _exact(format_length(value), value, "m", Length)


def exact_pressure(value: float) -> str:
    """Write pascals so that `pressure` reads the same number: in kPa if exact, otherwise in Pa.

    >>> exact_pressure(12000.0), exact_pressure(1e4 / 3.0)
    ('12 kPa', '3333.3333333333335 Pa')
    """
    return _exact(format_pressure(value), value, "Pa", Pressure)


def _exact(text: str, value: float, unit: str, kind: type[Q]) -> str:
    """Return a text if it is read as the same value, otherwise the value in the SI unit."""
    return text if float(_read(text, "value", kind)) == value else f"{float(value)!r} {unit}"


def text_pattern(kind: type[Length] | type[Pressure]) -> str:
    """Return a regular expression that the text of a length or of a pressure matches.

    >>> import re
    >>> [bool(re.search(text_pattern(Length), text)) for text in ("4.2 mm", "4,2mm", "4 kPa")]
    [True, False, False]
    """
    units = "|".join(re.escape(unit) for unit in _FACTORS[kind])
    return rf"^\s*[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?\s*({units})\s*$"


def unit_ratio(unit: str, other: str) -> float | None:
    """Return how many `other` are one `unit`; None for units of different kinds, or unknown ones.

    >>> unit_ratio("MPa", "kPa")
    1000.0
    """
    for factors in _FACTORS.values():
        if unit in factors and other in factors:
            return factors[unit] / factors[other]
    return None


def _read(value: Any, argument: str, kind: type[Q]) -> Q:
    if isinstance(value, kind):
        return value
    word, example = _WORDS[kind], _EXAMPLES[kind]
    if isinstance(value, Quantity):
        return _of_quantity(value, argument, kind)
    if not isinstance(value, str):
        raise BadInput(argument, value, f"{word} with its unit", f"write it like {example}")
    if len(value) <= LONGEST and _DECIMAL_COMMA.fullmatch(value):
        text = value.strip()
        remedy = f"write '{text.replace(',', '.')}'"
        if _THOUSANDS_COMMA.fullmatch(text):
            remedy += f", or '{text.replace(',', '')}' if the comma separates thousands"
        raise BadInput(argument, value, f"{word} with a decimal point", remedy)
    match = _TEXT.fullmatch(value) if len(value) <= LONGEST else None
    if match is None:
        raise BadInput(argument, value, f"{word} with its unit", f"write it like {example}")
    factor = _factor(match[2], argument, value, kind)
    si = float(match[1]) * factor
    if not math.isfinite(si):
        raise BadInput(argument, value, f"a finite {word.split()[-1]}")
    # 15 digits: 4.2 mm is 0.0042 m, not 0.004200000000000001 m. SI units need no product.
    return kind(si if factor == 1.0 else f"{si:.15g}")


def _of_quantity(value: Quantity, argument: str, kind: type[Q]) -> Q:
    """Read a quantity of pint."""
    try:
        si = float(value.m_as(_SI[kind]))
    except (TypeError, ValueError) as problem:  # pint's DimensionalityError is a TypeError
        allowed, remedy = f"one value that is {_WORDS[kind]}", f"write it like {_EXAMPLES[kind]}"
        raise BadInput(argument, str(value), allowed, remedy) from problem
    if not math.isfinite(si):
        raise BadInput(argument, str(value), f"a finite {_WORDS[kind].split()[-1]}")
    return kind(f"{si:.15g}")


def _factor(unit: str, argument: str, value: str, kind: type[Q]) -> float:
    factors = _FACTORS[kind]
    known = factors.get(unit.replace("²", "2").replace("^2", "2"))
    if known is not None:
        return known
    meant = [each for each in factors if each.casefold() == unit.casefold()]
    remedy = f"did you mean {meant[0]}" if meant else f"write it like {_EXAMPLES[kind]}"
    raise BadInput(argument, value, f"{_WORDS[kind]} in {_SHOWN[kind]}", remedy)
