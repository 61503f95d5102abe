"""Residuals of a law against laboratory data, and their sensitivities to its constants."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol, runtime_checkable

import numpy as np

from stonepass.array_types import Float
from stonepass.materials.constants import ConstantDeclaration, constants_of
from stonepass.materials.protocol import Law

__all__ = [
    "SPAN",
    "Data",
    "Objective",
    "at_an_end",
    "search_bounds",
    "starting_parameters",
    "stiffness_guess",
]

NUMBER = (1e-6, 1e3)  # widest search range of a positive dimensionless constant
ANY_SIGN = (-1e2, 1e2)  # widest search range of a dimensionless constant that may be negative
SPAN = 1e6  # largest modulus of the search, divided by the first guess of the shear modulus
IMPOSSIBLE = 1e3  # residual where the law predicts no stress, and largest residual
STEP = 1e-5  # relative step of a constant in difference quotients
# Relative changes of a constant refer to its magnitude, but at least to this fraction of a typical
# constant.
LEAST = 1e-3
AT_END = 1e-3  # relative distance from a search bound within which a constant lies at the bound


@runtime_checkable
class Data(Protocol):
    """Measurements, and the prediction of a law for each of them."""

    measured: str

    @property
    def lines(self) -> tuple[int, ...]:
        """Line number in the file of each point; empty if the data were not read from a file."""

    @property
    def observed(self) -> Float[np.ndarray, " n"]:
        """Measured stresses or pressures in Pa."""

    @property
    def abscissa(self) -> Float[np.ndarray, " n"]:
        """Stretch of a strip, or radius ratio r_a/R_a of a tube, at each point."""

    @property
    def groups(self) -> tuple[str, ...]:
        """Name of the curve that each point belongs to."""

    @property
    def strain_range(self) -> tuple[float, float]:
        """Smallest and largest stretch of the data."""

    @property
    def mistaken(self) -> Mapping[str, Callable[[float], Data]]:
        """Functions that correct the data for a wrong size at rest, by the code of the caution.

        The argument is the relative change of all stretches that belong to this size.
        """

    def taut_from(self, stretch: float) -> Data | None:
        """Return the data corrected for strips that are slack up to a stretch.

        None is returned for specimens that cannot be slack.
        """

    def without(self, point: int) -> Data:
        """Return the data without a point."""

    def predicted(self, law: Law) -> Float[np.ndarray, " n"]:
        """Return the stresses or pressures that a law predicts, in Pa; NaN if it predicts none."""

    def unstable_at(self, law: Law) -> float | None:
        """Return the stretch nearest to 1 at which the specimen is unstable; None if stable."""


@dataclass(frozen=True, eq=False)
class Objective:
    """Residuals of a law, each divided by the expected error of its point.

    Attributes
    ----------
    data : Data
        The n measured stresses or pressures.
    law : type
        Class of the law.
    spread : array (n)
        Expected errors in Pa. A common factor on all of them has no influence on the fit.

    References
    ----------
    docs/bench.md, "The fit".
    """

    data: Data
    law: type[Any]
    spread: Float[np.ndarray, " n"]

    def law_of(self, values: Mapping[str, float]) -> Law:
        """Return the law with all its constants by name, in SI units, which are not checked."""
        law: Law = object.__new__(self.law)  # the constructor would check the constants
        for name, value in values.items():
            object.__setattr__(law, name, value)
        return law

    def predicted(self, values: Mapping[str, float]) -> Float[np.ndarray, " n"]:
        """Return the prediction (n) of the law in Pa for constants by name, in SI units.

        The constants may lie outside the bounds of the law, since the prediction is a smooth
        function there too. The stability of the fitted law is checked after the fit.
        """
        try:
            with np.errstate(all="ignore"):
                return self.data.predicted(self.law_of(values))
        except (OverflowError, ZeroDivisionError):
            return np.full(len(self.spread), np.nan)

    def off(self, values: Mapping[str, float]) -> Float[np.ndarray, " n"]:
        """Return predicted minus observed values, divided by the expected errors; dimensionless.

        A residual is 1000 if the law predicts no stress, and never exceeds 1000 in magnitude.
        """
        found = (self.predicted(values) - self.data.observed) / self.spread
        return np.where(np.isfinite(found), np.clip(found, -IMPOSSIBLE, IMPOSSIBLE), IMPOSSIBLE)

    def residuals(self, parameters: Any) -> Float[np.ndarray, " n"]:
        """Return the residuals `off` for lmfit parameters."""
        return self.off(parameters.valuesdict())

    def misfit(self, parameters: Any) -> float:
        """Return the sum of the squared residuals for lmfit parameters."""
        return float(np.sum(self.residuals(parameters) ** 2))

    def sensitivities(
        self, values: Mapping[str, float], free: Sequence[str]
    ) -> Float[np.ndarray, "n free"]:
        """Compute the derivatives of the residuals for relative changes of the constants.

        Column k is the derivative of the residuals with respect to constant k, multiplied by the
        magnitude of that constant. A magnitude below 1e-3 of a typical constant is replaced by that
        value, since the column would otherwise vanish.

        Parameters
        ----------
        values : mapping of str to float
            Constants of the law in SI units.
        free : sequence of str
            Names of the constants with respect to which the residuals are differentiated.

        Returns
        -------
        array (n, free)
            Dimensionless derivatives by central differences.

        References
        ----------
        docs/bench.md, "Lack of fit" and docs/bench.md, "Identifiability".
        """
        columns = []
        for name, magnitude in zip(free, self.magnitudes(values, free), strict=True):
            step = STEP * magnitude
            sides = [self.off({**values, name: values[name] + s * step}) for s in (1.0, -1.0)]
            columns.append((sides[0] - sides[1]) / (2.0 * STEP))
        return np.array(columns).T

    def magnitudes(self, values: Mapping[str, float], free: Sequence[str]) -> list[float]:
        """Return the magnitude of each constant, to which its relative changes refer, in SI units.

        It is at least 1e-3 of a typical constant.
        """
        units = {each.name: each.unit for each in constants_of(self.law)}
        typical = {"Pa": stiffness_guess(self.data)}
        return [max(abs(values[each]), LEAST * typical.get(units[each], 1.0)) for each in free]


def stiffness_guess(data: Data) -> float:
    """Guess a shear modulus in Pa: a third of the median of |stress or pressure|/|strain|.

    The median is taken over the points with more than a fifth of the largest strain.
    """
    strain = np.abs(data.abscissa - 1.0)
    loaded = strain > 0.2 * strain.max()
    return float(max(np.median(np.abs(data.observed[loaded]) / strain[loaded]) / 3.0, 1e-3))


def starting_parameters(
    fitting: Any,
    declared: Mapping[str, ConstantDeclaration],
    fixed: Mapping[str, float],
    modulus: float,
    values: Mapping[str, float],
) -> Any:
    """Return lmfit parameters with starting values and search bounds.

    Parameters
    ----------
    fitting : module
        The module lmfit.
    declared : mapping of str to ConstantDeclaration
        Declarations of the constants of a law.
    fixed : mapping of str to float
        Constants that keep a given value, in SI units.
    modulus : float
        First guess of the shear modulus in Pa; moduli are searched up to 1e6 times it.
    values : mapping of str to float
        Starting values of the other constants, in SI units.
    """
    parameters = fitting.Parameters()
    for name, each in declared.items():
        if name in fixed:
            parameters.add(name, fixed[name], vary=False)
        else:
            low, high = search_bounds(each, modulus)
            parameters.add(name, values[name], min=low, max=high)
    return parameters


def search_bounds(declared: ConstantDeclaration, modulus: float) -> tuple[float, float]:
    """Return the bounds of the search for a constant, in SI units.

    Parameters
    ----------
    declared : ConstantDeclaration
    modulus : float
        First guess of the shear modulus in Pa.
    """
    if declared.unit == "Pa":
        low = 0.0 if declared.low_allowed else modulus / SPAN
        return (low if declared.positive else -SPAN * modulus), SPAN * modulus
    low, high = NUMBER if declared.positive else ANY_SIGN
    low = declared.low if declared.low_allowed else max(low, declared.low)
    return low, min(high, declared.high)


def at_an_end(parameter: Any, declared: ConstantDeclaration, modulus: float) -> str:
    """Return "lower" or "upper" if a fitted constant lies at that search bound, else "".

    Parameters
    ----------
    parameter : lmfit.Parameter
        The fitted constant with its search bounds.
    declared : ConstantDeclaration
        Declaration of the constant.
    modulus : float
        First guess of the shear modulus in Pa, the scale of constants in Pa.
    """
    value, low, high = float(parameter.value), float(parameter.min), float(parameter.max)
    unit = modulus if declared.unit == "Pa" else 1.0
    near = max(AT_END * abs(low), 1e-5 * unit)
    if value - low <= near:
        return "lower"
    return "upper" if high - value <= AT_END * abs(high) else ""
