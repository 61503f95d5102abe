"""Tests of the residuals of a fitted law for measuring mistakes and for a wrong law.

Each kind of mistake changes the n residuals along a vector that is known beforehand. A zero offset
changes all of them by the same amount, a wrong size at rest in proportion to the slope of the
curve, hysteresis with opposite signs in loading and unloading, and an outlier changes one residual.
The vector is appended to the sensitivities of the fitted constants at the best fit. An F test then
shows whether the sum of squares decreases by more than independent Gaussian errors of one unknown
variance explain.

The mistake with the smallest Schwarz criterion (BIC) is accepted, its vector is kept, and the
other mistakes are tested again. In this way one outlier is not reported as an offset as well. The
method is described in docs/bench.md, "Lack of fit".
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from scipy.special import betainc, fdtrc

from stonepass.array_types import Float
from stonepass.bench.branches import Branches, branches
from stonepass.bench.objective import Data
from stonepass.caution import Caution, caution

__all__ = ["NEGLIGIBLE", "lack_of_fit"]

# Probability of at least one caution if the law and the assumptions about the errors are right.
FALSE_ALARM = 0.02
# Residuals below this fraction of the largest observed value are attributed to rounding.
NEGLIGIBLE = 1e-4
FEWEST_FREE = 3  # smallest number of degrees of freedom of the residuals in a test
LARGEST_EXPLAINED = 4  # largest number of mistakes that are accepted one after the other
FEWEST_OF_BRANCH = 3  # smallest number of points of a branch or run
ALIKE = 6.0  # difference of Schwarz's criterion below which two mistakes explain equally well
SMALL_PART = 1e-4  # relative change of a size at rest, for a difference quotient
# Stretches up to which a strip may be slack; each is tried.
SLACK = (1.01, 1.02, 1.03, 1.04, 1.05, 1.07, 1.1, 1.14, 1.2)
# Smallest and largest relative change of a size at rest that is named. A smaller one would be shown
# as zero; a larger one has no meaning, since the residuals are linearised.
SIZE_CHANGE = (5e-5, 0.3)
FEWEST_OF_TOE = 2  # smallest number of points on the slack part of the curve
# A slack strip carries at most this part of the load that the law predicts for a taut one.
LOADED_TOE = 0.5
# A mistake is not tested if the part of its unit vector that is perpendicular to all known vectors
# is shorter than this.
INDISTINCT = 1e-3


_Amounts: TypeAlias = Float[np.ndarray, " k"]
_Shift: TypeAlias = Float[np.ndarray, " n"]


@dataclass(frozen=True, eq=False)
class _Mistake:
    """A kind of mistake and the k vectors along which it changes the residuals.

    The function `told` returns the caution. It has three arguments: the coefficients of the k
    vectors; the part of the residuals that these vectors explain and the fitted constants do not;
    and the p-value of the test.
    """

    code: str
    directions: Float[np.ndarray, "n k"]
    told: Callable[[_Amounts, _Shift, float], Caution]
    tried: int = 1  # number of similar vectors that were tried, for the Bonferroni correction
    # Bounds of the magnitude of the first coefficient; beyond them the mistake is impossible.
    bounds: tuple[float, float] = (0.0, np.inf)


@dataclass(frozen=True, eq=False)
class _Verdict:
    mistake: _Mistake
    chance: float
    criterion: float
    amounts: Float[np.ndarray, " k"]
    explained: Float[np.ndarray, " n"]

    @property
    def caution(self) -> Caution:
        return self.mistake.told(self.amounts, self.explained, self.chance)


def lack_of_fit(
    data: Data,
    law: Any,
    off: Float[np.ndarray, " n"],
    sensitivities: Float[np.ndarray, "n p"],
    spread: Float[np.ndarray, " n"],
) -> list[Caution]:
    """Return a caution for each mistake, or for a wrong law, that the residuals indicate.

    Parameters
    ----------
    data : Data
        Measured stresses or pressures.
    law : Law
        The law with its fitted constants.
    off : array (n)
        Residuals: predicted minus observed values, divided by `spread`; dimensionless.
    sensitivities : array (n, p)
        Derivatives of `off` with respect to the p fitted constants.
    spread : array (n)
        Expected errors in Pa, known up to a common factor.

    Returns
    -------
    list of Caution
        The list is empty if the assumed errors, or rounding, explain the residuals. If the law and
        the assumptions about the errors are right, it is empty with a probability of 98 %.

    References
    ----------
    docs/bench.md, "Lack of fit".
    """
    scale = float(np.abs(data.observed).max())
    if np.sqrt(np.mean((off * spread) ** 2)) < NEGLIGIBLE * scale:
        return []
    mistakes = _mistakes(data, law, spread)
    level = FALSE_ALARM / (len({each.code for each in mistakes}) + 2)
    known, told = sensitivities, []
    for _ in range(LARGEST_EXPLAINED):
        basis = _basis(known)
        tried = [*mistakes, _worst_point(data, off, basis, spread)]
        verdicts = [v for each in tried if (v := _verdict(off, basis, each, level)) is not None]
        if not verdicts:
            break
        verdicts.sort(key=lambda each: each.criterion)
        best, by_code = verdicts[0], {v.mistake.code: v for v in reversed(verdicts)}
        equal = [
            v for code, v in by_code.items()
            if v.criterion < best.criterion + ALIKE and v is not best
            and code not in ("outlier", "lack_of_fit")
        ]  # fmt: skip
        told += [each.caution for each in (best, *equal)]
        known = np.column_stack([known, best.mistake.directions])
        gone = {best.mistake.code, *(v.mistake.code for v in equal)}
        mistakes = [each for each in mistakes if each.code not in gone]
    told += _correlated(off, _basis(known), data, level)
    return list(dict.fromkeys(told))


def _basis(known: Float[np.ndarray, "n p"]) -> Float[np.ndarray, "n r"]:
    """Return an orthonormal basis of the known vectors."""
    scaled = known / np.maximum(np.linalg.norm(known, axis=0), np.finfo(float).tiny)
    left, sizes, _ = np.linalg.svd(scaled, full_matrices=False)
    return left[:, sizes > 1e-10 * sizes[0]]


def _verdict(
    off: Float[np.ndarray, " n"], basis: Float[np.ndarray, "n r"], mistake: _Mistake, level: float
) -> _Verdict | None:
    """Test whether the vectors of a mistake reduce the residuals significantly (F test).

    The basis spans the vectors that are accepted already. None is returned if the reduction is not
    significant at `level` or the test is impossible.
    """
    count = len(off)
    sizes = np.maximum(np.linalg.norm(mistake.directions, axis=0), np.finfo(float).tiny)
    scaled = mistake.directions / sizes
    new, rest = scaled - basis @ (basis.T @ scaled), off - basis @ (basis.T @ off)
    if np.linalg.norm(new) < INDISTINCT:
        return None
    found, _, rank, _ = np.linalg.lstsq(new, rest, rcond=INDISTINCT)
    left = rest - new @ found
    free = count - basis.shape[1] - int(rank)
    if free < FEWEST_FREE:
        return None
    before, after = float(rest @ rest), max(float(left @ left), np.finfo(float).tiny)
    ratio = (before - after) / rank / (after / free)
    chance = min(float(fdtrc(rank, free, ratio)) * mistake.tried, 1.0)
    if not chance < level:
        return None
    amounts = found / sizes
    if not mistake.bounds[0] <= abs(float(amounts[0])) <= mistake.bounds[1]:
        return None
    criterion = count * np.log(after / count) + rank * np.log(count)
    return _Verdict(mistake, chance, criterion, amounts, new @ found)


def _mistakes(
    data: Data,
    law: Any,
    spread: Float[np.ndarray, " n"],
) -> list[_Mistake]:
    predicted = data.predicted(law)
    found = [_offset(data, spread), *_sizes(data, law, spread)]
    found += _of_branches(branches(data), predicted, spread)
    return [*found, _shape(data, predicted, spread)]


def _offset(data: Data, spread: Float[np.ndarray, " n"]) -> _Mistake:
    def told(amounts: _Amounts, shift: _Shift, chance: float) -> Caution:
        # Predicted minus observed is −offset.
        return caution("zero_offset", offset_kPa=-float(amounts[0]) / 1e3, chance=chance)

    largest = float(np.abs(data.observed).max())
    return _Mistake("zero_offset", (1.0 / spread)[:, None], told, bounds=(0.0, largest))


def _sizes(data: Data, law: Any, spread: Float[np.ndarray, " n"]) -> list[_Mistake]:
    found = []
    for code, changed in data.mistaken.items():
        sides = [changed(sign * SMALL_PART).predicted(law) for sign in (1.0, -1.0)]
        slope = (sides[0] - sides[1]) / (2.0 * SMALL_PART) / spread
        if not np.all(np.isfinite(slope)):
            continue

        def told(amounts: _Amounts, shift: _Shift, chance: float, code: str = code) -> Caution:
            # If every size is too small by a fraction, predicted minus observed is too small by the
            # slope times that fraction.
            return caution(code, part=-float(amounts[0]), chance=chance)

        found.append(_Mistake(code, slope[:, None], told, bounds=SIZE_CHANGE))
    return found + _slack(data, law, spread)


def _slack(data: Data, law: Any, spread: Float[np.ndarray, " n"]) -> list[_Mistake]:
    """Return a mistake for each stretch up to which the strips may have been slack."""
    found, predicted = [], data.predicted(law)
    for stretch in SLACK:
        taut = data.taut_from(stretch)
        if taut is None:
            continue
        slack = taut.abscissa == 1.0
        toe = slack & (data.abscissa > 1.0)
        loads = [float(np.abs(each[toe]).sum()) for each in (data.observed, predicted)]
        if slack.sum() < FEWEST_OF_TOE or not toe.any() or loads[0] > LOADED_TOE * loads[1]:
            continue  # too few points, or the strip carries a load there
        shift = (taut.predicted(law) - predicted) / spread

        def told(amounts: _Amounts, shift: _Shift, chance: float, x: float = stretch) -> Caution:
            return caution("slack", stretch=x, chance=chance)

        if np.all(np.isfinite(shift)):
            found.append(_Mistake("slack", shift[:, None], told, tried=len(SLACK)))
    return found


def _of_branches(
    found: Branches, predicted: Float[np.ndarray, " n"], spread: Float[np.ndarray, " n"]
) -> list[_Mistake]:
    """Return the mistakes hysteresis and differing runs, if the data have the branches for them."""
    mistakes, level = [], predicted / spread
    if min(np.sum(found.loading > 0), np.sum(found.loading < 0)) >= FEWEST_OF_BRANCH:
        width = np.abs(predicted).max() / spread * found.width
        both = np.column_stack([found.loading * level, found.loading * width])

        def hysteresis(amounts: _Amounts, shift: _Shift, chance: float) -> Caution:
            gap = both @ amounts * spread
            share = 2.0 * float(np.abs(gap).max() / np.abs(predicted).max())
            return caution("hysteresis", share=share, chance=chance)

        mistakes.append(_Mistake("hysteresis", both, hysteresis))
    runs = [k for k in np.unique(found.run) if np.sum(found.run == k) >= FEWEST_OF_BRANCH]
    if 2 <= len(runs) <= max(2, len(predicted) // 4):
        apart = np.column_stack([(found.run == k) * level for k in runs[1:]])

        def differ(amounts: _Amounts, shift: _Shift, chance: float) -> Caution:
            share = float(np.ptp(np.append(amounts, 0.0)))
            return caution("runs_differ", runs=len(runs), share=share, chance=chance)

        mistakes.append(_Mistake("runs_differ", apart, differ))
    return mistakes


def _shape(
    data: Data, predicted: Float[np.ndarray, " n"], spread: Float[np.ndarray, " n"]
) -> _Mistake:
    """Return the mistake of a wrong law: predictions multiplied by a parabola over the abscissa.

    The quotient of the predictions of two similar, smooth laws is approximately a parabola.
    """
    x = data.abscissa
    u = (2.0 * x - x.min() - x.max()) / np.ptp(x)
    columns = [predicted * u / spread, predicted * (1.5 * u * u - 0.5) / spread]
    names = list(dict.fromkeys(data.groups))
    if 1 < len(names) <= 3:
        columns += [predicted * (np.array(data.groups) == name) / spread for name in names[1:]]
    directions = np.column_stack(columns)

    def told(amounts: _Amounts, shift: _Shift, chance: float) -> Caution:
        return _misses(data, shift * spread)

    return _Mistake("lack_of_fit", directions, told)


def _misses(data: Data, misfit: Float[np.ndarray, " n"]) -> Caution:
    worst = int(np.argmax(np.abs(misfit)))
    return caution(
        "lack_of_fit",
        off_kPa=abs(float(misfit[worst])) / 1e3,
        share=abs(float(misfit[worst])) / float(np.abs(data.observed).max()),
        at=float(data.abscissa[worst]),
    )


def _worst_point(
    data: Data,
    off: Float[np.ndarray, " n"],
    basis: Float[np.ndarray, "n r"],
    spread: Float[np.ndarray, " n"],
) -> _Mistake:
    """Return the mistake of an outlier at the point with the largest standardised residual."""
    kept = 1.0 - np.sum(basis**2, axis=1)
    left = off - basis @ (basis.T @ off)
    sizes = np.where(kept > INDISTINCT, np.abs(left) / np.sqrt(np.maximum(kept, INDISTINCT)), 0.0)
    k = int(np.argmax(sizes))
    direction = np.zeros((len(off), 1))
    direction[k] = 1.0

    def told(amounts: _Amounts, shift: _Shift, chance: float) -> Caution:
        row = f"row {data.lines[k]}" if data.lines else f"point {k + 1}"
        off = -float(amounts[0]) * float(spread[k])
        return caution("outlier", row=row, observed_kPa=float(data.observed[k]) / 1e3,
                       off_kPa=off / 1e3, chance=chance)  # fmt: skip

    return _Mistake("outlier", direction, told, tried=len(off))


def _correlated(
    off: Float[np.ndarray, " n"], known: Float[np.ndarray, "n r"], data: Data, level: float
) -> list[Caution]:
    """Return a caution if the residuals of neighbouring points are positively correlated.

    The test is that of Durbin and Watson 1950, Biometrika 37, 409–428. Their statistic is
    d = Σ (e_k+1 − e_k)²/Σ e_k²; they approximate the distribution of d/4 by a beta distribution
    with the exact mean and variance.
    """
    names = list(dict.fromkeys(data.groups))
    group = np.array([names.index(each) for each in data.groups])
    order = np.lexsort((data.abscissa, group))
    basis = known[order]
    free = len(off) - basis.shape[1]
    left = off[order] - basis @ (basis.T @ off[order])
    if free < FEWEST_FREE or not float(left @ left) > 0.0:
        return []
    # D forms the differences of neighbours of a curve, A = DᵀD, and M = 1 − BBᵀ projects out the
    # basis B. The traces of MA and MAMA follow from tr A, tr A² and B without large matrices.
    same = (np.diff(group[order]) == 0).astype(float)
    differences = same[:, None] * np.diff(basis, axis=0)
    applied = np.zeros_like(basis)
    applied[1:] += differences
    applied[:-1] -= differences
    diagonal = np.append(same, 0.0) + np.append(0.0, same)
    inner = basis.T @ applied
    first = float(diagonal.sum() - np.trace(inner))
    second = float(
        np.sum(diagonal**2) + 2.0 * same.sum() - 2.0 * np.sum(applied**2) + np.sum(inner * inner)
    )
    mean = first / free / 4.0
    variance = 2.0 * (free * second - first**2) / (free**2 * (free + 2.0)) / 16.0
    total = mean * (1.0 - mean) / variance - 1.0
    found = float(np.sum(same * np.diff(left) ** 2) / (left @ left))
    chance = float(betainc(mean * total, (1.0 - mean) * total, min(found / 4.0, 1.0)))
    alike = 1.0 - found / (4.0 * mean)
    return [caution("residuals_correlated", alike=alike, chance=chance)] if chance < level else []
