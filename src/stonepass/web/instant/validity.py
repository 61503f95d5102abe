"""The ranges of the inputs within which a surrogate answers, and where a case lies in them."""

from __future__ import annotations

from typing import Any

import numpy as np

from stonepass.model.load import CONFINING
from stonepass.model.stone import SIZE_RATIO
from stonepass.studies.stiffness_input import STIFFNESS_BOUNDS
from stonepass.studies.surrogates.surrogate import Surrogate
from stonepass.web.instant.question import InstantQuestion, largest_load

__all__ = ["validity"]


def validity(question: InstantQuestion, surrogate: Surrogate) -> dict[str, dict[str, Any]]:
    """Return the valid range of every input, in SI units, with a sentence for a reader.

    The range of an input is valid for the present values of the others. A stone that is smaller
    than the lumen is loose, and therefore every smaller stone has an answer.

    Parameters
    ----------
    question : InstantQuestion
    surrogate : Surrogate
        The surrogate that answers it.

    Returns
    -------
    dict
        For each input ``low``, ``high``, ``value``, ``inside`` and ``sentence``. Lengths are in m
        and pressures in Pa.
    """
    case, box = question.case, surrogate.box
    most = min(question.stiffness * largest_load(surrogate, case.wall_ratio), CONFINING[1])
    confining = float(case.load.confining_pressure)
    low_wall, high_wall = _walls(question, surrogate)
    smallest = SIZE_RATIO[0]
    found = {
        "stone.size_ratio": _range(smallest, box.size_ratio, case.size_ratio, "The size ratio"),
        "ureter.wall_ratio": _range(low_wall, high_wall, case.wall_ratio, "The wall ratio"),
        "stone.friction": _range(*box.friction, case.stone.friction, "The friction coefficient"),
        "load.confining_pressure": _range(
            0.0, most, confining, "The confining pressure", _kilopascals
        ),
        "stiffness": _stiffness(question, surrogate),
    }
    inner = case.ureter.inner_diameter
    diameter = case.stone_diameter
    if inner is not None and diameter is not None:
        found["stone.diameter"] = _range(
            smallest * inner,
            box.size_ratio * inner,
            diameter,
            "The diameter of the stone",
            _millimetres,
        )
        low, high = (float(inner) * each for each in (low_wall, high_wall))
        if case.ureter.outer_diameter is not None:
            outer = float(case.ureter.outer_diameter)
            found["ureter.outer_diameter"] = _range(
                low, high, outer, "The outer diameter of the ureter", _millimetres
            )
            walls = [(each - inner) / 2.0 for each in (low, high, outer)]
            found["ureter.wall_thickness"] = _range(
                walls[0], walls[1], walls[2], "The thickness of the wall", _millimetres
            )
    return found


def _kilopascals(pressure: float) -> str:
    return f"{pressure / 1e3:.4g} kPa"


def _millimetres(length: float) -> str:
    return f"{1e3 * length:.4g} mm"


def _stiffness(question: InstantQuestion, surrogate: Surrogate) -> dict[str, Any]:
    """Return the range of the stiffness; a load needs a wall that is stiff enough."""
    low, high = STIFFNESS_BOUNDS
    confining = float(question.case.load.confining_pressure)
    most = largest_load(surrogate, question.case.wall_ratio)
    if confining > 0.0 and most > 0.0:
        low = max(low, confining / most)
    return _range(low, high, question.stiffness, "The stiffness factor of the wall")


def _walls(question: InstantQuestion, surrogate: Surrogate) -> tuple[float, float]:
    """Return the range of the wall ratio; a load needs a wall that does not buckle."""
    low, high = surrogate.box.wall_ratio
    confining = float(question.case.load.confining_pressure) / question.stiffness
    most, stable = float(surrogate.case.load.confining_pressure), surrogate.stable
    # Without a load in the box, no wall ratio would help: the load itself is out of range.
    if most == 0.0 or not most * stable.factor[0] < confining <= most:
        return low, high
    enough = int(np.argmax(stable.factor >= confining / most))  # the first wall that bears the load
    around = slice(enough - 1, enough + 1)
    walls = stable.wall_ratio[around]
    return float(np.interp(confining / most, stable.factor[around], walls)), high


def _range(low: float, high: float, value: float, name: str, shown: Any = None) -> dict[str, Any]:
    """Return the range of one input; `shown` writes a number with its unit."""
    write = shown or (lambda number: f"{number:.4g}")
    low, high, value = float(low), float(high), float(value)
    slack = 1e-9 * max(abs(low), abs(high))  # of a quotient of two lengths
    inside = low - slack <= value <= high + slack
    where = "within" if inside else "outside"
    sentence = (
        f"{name} is {write(value)}, {where} the range from {write(low)} to {write(high)} of the "
        "instant answer."
    )
    return {"low": low, "high": high, "value": value, "inside": inside, "sentence": sentence}
