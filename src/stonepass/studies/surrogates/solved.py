"""The results of the balance of a surrogate: outcomes, pressures, lower bounds of many cases."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Float, Int
from stonepass.errors import Outcome

__all__ = ["BEYOND_CLOSURE", "LOOSE", "MOVES", "NO_SOLUTION", "OUTCOMES", "UNITS", "Solved"]

# The outcomes of a surrogate; arrays of outcomes contain the places in this tuple.
OUTCOMES = (
    Outcome.MOVES,
    Outcome.LOOSE,
    Outcome.BEYOND_CLOSURE,
    Outcome.NO_SOLUTION,
)
MOVES, LOOSE, BEYOND_CLOSURE, NO_SOLUTION = range(len(OUTCOMES))

# Units of the further results of a surrogate. Pressures are proportional to the stiffness.
UNITS = {
    "contact_angle": "rad",
    "leak_pressure": "Pa",
    "friction_work": "Pa",
    "opened_radius": "",
    "error": "Pa",
}


@array_dataclass
@dataclass(frozen=True)
class Solved:
    """The results of n cases with a stone that is larger than the lumen.

    Attributes
    ----------
    outcome : array (n) of int
        Places in `OUTCOMES`.
    pressure : array (n)
        P_ucr in Pa; NaN if it does not exist.
    lower_bound : array (n)
        Pressure in Pa that P_ucr exceeds; 0 if P_ucr exists, or if no bound is known.
    quantities : mapping of str to array (n)
        Further results by name, in the units of `UNITS`; NaN where they do not exist.
    """

    outcome: Int[np.ndarray, " n"]
    pressure: Float[np.ndarray, " n"]
    lower_bound: Float[np.ndarray, " n"]
    quantities: Mapping[str, Float[np.ndarray, " n"]]
