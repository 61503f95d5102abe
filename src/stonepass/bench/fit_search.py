"""Least-squares search for the constants of a law from several starting points, with lmfit."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from stonepass.array_types import Float
from stonepass.bench.bounded_search import improved
from stonepass.bench.fit_starts import starting_values
from stonepass.bench.least_squares import lmfit
from stonepass.bench.objective import Data, Objective, starting_parameters, stiffness_guess
from stonepass.bench.short_search import most_promising
from stonepass.errors import BadInput, refuse_unknown, require
from stonepass.materials.constants import ConstantDeclaration, shown_constant
from stonepass.materials.known_laws import constants_by_name, known_law

__all__ = ["BestFit", "Search", "best_fit", "proportional_spread", "search_for"]

# Smallest proportional error, as a fraction of the error at the largest stress.
SMALLEST_SHARE = 0.01
# Two fits are equally good if their sums of squares differ by less than this fraction of the
# variance of the errors, or by this fraction of the sum of squares of the data.
AS_GOOD, EXACT = 0.1, 1e-12
COUNT = 3  # number of starting points from which the search goes on
ITERATIONS = 200  # iterations with the logarithms of positive constants, before the fit
# Largest number of evaluations of the fit after these iterations. A fit that needs more follows a
# valley of the sum of squares that does not end.
EVALUATIONS = 1000
REWEIGHTED = 3  # iterations in which proportional errors are updated from the predictions


@dataclass(frozen=True)
class Search:
    """The constants of a law to be fitted, the given ones, and the scale of the starting point.

    Attributes
    ----------
    law : str
        Name of the law.
    declared : mapping of str to ConstantDeclaration
        Declarations of all constants of the law.
    fixed : mapping of str to float
        Constants that keep a given value, in SI units.
    free : tuple of str
        Names of the constants to be fitted.
    modulus : float
        First guess of the shear modulus in Pa, which scales the search bounds of all moduli.
    """

    law: str
    declared: Mapping[str, ConstantDeclaration]
    fixed: Mapping[str, float]
    free: tuple[str, ...]
    modulus: float

    @property
    def made(self) -> type[Any]:
        """The class of the law."""
        return known_law(self.law)

    def shown(self, values: Mapping[str, float]) -> str:
        """Return the constants to be fitted as text, from values in SI units."""
        parts = [f"{name} = {shown_constant(values[name], self.declared[name])}"
                 for name in self.free]  # fmt: skip
        return ", ".join(parts)

    def starts(self, objective: Objective) -> list[Any]:
        """Return lmfit parameters at the starting points of the search, the best first."""
        return [
            starting_parameters(lmfit(), self.declared, self.fixed, self.modulus, values)
            for values in starting_values(objective, self.declared, self.fixed, self.modulus)
        ]


def search_for(data: Data, law: str, given: Mapping[str, float], free: Sequence[str]) -> Search:
    """Decide which constants of a law are fitted and which keep a given or default value.

    Parameters
    ----------
    data : Data
        Data from which the scale of the moduli is guessed.
    law : str
        Name of the law in `materials.known_laws.KNOWN_LAWS`.
    given : mapping of str to float
        Constants that are not fitted, in SI units.
    free : sequence of str
        Names of constants to be fitted although they normally keep their default.

    Raises
    ------
    BadInput
        The law or one of the constants is unknown, a given value is outside the bounds of its
        constant, or a constant is both given and named in `free`.
    """
    declared, fixed = constants_by_name(law), dict(given)
    for each in (*fixed, *free):
        if each not in declared:
            refuse_unknown(f"constant of law '{law}'", each, list(declared))
    for name, value in fixed.items():
        if name in free:
            raise BadInput(f"constant {name}", "both fixed and freed", "one of them, since a "
                           "fixed constant is not fitted", f"leave out --fix {name} or --free "
                           f"{name}")  # fmt: skip
        require(declared[name].allows(value), f"fixed constant {name}",
                shown_constant(value, declared[name]), declared[name].allowed)  # fmt: skip
    for constant in declared.values():
        if constant.held and constant.default is not None and constant.name not in free:
            fixed.setdefault(constant.name, constant.default)
    looked_for = tuple(each for each in declared if each not in fixed)
    return Search(law, declared, fixed, looked_for, stiffness_guess(data))


@dataclass(frozen=True)
class BestFit:
    """The best result of a search.

    Attributes
    ----------
    objective : Objective
        The objective with the errors of the last fit.
    minimizer : lmfit.Minimizer
    result : lmfit.minimizer.MinimizerResult
    as_good : list of dict of str to float
        Constants, in SI units, at which the search ended from other starting points, if they
        describe the data as well as the result.
    others : list of lmfit.Parameters
        The points at which the search ended from the other starting points.
    """

    objective: Objective
    minimizer: Any
    result: Any
    as_good: list[dict[str, float]]
    others: list[Any]


def best_fit(
    objective: Objective, search: Search, starts: Sequence[Any], relative: bool
) -> BestFit:
    """Fit from every starting point and return the best result.

    With proportional errors the expected error of a point is proportional to its predicted value,
    so that the best fit is repeated with updated errors (iteratively reweighted least squares).

    Parameters
    ----------
    objective : Objective
        Data, law and the errors to begin with.
    search : Search
        The constants.
    starts : sequence of lmfit.Parameters
        Starting points, see `Search.starts`.
    relative : bool
        True if the errors are proportional to the predicted values.
    """
    data = objective.data
    if relative:
        objective = replace(objective, spread=proportional_spread(data.observed))
    chosen = most_promising(objective, starts, COUNT)
    ended = [improved(objective.residuals, each, ITERATIONS) for each in chosen]
    ended.sort(key=objective.misfit)
    minimizer, result = _minimized(objective, ended[0])
    noise = float(result.chisqr) / max(1, len(data.observed) - len(search.free))
    level = float(np.sum((data.observed / objective.spread) ** 2))
    limit = float(result.chisqr) + AS_GOOD * noise + EXACT * level
    equal = [each for each in ended[1:] if objective.misfit(each) <= limit]
    as_good = [{k: float(v) for k, v in each.valuesdict().items()} for each in equal]
    for _ in range(REWEIGHTED if relative else 0):
        predicted = objective.predicted(result.params.valuesdict())
        if not np.all(np.isfinite(predicted)):
            break
        objective = replace(objective, spread=proportional_spread(predicted))
        minimizer, result = _minimized(objective, result.params)
    return BestFit(objective, minimizer, result, as_good, ended[1:])


def _minimized(objective: Objective, parameters: Any) -> tuple[Any, Any]:
    minimizer = lmfit().Minimizer(objective.residuals, parameters, max_nfev=EVALUATIONS)
    with np.errstate(all="ignore"):
        return minimizer, minimizer.minimize(method="least_squares", x_scale="jac")


def proportional_spread(
    level: Float[np.ndarray, " n"], smallest: float = SMALLEST_SHARE
) -> Float[np.ndarray, " n"]:
    """Return errors proportional to stresses, but at least a fraction of the largest error.

    Parameters
    ----------
    level : array (n)
        Stresses in any unit.
    smallest : float
        The fraction.
    """
    size = np.abs(level)
    return np.maximum(size, smallest * float(size.max()))
