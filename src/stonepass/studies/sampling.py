"""Monte Carlo samples of uncertain quantities, from a scrambled Sobol sequence."""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np
from scipy.stats import qmc

from stonepass.array_types import Bool, Float
from stonepass.studies.uncertain_quantity import UncertainQuantity

__all__ = ["Draws", "draw", "sobol_points"]

Draws = Mapping[str, Float[np.ndarray, " n"]]
MORE_DRAWS = (0, 2, 4, 6)  # powers of two over the samples asked for, tried one after the other


def draw(
    quantities: Mapping[str, UncertainQuantity],
    count: int,
    seed: int,
    keep: Callable[[Draws, Float[np.ndarray, " n"]], Bool[np.ndarray, " n"]],
) -> tuple[Draws, Bool[np.ndarray, " n"]]:
    """Draw independent quantities until `count` draws are kept.

    Parameters
    ----------
    quantities : mapping of str to UncertainQuantity
    count : int
        Number of draws wanted, at least 1.
    seed : int
        Seed of the scrambling, 0 to 2³² − 1.
    keep : callable
        Takes the draws and, for each, a number that is uniform between 0 and 1 and independent of
        them; returns which draws are kept. With the number a draw can be kept with a probability.

    Returns
    -------
    draws : mapping of str to array (n)
        All draws; n is a power of two, at most 64 times `count` rounded up.
    kept : array (n)
        Which are kept; they may be fewer than `count`.
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
    """Return 2^`power` points of the unit cube, none of them on its faces."""
    tiny = np.finfo(float).eps
    points = qmc.Sobol(dimensions, seed=seed).random_base2(power)
    return np.clip(points, tiny, 1.0 - tiny)
