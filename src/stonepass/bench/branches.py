"""Find loading, unloading and repeated runs of a test from the order of the rows in its table."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from stonepass.array_types import Float, Int
from stonepass.bench.objective import Data

__all__ = ["Branches", "branches"]

# The abscissa must go back by this fraction of its range to count as a change of direction.
REVERSAL = 0.1


@dataclass(frozen=True, eq=False)
class Branches:
    """The branch of the loading history that each of the n points of a test belongs to.

    Attributes
    ----------
    loading : array (n)
        1 on a loading branch, where the strain grows from row to row; −1 on an unloading branch.
    run : array (n) of int
        Number of the run, starting at 0. A new run begins where loading begins again.
    width : array (n)
        Assumed shape of the width of a hysteresis loop, 4 u (1 − u), where u runs from 0 to 1 over
        the range of the abscissa. It vanishes at both ends of the loop.
    """

    loading: Float[np.ndarray, " n"]
    run: Int[np.ndarray, " n"]
    width: Float[np.ndarray, " n"]


def branches(data: Data) -> Branches:
    """Find the branches of every curve of the data from the order of its rows."""
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
        if last - first == 1 and not up:  # the next strip begins; its unloading was not measured
            loading[rows], run[rows] = 1.0, count + 1
            before = -1
            continue
        count += up and before == -1
        loading[rows], run[rows] = (1.0 if up else -1.0), count
        before = 1 if up else -1
    return loading, run


def _turns(x: Float[np.ndarray, " n"]) -> list[int]:
    """Return the rows at which the direction changes by more than the noise of the abscissa."""
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
