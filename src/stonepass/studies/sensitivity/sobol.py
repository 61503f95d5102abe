"""Sobol' indices of any evaluator with SALib: first order, total and second order.

The samples are a Saltelli design: N base samples and 2 d + 2 cases for each of them, where d is the
number of inputs. All cases of a base sample are a group. A group is left out of the indices of a
response if the response of one of its cases does not exist.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from stonepass.array_types import Float
from stonepass.io.optional_imports import library
from stonepass.studies.sensitivity.estimate import (
    LEVEL,
    IndexEstimate,
    Indices,
    Interaction,
    Response,
    Sensitivities,
)
from stonepass.studies.sensitivity.groups import groups_of, unit_problem
from stonepass.studies.uncertain_quantity import UncertainQuantity

__all__ = ["FEWEST_GROUPS", "saltelli_design", "sobol_sensitivities"]

FEWEST_GROUPS = 32  # smallest number of complete groups from which indices are computed
# Number of bootstrap resamples for the confidence intervals, and of values in all of them together,
# which limits the memory.
RESAMPLES, VALUES = (50, 200), 4_000_000


def saltelli_design(
    quantities: Mapping[str, UncertainQuantity], samples: int, seed: int
) -> dict[str, Float[np.ndarray, " n"]]:
    """Return the samples of a Saltelli design from a scrambled Sobol' sequence.

    Parameters
    ----------
    quantities : mapping of str to UncertainQuantity
        The d independent inputs, none of them exact.
    samples : int
        Number N of base samples, a power of two.
    seed : int
        Seed of the scrambling.

    Returns
    -------
    dict of str to array (n)
        Values of every input in SI units, with n = N (2 d + 2).

    Raises
    ------
    BadInput
        SALib is not installed.

    References
    ----------
    docs/howto/sensitivity.md, "Sobol' indices".
    """
    sampler = library("SALib.sample.sobol", "sample for sensitivity indices", "studies")
    unit = sampler.sample(unit_problem(quantities), samples, calc_second_order=True, seed=seed)
    tiny = np.finfo(float).eps
    inside = np.clip(unit, tiny, 1.0 - tiny)
    return {name: each.quantiles(inside[:, k]) for k, (name, each) in enumerate(quantities.items())}


def sobol_sensitivities(
    quantities: Mapping[str, UncertainQuantity],
    response: Response,
    values: np.ma.MaskedArray,
    seed: int,
) -> Sensitivities:
    """Compute the Sobol' indices of a response with 95 % confidence intervals by the bootstrap.

    Parameters
    ----------
    quantities : mapping of str to UncertainQuantity
        The d inputs, as for `saltelli_design`.
    response : Response
        Name and unit of the response.
    values : masked array (n)
        Values of the response in the order of the design; masked where they do not exist.
    seed : int
        Seed of the bootstrap.

    Raises
    ------
    BadInput
        SALib is not installed.

    References
    ----------
    docs/howto/sensitivity.md, "Sobol' indices".
    """
    analysis = library("SALib.analyze.sobol", "compute sensitivity indices", "studies")
    groups = groups_of(values, 2 * len(quantities) + 2)
    # The variance is that of the two independent samples of each group, its first and last case.
    gap = groups.gap(response, groups.values[:, [0, -1]], FEWEST_GROUPS)
    if gap is not None:
        return Sensitivities(response, (), (), groups.count, groups.dropped, gap)
    problem, flat, names = unit_problem(quantities), groups.values.ravel(), list(quantities)
    resamples = int(np.clip(VALUES // len(groups.values), *RESAMPLES))
    found = analysis.analyze(
        problem, flat, calc_second_order=True, num_resamples=resamples, conf_level=LEVEL,
        seed=seed + 1,  # a seed of 0 would count as no seed
    )  # fmt: skip
    pairs = _interactions(names, found)
    return Sensitivities(response, _indices(names, found), pairs, groups.count, groups.dropped)


def _indices(names: list[str], found: Any) -> tuple[Indices, ...]:
    each = [
        Indices(name, _estimate(found, "S1", k), _estimate(found, "ST", k))
        for k, name in enumerate(names)
    ]
    return tuple(sorted(each, key=lambda index: -index.total.value))


def _interactions(names: list[str], found: Any) -> tuple[Interaction, ...]:
    each = [
        Interaction((names[j], names[k]), _estimate(found, "S2", (j, k)))
        for j in range(len(names))
        for k in range(j + 1, len(names))
    ]
    return tuple(sorted(each, key=lambda interaction: -interaction.second.value))


def _estimate(found: Any, name: str, at: Any) -> IndexEstimate:
    return IndexEstimate(float(found[name][at]), float(found[f"{name}_conf"][at]))
