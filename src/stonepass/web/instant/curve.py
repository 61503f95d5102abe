"""The critical pressure over the size of the stone, by a surrogate."""

from __future__ import annotations

from typing import Any

import numpy as np

from stonepass.model.stone import SIZE_RATIO
from stonepass.studies.surrogates.answers import SurrogateAnswers
from stonepass.studies.surrogates.surrogate import Surrogate
from stonepass.web.instant.question import InstantQuestion

__all__ = ["answers_by_column", "curve", "lowest_size", "rounded"]

POINTS = 97  # number of sizes of the curve
DIGITS = 6  # decimals of numbers in lists


def curve(question: InstantQuestion, surrogate: Surrogate) -> dict[str, list[Any]]:
    """Return the critical pressures of stones of all sizes in the ureter of a question.

    Parameters
    ----------
    question : InstantQuestion
    surrogate : Surrogate
        The surrogate that answers it.

    Returns
    -------
    dict
        Lists by name: ``size_ratio``, ``diameter_mm`` (null without an inner diameter),
        ``critical_pressure_kPa``, ``critical_pressure_error_kPa``, ``lower_bound_kPa``,
        ``outcome``.
    """
    sizes = np.linspace(lowest_size(surrogate), surrogate.box.size_ratio, POINTS)
    found = question.held.answers(surrogate, sizes, question.case.wall_ratio)
    inner = question.case.ureter.inner_diameter
    diameters = [None] * POINTS if inner is None else rounded(1e3 * float(inner) * sizes)
    return {"size_ratio": rounded(sizes), "diameter_mm": diameters} | answers_by_column(found)


def lowest_size(surrogate: Surrogate) -> float:
    """Return a multiple of 0.05 that is smaller than the narrowest lumen of a surrogate."""
    return max(SIZE_RATIO[0], float(np.ceil(20.0 * surrogate.narrowest) - 1.0) / 20.0)


def answers_by_column(found: SurrogateAnswers) -> dict[str, list[Any]]:
    """Return the answers as lists by name; a number that does not exist is None."""
    return {
        "critical_pressure_kPa": rounded(1e-3 * found.pressure),
        "critical_pressure_error_kPa": rounded(1e-3 * found.error),
        "lower_bound_kPa": rounded(1e-3 * found.lower_bound),
        "outcome": [found.OUTCOMES[k].name for k in found.outcome],
    }


def rounded(values: Any) -> list[float | None]:
    """Return an array as a list of numbers with six decimals; None for masked values and NaN."""
    plain = np.ma.filled(np.ma.masked_invalid(values), np.nan).round(DIGITS)
    return [None if each != each else each for each in plain.tolist()]
