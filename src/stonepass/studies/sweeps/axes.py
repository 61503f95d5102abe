"""The values that a sweep gives to its inputs: axes of a grid, ranges of samples, and points."""

from __future__ import annotations

import hashlib
import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Float
from stonepass.errors import BadInput, refuse_unknown, require
from stonepass.studies.sweeps.varied_input import VariedInput, described, plain

__all__ = ["Axis", "Points", "SampledRange", "read_variation"]

SCALES = ("linear", "log")
GRID_KEYS, RANGE_KEYS = ("from", "to", "count", "scale"), ("low", "high", "scale")
MOST_VALUES = 1_000_000  # of one axis
WRITTEN = "a list, {from = …, to = …, count = …}, or {low = …, high = …} for samples"


@dataclass(frozen=True)
class Axis:
    """The values of one input in a grid.

    Attributes
    ----------
    input : VariedInput
        The input.
    values : tuple
        Its values in SI units, or materials, shapes or opening curves; at least one.
    """

    input: VariedInput
    values: tuple[Any, ...]

    def describe(self) -> dict[str, Any]:
        """Return a JSON-ready description, which contains everything that answers depend on."""
        cells = [plain(each) for each in self.values]
        return {
            "key": self.input.key,
            "column": self.input.column,
            "values": cells,
            "details": [described(each) for each in self.values]
            if self.input.type == "string"
            else [],
        }


@dataclass(frozen=True)
class SampledRange:
    """The range of an input that is sampled.

    Attributes
    ----------
    input : VariedInput
        The input, whose values are real numbers.
    low, high : float
        Ends of the range in SI units, low < high.
    scale : {"linear", "log"}
        Samples are uniform in the value, or in its logarithm; the latter needs low > 0.
    """

    input: VariedInput
    low: float
    high: float
    scale: str = "linear"

    def at(self, fraction: float) -> Any:
        """Return the value at a fraction of the range, 0 to 1."""
        if self.scale == "log":
            low, high = math.log(self.low), math.log(self.high)
            number = math.exp(low * (1.0 - fraction) + high * fraction)
        else:
            number = self.low * (1.0 - fraction) + self.high * fraction
        return self.input.from_number(min(max(number, self.low), self.high))

    def describe(self) -> dict[str, Any]:
        """Return a JSON-ready description."""
        return {
            "key": self.input.key,
            "column": self.input.column,
            "low": self.low,
            "high": self.high,
            "scale": self.scale,
        }


@array_dataclass
@dataclass(frozen=True)
class Points:
    """Explicit points, one row of values for each sample, e.g. a design for sensitivity indices.

    Attributes
    ----------
    inputs : tuple of VariedInput
        The inputs of the d columns, whose values are real numbers.
    values : array (n, d)
        Values in SI units.
    first : int
        Index of the first row, which is not 0 in a part of the points (see `part`).
    """

    inputs: tuple[VariedInput, ...]
    values: Float[np.ndarray, "n d"]
    first: int = field(default=0)

    def row(self, sample: int) -> list[float]:
        """Return the values of one sample."""
        return [float(each) for each in self.values[sample - self.first]]

    def part(self, start: int, stop: int) -> Points:
        """Return the points of the samples from `start` to `stop`, which is excluded."""
        return Points(self.inputs, self.values[start - self.first : stop - self.first], start)

    def describe(self) -> dict[str, Any]:
        """Return a JSON-ready description with a digest of the values."""
        contents = np.ascontiguousarray(self.values, dtype="<f8").tobytes()
        return {
            "keys": [each.key for each in self.inputs],
            "columns": [each.column for each in self.inputs],
            "count": len(self.values),
            "digest": hashlib.sha256(contents).hexdigest(),
        }


def read_variation(
    given: VariedInput, value: Any, folder: Path | None = None
) -> Axis | SampledRange:
    """Read what a study says of one varied input.

    Parameters
    ----------
    given : VariedInput
        The input.
    value : list or table
        A list of values; a table with ``from``, ``to`` and ``count`` for equal steps; or a table
        with ``low`` and ``high`` for samples. ``scale = "log"`` makes steps and samples uniform in
        the logarithm.
    folder : Path, optional
        Folder in which relative paths start.

    Raises
    ------
    BadInput
        A key of the table is unknown or missing, or a value has the wrong unit or is out of bounds.
    """
    if isinstance(value, Mapping):
        if "low" in value or "high" in value:
            return _range(given, value)
        return Axis(given, _steps(given, value))
    if isinstance(value, str) or not isinstance(value, Iterable):
        raise BadInput(given.key, value, WRITTEN)
    values = tuple(given.read(_built_in(each), folder) for each in value)
    require(0 < len(values) <= MOST_VALUES, given.key, f"{len(values)} values",
            f"a list of 1 to {MOST_VALUES} values")  # fmt: skip
    return Axis(given, values)


def _built_in(value: Any) -> Any:
    """Return a number of NumPy as the built-in number."""
    return value.item() if isinstance(value, np.generic) else value


def _range(given: VariedInput, table: Mapping[str, Any]) -> SampledRange:
    low, high = _ends(given, table, RANGE_KEYS)
    return SampledRange(given, low, high, _scale(given, table, low))


def _steps(given: VariedInput, table: Mapping[str, Any]) -> tuple[Any, ...]:
    first, last = _ends(given, table, GRID_KEYS)
    count = table.get("count", "missing")
    whole = isinstance(count, int) and not isinstance(count, bool)
    require(whole and 2 <= count <= MOST_VALUES, f"{given.key}, count", count,
            f"a whole number from 2 to {MOST_VALUES}")  # fmt: skip
    spaced = np.geomspace if _scale(given, table, first) == "log" else np.linspace
    # Fifteen digits, so that 1.05, 1.1, 1.15 are the numbers that one would write.
    inner = (float(f"{each:.15g}") for each in spaced(first, last, count)[1:-1])
    return tuple(map(given.from_number, (first, *inner, last)))


def _ends(
    given: VariedInput, table: Mapping[str, Any], keys: tuple[str, ...]
) -> tuple[float, float]:
    for each in table:
        if each not in keys:
            refuse_unknown(f"key of '{given.key}'", str(each), list(keys))
    if not given.numeric:
        raise BadInput(given.key, "a range", "a list, because its values are no real numbers")
    for each in keys[:2]:
        require(each in table, f"{given.key}, {each}", "missing", "given")
    low, high = (float(given.read(_built_in(table[each]))) for each in keys[:2])
    require(low < high, given.key, f"from {table[keys[0]]} to {table[keys[1]]}", "rising")
    return low, high


def _scale(given: VariedInput, table: Mapping[str, Any], low: float) -> str:
    scale = table.get("scale", "linear")
    if scale not in SCALES:
        refuse_unknown(f"{given.key}, scale", str(scale), list(SCALES))
    require(scale == "linear" or low > 0.0, f"{given.key}, scale", scale,
            "'linear', because the range does not begin above 0")  # fmt: skip
    return str(scale)
