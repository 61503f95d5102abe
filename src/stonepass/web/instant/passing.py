"""The largest stones that move at a pressure limit, for many walls at once, by a surrogate."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from stonepass.array_types import Float
from stonepass.errors import Outcome
from stonepass.studies.surrogates.surrogate import Surrogate
from stonepass.units import Pressure
from stonepass.web.instant.curve import lowest_size
from stonepass.web.instant.question import Held

__all__ = ["Passing", "passing_sizes", "tabulated_sizes"]

TABULATED = 33  # number of size ratios of the table
PIECES = 9  # number of parts into which a refinement divides an interval
REFINEMENTS = 2


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
        SOLVED, BELOW_RANGE, BEYOND_CLOSURE, or BEYOND_RANGE.
    """

    sizes: Float[np.ndarray, " n"]
    outcomes: list[Outcome]


def passing_sizes(
    held: Held,
    limit: Pressure,
    surrogate: Surrogate,
    walls: Float[np.ndarray, " n"],
    coarse: np.ma.MaskedArray | None = None,
) -> Passing:
    """Find the largest stones that move at a pressure limit.

    The interval in which P_ucr exceeds the limit for the first time is found in a table of coarse
    size ratios, divided into nine parts twice, and interpolated linearly at last.

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
    coarse : masked array (n, m), optional
        P_ucr in Pa at the m size ratios `tabulated_sizes` of each wall, if it is known.
    """
    sizes = np.tile(tabulated_sizes(surrogate), (len(walls), 1))
    excess = (
        _excess(held, limit, surrogate, walls, sizes)
        if coarse is None
        else np.ma.filled(coarse, np.inf) - limit
    )
    reached = np.asarray((excess > 0.0).any(axis=1))
    for _ in range(REFINEMENTS):
        low, high, _, _ = _bracket(sizes, excess)
        sizes = low[:, None] + (high - low)[:, None] * np.linspace(0.0, 1.0, PIECES + 1)
        excess = _excess(held, limit, surrogate, walls, sizes)
    low, high, below, above = _bracket(sizes, excess)
    known = np.isfinite(above)
    share = np.divide(-below, above - below, out=np.zeros(len(walls)), where=known)
    loaded = surrogate.lumen is not None  # P_ucr of a stone as large as the lumen may then jump
    at_lumen = np.asarray((below == -limit) & loaded)
    found = np.where(reached, low + np.where(at_lumen, 0.0, share) * (high - low),
                     surrogate.box.size_ratio)  # fmt: skip
    rows = zip(reached.tolist(), known.tolist(), at_lumen.tolist(), strict=True)
    return Passing(found, [_outcome(*row) for row in rows])


def _outcome(reached: bool, known: bool, at_lumen: bool) -> Outcome:
    """Return the outcome of one search: whether P_ucr is above the limit, known, and of a jump."""
    if not reached:
        return Outcome.BEYOND_RANGE
    if not known:
        return Outcome.BEYOND_CLOSURE
    return Outcome.BELOW_RANGE if at_lumen else Outcome.SOLVED


def tabulated_sizes(surrogate: Surrogate) -> Float[np.ndarray, " n"]:
    """Return coarse size ratios from below every lumen to the end of a surrogate's box."""
    return np.linspace(lowest_size(surrogate), surrogate.box.size_ratio, TABULATED)


def _excess(
    held: Held,
    limit: Pressure,
    surrogate: Surrogate,
    walls: Float[np.ndarray, " n"],
    sizes: Float[np.ndarray, "n m"],
) -> Float[np.ndarray, "n m"]:
    """Return P_ucr minus the limit; infinity beyond the end of the closure."""
    count = sizes.shape[1]
    found = held.answers(surrogate, sizes.ravel(), np.repeat(walls, count))
    return np.asarray(found.pressure.filled(np.inf)).reshape(sizes.shape) - limit


def _bracket(
    sizes: Float[np.ndarray, "n m"], excess: Float[np.ndarray, "n m"]
) -> tuple[Float[np.ndarray, " n"], ...]:
    """Return the sizes before and after the first positive excess, and the excess at both."""
    after = np.maximum(1, np.argmax(excess > 0.0, axis=1))
    rows = np.arange(len(sizes))
    return (sizes[rows, after - 1], sizes[rows, after],
            excess[rows, after - 1], excess[rows, after])  # fmt: skip
