"""Checks of the data before a fit, and of the fitted constants after it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.stats import f as f_distribution

from stonepass.array_types import Float
from stonepass.bench.fit_search import Search
from stonepass.bench.least_squares import LEVEL
from stonepass.bench.objective import Data, Objective, at_an_end
from stonepass.caution import Caution, caution
from stonepass.errors import BadInput, require
from stonepass.materials.constants import constants_of, shown_constant

__all__ = ["check_enough", "check_fit", "check_told", "r_squared_of"]

# A singular value of the sensitivity matrix below this fraction of the largest one counts as zero.
INDISTINCT = 1e-6
# A constant is named if its component in an unidentified direction (a unit vector) exceeds this, or
# if its effect on the predictions along that direction exceeds this fraction of the largest effect.
SHARE = 0.3
# Largest standard error of a combination of relative changes of the constants; a fit with a larger
# one is refused.
VAGUE = 30.0
SAME = 1e-3  # relative difference of two coefficients that are equal


def check_enough(data: Data, free: Sequence[str]) -> None:
    """Refuse data that cannot determine the constants of any law.

    Parameters
    ----------
    data : Data
        Measured stresses or pressures.
    free : sequence of str
        Names of the constants to be fitted.

    Raises
    ------
    BadInput
        No constant is to be fitted, there are no more points than constants, or all points have
        the same stretch or the same load.
    """
    points, observed = len(data.observed), data.observed
    require(len(free) > 0, "number of constants to be fitted", 0, "at least 1",
            "leave out one of the given constants")  # fmt: skip
    require(points > len(free), "number of data points", points, f"more than {len(free)}, the "
            "number of constants to be fitted", "add points, or give constants with --fix "
            "NAME=VALUE")  # fmt: skip
    require(float(np.abs(observed).max()) > 0.0, data.measured, "0 kPa in every row",
            "different from 0 in some rows")  # fmt: skip
    require(float(np.ptp(data.abscissa)) > 1e-6, "stretch", f"{data.abscissa[0]:.4g} in every row",
            "different in at least two rows")  # fmt: skip
    require(float(np.ptp(observed)) > 1e-9 * float(np.abs(observed).max()), data.measured,
            f"{observed[0] / 1e3:.4g} kPa in every row", "different in at least two rows"
            )  # fmt: skip


def check_told(objective: Objective, search: Search, starts: Sequence[Any]) -> None:
    """Refuse constants that this kind of test cannot identify, whatever their values are.

    The constants cannot be identified separately if some combination of relative changes of them
    leaves every prediction unchanged. The constants are refused only if such a combination exists
    at every starting point of the search, since at a single point it may be a coincidence.

    Parameters
    ----------
    objective : Objective
        Data and law.
    search : Search
        The constants to be fitted.
    starts : sequence of lmfit.Parameters
        The starting points, see `Search.starts`.

    Raises
    ------
    BadInput
        The message names the constants that are not identified.

    References
    ----------
    docs/bench.md, "Identifiability".
    """
    told: list[_Blind] = []
    for start in starts:
        values = start.valuesdict()
        slopes = objective.sensitivities(values, search.free)
        found = _blind(objective, slopes, values, search.free)
        if found is None:
            return
        told.append(found)
    sums = {each.determined for each in told}
    _refuse_blind(_Blind(told[-1].names, sums.pop() if len(sums) == 1 else ""))


@dataclass(frozen=True)
class _Blind:
    """Constants that the data do not identify, and the sum that they do, if there is one."""

    names: list[str]
    determined: str


def _blind(
    objective: Objective,
    slopes: Float[np.ndarray, "n free"],
    values: Mapping[str, float],
    free: Sequence[str],
) -> _Blind | None:
    """Return the constants whose changes can leave every prediction unchanged; None without one."""
    _, sizes, directions = np.linalg.svd(slopes, full_matrices=False)
    blind = np.abs(directions[sizes <= INDISTINCT * sizes[0]])
    if not len(blind):
        return None
    effects = blind * np.linalg.norm(slopes, axis=0)
    largest = np.maximum(effects.max(axis=1, keepdims=True), INDISTINCT * sizes[0])
    part = ((blind > SHARE) | (effects > SHARE * largest)).any(axis=0)
    named = [k for k in range(len(free)) if part[k]]
    names = [free[k] for k in named]
    units = {each.unit for each in constants_of(objective.law) if each.name in names}
    if len(named) != 2 or units != {"Pa"} or effects.max() <= INDISTINCT * sizes[0]:
        return _Blind(names, "")
    # Stresses are linear in the moduli, so that two moduli with parallel slopes act as a sum.
    magnitudes = np.array(objective.magnitudes(values, free))[named]
    first, second = (slopes[:, named] / magnitudes).T
    ratio = float(second @ first / (first @ first))
    weight = "" if abs(ratio - 1.0) < SAME else f"{abs(ratio):.3g} "
    sign = "+" if ratio > 0.0 else "-"
    return _Blind(names, f"{names[0]} {sign} {weight}{names[1]}")


def check_fit(objective: Objective, search: Search, result: Any) -> list[Caution]:
    """Refuse a fit that describes the data no better than chance or ends at a search bound.

    Parameters
    ----------
    objective : Objective
        Data, law and expected errors of the fit.
    search : Search
        The fitted constants and their search bounds.
    result : lmfit.minimizer.MinimizerResult
        Result of the least-squares fit.

    Returns
    -------
    list of Caution
        A caution for each constant that lies at a physical bound of its own, such as zero.

    Raises
    ------
    BadInput
        The law predicts no stress for some of the data, R² is negative, a constant lies at a bound
        of the search, the F test shows no improvement over a law without stress, the data do not
        identify some constants separately, or hardly so.

    References
    ----------
    docs/bench.md, "The fit".
    """
    law, data, told = search.law, objective.data, []
    values = {each: float(value) for each, value in result.params.valuesdict().items()}
    predicted = objective.predicted(values)
    law_of = f"fit of law '{law}'"
    remedy = "check signs, units and sizes at rest, or fit another law"
    if not np.all(np.isfinite(predicted)):
        raise BadInput(f"prediction of law '{law}'", "undefined for some of the data",
                       "defined for all of them", "fit another law")  # fmt: skip
    r_squared = r_squared_of(predicted - data.observed, data.observed)
    if r_squared < 0.0:
        raise BadInput(law_of, f"worse than a constant, R² = {r_squared:.3g}",
                       "better than a constant, R² above 0", remedy)  # fmt: skip
    for name in search.free:
        each = search.declared[name]
        end = at_an_end(result.params[name], each, search.modulus)
        if not end:
            continue
        shown = shown_constant(values[name], each)
        limit = each.low if end == "lower" else each.high
        own = each.low_allowed if end == "lower" else each.high_allowed
        bound = result.params[name].min if end == "lower" else result.params[name].max
        if own and each.positive and bound == limit:
            told.append(caution("constant_at_bound", name=name, value=shown))
            continue
        raise BadInput(f"constant {name} of the {law_of}", f"{shown}, the {end} bound of the "
                       "search", "within the bounds of the search", f"give it with --fix "
                       f"{name}=VALUE, or fit another law")  # fmt: skip
    off = objective.off(values)
    level = predicted / objective.spread
    count = len(search.free)
    explained = float(level @ level) / count
    noise = float(off @ off) / (len(off) - count)
    if explained < noise * float(f_distribution.ppf(LEVEL, count, len(off) - count)):
        raise BadInput(law_of, f"no better than chance, R² = {r_squared:.3g}",
                       "significant compared with the scatter of the data (F test, 5 %)",
                       remedy)  # fmt: skip
    named = {dict(each.values)["name"] for each in told}
    inside = [each for each in search.free if each not in named]
    if not inside:
        return told
    slopes = objective.sensitivities(values, inside)
    blind = _blind(objective, slopes, values, inside)
    if blind is not None:
        _refuse_blind(blind)
    _refuse_vague(slopes, off, inside, endless=result.aborted)
    return told


def _refuse_vague(
    slopes: Float[np.ndarray, "n free"],
    off: Float[np.ndarray, " n"],
    free: Sequence[str],
    *,
    endless: bool,
) -> None:
    """Refuse constants of which the data determine hardly more than a combination.

    In some direction of relative changes, the standard error exceeds `VAGUE`, or the search has no
    end.
    """
    _, sizes, directions = np.linalg.svd(slopes, full_matrices=False)
    noise = float(np.sqrt(off @ off / (len(off) - len(free))))
    if noise <= VAGUE * sizes[-1] and not endless:
        return
    names = [name for name, part in zip(free, directions[-1], strict=True) if abs(part) > SHARE]
    raise BadInput(
        f"effect of {' and '.join(names)} on the predictions",
        "hardly separable",
        "distinct for each fitted constant",
        f"fix one of them, e.g. --fix {names[-1]}=VALUE, or use another kind of test",
    )


def _refuse_blind(blind: _Blind) -> None:
    names, total = blind.names, blind.determined
    determined = f"the data determine only {total}, so " if total else ""
    raise BadInput(
        f"effect of {' and '.join(names)} on the predictions",
        "not separable" if len(names) > 1 else "zero",
        "distinct for each fitted constant",
        f"{determined}fix one of them, e.g. --fix {names[-1]}=VALUE, or use another kind of test",
    )


def r_squared_of(off: Float[np.ndarray, " n"], observed: Float[np.ndarray, " n"]) -> float:
    """Compute the coefficient of determination R² = 1 − Σ off²/Σ (observed − mean)².

    It is negative if the mean of the data describes them better than the law does.

    Parameters
    ----------
    off : array (n)
        Predicted minus observed values in Pa.
    observed : array (n)
        Observed values in Pa, not all equal.
    """
    return 1.0 - float(np.sum(off**2) / np.sum((observed - observed.mean()) ** 2))
