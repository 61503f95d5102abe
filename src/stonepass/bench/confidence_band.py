"""Confidence band of a fitted law."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from scipy.stats import t as t_distribution

from stonepass.array_types import Float
from stonepass.bench.least_squares import LEVEL
from stonepass.bench.objective import Objective

__all__ = ["confidence_band"]


def confidence_band(
    objective: Objective, values: Mapping[str, float], free: Sequence[str]
) -> Float[np.ndarray, " n"]:
    """Compute the half-width of the pointwise 95 % confidence band of a fitted law.

    The law is linearised in its constants at the best fit. The half-width is t s √h times the
    expected error of the point. Here t is the quantile of Student's distribution, s² the variance
    of the residuals, and h the diagonal of J (JᵀJ)⁻¹ Jᵀ with the sensitivities J of the residuals.
    The band is the uncertainty of the fitted curve, not that of a further measurement.

    Parameters
    ----------
    objective : Objective
        Data, law and expected errors of the fit.
    values : mapping of str to float
        Constants of the best fit in SI units.
    free : sequence of str
        Names of the fitted constants; without any the width is 0.

    Returns
    -------
    array (n)
        Half-width in Pa at each point of the data; 0 if there are no more points than constants.

    References
    ----------
    docs/bench.md, "The fit".
    """
    count = len(objective.spread)
    if not free or count <= len(free):
        return np.zeros(count)
    basis, _ = np.linalg.qr(objective.sensitivities(values, free))
    leverage = np.sum(basis**2, axis=1)
    freedom = count - len(free)
    scatter = float(np.sqrt(np.sum(objective.off(values) ** 2) / freedom))
    student = float(t_distribution.ppf(0.5 + LEVEL / 2.0, freedom))
    return student * scatter * np.sqrt(leverage) * objective.spread
