"""The interface to fast sources of critical pressures: a surrogate or a response surface."""

from __future__ import annotations

from typing import Protocol, runtime_checkable

import numpy as np

from stonepass.array_types import Bool, Float
from stonepass.model.case import Case
from stonepass.studies.conditions import Conditions

__all__ = ["CriticalPressures"]


@runtime_checkable
class CriticalPressures(Protocol):
    """The critical pressures of many conditions with the material and the load of one case."""

    @property
    def case(self) -> Case:
        """Material, load, model and shape of all conditions."""

    @property
    def error(self) -> float:
        """95th percentile of the relative error of P_ucr."""

    def __call__(self, asked: Conditions) -> tuple[Float[np.ndarray, " n"], Bool[np.ndarray, " n"]]:
        """Return P_ucr in Pa for n conditions; some values are only lower bounds (*censored*).

        P_ucr is 0, and not censored, for a stone that is no larger than the lumen. A value that is
        not known at all is censored and 0.

        Parameters
        ----------
        asked : Conditions
            Size ratio, wall ratio, friction and load factor; the factor 1 is the load of `case`.

        Returns
        -------
        pressure : array (n)
            P_ucr or its lower bound in Pa.
        censored : array (n) of bool
            True for a value that is only a lower bound.
        """
