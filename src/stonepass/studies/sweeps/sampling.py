"""Sampling plans in the unit cube whose points are known by their index."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np

from stonepass.array_types import Float
from stonepass.errors import refuse_unknown, require
from stonepass.studies.seed import check_seed

__all__ = ["METHODS", "Sampling", "read_sampling"]

KEYS = ("method", "count", "seed")
METHODS = ("sobol", "latin-hypercube")
MOST = {"sobol": 2**30, "latin-hypercube": 2**20}  # samples


@dataclass(frozen=True)
class Sampling:
    """A sampling plan.

    Point i depends on the method, the count, the seed and i alone, so that a case has the same
    inputs in whichever order, block or process it is solved.

    Attributes
    ----------
    method : {"sobol", "latin-hypercube"}
        Scrambled Sobol' sequence, or Latin hypercube. A Latin hypercube is computed as a whole, so
        that it has 2²⁰ points at most; a Sobol' sequence has 2³⁰ at most.
    count : int
        Number of points. The points of a Sobol' sequence are balanced if it is a power of two.
    seed : int
        Seed of the scrambling or of the hypercube, 0 to 2³² − 1.

    Raises
    ------
    BadInput
        A value is out of bounds, or the method is unknown.

    References
    ----------
    ``scipy.stats.qmc``.
    """

    method: str = "sobol"
    count: int = 1024
    seed: int = 0

    def __post_init__(self) -> None:
        _check(self.method, self.count, self.seed)

    @property
    def balanced(self) -> bool:
        """True for a Latin hypercube, and for a Sobol' sequence whose length is a power of two."""
        return self.method != "sobol" or self.count.bit_count() == 1

    def points(self, dimensions: int, start: int, stop: int) -> Float[np.ndarray, "n d"]:
        """Return the points from `start` to `stop`, which is excluded, in the unit cube."""
        if self.method == "sobol":
            from scipy.stats import qmc  # takes a second to load

            sequence = qmc.Sobol(dimensions, seed=self.seed)
            if start:
                sequence.fast_forward(start)
            with warnings.catch_warnings():
                # The warning is about the balance of a part of the sequence.
                warnings.simplefilter("ignore", UserWarning)
                return np.asarray(sequence.random(stop - start))
        return _hypercube(dimensions, self.count, self.seed)[start:stop]


@lru_cache(maxsize=2)
def _hypercube(dimensions: int, count: int, seed: int) -> Float[np.ndarray, "n d"]:
    from scipy.stats import qmc

    return np.asarray(qmc.LatinHypercube(dimensions, seed=seed).random(count))


def read_sampling(table: Mapping[str, Any]) -> Sampling:
    """Return the sampling plan that the section ``samples`` of a study describes.

    Raises
    ------
    BadInput
        A key is unknown, the count is missing, or a value has the wrong type or is out of bounds.
    """
    for key in table:
        if key not in KEYS:
            refuse_unknown("key of [samples]", key, list(KEYS))
    require("count" in table, "'samples.count'", "missing", "given, because ranges are sampled")
    method, count, seed = table.get("method", METHODS[0]), table["count"], table.get("seed", 0)
    _check(method, count, seed)
    return Sampling(method, count, seed)


def _check(method: Any, count: Any, seed: Any) -> None:
    if method not in METHODS:
        refuse_unknown("'samples.method'", str(method), list(METHODS))
    whole = isinstance(count, int) and not isinstance(count, bool)
    allowed = f"a whole number from 1 to {MOST[method]}"
    require(whole and 1 <= count <= MOST[method], "'samples.count'", count, allowed)
    check_seed(seed, "'samples.seed'")
