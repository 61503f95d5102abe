"""Starting points of a fit: a grid of the dimensionless constants, each with its best moduli.

The stress is proportional to a common factor on all moduli, and for isotropic laws it is linear in
each of them. The best moduli for given dimensionless constants are therefore found at once, at
least nearly, so that many dimensionless constants can be tried before the search begins.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from itertools import product

import numpy as np

from stonepass.array_types import Float
from stonepass.bench.objective import Objective, search_bounds
from stonepass.materials.constants import ConstantDeclaration

__all__ = ["starting_values"]

# Factors on the first guess of a dimensionless constant that is positive, or of any sign.
POSITIVE, ANY_SIGN = (0.1, 1.0, 5.0), (-5.0, -2.0, -0.5, 0.5, 2.0, 5.0)
STARTS = 40  # largest number of starting points
LEAST = 1e-3  # smallest starting modulus as a fraction of the first guess of the shear modulus

Values = dict[str, float]


def starting_values(
    objective: Objective,
    declared: Mapping[str, ConstantDeclaration],
    fixed: Mapping[str, float],
    modulus: float,
) -> list[Values]:
    """Return the constants that describe the data best among those of a grid, the best first.

    Parameters
    ----------
    objective : Objective
        Data, law and expected errors.
    declared : mapping of str to ConstantDeclaration
        Declarations of the constants of the law.
    fixed : mapping of str to float
        Constants that keep a given value, in SI units.
    modulus : float
        First guess of the shear modulus in Pa.

    Returns
    -------
    list of dict of str to float
        Up to 40 sets of the constants that are not fixed, in SI units, with different
        dimensionless constants. All constants are inside the bounds of the search.
    """
    free = {name: each for name, each in declared.items() if name not in fixed}
    numbers = {name: each for name, each in free.items() if each.unit != "Pa"}
    moduli = {name: each for name, each in free.items() if each.unit == "Pa"}
    found = []
    for tried in product(*(_tried(each, modulus) for each in numbers.values())):
        held = {**fixed, **dict(zip(numbers, tried, strict=True))}
        chosen = [{**held, **each} for each in _best_moduli(objective, held, moduli, modulus)]
        errors = [float(np.sum(objective.off(each) ** 2)) for each in chosen]
        best = int(np.argmin(errors))
        found.append((errors[best], {name: chosen[best][name] for name in free}))
    found.sort(key=lambda each: each[0])
    return [values for _, values in found[:STARTS]]


def _tried(declared: ConstantDeclaration, modulus: float) -> list[float]:
    """Return the values of a dimensionless constant that are tried."""
    low, high = search_bounds(declared, modulus)
    factors = POSITIVE if declared.positive else ANY_SIGN
    inside = [value for each in factors if low < (value := each * declared.guess) < high]
    return inside if len(inside) == len(factors) else [*inside, (low + high) / 2.0]


def _best_moduli(
    objective: Objective,
    held: Values,
    moduli: Mapping[str, ConstantDeclaration],
    modulus: float,
) -> Iterator[Values]:
    """Yield the guessed moduli, the guessed ones times their best factor, and the best ones."""
    guess = {name: each.guess * modulus for name, each in moduli.items()}
    yield guess
    observed = objective.data.observed / objective.spread
    level = objective.predicted(held | guess) / objective.spread
    if np.all(np.isfinite(level)) and level.any():
        factor = float(level @ observed / (level @ level))
        yield _inside({name: factor * value for name, value in guess.items()}, moduli, modulus)
    if len(moduli) < 2:  # the factor is the best one
        return
    none = dict.fromkeys(moduli, 0.0)
    rest = objective.predicted(held | none) if any(held.values()) else np.zeros(len(observed))
    rest = np.where(np.isfinite(rest), rest, 0.0) / objective.spread
    columns = [
        objective.predicted(held | none | {name: value}) / objective.spread - rest
        for name, value in guess.items()
    ]
    matrix: Float[np.ndarray, "n moduli"] = np.array(columns).T
    if np.all(np.isfinite(matrix)):
        factors = np.linalg.lstsq(matrix, observed - rest, rcond=None)[0]
        best = {name: float(f) * guess[name] for name, f in zip(moduli, factors, strict=True)}
        yield _inside(best, moduli, modulus)


def _inside(values: Values, moduli: Mapping[str, ConstantDeclaration], modulus: float) -> Values:
    """Return moduli inside the bounds of the search, and not smaller than `LEAST` of the guess."""
    found = {}
    for name, value in values.items():
        low, high = search_bounds(moduli[name], modulus)
        least = LEAST * modulus
        if moduli[name].positive:
            low = max(low, least)
        found[name] = min(max(value if abs(value) > least else least, low), high)
    return found
