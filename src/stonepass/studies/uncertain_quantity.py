"""Quantities with an uncertainty: ``"5 mm ± 1 mm"``, ``"5 mm ± 20 %"``, ``"0.05 to 0.5"``."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from stonepass.array_types import Float
from stonepass.errors import BadInput, require
from stonepass.units import format_length, format_pressure, length, pressure

__all__ = [
    "UncertainQuantity",
    "measured_angle",
    "measured_length",
    "measured_number",
    "measured_pressure",
]

_PLUS_MINUS = re.compile(r"(.+?)\s*(?:±|\+/-|\+-)\s*(.+)")
_RANGE = re.compile(r"(.+?)\s+to\s+(.+)")
_ZERO = re.compile(r"\+?0+(?:\.0*)?")
_UNIT = re.compile(r"[A-Za-zµμ%°][^\s]*$")
LONGEST = 100  # largest number of characters of a text
FARTHEST = 6.0  # largest distance from the mean in standard deviations


@dataclass(frozen=True)
class _Form:
    """The form in which the values of one kind of quantity are written."""

    name: str
    example: str
    show: Callable[[float], str]  # writes a bound in messages
    has_unit: bool = True


_LENGTH = _Form("a length", "'5 mm ± 1 mm', '5 mm ± 20 %' or '3 mm to 4 mm'", format_length)
_PRESSURE = _Form(
    "a pressure", "'5 kPa ± 1 kPa', '5 kPa ± 20 %' or '3 kPa to 4 kPa'", format_pressure
)
_ANGLE = _Form(
    "an angle",
    "'40 deg ± 5 deg', '40 deg ± 10 %' or '30 deg to 50 deg'",
    lambda angle: f"{np.degrees(angle):g} deg",
)
_NUMBER = _Form("a number", "'0.3 ± 0.1', '0.3 ± 30 %' or '0.05 to 0.5'", "{:g}".format, False)


@dataclass(frozen=True)
class UncertainQuantity:
    """A quantity with its uncertainty, in SI units.

    A range is uniformly distributed. A value with a standard deviation has a truncated normal
    distribution, or a lognormal distribution if the quantity is a factor.

    Attributes
    ----------
    value : float
        Measured value, or the middle of a range.
    sd : float or None
        Standard deviation of the measuring error; 0 for an exact value, None for a range.
    low, high : float
        Ends of the range, or bounds at which the distribution is truncated.
    factor : bool
        True if the quantity is a factor, such as a relative stiffness. Its distribution is then
        lognormal with the median `value`.

    References
    ----------
    docs/assess.md, "The file".
    """

    value: float
    sd: float | None
    low: float
    high: float
    factor: bool = False

    @property
    def exact(self) -> bool:
        """True if the quantity has no uncertainty."""
        return self.sd == 0.0 or self.low == self.high

    @property
    def distribution(self) -> Any:
        """Distribution as a frozen distribution of `scipy.stats`; not for an exact value."""
        from scipy.stats import lognorm, truncnorm, uniform  # takes a second to load

        if self.sd is None:
            return uniform(self.low, self.high - self.low)
        if self.factor:
            return lognorm(np.sqrt(np.log1p((self.sd / self.value) ** 2)), scale=self.value)
        ends = [(end - self.value) / self.sd for end in (self.low, self.high)]
        first, last = np.clip(ends, -FARTHEST, FARTHEST)
        return truncnorm(first, last, loc=self.value, scale=self.sd)

    def quantiles(self, fractions: Float[np.ndarray, " n"]) -> Float[np.ndarray, " n"]:
        """Return the quantiles (n) of the distribution for fractions (n) between 0 and 1."""
        if self.exact:
            return np.full(len(fractions), self.value)
        return np.clip(self.distribution.ppf(fractions), self.low, self.high)

    def describe(self, scale: float = 1.0, unit: str = "") -> str:
        """Return the quantity as text, e.g. ``5 ± 1 mm`` or ``0.05 to 0.5``.

        Parameters
        ----------
        scale : float
            Size of the unit of the text in SI units, e.g. 1e-3 for mm.
        unit : str
            Unit of the text; empty for a dimensionless quantity.
        """
        tail = f" {unit}" if unit else ""
        if self.exact:
            return f"{self.value / scale:.4g}{tail}"
        if self.sd is None:
            return f"{self.low / scale:.4g} to {self.high / scale:.4g}{tail}"
        return f"{self.value / scale:.4g} ± {self.sd / scale:.3g}{tail}"


def measured_length(text: str, argument: str, bounds: tuple[float, float]) -> UncertainQuantity:
    """Read a length with its uncertainty; ``±`` means one standard deviation.

    Parameters
    ----------
    text : str
        A text such as ``"5 mm ± 1 mm"``, ``"5 mm ± 20 %"`` or ``"3 mm to 4 mm"``.
    argument : str
        Name of the quantity in messages.
    bounds : (float, float)
        Smallest and largest length in m.

    Raises
    ------
    BadInput
        The text has no uncertainty or no unit, or the length is out of bounds.

    References
    ----------
    docs/assess.md, "The file".
    """
    return _read(text, argument, bounds, lambda part: float(length(part, argument)), _LENGTH)


def measured_pressure(text: str, argument: str, bounds: tuple[float, float]) -> UncertainQuantity:
    """Read a pressure or a modulus with its uncertainty; ``±`` means one standard deviation.

    Parameters
    ----------
    text : str
        A text such as ``"5 kPa ± 1 kPa"``, ``"5 kPa ± 20 %"`` or ``"3 kPa to 4 kPa"``.
    argument : str
        Name of the quantity in messages.
    bounds : (float, float)
        Smallest and largest pressure in Pa.

    Raises
    ------
    BadInput
        The text has no uncertainty or no unit, or the pressure is out of bounds.

    References
    ----------
    docs/howto/sensitivity.md, "The file".
    """
    return _read(text, argument, bounds, lambda part: float(pressure(part, argument)), _PRESSURE)


def measured_angle(
    text: str, argument: str, bounds: tuple[float, float], read: Callable[[str], float]
) -> UncertainQuantity:
    """Read an angle with its uncertainty; ``±`` means one standard deviation.

    Parameters
    ----------
    text : str
        A text such as ``"40 deg ± 5 deg"``, ``"40 deg ± 10 %"`` or ``"30 deg to 50 deg"``.
    argument : str
        Name of the quantity in messages.
    bounds : (float, float)
        Smallest and largest angle in rad.
    read : callable
        Function that reads a single angle with its unit and returns rad.

    Raises
    ------
    BadInput
        The text has no uncertainty or no unit, or the angle is out of bounds.

    References
    ----------
    docs/howto/sensitivity.md, "The file".
    """
    return _read(text, argument, bounds, read, _ANGLE)


def measured_number(
    text: str, argument: str, bounds: tuple[float, float], *, factor: bool = False
) -> UncertainQuantity:
    """Read a dimensionless number with its uncertainty; ``±`` means one standard deviation.

    Parameters
    ----------
    text : str
        A text such as ``"0.3 ± 0.1"``, ``"0.3 ± 30 %"`` or ``"0.05 to 0.5"``.
    argument : str
        Name of the quantity in messages.
    bounds : (float, float)
        Smallest and largest number.
    factor : bool
        True if the number is a factor with a lognormal distribution (see `UncertainQuantity`).

    Raises
    ------
    BadInput
        The text has no uncertainty, or the number is out of bounds.

    References
    ----------
    docs/assess.md, "The file".
    """

    def number(part: str) -> float:
        try:
            return float(part)
        except ValueError as problem:
            raise _unreadable(argument, text, _NUMBER) from problem

    found = _read(text, argument, bounds, number, _NUMBER)
    return replace(found, factor=factor)


def _read(
    text: str,
    argument: str,
    bounds: tuple[float, float],
    read: Callable[[str], float],
    form: _Form,
) -> UncertainQuantity:
    if len(text) > LONGEST:  # matching the patterns to a long text takes too long
        raise _unreadable(argument, text, form)
    stripped = text.strip()
    spread, span = _PLUS_MINUS.fullmatch(stripped), _RANGE.fullmatch(stripped)
    found = spread or span
    if found is None:
        raise _unreadable(argument, text, form)
    parts = [part.strip() for part in found.groups()]
    relative = spread is not None and parts[1].endswith("%")
    unit = _UNIT.search(parts[1])
    if form.has_unit and not relative and unit is not None and _UNIT.search(parts[0]) is None:
        parts[0] += f" {unit[0]}"  # 5 ± 1 mm
    first = read(parts[0])
    if relative:
        second = first * _percentage(parts[1], argument, text)
    else:  # an exact value: 5 mm ± 0, whatever the unit
        second = 0.0 if spread and _ZERO.fullmatch(parts[1]) else read(parts[1])
    low, high = bounds
    shown = [form.show(bound) for bound in bounds]
    allowed = f"from {shown[0]} to {shown[1]}"
    require(low <= first <= high, argument, text, allowed)
    if spread:
        require(0.0 <= second <= high, argument, text, f"with an uncertainty from 0 to {shown[1]}")
        return UncertainQuantity(first, second, low, high)
    require(first <= second <= high, argument, text, f"a rising range {allowed}")
    return UncertainQuantity((first + second) / 2.0, None, first, second)


def _percentage(part: str, argument: str, text: str) -> float:
    """Read ``20 %`` as 0.2."""
    try:
        return float(part.removesuffix("%")) / 100.0
    except ValueError:
        raise BadInput(argument, text, "followed by a number in percent, e.g. ± 20 %") from None


def _unreadable(argument: str, text: str, form: _Form) -> BadInput:
    remedy = f"write it like {form.example}; an exact value has the uncertainty '± 0'"
    return BadInput(argument, text, f"{form.name} with its uncertainty", remedy)
