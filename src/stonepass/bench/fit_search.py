"""The search for the constants of a law: least squares from several starts, by lmfit."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from stonepass.array_types import Float
from stonepass.bench.least_squares import lmfit
from stonepass.bench.objective import Data, Objective, starting_parameters, stiffness_guess
from stonepass.errors import refuse_unknown
from stonepass.materials.constants import ConstantDeclaration
from stonepass.materials.known_laws import constants_by_name, known_law

__all__ = ["STARTS", "Search", "best_fit", "proportional_spread", "search_for"]

STARTS = (0.1, 1.0, 5.0)  # of the numbers of a law, each tried
SMALLEST_SHARE = 0.01  # of the largest stress: below it an error is no longer proportional
REWEIGHTED = 3  # times that proportional errors are taken anew from what the law predicts


@dataclass(frozen=True)
class Search:
    """Which constants are looked for, and where it begins."""

    law: str
    declared: Mapping[str, ConstantDeclaration]
    fixed: Mapping[str, float]
    free: tuple[str, ...]
    modulus: float

    @property
    def made(self) -> type[Any]:
        """The class of the law."""
        return known_law(self.law)

    def parameters(self, start: float) -> Any:
        """Parameters of lmfit, with the numbers of the law `start` times their guess."""
        return starting_parameters(lmfit(), self.declared, self.fixed, self.modulus, start)


def search_for(data: Data, law: str, given: Mapping[str, float], free: Sequence[str]) -> Search:
    """Tell which constants of a law are fitted; for the parameters see `law_fit.fit_law`."""
    declared, fixed = constants_by_name(law), dict(given)
    for each in (*fixed, *free):
        if each not in declared:
            refuse_unknown(f"constant of law '{law}'", each, list(declared))
    for constant in declared.values():
        if constant.held and constant.default is not None and constant.name not in free:
            fixed.setdefault(constant.name, constant.default)
    looked_for = tuple(each for each in declared if each not in fixed)
    return Search(law, declared, fixed, looked_for, stiffness_guess(data))


def best_fit(objective: Objective, search: Search, relative: bool) -> tuple[Objective, Any, Any]:
    """The best of the fits from several starts; proportional errors follow what it predicts."""
    data = objective.data
    if relative:
        objective = replace(objective, spread=proportional_spread(data.observed))
    starts = [search.parameters(start) for start in STARTS]
    alike = starts[0].valuesdict() == starts[-1].valuesdict()  # where no number is looked for
    found = [_minimized(objective, each) for each in (starts[:1] if alike else starts)]
    minimizer, result = min(found, key=lambda each: float(each[1].chisqr))
    for _ in range(REWEIGHTED if relative else 0):
        predicted = objective.predicted(result.params.valuesdict())
        if not np.all(np.isfinite(predicted)):
            break
        objective = replace(objective, spread=proportional_spread(predicted))
        minimizer, result = _minimized(objective, result.params)
    return objective, minimizer, result


def _minimized(objective: Objective, parameters: Any) -> tuple[Any, Any]:
    minimizer = lmfit().Minimizer(objective.residuals, parameters)
    with np.errstate(all="ignore"):
        return minimizer, minimizer.minimize(method="least_squares")


def proportional_spread(level: Float[np.ndarray, " n"]) -> Float[np.ndarray, " n"]:
    """Standard deviations in proportion to a level, and not below a hundredth of the largest."""
    size = np.abs(level)
    return np.maximum(size, SMALLEST_SHARE * float(size.max()))
