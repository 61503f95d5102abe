"""Declarations of the constants of a law: symbol, unit, bounds, meaning, and first value of a fit.

Each constant is declared once, in the metadata of the dataclass field that stores its value. Law
files, the command ``material show``, fits and exports read the declarations from there.
"""

from __future__ import annotations

import math
import re
from dataclasses import MISSING, dataclass, field, fields
from typing import Any, Literal

from stonepass.errors import BadInput, require
from stonepass.units import exact_pressure, pressure

__all__ = [
    "ConstantDeclaration",
    "Unit",
    "check_constants",
    "constant",
    "constants_of",
    "fixed_constant",
    "format_constant",
    "read_constant",
    "shown_constant",
]

Unit = Literal["Pa", "1", "rad"]

_KEY = "stonepass.constant"
_ANGLE = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(deg|°|rad)\s*")


@dataclass(frozen=True)
class ConstantDeclaration:
    """The declaration of one constant of a law.

    Attributes
    ----------
    name : str
        Name of the dataclass field, which is also the key in a law file.
    symbol : str
        Symbol in formulas.
    unit : {"Pa", "1", "rad"}
        SI unit of the stored number; "1" means dimensionless.
    meaning : str
        Meaning of the constant in words.
    low, high : float
        Bounds in `unit`.
    low_allowed, high_allowed : bool
        True if the bound itself is an allowed value.
    guess : float
        First guess of a fit. For a modulus it is a factor of the shear modulus that is estimated
        from the data. For a dimensionless constant several multiples of it are tried, negative ones
        too if the constant may be negative.
    held : bool
        True if a fit keeps the default value unless the user frees the constant.
    default : float or None
        Default value in `unit`; None if a value must be given.
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
        """True if no negative value is allowed."""
        return self.low >= 0.0

    def allows(self, value: float) -> bool:
        """Return True if `value`, in `unit`, is finite and within the bounds."""
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
    """Declare a constant as a field of the dataclass of a law.

    Parameters
    ----------
    symbol, unit, meaning, low, high, low_allowed, high_allowed, guess, held, default
        See `ConstantDeclaration`.

    Returns
    -------
    dataclasses.Field
    """
    declared = {
        "symbol": symbol, "unit": unit, "meaning": meaning, "low": low, "high": high,
        "low_allowed": low_allowed, "high_allowed": high_allowed, "guess": guess, "held": held,
    }  # fmt: skip
    return field(default=MISSING if default is None else default, metadata={_KEY: declared})


def constants_of(law: Any) -> tuple[ConstantDeclaration, ...]:
    """Return the constants that a law or a class of laws declares, in the order of its fields.

    The tuple is empty for a law without declarations, such as a Python function of the user.
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
    """Check the constants of a law against their declared bounds.

    Raises
    ------
    BadInput
        A constant is out of bounds or not finite.
    """
    for each in constants_of(law):
        value = getattr(law, each.name)
        require(each.allows(value), each.name, value, each.allowed)


def read_constant(text: str | float, declared: ConstantDeclaration, argument: str = "") -> float:
    """Convert the text of a file or an option into the stored number.

    Parameters
    ----------
    text : str or float
        A value with its unit, such as "12 kPa" or "40 deg", or a dimensionless number.
    declared : ConstantDeclaration
    argument : str
        Name of the constant in the error message; by default its declared name.

    Returns
    -------
    float
        The value in ``declared.unit``. Its bounds are not checked here.

    Raises
    ------
    BadInput
        The unit is missing or wrong, or the text is not a number.
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


def fixed_constant(text: str | float, declared: ConstantDeclaration, argument: str) -> float:
    """Read the value of a constant that is not fitted.

    Parameters
    ----------
    text : str or float
        The value with its unit, or a dimensionless number.
    declared : ConstantDeclaration
    argument : str
        Name of the constant in messages, e.g. "--fix angle".

    Returns
    -------
    float
        The value in SI units.

    Raises
    ------
    BadInput
        The text cannot be read, or the value is outside the bounds of the constant.
    """
    value = read_constant(text, declared, argument)
    require(declared.allows(value), argument, text, declared.allowed)
    return value


def format_constant(value: float, declared: ConstantDeclaration) -> str | float:
    """Convert a stored number into a text or a number that `read_constant` reads as the same.

    Parameters
    ----------
    value : float
        The value in ``declared.unit``.
    declared : ConstantDeclaration

    Returns
    -------
    str or float
        For example "12 kPa", "40 deg" or 0.7.
    """
    if declared.unit == "Pa":
        return exact_pressure(value)
    if declared.unit == "rad":
        text = f"{math.degrees(value):.12g} deg"
        return text if read_constant(text, declared) == value else f"{value!r} rad"
    return value


def shown_constant(value: float, declared: ConstantDeclaration) -> str:
    """Format a stored number for display: moduli in MPa, angles in degrees.

    Parameters
    ----------
    value : float
        The value in ``declared.unit``.
    declared : ConstantDeclaration
    """
    if declared.unit == "Pa":
        return f"{value / 1e6:g} MPa"
    return f"{math.degrees(value):g} deg" if declared.unit == "rad" else f"{value:g}"
