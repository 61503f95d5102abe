"""The map of critical pressures over size ratio and wall ratio, with the passing line."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np

from stonepass.errors import Outcome
from stonepass.units import Pressure
from stonepass.web.instant.curve import answers_by_column, rounded
from stonepass.web.instant.passing import passing_sizes, tabulated_sizes
from stonepass.web.instant.question import Held, named_surrogate

__all__ = ["size_map"]

WALLS = 21  # number of wall ratios


@lru_cache(maxsize=32)
def size_map(material: str, model: str, held: Held, limit: Pressure | None) -> dict[str, Any]:
    """Return the critical pressures over size ratio and wall ratio, and the passing line.

    The map does not depend on the sizes of a question, so that it is kept for the next questions.
    The result must not be changed.

    Parameters
    ----------
    material, model : str
        Name of the surrogate.
    held : Held
        Friction, load and stiffness, inside the box of the surrogate.
    limit : Pressure or None
        Pressure limit in Pa; without it there is no passing line.

    Returns
    -------
    dict
        ``size_ratio`` and ``wall_ratio`` are the coordinates of the grid.
        ``critical_pressure_kPa`` has one list for each wall ratio, with null where there is no
        critical pressure, and ``outcome`` has the outcomes. ``critical_size_ratio`` is the largest
        size ratio that moves at the limit, for each wall ratio; it is null where the outcome in
        ``critical_size_outcome`` is not SOLVED.
    """
    surrogate = named_surrogate(material, model)
    low, high = surrogate.box.wall_ratio
    walls = 1.0 + np.geomspace(low - 1.0, high - 1.0, WALLS)
    walls[[0, -1]] = low, high
    sizes = tabulated_sizes(surrogate)
    count = len(sizes)
    found = held.answers(surrogate, np.tile(sizes, WALLS), np.repeat(walls, count))
    columns = answers_by_column(found)
    document: dict[str, Any] = {
        "size_ratio": rounded(sizes),
        "wall_ratio": rounded(walls),
        "critical_pressure_kPa": _rows(columns["critical_pressure_kPa"], count),
        "outcome": _rows(columns["outcome"], count),
        "critical_size_ratio": None,
        "critical_size_outcome": None,
    }
    if limit is not None:
        known = found.pressure.reshape(WALLS, count)
        passing = passing_sizes(held, limit, surrogate, walls, (sizes, known))
        solved = np.array([each is Outcome.SOLVED for each in passing.outcomes])
        document["critical_size_ratio"] = rounded(np.where(solved, passing.sizes, np.nan))
        document["critical_size_outcome"] = [each.name for each in passing.outcomes]
    return document


def _rows(values: list[Any], count: int) -> list[list[Any]]:
    return [values[k : k + count] for k in range(0, len(values), count)]
