"""Elementary effects of any evaluator by the method of Morris, with SALib.

A trajectory moves one input after the other, so that d inputs need d + 1 cases. A trajectory is
left out of the effects of a response if the response of one of its cases does not exist.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from stonepass.array_types import Float
from stonepass.io.optional_imports import library
from stonepass.studies.sensitivity.estimate import (
    LEVEL,
    Effects,
    IndexEstimate,
    Response,
    Sensitivities,
)
from stonepass.studies.sensitivity.groups import groups_of, unit_problem
from stonepass.studies.uncertain_quantity import UncertainQuantity

__all__ = ["FEWEST_TRAJECTORIES", "TAILS", "morris_design", "morris_sensitivities"]

FEWEST_TRAJECTORIES = 4  # smallest number of complete trajectories from which effects are computed
LEVELS = 4  # number of levels of each input between the two quantiles
TAILS = (0.05, 0.95)  # quantiles between which the inputs are moved
RESAMPLES = 1000  # number of bootstrap resamples for the confidence intervals


def morris_design(
    quantities: Mapping[str, UncertainQuantity], trajectories: int, seed: int
) -> dict[str, Float[np.ndarray, " n"]]:
    """Return the samples of Morris trajectories.

    Parameters
    ----------
    quantities : mapping of str to UncertainQuantity
        The d independent inputs, none of them exact. They are moved between their 5 % and 95 %
        quantiles over four levels, which are equally spaced in probability.
    trajectories : int
        Number of trajectories.
    seed : int
        Seed of the trajectories.

    Returns
    -------
    dict of str to array (n)
        Values of every input in SI units, with n = trajectories × (d + 1).

    Raises
    ------
    BadInput
        SALib is not installed.

    References
    ----------
    docs/howto/sensitivity.md, "Elementary effects".
    """
    fractions = TAILS[0] + _unit_design(quantities, trajectories, seed) * (TAILS[1] - TAILS[0])
    return {
        name: each.quantiles(fractions[:, k]) for k, (name, each) in enumerate(quantities.items())
    }


def morris_sensitivities(
    quantities: Mapping[str, UncertainQuantity],
    response: Response,
    values: np.ma.MaskedArray,
    seed: int,
) -> Sensitivities:
    """Compute the elementary effects of a response with 95 % confidence intervals of μ*.

    Parameters
    ----------
    quantities : mapping of str to UncertainQuantity
        The d inputs, as for `morris_design`.
    response : Response
        Name and unit of the response.
    values : masked array (n)
        Values of the response in the order of the design with this seed; masked where they do not
        exist.
    seed : int
        Seed of the trajectories, and of the bootstrap.

    Raises
    ------
    BadInput
        SALib is not installed.

    References
    ----------
    docs/howto/sensitivity.md, "Elementary effects".
    """
    analysis = library("SALib.analyze.morris", "compute sensitivity indices", "studies")
    groups = groups_of(values, len(quantities) + 1)
    gap = groups.gap(response, groups.values, FEWEST_TRAJECTORIES)
    if gap is not None:
        return Sensitivities(response, (), (), groups.count, groups.dropped, gap)
    count = len(quantities)
    unit = _unit_design(quantities, len(groups.complete), seed).reshape(-1, count + 1, count)
    used = unit[groups.complete].reshape(-1, count)
    found = analysis.analyze(
        unit_problem(quantities), used, groups.values.ravel(), num_levels=LEVELS,
        num_resamples=RESAMPLES, conf_level=LEVEL, seed=seed,
    )  # fmt: skip
    effects = [
        Effects(
            name,
            IndexEstimate(float(found["mu_star"][k]), float(found["mu_star_conf"][k])),
            float(found["mu"][k]),
            float(found["sigma"][k]),
        )
        for k, name in enumerate(quantities)
    ]
    ordered = tuple(sorted(effects, key=lambda each: -each.mean_absolute.value))
    return Sensitivities(response, ordered, (), groups.count, groups.dropped)


def _unit_design(
    quantities: Mapping[str, UncertainQuantity], trajectories: int, seed: int
) -> Float[np.ndarray, "n d"]:
    sampler = library("SALib.sample.morris", "sample for sensitivity indices", "studies")
    return np.asarray(
        sampler.sample(unit_problem(quantities), trajectories, num_levels=LEVELS, seed=seed)
    )
