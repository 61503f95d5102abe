"""Test whether a series of measured pressures agrees with the model within the measuring errors."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy.special import chdtrc, fdtrc

from stonepass.array_types import Float
from stonepass.bench.comparison import SeriesComparison
from stonepass.caution import Caution, caution
from stonepass.errors import Outcome
from stonepass.inputs.measured_pressures import Point

__all__ = ["OBJECTIONS", "disagreement"]

UNLIKELY = 0.01  # significance level of both tests
# Codes of the cautions after which the fitted numbers of a series must not be used.
OBJECTIONS = ("beyond_sd", "beyond_repeats", "stiffness_excluded", "no_friction_fits")


def disagreement(comparison: SeriesComparison, fitted: int) -> list[Caution]:
    """Test whether the measuring errors explain the residuals of a series.

    If every point has a standard deviation, the sum of the squared residuals, each divided by its
    standard deviation, is tested against the χ² distribution. Otherwise the scatter of repeated
    points about their means estimates the measuring error, and an F test of lack of fit compares
    the remaining sum of squares with it. Both tests have a significance level of 1 %.

    Parameters
    ----------
    comparison : SeriesComparison
        Measured pressures and the answers of the model.
    fitted : int
        Number of parameters that were fitted to the series, 0 or more.

    Returns
    -------
    list of Caution
        The list is empty if the errors explain the residuals. It is also empty if the test is
        impossible: the errors are unknown, because neither standard deviations nor repeated points
        are given, or there are no more compared points than fitted parameters.

    References
    ----------
    docs/bench.md, "A series in vitro".
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
    """Test the residuals against the scatter of repeated points (F test of lack of fit)."""
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
