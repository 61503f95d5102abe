"""Groups of samples, of which only complete ones are used, and the problem in the form of SALib."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Bool, Float
from stonepass.studies.sensitivity.estimate import Gap, Response
from stonepass.studies.uncertain_quantity import UncertainQuantity

__all__ = ["Groups", "groups_of", "unit_problem"]

FEWEST_OF_A_KIND = 10  # smallest number of samples with the rarer value of a yes-or-no response


@array_dataclass
@dataclass(frozen=True)
class Groups:
    """The groups of samples of one response.

    Attributes
    ----------
    complete : array (g) of bool
        True for a group in which all values exist.
    values : array (m, k)
        Values of the m complete groups.
    """

    complete: Bool[np.ndarray, " g"]
    values: Float[np.ndarray, "m k"]

    @property
    def count(self) -> int:
        """Number of groups, complete or not."""
        return len(self.complete)

    @property
    def dropped(self) -> int:
        """Number of groups that are not complete."""
        return int(np.count_nonzero(~self.complete))

    def gap(
        self, response: Response, independent: Float[np.ndarray, "m j"], fewest: int
    ) -> Gap | None:
        """Return the reason why no sensitivity can be computed from the complete groups, if any.

        Parameters
        ----------
        response : Response
            The response, which may be a yes-or-no number.
        independent : array (m, j)
            The values of the complete groups whose variance counts.
        fewest : int
            Smallest number of complete groups.
        """
        if len(independent) < fewest:
            return Gap.INCOMPLETE
        if float(np.ptp(independent)) == 0.0:
            return Gap.CONSTANT
        ones = int(np.count_nonzero(independent == 1.0))
        rare = response.yes_or_no and min(ones, independent.size - ones) < FEWEST_OF_A_KIND
        return Gap.RARE if rare else None


def groups_of(values: np.ma.MaskedArray, size: int) -> Groups:
    """Return the groups of `size` consecutive values, of which some may be masked."""
    grouped = values.reshape(-1, size)
    complete = np.asarray(~np.ma.getmaskarray(grouped).any(axis=1))
    return Groups(complete, grouped.filled(0.0)[complete])


def unit_problem(quantities: Mapping[str, UncertainQuantity]) -> dict[str, Any]:
    """Return the problem in the form of SALib, with inputs in the unit cube."""
    count = len(quantities)
    return {"num_vars": count, "names": list(quantities), "bounds": [[0.0, 1.0]] * count}
