"""How far a fitted law is uncertain at each measured point."""

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
    """Return half the width of the pointwise 95 % confidence band of the fitted law.

    The law is taken as linear in its constants about the best fit, and the scatter is that of the
    residuals: Student's t times s √h times the expected error of the point, with h the diagonal of
    J (JᵀJ)⁻¹ Jᵀ, and J the sensitivities of the residuals. It is the uncertainty of the curve, not
    that of another measurement.

    Parameters
    ----------
    objective : Objective
    values : mapping
        The constants of the best fit.
    free : sequence of str
        Names of those that were fitted; without any the band has no width.

    Returns
    -------
    array (n)
        In Pa, for each point of the data.
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
