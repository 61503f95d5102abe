"""Monte Carlo samples of uncertain quantities, from a scrambled Sobol sequence."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from scipy.stats import qmc

from stonepass.array_types import Bool, Float
from stonepass.studies.uncertain_quantity import UncertainQuantity

__all__ = ["Draws", "draw", "sobol_points"]

Draws = Mapping[str, Float[np.ndarray, " n"]]
# As long as too few samples are accepted, the first number of draws is multiplied by 2 to these
# powers, one after the other.
MORE_DRAWS = (0, 2, 4, 6)


def draw(
    quantities: Mapping[str, UncertainQuantity],
    count: int,
    seed: int,
    keep: Callable[[Draws, Float[np.ndarray, " n"]], Bool[np.ndarray, " n"]],
) -> tuple[Draws, Bool[np.ndarray, " n"]]:
    """Draw samples of independent quantities until enough of them are accepted.

    Parameters
    ----------
    quantities : mapping of str to UncertainQuantity
        The quantities by name.
    count : int
        Number of accepted samples that is wanted, at least 1.
    seed : int
        Seed of the scrambled Sobol sequence, 0 to 2³² − 1.
    keep : callable
        Function that returns an array (n) of bool: True for an accepted sample. Its first argument
        is the samples. Its second argument is an array (n) of independent random numbers, uniform
        between 0 and 1. A sample is accepted with the probability p if it is accepted whenever its
        number is below p.

    Returns
    -------
    draws : mapping of str to array (n)
        All samples, accepted or not. n is a power of two and at most 64 times `count` (rounded up
        to a power of two).
    kept : array (n) of bool
        True for an accepted sample. Fewer than `count` may be accepted.

    References
    ----------
    docs/assess.md, "What is done".
    """
    power = int(np.ceil(np.log2(count)))
    for more in MORE_DRAWS:
        unit = sobol_points(len(quantities) + 1, power + more, seed)
        draws = {name: each.quantiles(unit[:, k]) for k, (name, each) in
                 enumerate(quantities.items())}  # fmt: skip
        kept = keep(draws, unit[:, -1])
        if kept.sum() >= count:
            break
    return draws, kept


def sobol_points(dimensions: int, power: int, seed: int) -> Float[np.ndarray, "n d"]:
    """Return points of a scrambled Sobol sequence inside the unit cube.

    Parameters
    ----------
    dimensions : int
        Number d of coordinates of a point.
    power : int
        Binary logarithm of the number n of points.
    seed : int
        Seed of the scrambling, 0 to 2³² − 1.

    Returns
    -------
    array (n, d)
        Numbers between 0 and 1, both excluded.
    """
    tiny = np.finfo(float).eps
    points = qmc.Sobol(dimensions, seed=seed).random_base2(power)
    return np.clip(points, tiny, 1.0 - tiny)
