"""The largest stones that move at a pressure limit, for many walls at once, by a surrogate."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Float
from stonepass.errors import Outcome
from stonepass.studies.surrogates.answers import SurrogateAnswers
from stonepass.studies.surrogates.surrogate import Surrogate
from stonepass.units import Pressure
from stonepass.web.instant.curve import lowest_size
from stonepass.web.instant.question import Held

__all__ = ["Passing", "passing_sizes", "tabulated_sizes"]

TABULATED = 41  # number of size ratios of the table
PIECES = 12  # number of parts into which the interval of the table is divided


@array_dataclass
@dataclass(frozen=True)
class Passing:
    """The largest stones that move at a pressure limit, for n walls.

    Attributes
    ----------
    sizes : array (n)
        Critical size ratios. Where the outcome is not SOLVED, it is the largest size ratio that is
        known to move: that of the lumen for BELOW_RANGE, the end of the closure for BEYOND_CLOSURE,
        and the largest one of the surrogate for BEYOND_RANGE.
    outcomes : list of Outcome
        SOLVED, BELOW_RANGE, BEYOND_RANGE, or the outcome of the surrogate where it has no P_ucr.
    """

    sizes: Float[np.ndarray, " n"]
    outcomes: list[Outcome]


def passing_sizes(
    held: Held,
    limit: Pressure,
    surrogate: Surrogate,
    walls: Float[np.ndarray, " n"],
    table: tuple[Float[np.ndarray, " m"], Any],
    refinements: int = 1,
) -> Passing:
    """Find the largest stones that move at a pressure limit.

    The interval of the table in which P_ucr exceeds the limit for the first time is divided into
    twelve parts, once or more often; the critical size is interpolated linearly in the last one.

    Parameters
    ----------
    held : Held
        Friction, load and stiffness.
    limit : Pressure
        Pressure limit in Pa.
    surrogate : Surrogate
        The surrogate that answers.
    walls : array (n)
        Wall ratios inside the box of the surrogate.
    table : (array (m), masked array (n, m))
        Rising size ratios from below the lumen to the end of the box, and P_ucr in Pa.
    refinements : int
        How often an interval is divided, at least once.
    """
    sizes = np.broadcast_to(table[0], table[1].shape)
    excess = np.ma.filled(table[1], np.inf) - limit
    reached = np.asarray((excess > 0.0).any(axis=1))
    for _ in range(refinements):
        low, high, *_ = _bracket(sizes, excess)
        sizes = low[:, None] + (high - low)[:, None] * np.linspace(0.0, 1.0, PIECES + 1)
        answers = held.answers(surrogate, sizes.ravel(), np.repeat(walls, PIECES + 1))
        excess = answers.pressure.filled(np.inf).reshape(sizes.shape) - limit
    low, high, below, above = _bracket(sizes, excess)
    ended = answers.outcome.reshape(sizes.shape)[_first_above(excess)]
    known = np.isfinite(above)
    known &= np.isfinite(below)  # a wall that is not covered has no pressure at all
    change = np.subtract(above, below, out=np.ones(len(walls)), where=known)
    part = np.divide(-below, change, out=np.zeros(len(walls)), where=known & reached)
    loaded = surrogate.lumen is not None  # P_ucr of a stone as large as the lumen may then jump
    at_lumen = np.asarray((below == -limit) & loaded)
    found = low + np.where(at_lumen, 0.0, part) * (high - low)
    rows = zip(reached.tolist(), known.tolist(), at_lumen.tolist(), ended.tolist(), strict=True)
    outcomes = [_outcome(*row) for row in rows]
    return Passing(np.where(reached, found, surrogate.box.size_ratio), outcomes)


def _outcome(reached: bool, known: bool, at_lumen: bool, ended: int) -> Outcome:
    """Return the outcome of one search: whether P_ucr is above the limit, known, and of a jump.

    `ended` is the place in `OUTCOMES` of the surrogate's outcome where the search ended.
    """
    if not reached:
        return Outcome.BEYOND_RANGE
    if not known:
        return SurrogateAnswers.OUTCOMES[ended]
    return Outcome.BELOW_RANGE if at_lumen else Outcome.SOLVED


def tabulated_sizes(surrogate: Surrogate) -> Float[np.ndarray, " n"]:
    """Return coarse size ratios from below every lumen to the end of a surrogate's box."""
    return np.linspace(lowest_size(surrogate), surrogate.box.size_ratio, TABULATED)


def _bracket(
    sizes: Float[np.ndarray, "n m"], excess: Float[np.ndarray, "n m"]
) -> tuple[Float[np.ndarray, " n"], ...]:
    """Return the sizes before and after the first positive excess, and the excess at both."""
    rows, after = _first_above(excess)
    before = after - 1
    return sizes[rows, before], sizes[rows, after], excess[rows, before], excess[rows, after]


def _first_above(excess: Float[np.ndarray, "n m"]) -> tuple[np.ndarray, np.ndarray]:
    """Return the rows and, for each, the column of the first positive excess, at least 1."""
    return np.arange(len(excess)), np.maximum(1, np.argmax(excess > 0.0, axis=1))
