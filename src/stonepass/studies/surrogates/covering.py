"""A surrogate of the package as the source of the critical pressures of a case's conditions."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from stonepass.array_types import Bool, Float
from stonepass.model.case import Case
from stonepass.studies.conditions import Conditions, lumen_ratios
from stonepass.studies.surrogates.solved import MOVES
from stonepass.studies.surrogates.store import load_surrogate, shipped_surrogates
from stonepass.studies.surrogates.surrogate import Surrogate

__all__ = ["CoveringSurrogate", "covering_surrogate"]

MOST_OUTSIDE = 0.005  # largest fraction of the conditions that may be outside the box


@dataclass(frozen=True)
class CoveringSurrogate:
    """A surrogate that covers the walls, frictions and loads of some conditions of a case.

    Attributes
    ----------
    case : Case
        Material, load, model and shape of the conditions.
    surrogate : Surrogate
        A surrogate of the package for this material, model and kind of load.
    """

    case: Case
    surrogate: Surrogate

    @property
    def error(self) -> float:
        """95th percentile of the relative error of P_ucr, measured with held-out cases."""
        return float(self.surrogate.about["check"]["percentile_95"])

    def __call__(self, asked: Conditions) -> tuple[Float[np.ndarray, " n"], Bool[np.ndarray, " n"]]:
        """Return P_ucr in Pa for n conditions; some values are only lower bounds (*censored*).

        A value is censored if the stone is larger than the largest one of the surrogate, whose
        P_ucr is then the lower bound; if the paper's closure ends before the stone moves; and, with
        the lower bound 0, if wall, friction or load are outside the box.
        """
        at = self._relative(asked)
        largest = self.surrogate.box.size_ratio
        held = replace(at, size_ratio=np.minimum(at.size_ratio, largest))
        found = self.surrogate.solve(held)
        known = np.isfinite(found.pressure)
        pressure = np.where(known, found.pressure, found.lower_bound)
        larger = (at.size_ratio > largest) & (found.outcome == MOVES)
        return pressure, larger | (~known & ~self._loose(asked, ~known))

    def _loose(self, asked: Conditions, chosen: Bool[np.ndarray, " n"]) -> Bool[np.ndarray, " n"]:
        """Return which of the chosen conditions have a stone that is no larger than the lumen."""
        some = asked.where(chosen)
        lumen = lumen_ratios(self.case, some.wall_ratio, some.load_factor)
        loose = chosen.copy()
        loose[chosen] = some.size_ratio <= lumen
        return loose

    def covers(self, over: Conditions) -> bool:
        """Return whether nearly all walls, frictions and loads are inside the box."""
        at = self._relative(over)
        inside = self.surrogate.contains(replace(at, size_ratio=np.ones(len(at.friction))))
        return bool(np.mean(~inside) <= MOST_OUTSIDE)

    def _relative(self, asked: Conditions) -> Conditions:
        """Return the conditions with load factors that belong to the load of the surrogate."""
        most = self.surrogate.case.load.confining_pressure
        given = self.case.load.confining_pressure
        if given == 0.0:
            return replace(asked, load_factor=np.zeros(len(asked.friction)))
        ratio = given / most if most > 0.0 else np.inf
        return replace(asked, load_factor=ratio * asked.load_factor)


def covering_surrogate(case: Case, over: Conditions) -> CoveringSurrogate | None:
    """Return a surrogate of the package that covers some conditions; None if there is none.

    Parameters
    ----------
    case : Case
        Material, load, model and shape of all conditions.
    over : Conditions
        Walls, frictions and load factors; at most 0.5 % of them may be outside the box of the
        surrogate. Their sizes are ignored.
    """
    key = (case.ureter.material.name, case.model.NAME)
    if key not in shipped_surrogates():
        return None
    found = CoveringSurrogate(case, load_surrogate(*key))
    own = found.surrogate.case
    same = (
        case.ureter.material == own.ureter.material
        and case.model == own.model
        and case.numerics == own.numerics
        and case.stone.shape == own.stone.shape
        and case.load.prestretch == own.load.prestretch
        and (case.load.confining_pressure == 0.0 or case.load.confinement == own.load.confinement)
    )
    return found if same and found.covers(over) else None
