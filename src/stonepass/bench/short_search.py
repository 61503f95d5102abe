"""Short searches from many starting points, which select the points from which a fit begins.

The sum of squares of a law with several constants often has more than one minimum, and the grid of
starting points is coarse. Each point is therefore improved a little before the best are selected.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from stonepass.array_types import Float
from stonepass.bench.bounded_search import improved
from stonepass.bench.objective import Objective
from stonepass.bench.same_solid import energies, same_solid

__all__ = ["most_promising"]

# Each round improves so many of the best points by so many iterations, or until an iteration lowers
# the sum of squares by less than this fraction.
ROUNDS = ((40, 12, 1e-2), (10, 60, 1e-3))


def most_promising(objective: Objective, starts: Sequence[Any], count: int) -> list[Any]:
    """Return the points from which a fit should begin, the best first.

    Parameters
    ----------
    objective : Objective
        Data, law and expected errors.
    starts : sequence of lmfit.Parameters
        Starting points, the best first. If there are not more than `count`, they are returned
        unchanged.
    count : int
        Largest number of points that are returned. They are different solids.
    """
    points = list(starts)
    for tried, iterations, precision in ROUNDS:
        if len(points) <= count:
            return points
        found = [
            improved(objective.residuals, each, iterations, precision) for each in points[:tried]
        ]
        found.sort(key=objective.misfit)
        points = _different(objective, found)
    return points[:count]


def _different(objective: Objective, points: Sequence[Any]) -> list[Any]:
    """Return the points without those that are nearly the same solid as a better one."""
    kept: list[Any] = []
    known: list[Float[np.ndarray, " states"]] = []
    for each in points:
        own = energies(objective.law_of(each.valuesdict()))
        if not any(same_solid(own, other) for other in known):
            kept.append(each)
            known.append(own)
    return kept
