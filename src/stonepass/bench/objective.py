"""The residuals that a fit of a law makes small, and their sensitivities to its constants."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol, runtime_checkable

import numpy as np

from stonepass.array_types import Float
from stonepass.materials.constants import ConstantDeclaration, constants_of
from stonepass.materials.protocol import Law

__all__ = ["SPAN", "Data", "Objective", "at_an_end", "starting_parameters", "stiffness_guess"]

NUMBER = (1e-6, 1e3)  # widest interval of a positive constant that is no modulus
ANY_SIGN = (-1e2, 1e2)  # widest interval of one that may be negative
SPAN = 1e6  # of moduli over the first guess
IMPOSSIBLE = 1e3  # times the data, where a law has no stress
STEP = 1e-5  # relative, of differences over a constant
LEAST = 1e-3  # of a typical constant, its size where it is near zero
AT_END = 1e-3  # of a constant, or of its range, within which it lies at an end of the search


@runtime_checkable
class Data(Protocol):
    """Measurements, and the prediction of a law for each of them."""

    measured: str

    @property
    def lines(self) -> tuple[int, ...]:
        """Line of the file that each point stands in; empty where there is no file."""

    @property
    def observed(self) -> Float[np.ndarray, " n"]:
        """The measured quantity, in Pa."""

    @property
    def abscissa(self) -> Float[np.ndarray, " n"]:
        """The quantity on the horizontal axis of a drawing."""

    @property
    def groups(self) -> tuple[str, ...]:
        """Name of the curve that each point belongs to."""

    @property
    def strain_range(self) -> tuple[float, float]:
        """Smallest and largest stretch."""

    @property
    def mistaken(self) -> Mapping[str, Callable[[float], Data]]:
        """The data with a size at rest, by name of the caution, that is wrong by a small part."""

    def taut_from(self, stretch: float) -> Data | None:
        """The data of strips that hang loose up to this stretch; None for what cannot."""

    def predicted(self, law: Law) -> Float[np.ndarray, " n"]:
        """The measured quantity as a law predicts it, in Pa; NaN where it predicts none."""

    def unstable_at(self, law: Law) -> float | None:
        """First stretch at which what was measured would not keep its shape; None where none."""


@dataclass(frozen=True, eq=False)
class Objective:
    """Residuals of a law over the error that is expected of each point.

    Attributes
    ----------
    data : Data
    law : type
        Class of the law.
    spread : array (n)
        In Pa; only the ratios of the expected errors count.
    """

    data: Data
    law: type[Any]
    spread: Float[np.ndarray, " n"]

    def predicted(self, values: Mapping[str, float]) -> Float[np.ndarray, " n"]:
        """Return the prediction of the law in Pa.

        The constants may lie out of the bounds of the law: what it predicts is smooth across them,
        and whether the constants that fit describe a solid is asked afterwards.
        """
        law = object.__new__(self.law)  # leaves out the check of the constants
        for name, value in values.items():
            object.__setattr__(law, name, value)
        try:
            with np.errstate(all="ignore"):
                return self.data.predicted(law)
        except (OverflowError, ZeroDivisionError):
            return np.full(len(self.spread), np.nan)

    def off(self, values: Mapping[str, float]) -> Float[np.ndarray, " n"]:
        """Predicted less observed over what is expected; far off where the law has no stress."""
        found = (self.predicted(values) - self.data.observed) / self.spread
        return np.where(np.isfinite(found), np.clip(found, -IMPOSSIBLE, IMPOSSIBLE), IMPOSSIBLE)

    def residuals(self, parameters: Any) -> Float[np.ndarray, " n"]:
        """`off`, of parameters of lmfit."""
        return self.off(parameters.valuesdict())

    def sensitivities(
        self, values: Mapping[str, float], free: Sequence[str]
    ) -> Float[np.ndarray, "n free"]:
        """Change of every residual with each constant, over a change of the constant's own size.

        A constant near zero counts as of the size of `LEAST` of a typical one, so that it is not
        taken for one that does nothing.
        """
        typical = {each.name: each.unit for each in constants_of(self.law)}
        modulus, columns = stiffness_guess(self.data), []
        for name in free:
            least = LEAST * (modulus if typical[name] == "Pa" else 1.0)
            step = STEP * max(abs(values[name]), least)
            sides = [self.off({**values, name: values[name] + s * step}) for s in (1.0, -1.0)]
            columns.append((sides[0] - sides[1]) / (2.0 * STEP))
        return np.array(columns).T


def stiffness_guess(data: Data) -> float:
    """First guess of a shear modulus in Pa: what was measured over the strain, the median of it."""
    strain = np.abs(data.abscissa - 1.0)
    loaded = strain > 0.2 * strain.max()
    return float(max(np.median(np.abs(data.observed[loaded]) / strain[loaded]) / 3.0, 1e-3))


def starting_parameters(
    fitting: Any,
    declared: Mapping[str, ConstantDeclaration],
    fixed: Mapping[str, float],
    modulus: float,
    start: float,
) -> Any:
    """Parameters of lmfit at a first guess; numbers without unit are times `start`."""
    parameters = fitting.Parameters()
    for name, each in declared.items():
        if name in fixed:
            parameters.add(name, fixed[name], vary=False)
        elif each.unit == "Pa":
            low = 0.0 if each.low_allowed else modulus / SPAN
            low = low if each.positive else -SPAN * modulus
            parameters.add(name, each.guess * modulus, min=low, max=SPAN * modulus)
        else:
            low, high = NUMBER if each.positive else ANY_SIGN
            low = each.low if each.low_allowed else max(low, each.low)
            high = min(high, each.high)
            # A first guess beyond a bound would be put on it, where nothing changes any more.
            guess = each.guess * start
            inside = guess if low < guess < high else (low + high) / 2.0
            parameters.add(name, inside, min=low, max=high)
    return parameters


def at_an_end(parameter: Any, declared: ConstantDeclaration, modulus: float) -> str:
    """Whether a fitted constant lies at the "lower" or "upper" end of its search; else empty."""
    value, low, high = float(parameter.value), float(parameter.min), float(parameter.max)
    unit = modulus if declared.unit == "Pa" else 1.0
    near = max(AT_END * abs(low), 1e-5 * unit)
    if value - low <= near:
        return "lower"
    return "upper" if high - value <= AT_END * abs(high) else ""
