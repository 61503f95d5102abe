"""Does a series agree with the model at all: residuals beside their errors, and the joint fit."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.special import chdtrc, fdtrc

from stonepass.array_types import Float
from stonepass.bench.comparison import Comparison
from stonepass.caution import Caution, caution
from stonepass.errors import Outcome
from stonepass.inputs.measured_pressures import Point

__all__ = ["OBJECTIONS", "disagreement"]

UNLIKELY = 0.01  # chance of residuals as large where only the stated errors make them
# Cautions that say that the numbers of a series describe no agreement.
OBJECTIONS = ("beyond_sd", "beyond_repeats", "stiffness_excluded", "no_friction_fits")


def disagreement(comparison: Comparison, fitted: int) -> list[Caution]:
    """Compare residuals with standard deviations, or with the scatter of repeated points.

    With standard deviations the sum of squares over them is χ² distributed; of repeated points the
    scatter about their own means gives the error, and the rest follows an F distribution.

    Parameters
    ----------
    comparison : Comparison
        The series beside the model.
    fitted : int
        Number of constants that were fitted to it.

    Returns
    -------
    list of Caution
        Empty where residuals are as the errors would have them, or errors are not known.
    """
    pairs = [
        (point, answer)
        for point, answer in zip(comparison.points, comparison.answers, strict=True)
        if answer.outcome is Outcome.MOVES and answer.pressure is not None
    ]
    points = [point for point, _ in pairs]
    free = len(points) - fitted
    if free < 1:
        return []
    off = np.array([float(answer.pressure or 0.0) - point.pressure for point, answer in pairs])
    if any(point.sd is None for point in points):
        return _beside_repeats(points, off, fitted)
    ratio = off / np.array([float(point.sd or np.nan) for point in points])
    squares = float(ratio @ ratio)
    if not chdtrc(free, squares) < UNLIKELY:
        return []
    return [caution("beyond_sd", typical=float(np.sqrt(squares / free)),
                    largest=float(np.abs(ratio).max()), friction=comparison.friction)]  # fmt: skip


def _beside_repeats(
    points: Sequence[Point], off: Float[np.ndarray, " n"], fitted: int
) -> list[Caution]:
    """F test of lack of fit against pure error."""
    keys = [(p.size_ratio, p.wall_ratio, float(p.confining_pressure)) for p in points]
    groups = [np.array([key == each for key in keys]) for each in dict.fromkeys(keys)]
    pure = sum(float(np.sum((off[some] - off[some].mean()) ** 2)) for some in groups)
    repeats, distinct = len(points) - len(groups), len(groups) - fitted
    if repeats < 1 or distinct < 1 or pure == 0.0:
        return []
    rest = float(off @ off) - pure
    if not fdtrc(distinct, repeats, rest / distinct / (pure / repeats)) < UNLIKELY:
        return []
    return [caution("beyond_repeats", off_kPa=float(np.sqrt(rest / len(off))) / 1e3,
                    scatter_kPa=float(np.sqrt(pure / repeats)) / 1e3)]  # fmt: skip
