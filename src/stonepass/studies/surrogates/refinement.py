"""The cases at which a surrogate is least certain: two fits to halves of the cases differ most."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from stonepass.array_types import Float, Int
from stonepass.model.case import Case
from stonepass.studies.conditions import Conditions
from stonepass.studies.surrogates.box import Setting
from stonepass.studies.surrogates.claimed_error import NONE
from stonepass.studies.surrogates.domain import Domain

__all__ = ["least_certain", "least_certain_cases"]

APART = 0.08  # smallest distance of two chosen cases, in coordinates of the box


def least_certain(
    pressures: Callable[[slice], Float[np.ndarray, " m"]],
    points: Float[np.ndarray, "m d"],
    count: int,
) -> Int[np.ndarray, " k"]:
    """Return the numbers of the cases at which two surrogates differ most.

    The surrogates are fitted to the cases with even and with odd numbers. Cases that are close to
    one that was chosen before are passed over, so that the chosen cases do not gather at one place.

    Parameters
    ----------
    pressures : callable
        Returns P_ucr in Pa of m candidates by a surrogate that is fitted to a part of the solved
        cases, which is given as a slice; NaN where P_ucr does not exist.
    points : array (m, d)
        Coordinates of the candidates.
    count : int
        Largest number k of cases.

    References
    ----------
    docs/surrogates.md, "How a surrogate is built".
    """
    even, odd = (pressures(slice(first, None, 2)) for first in (0, 1))
    off = np.abs(even - odd)
    apart = np.where(np.isfinite(off) & (off > NONE), off / np.maximum(even, odd), 0.0)
    chosen: list[int] = []
    for k in np.argsort(-apart):
        if len(chosen) == count or apart[k] == 0.0:
            break
        if not chosen or np.linalg.norm(points[chosen] - points[k], axis=1).min() > APART:
            chosen.append(int(k))
    return np.array(chosen, dtype=int)


def least_certain_cases(
    domain: Domain,
    case: Case,
    pressures: Callable[[slice, Setting], Float[np.ndarray, " m"]],
    count: int,
    candidates: int,
) -> Conditions:
    """Return the candidates of a domain at which two surrogates differ most.

    Parameters
    ----------
    domain : Domain
    case : Case
        Model and numerics of the solved cases.
    pressures : callable
        Returns P_ucr in Pa at m conditions by a surrogate that is fitted to a part of the solved
        cases, see `least_certain`.
    count : int
        Largest number of cases to return.
    candidates : int
        Number of candidates.
    """
    tried = domain.candidates(case, candidates)
    there = domain.setting(case, tried)
    chosen = np.zeros(len(tried.friction), dtype=bool)
    chosen[least_certain(lambda half: pressures(half, there), there.unit, count)] = True
    return tried.where(chosen)
