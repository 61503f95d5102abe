"""Loading and unloading, and the runs of a test, told from the order of its rows."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from stonepass.array_types import Float, Int
from stonepass.bench.objective import Data

__all__ = ["Branches", "branches"]

REVERSAL = 0.1  # of the range, that a change of direction has to reach


@dataclass(frozen=True, eq=False)
class Branches:
    """Which branch each point of a test belongs to.

    Attributes
    ----------
    loading : array (n)
        1 where the strain grows from row to row, −1 where it falls.
    run : array (n) of int
        Number of the run, from 0: a run begins where loading begins again.
    width : array (n)
        4 u (1 − u) with u from 0 to 1 over the range of the abscissa: how wide a loop is.
    """

    loading: Float[np.ndarray, " n"]
    run: Int[np.ndarray, " n"]
    width: Float[np.ndarray, " n"]


def branches(data: Data) -> Branches:
    """Find the branches of every curve, by the order of its rows."""
    x, names = data.abscissa, np.array(data.groups)
    loading, run = np.ones(len(x)), np.zeros(len(x), dtype=int)
    for name in dict.fromkeys(data.groups):
        rows = np.flatnonzero(names == name)
        loading[rows], run[rows] = _of_curve(x[rows])
    u = (x - x.min()) / max(float(np.ptp(x)), np.finfo(float).tiny)
    return Branches(loading, run, 4.0 * u * (1.0 - u))


def _of_curve(
    x: Float[np.ndarray, " n"],
) -> tuple[Float[np.ndarray, " n"], Int[np.ndarray, " n"]]:
    loading, run = np.ones(len(x)), np.zeros(len(x), dtype=int)
    turns = [0, *_turns(x), len(x) - 1]
    count, before = 0, 0
    for first, last in pairwise(turns):
        rows = slice(first if first == 0 else first + 1, last + 1)
        up = bool(x[last] >= x[first])
        if last - first == 1 and not up:  # the next strip begins, no unloading was measured
            loading[rows], run[rows] = 1.0, count + 1
            before = -1
            continue
        count += up and before == -1
        loading[rows], run[rows] = (1.0 if up else -1.0), count
        before = 1 if up else -1
    return loading, run


def _turns(x: Float[np.ndarray, " n"]) -> list[int]:
    """Rows at which the direction changes, by more than noise of the abscissa."""
    threshold = REVERSAL * float(np.ptp(x))
    found, extreme, direction = [], 0, 0.0
    for k in range(1, len(x)):
        away = x[k] - x[extreme]
        if direction == 0.0:
            direction = np.sign(away) if abs(away) > threshold else 0.0
            extreme = k if direction else extreme
        elif away * direction >= 0.0:
            extreme = k
        elif abs(away) > threshold:
            found.append(extreme)
            extreme, direction = k, -direction
    return found
