"""Tornado: one input at a time moves from its 5 % to its 95 % quantile, the others stay at medians.

The result is the critical pressure at both ends, or the critical size at a pressure limit.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from stonepass.array_types import Float
from stonepass.studies.sensitivity.evaluator import (
    Evaluations,
    Evaluator,
    outcome_name,
)
from stonepass.studies.sensitivity.uncertain_case import UncertainCase

__all__ = [
    "INNER",
    "STONE_SIZE",
    "Bar",
    "End",
    "Tornado",
    "pressure_tornado",
    "size_tornado",
]

TAILS = (0.05, 0.95)  # quantiles between which an input moves
STONE_SIZE = ("stone.diameter", "stone.size_ratio")
INNER = "ureter.inner_diameter"


@dataclass(frozen=True)
class End:
    """The result at one value of the moved input.

    Attributes
    ----------
    input : float or None
        Value of the moved input in SI units; None where all inputs have their medians.
    value : float or None
        The result; None if there is none.
    outcome : str
        Name of the outcome.
    lower_bound : float or None
        Lower bound of a result that does not exist; None if no bound is known.
    """

    input: float | None
    value: float | None
    outcome: str
    lower_bound: float | None = None

    def describe(self, unit: str = "") -> str:
        """Return the result as text, e.g. ``4.00 mm``, or the outcome with its lower bound."""
        if self.value is not None:
            return f"{_three_digits(self.value)} {unit}".rstrip()
        bound = "" if self.lower_bound is None else f" > {_three_digits(self.lower_bound)}"
        return f"{self.outcome}{bound}"


@dataclass(frozen=True)
class Bar:
    """The results at both ends of the range of one input.

    Attributes
    ----------
    key : str
        Key of the input.
    low, high : End
        Results at the 5 % and at the 95 % quantile of the input.
    """

    key: str
    low: End
    high: End

    @property
    def span(self) -> float | None:
        """Absolute difference of the two results; None if one of them does not exist."""
        if self.low.value is None or self.high.value is None:
            return None
        return abs(self.high.value - self.low.value)


@dataclass(frozen=True)
class Tornado:
    """The effect of every input on one quantity.

    Attributes
    ----------
    quantity : {"critical pressure", "critical size"}
        The quantity.
    unit : {"kPa", "mm", "inner diameters"}
        Unit of all results.
    centre : End
        Result with all inputs at their medians.
    bars : tuple of Bar
        One bar for each input. Bars of which an end does not exist come first, then the others in
        descending order of their span.
    limit : float or None
        Pressure limit of the critical size in Pa.
    """

    quantity: str
    unit: str
    centre: End
    bars: tuple[Bar, ...]
    limit: float | None = None


def pressure_tornado(uncertain: UncertainCase, evaluator: Evaluator) -> Tornado:
    """Compute the effect of every input on the critical pressure in kPa.

    Parameters
    ----------
    uncertain : UncertainCase
        The case with its uncertain inputs.
    evaluator : Evaluator
        Evaluates 2 d + 1 cases, where d is the number of inputs.

    References
    ----------
    docs/howto/sensitivity.md, "Tornado".
    """
    inputs = _one_at_a_time(uncertain, uncertain.keys)
    found = evaluator(inputs)
    return _tornado(uncertain.keys, inputs, found, np.full(len(found.outcome), 1e-3),
                    ("critical pressure", "kPa"))  # fmt: skip


def size_tornado(uncertain: UncertainCase, evaluator: Evaluator, limit: float) -> Tornado | None:
    """Compute the effect of every input on the critical size at a pressure limit.

    Parameters
    ----------
    uncertain : UncertainCase
        The case with its uncertain inputs. The size of the stone is no input of the critical size.
    evaluator : Evaluator
        Finds 2 d + 1 critical sizes, where d is the number of the other inputs.
    limit : float
        Pressure limit in Pa.

    Returns
    -------
    Tornado or None
        Diameters in mm, or in inner diameters if the ureter has no length; None if no input but the
        size of the stone is uncertain.

    References
    ----------
    docs/howto/sensitivity.md, "Tornado".
    """
    keys = tuple(key for key in uncertain.keys if key not in STONE_SIZE)
    if not keys:
        return None
    inputs = _one_at_a_time(uncertain, keys)
    found = evaluator.critical_sizes(inputs, limit)
    inner = uncertain.median_case.ureter.inner_diameter
    if inner is None:
        scales, unit = np.ones(len(found.outcome)), "inner diameters"
    else:
        scales, unit = 1e3 * inputs.get(INNER, np.full(len(found.outcome), float(inner))), "mm"
    return _tornado(keys, inputs, found, scales, ("critical size", unit), limit)


def _one_at_a_time(
    uncertain: UncertainCase, keys: tuple[str, ...]
) -> dict[str, Float[np.ndarray, " n"]]:
    """Return the medians, and then two rows for each key, in which it has its two quantiles."""
    count = 2 * len(keys) + 1
    rows = {key: np.full(count, value) for key, value in uncertain.medians.items()}
    for k, key in enumerate(keys):
        rows[key][2 * k + 1 : 2 * k + 3] = [uncertain[key].quantile(each) for each in TAILS]
    return rows


def _tornado(
    keys: tuple[str, ...],
    inputs: dict[str, Float[np.ndarray, " n"]],
    found: Evaluations,
    scales: Float[np.ndarray, " n"],
    words: tuple[str, str],
    limit: float | None = None,
) -> Tornado:
    def end(row: int, key: str | None) -> End:
        code, scale = int(found.outcome[row]), float(scales[row])
        return End(
            None if key is None else float(inputs[key][row]),
            _number(found.value, row, scale),
            outcome_name(code),
            _number(found.lower_bound, row, scale),
        )

    bars = [Bar(key, end(2 * k + 1, key), end(2 * k + 2, key)) for k, key in enumerate(keys)]
    bars.sort(key=lambda bar: -np.inf if bar.span is None else -bar.span)
    return Tornado(*words, end(0, None), tuple(bars), limit)


def _number(values: np.ma.MaskedArray, row: int, scale: float) -> float | None:
    return None if np.ma.getmaskarray(values)[row] else float(values[row]) * scale


def _three_digits(value: float) -> str:
    return f"{value:#.3g}".rstrip(".")
