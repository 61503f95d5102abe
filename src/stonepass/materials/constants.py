"""A law declares its constants once: symbol, unit, bounds, meaning, and how a fit begins.

The declaration is metadata of the dataclass field. Law files, ``material show``, fits and exports
read it from there.
"""

from __future__ import annotations

import math
import re
from dataclasses import MISSING, dataclass, field, fields
from typing import Any, Literal

from stonepass.errors import BadInput, require
from stonepass.units import format_pressure, pressure

__all__ = [
    "ConstantDeclaration",
    "Unit",
    "check_constants",
    "constant",
    "constants_of",
    "format_constant",
    "read_constant",
    "shown_constant",
]

Unit = Literal["Pa", "1", "rad"]

_KEY = "stonepass.constant"
_ANGLE = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(deg|°|rad)\s*")


@dataclass(frozen=True)
class ConstantDeclaration:
    """One constant of a law.

    Attributes
    ----------
    name : str
        Name of the dataclass field, and so of the key in a law file.
    symbol : str
        Symbol in formulas.
    unit : {"Pa", "1", "rad"}
        SI unit of the stored number; "1" is a number without unit.
    meaning : str
        What the constant is, in words.
    low, high : float
        Bounds in `unit`.
    low_allowed, high_allowed : bool
        Whether the bound itself is a value.
    guess : float
        First value in a fit. For a modulus it is a multiple of the shear modulus that the data
        suggest; for a number without unit it is multiplied by each of several starts.
    held : bool
        Whether a fit keeps the default unless it is asked to free the constant.
    default : float or None
        Value where none is given; None where one must be given.
    """

    name: str
    symbol: str
    unit: Unit
    meaning: str
    low: float
    high: float
    low_allowed: bool
    high_allowed: bool
    guess: float
    held: bool
    default: float | None

    @property
    def positive(self) -> bool:
        """Whether no value is negative."""
        return self.low >= 0.0

    def allows(self, value: float) -> bool:
        """Whether the value lies within the bounds; a NaN does not."""
        above = value >= self.low if self.low_allowed else value > self.low
        below = value <= self.high if self.high_allowed else value < self.high
        return bool(math.isfinite(value) and above and below)

    @property
    def allowed(self) -> str:
        """The bounds in words."""
        if self.unit == "Pa" and math.isinf(self.high):
            if math.isinf(self.low):
                return "a finite modulus"
            return "a modulus, zero or positive" if self.low_allowed else "a positive modulus"
        if self.unit == "rad":
            return f"an angle from {math.degrees(self.low):g}° to {math.degrees(self.high):g}°"
        if self.low_allowed or self.high_allowed:
            return f"a number from {self.low:g} to {self.high:g}"
        if self.low < 0.0:
            return f"a number between {self.low:g} and {self.high:g}"
        return f"a number above {self.low:g} and below {self.high:g}"


def constant(
    symbol: str,
    unit: Unit,
    meaning: str,
    *,
    low: float = 0.0,
    high: float = math.inf,
    low_allowed: bool = False,
    high_allowed: bool = False,
    guess: float = 1.0,
    held: bool = False,
    default: float | None = None,
) -> Any:
    """Declare a constant as a field of a law's dataclass; see `ConstantDeclaration`."""
    declared = {
        "symbol": symbol, "unit": unit, "meaning": meaning, "low": low, "high": high,
        "low_allowed": low_allowed, "high_allowed": high_allowed, "guess": guess, "held": held,
    }  # fmt: skip
    return field(default=MISSING if default is None else default, metadata={_KEY: declared})


def constants_of(law: Any) -> tuple[ConstantDeclaration, ...]:
    """Constants that a law, or a class of laws, declares, in the order of its fields.

    The tuple is empty for a law without declarations, as one written by a user.
    """
    if not hasattr(law, "__dataclass_fields__"):
        return ()
    return tuple(
        ConstantDeclaration(
            name=each.name,
            default=None if each.default is MISSING else float(each.default),
            **each.metadata[_KEY],
        )
        for each in fields(law)
        if _KEY in each.metadata
    )


def check_constants(law: Any) -> None:
    """Refuse the first constant of a law that is out of its declared bounds.

    Raises
    ------
    BadInput
        A constant is out of bounds or not finite.
    """
    for each in constants_of(law):
        value = getattr(law, each.name)
        require(each.allows(value), each.name, value, each.allowed)


def read_constant(text: str | float, declared: ConstantDeclaration, argument: str = "") -> float:
    """Turn what a file or an option says into the stored number: "12 kPa", "40 deg" or 0.7.

    `argument` is how the caller calls the constant, its name where it is left out.

    Raises
    ------
    BadInput
        A number without the unit that it needs, a wrong unit, or no number.
    """
    argument = argument or declared.name
    if declared.unit == "Pa":
        return float(pressure(text, argument))
    if declared.unit == "rad":
        match = _ANGLE.fullmatch(text) if isinstance(text, str) else None
        if match is None:
            raise BadInput(argument, text, "an angle with its unit", "write it like '40 deg'")
        return float(match[1]) if match[2] == "rad" else math.radians(float(match[1]))
    try:
        return float(text)
    except ValueError as problem:
        raise BadInput(argument, text, "a number") from problem


def format_constant(value: float, declared: ConstantDeclaration) -> str | float:
    """Turn the stored number into what `read_constant` reads: "12 kPa", "40 deg" or 0.7."""
    if declared.unit == "Pa":
        return format_pressure(value)
    return f"{math.degrees(value):.12g} deg" if declared.unit == "rad" else value


def shown_constant(value: float, declared: ConstantDeclaration) -> str:
    """Write the number with its unit for a person: moduli in MPa, angles in degrees."""
    if declared.unit == "Pa":
        return f"{value / 1e6:g} MPa"
    return f"{math.degrees(value):g} deg" if declared.unit == "rad" else f"{value:g}"
