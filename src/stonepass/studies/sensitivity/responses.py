"""The responses whose sensitivity is computed, none of which is NaN where a case has no answer.

The critical pressure exists in a part of the cases only. Its rank also uses lower bounds, and the
two yes-or-no responses are numbers in (almost) every case.
"""

from __future__ import annotations

import numpy as np

from stonepass.errors import Outcome
from stonepass.studies.sensitivity.estimate import Response
from stonepass.studies.sensitivity.evaluator import OUTCOMES, OUTSIDE, Evaluations
from stonepass.studies.sensitivity_indices import rank_among

__all__ = ["ANSWERED", "MOVES", "PRESSURE", "RANK", "responses"]

PRESSURE = Response("pressure", "the critical pressure", "kPa")
RANK = Response("rank", "the rank of the critical pressure")
MOVES = Response("moves", "the outcome that the stone moves within the pressure limit", "", True)
ANSWERED = Response("answered", "the outcome that a critical pressure exists", "", True)


def responses(
    found: Evaluations, limit: float | None
) -> tuple[tuple[Response, np.ma.MaskedArray], ...]:
    """Return the responses of n evaluated cases.

    Parameters
    ----------
    found : Evaluations
        Outcomes, critical pressures and lower bounds.
    limit : float or None
        Pressure limit in Pa; None leaves out the response `MOVES`.

    Returns
    -------
    tuple of (Response, masked array (n))
        `PRESSURE` in kPa is masked where there is no critical pressure. `RANK`, 0 to 1, is the
        fraction of cases with a smaller value; a lower bound stands for a critical pressure that
        does not exist, and the rank is masked where no bound is known. `MOVES` is 1 if the critical
        pressure is at most the limit; it is 0 if the critical pressure or its lower bound is above
        the limit, or if urine passes the stone first; else it is masked. `ANSWERED` is 1 if a
        critical pressure exists and 0 if not; it is masked outside the range of a surrogate or of a
        sweep, where neither is known.

    References
    ----------
    docs/howto/sensitivity.md, "Cases without an answer".
    """
    pressure = np.ma.MaskedArray(found.value / 1e3)
    all_of_them = [(PRESSURE, pressure), (RANK, _rank(found))]
    if limit is not None:
        all_of_them.append((MOVES, _moves(found, limit)))
    known = (~np.ma.getmaskarray(found.value)).astype(float)
    return (*all_of_them, (ANSWERED, np.ma.MaskedArray(known, found.outcome == OUTSIDE)))


def _rank(found: Evaluations) -> np.ma.MaskedArray:
    missing = np.ma.getmaskarray(found.value)
    values = np.where(missing, found.lower_bound.filled(0.0), found.value.filled(0.0))
    unknown = missing & np.ma.getmaskarray(found.lower_bound)
    ordered = np.sort(values[~unknown])
    if not len(ordered):
        return np.ma.MaskedArray(values, True)
    return np.ma.MaskedArray(rank_among(ordered, values), unknown)


def _moves(found: Evaluations, limit: float) -> np.ma.MaskedArray:
    known = ~np.ma.getmaskarray(found.value)
    bounded = ~np.ma.getmaskarray(found.lower_bound)
    moves = known & (found.value.filled(np.inf) <= limit)
    leaks = found.outcome == OUTCOMES.index(Outcome.LEAKS)
    held = leaks | (bounded & (found.lower_bound.filled(0.0) > limit))
    return np.ma.MaskedArray(moves.astype(float), ~(known | held))
