"""The critical pressure over the size of the stone, by a surrogate."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from stonepass.array_types import Float
from stonepass.model.stone import SIZE_RATIO
from stonepass.studies.surrogates.answers import SurrogateAnswers
from stonepass.studies.surrogates.surrogate import Surrogate
from stonepass.web.instant.question import InstantQuestion

__all__ = ["answers_by_column", "curve", "curve_sizes", "lowest_size", "part_of", "rounded"]

Columns = dict[str, list[Any]]

POINTS = 97  # number of sizes of the curve
DIGITS = 6  # decimals of numbers in lists


def curve_sizes(surrogate: Surrogate) -> Float[np.ndarray, " n"]:
    """Return the size ratios of the curve, from below every lumen to the end of the box."""
    return np.linspace(lowest_size(surrogate), surrogate.box.size_ratio, POINTS)


def curve(question: InstantQuestion, surrogate: Surrogate, found: SurrogateAnswers) -> Columns:
    """Return the critical pressures of stones of all sizes in the ureter of a question.

    Parameters
    ----------
    question : InstantQuestion
    surrogate : Surrogate
        The surrogate that answers it.
    found : SurrogateAnswers
        The answers at `curve_sizes`.

    Returns
    -------
    dict
        Lists by name: ``size_ratio``, ``diameter_mm`` (null without an inner diameter),
        ``critical_pressure_kPa``, ``critical_pressure_error_kPa``, ``lower_bound_kPa``,
        ``outcome``.
    """
    sizes, inner = curve_sizes(surrogate), question.case.ureter.inner_diameter
    diameters = [None] * POINTS if inner is None else rounded(1e3 * float(inner) * sizes)
    return {"size_ratio": rounded(sizes), "diameter_mm": diameters} | answers_by_column(found)


def lowest_size(surrogate: Surrogate) -> float:
    """Return a multiple of 0.05 that is smaller than the narrowest lumen of a surrogate."""
    return max(SIZE_RATIO[0], float(np.ceil(20.0 * surrogate.stable.narrowest) - 1.0) / 20.0)


def answers_by_column(found: SurrogateAnswers) -> Columns:
    """Return the answers as lists by name; a number that does not exist is None."""
    return {
        "critical_pressure_kPa": rounded(1e-3 * found.pressure),
        "critical_pressure_error_kPa": rounded(1e-3 * found.error),
        "lower_bound_kPa": rounded(1e-3 * found.lower_bound),
        "outcome": [found.OUTCOMES[k].name for k in found.outcome],
    }


def rounded(values: Any) -> list[float | None]:
    """Return an array as a list of numbers with six decimals; None for masked values and NaN."""
    plain = np.round(np.ma.filled(values, np.nan), DIGITS)
    return [None if each != each else each for each in plain.tolist()]


def part_of(found: SurrogateAnswers, chosen: slice) -> SurrogateAnswers:
    """Return the answers of some conditions."""
    return replace(
        found,
        inputs={name: each[chosen] for name, each in found.inputs.items()},
        outcome=found.outcome[chosen],
        pressure=found.pressure[chosen],
        error=found.error[chosen],
        lower_bound=found.lower_bound[chosen],
        outside=found.outside[chosen],
        quantities={name: each[chosen] for name, each in found.quantities.items()},
    )
