"""Checks of the data before a fit and of the fit after it; each refuses in one sentence."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from scipy.stats import f as f_distribution

from stonepass.array_types import Float
from stonepass.bench.fit_search import STARTS, Search
from stonepass.bench.least_squares import LEVEL
from stonepass.bench.objective import Data, Objective, at_an_end
from stonepass.caution import Caution, caution
from stonepass.errors import BadInput, require
from stonepass.materials.constants import shown_constant

__all__ = ["check_enough", "check_fit", "check_told", "r_squared_of"]

INDISTINCT = 1e-6  # of singular values of the sensitivities, relative
SHARE = 0.3  # of a constant in what the data cannot tell, for it to be named


def check_enough(data: Data, free: Sequence[str]) -> None:
    """Refuse data that say nothing of any law."""
    points, observed = len(data.observed), data.observed
    require(len(free) > 0, "constants", "all given", "some to be fitted")
    require(points > len(free), "data", f"{points} points", f"more than the {len(free)} constants",
            "add points, or give constants with --fix NAME=VALUE")  # fmt: skip
    require(float(np.abs(observed).max()) > 0.0, "data", "zero throughout", "measured under load")
    require(float(np.ptp(data.abscissa)) > 1e-6, "data", f"at {data.abscissa[0]:.4g} times the "
            "size at rest in every row", "measured at two stretches or more")  # fmt: skip
    require(float(np.ptp(observed)) > 1e-9 * float(np.abs(observed).max()), data.measured,
            f"{observed[0] / 1e3:.4g} kPa in every row", "one that changes with the stretch"
            )  # fmt: skip


def check_told(objective: Objective, search: Search) -> None:
    """Refuse constants whose changes cancel wherever the search begins: no data of this kind tell.

    The sensitivities are to relative changes; columns without any are those of constants that do
    nothing.
    """
    smallest: Float[np.ndarray, " free"] | None = None
    for start in STARTS:
        values = search.parameters(start).valuesdict()
        slopes = objective.sensitivities(values, search.free)
        _, sizes, directions = np.linalg.svd(slopes, full_matrices=False)
        blind = directions[sizes <= INDISTINCT * sizes[0]]
        if not len(blind):
            return
        smallest = np.abs(blind).max(axis=0)
    assert smallest is not None
    _refuse_blind([n for n, part in zip(search.free, smallest, strict=True) if part > SHARE])


def check_fit(objective: Objective, search: Search, result: Any) -> list[Caution]:
    """Refuse a fit that is none; say where a constant is zero, or another end of its own range."""
    law, data, told = search.law, objective.data, []
    values = {each: float(value) for each, value in result.params.valuesdict().items()}
    predicted = objective.predicted(values)
    law_of = f"fit of law '{law}'"
    remedy = "check signs, units and sizes at rest, or fit another law"
    if not np.all(np.isfinite(predicted)):
        raise BadInput(law_of, "without a prediction for some of the data",
                       "one that meets all of them", "fit another law")  # fmt: skip
    r_squared = r_squared_of(predicted - data.observed, data.observed)
    if r_squared < 0.0:
        raise BadInput(law_of, f"worse than a constant, R² = {r_squared:.3g}",
                       "better than one", remedy)  # fmt: skip
    for name in search.free:
        each = search.declared[name]
        end = at_an_end(result.params[name], each, search.modulus)
        if not end:
            continue
        shown = shown_constant(values[name], each)
        limit = each.low if end == "lower" else each.high
        own = each.low_allowed if end == "lower" else each.high_allowed
        if own and each.positive and abs(limit - values[name]) < 1e-2 * max(abs(limit), 1.0):
            told.append(caution("constant_at_bound", name=name, value=shown))
            continue
        raise BadInput(f"constant {name} of the {law_of}", f"{shown}, the {end} end of the search",
                       "one that the data bound", f"give it, --fix {name}=VALUE, or fit another "
                       "law, which these data obey")  # fmt: skip
    off = objective.off(values)
    level = predicted / objective.spread
    count = len(search.free)
    explained = float(level @ level) / count
    noise = float(off @ off) / (len(off) - count)
    if explained < noise * float(f_distribution.ppf(LEVEL, count, len(off) - count)):
        raise BadInput(law_of, f"no better than chance, R² = {r_squared:.3g}",
                       "clearer than the scatter of the data", remedy)  # fmt: skip
    named = {dict(each.values)["name"] for each in told}
    inside = [each for each in search.free if each not in named]
    _, sizes, directions = np.linalg.svd(objective.sensitivities(values, inside),
                                         full_matrices=False)  # fmt: skip
    blind = directions[sizes <= INDISTINCT * sizes[0]]
    if len(blind):
        _refuse_blind([n for n, part in zip(inside, np.abs(blind).max(axis=0), strict=True)
                       if part > SHARE])  # fmt: skip
    return told


def _refuse_blind(named: Sequence[str]) -> None:
    raise BadInput(
        "data",
        f"blind to {' and '.join(named)}",
        "such that every constant changes what is predicted",
        f"give one of them, e.g. --fix {named[-1]}=VALUE, or another test",
    )


def r_squared_of(off: Float[np.ndarray, " n"], observed: Float[np.ndarray, " n"]) -> float:
    """1 − Σ off²/Σ (observed − mean)²; negative where a constant would be nearer."""
    return 1.0 - float(np.sum(off**2) / np.sum((observed - observed.mean()) ** 2))
