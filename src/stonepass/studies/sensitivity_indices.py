"""Sobol' total sensitivity indices of an outcome with respect to its uncertain inputs."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from scipy.stats import sobol_indices

from stonepass.array_types import Float
from stonepass.studies.sampling import Draws
from stonepass.studies.uncertain_quantity import UncertainQuantity

__all__ = ["SensitivityIndex", "rank_among", "rank_sensitivity"]

SAMPLES = 1024  # number of samples of each input, a power of two


@dataclass(frozen=True)
class SensitivityIndex:
    """Sobol' total index of an input.

    The index is the fraction of the variance of the outcome that involves the input, alone or in
    interactions. An interaction counts for each of its inputs, so that the sum may exceed 1.

    Attributes
    ----------
    name : str
        Name of the input.
    total : float
        Total index, 0 to 1.

    References
    ----------
    docs/assess.md, "What is done".
    """

    name: str
    total: float


def rank_among(
    ordered: Float[np.ndarray, " m"], values: Float[np.ndarray, " n"]
) -> Float[np.ndarray, " n"]:
    """Return the ranks of values: the fraction of known values below each of them.

    Parameters
    ----------
    ordered : array (m)
        Known values in ascending order.
    values : array (n)
        Values whose ranks are wanted.

    Returns
    -------
    array (n)
        Ranks from 0 to 1.
    """
    return np.searchsorted(ordered, values) / len(ordered)


def rank_sensitivity(
    outcome: Callable[[Draws], Float[np.ndarray, " n"]],
    quantities: Mapping[str, UncertainQuantity],
    known: Float[np.ndarray, " m"],
    seed: int,
) -> tuple[SensitivityIndex, ...]:
    """Compute the total sensitivity index of every input for the rank of an outcome.

    The rank of an outcome is the fraction of known outcomes below it. The variance of the rank,
    unlike that of the outcome itself, cannot be dominated by a few extreme values.

    Parameters
    ----------
    outcome : callable
        Function that returns an array (n) of outcomes for n samples of the inputs.
    quantities : mapping of str to UncertainQuantity
        Independent inputs, none of them exact.
    known : array (m)
        Outcomes of other samples, which define the rank.
    seed : int
        Seed of the samples.

    Returns
    -------
    tuple of SensitivityIndex
        Indices in descending order. A single input has the index 1. The tuple is empty if all known
        outcomes are equal.

    References
    ----------
    docs/assess.md, "What is done".
    """
    if len(quantities) < 2:
        return tuple(SensitivityIndex(name, 1.0) for name in quantities)
    ordered = np.sort(known)
    if ordered[0] == ordered[-1]:
        return ()

    def rank(inputs: Float[np.ndarray, "d n"]) -> Float[np.ndarray, " n"]:
        draws = dict(zip(quantities, inputs, strict=True))
        return rank_among(ordered, outcome(draws))

    found = sobol_indices(
        func=rank,
        n=SAMPLES,
        dists=[each.distribution for each in quantities.values()],
        rng=seed,
    )
    totals = np.clip(found.total_order, 0.0, 1.0)
    indices = [SensitivityIndex(n, float(t)) for n, t in zip(quantities, totals, strict=True)]
    return tuple(sorted(indices, key=lambda each: -each.total))
