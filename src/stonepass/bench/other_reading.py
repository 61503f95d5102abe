"""Comparison of two readings of one column: as the name of the column says, and by mistake.

Strains under the name of stretches, or outer diameters under the name of inner ones, can be fitted
with wrong constants and a high R². Load is zero at rest, which lies at different values of the two
readings. Each reading is therefore compared with the load by linear least squares, without a law.
"""

from __future__ import annotations

import numpy as np

from stonepass.array_types import Float
from stonepass.bench.bench_stress import tube_pressure
from stonepass.materials.yeoh import Yeoh

__all__ = ["explains_better", "strip_shapes", "tube_shapes"]

FEWEST = 4  # smallest number of rows for a comparison
# The other reading is accepted if the reading as named misses the loads by more than this fraction
# of the largest load (root mean square), and by more than this multiple of what the other misses.
MISSED, TIMES = 0.01, 4.0
SAME = 1e-6  # relative range of loads that are equal


def explains_better(
    load: Float[np.ndarray, " n"],
    named: Float[np.ndarray, "n k"],
    other: Float[np.ndarray, "n m"],
) -> bool:
    """Return True if another reading of the data explains the loads far better.

    The comparison favours the reading as named if it has more shapes.

    Parameters
    ----------
    load : array (n)
        Measured stresses or pressures in any unit.
    named, other : array (n, k), array (n, m)
        Shapes of load curves for both readings; a curve is a linear combination of them. The sum
        of the coefficients of the other reading, by which stiffness is judged, has to be positive.
    """
    if len(load) < FEWEST or not (np.all(np.isfinite(named)) and np.all(np.isfinite(other))):
        return False
    # The same load, or the same size, in all rows is told by `fit_checks.check_enough`.
    if np.ptp(load) <= SAME * np.abs(load).max() or not named.any(axis=0).all():
        return False
    missed, _ = _missed(load, named)
    left, stiffness = _missed(load, other)
    return bool(stiffness > 0.0 and missed > max(MISSED, TIMES * left))


def strip_shapes(stretch: Float[np.ndarray, " n"], count: int) -> Float[np.ndarray, "n k"]:
    """Return the nominal stresses of a strip by the first `count` of C10, C01 and C20.

    These are the terms of the laws of Mooney-Rivlin and Yeoh; they bend a curve in both directions.
    """
    first = stretch - stretch**-2
    over = stretch**2 + 2.0 / stretch - 3.0
    return np.column_stack([first, first / stretch, first * over][:count])


def tube_shapes(
    radius_ratio: Float[np.ndarray, " n"],
    wall_ratio: float,
    axial: Float[np.ndarray, " n"],
    count: int,
) -> Float[np.ndarray, "n k"]:
    """Return the pressures of a tube by the first `count` constants of the law of Yeoh, in Pa.

    Each constant is 1 Pa. For the arguments see `tube_pressure`.
    """
    with np.errstate(invalid="ignore"):
        total = [
            tube_pressure(Yeoh(*constants), radius_ratio, wall_ratio, axial)
            for constants in ((1.0, 0.0, 0.0), (1.0, 1.0, 0.0), (1.0, 0.0, 1.0))[:count]
        ]
    return np.column_stack([total[0], *(each - total[0] for each in total[1:])])


def _missed(load: Float[np.ndarray, " n"], shapes: Float[np.ndarray, "n k"]) -> tuple[float, float]:
    """Return the root mean square of the residuals over the largest load, and Σ coefficients."""
    sizes = np.linalg.norm(shapes, axis=0)
    found, *_ = np.linalg.lstsq(shapes / sizes, load, rcond=None)
    off = shapes @ (found / sizes) - load
    return float(np.sqrt(np.mean(off**2)) / np.abs(load).max()), float(np.sum(found / sizes))
