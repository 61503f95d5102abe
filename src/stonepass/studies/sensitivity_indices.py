"""Which uncertain input the spread of an outcome comes from: Sobol's total indices."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np
from scipy.stats import sobol_indices

from stonepass.array_types import Float
from stonepass.studies.sampling import Draws
from stonepass.studies.uncertain_quantity import UncertainQuantity

__all__ = ["SensitivityIndex", "rank_sensitivity"]

SAMPLES = 1024


@dataclass(frozen=True)
class SensitivityIndex:
    """Sobol's total index of an input: the fraction of the variance that it has a part in.

    Interactions count for each input that takes part, so that the sum may exceed 1.
    """

    name: str
    total: float


def rank_sensitivity(
    outcome: Callable[[Draws], Float[np.ndarray, " n"]],
    quantities: Mapping[str, UncertainQuantity],
    known: Float[np.ndarray, " m"],
    seed: int,
) -> tuple[SensitivityIndex, ...]:
    """Return the total index of every input for the rank of an outcome, the largest first.

    The rank of an outcome is its place among known outcomes, from 0 to 1. Its variance cannot be
    dominated by a tail, as that of the outcome itself can.

    Parameters
    ----------
    outcome : callable
        Takes draws of the quantities and returns one number for each.
    quantities : mapping of str to UncertainQuantity
        Independent inputs, none of them exact.
    known : array (m)
        Outcomes of other samples, which define the rank.
    seed : int

    Returns
    -------
    tuple of SensitivityIndex
        Each between 0 and 1; one input alone has 1; empty where the known outcomes are all equal.
    """
    if len(quantities) < 2:
        return tuple(SensitivityIndex(name, 1.0) for name in quantities)
    ordered = np.sort(known)
    if ordered[0] == ordered[-1]:
        return ()

    def rank(inputs: Float[np.ndarray, "d n"]) -> Float[np.ndarray, " n"]:
        draws = dict(zip(quantities, inputs, strict=True))
        return np.searchsorted(ordered, outcome(draws)) / len(ordered)

    found = sobol_indices(
        func=rank,
        n=SAMPLES,
        dists=[each.distribution for each in quantities.values()],
        rng=seed,
    )
    totals = np.clip(found.total_order, 0.0, 1.0)
    indices = [SensitivityIndex(n, float(t)) for n, t in zip(quantities, totals, strict=True)]
    return tuple(sorted(indices, key=lambda each: -each.total))
