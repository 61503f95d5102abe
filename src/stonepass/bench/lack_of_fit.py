"""Do the data obey the law, but for noise: what the residuals tell of mistakes and of the law.

A mistake shifts the residuals in a direction that is known beforehand: an offset by the same amount
everywhere, a wrong size at rest in proportion to the slope of the curve, hysteresis by opposite
amounts when loading and unloading, an outlier at one point. A direction is added to the
sensitivities of the fitted constants, linearised at the best fit, and the F test says whether the
residuals shrink by more than noise would let them. Errors are taken as Gaussian and independent,
with one unknown variance. The mistake that leaves least by Schwarz's criterion is taken in and the
rest asked again, so that one outlier is not told as an offset too. Theory: docs, *From the bench*.
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

__all__ = ["lack_of_fit"]

FALSE_ALARM = 0.02  # chance of any caution where the law and the noise are as assumed
NEGLIGIBLE = 1e-4  # of the largest observation: residuals below it are rounding
FEWEST_FREE = 3  # degrees of freedom that a test leaves
LARGEST_EXPLAINED = 4  # mistakes taken in one after the other
FEWEST_OF_BRANCH = 3  # points
ALIKE = 6.0  # difference of Schwarz's criterion below which two mistakes explain equally well
SMALL_PART = 1e-4  # of a size at rest, for a difference
SLACK = (1.01, 1.02, 1.03, 1.04, 1.05, 1.07, 1.1, 1.14, 1.2)  # stretches up to which strips hang
FEWEST_OF_TOE = 2  # points without load
INDISTINCT = 1e-3  # part of a direction that is not a change of the constants already


_Amounts: TypeAlias = Float[np.ndarray, " k"]
_Shift: TypeAlias = Float[np.ndarray, " n"]


@dataclass(frozen=True, eq=False)
class _Mistake:
    """A direction, or several, in which a mistake shifts the residuals.

    `told` makes the caution from the amounts of the directions, the part of the residuals that they
    explain beside the constants, and the chance of the test.
    """

    code: str
    directions: Float[np.ndarray, "n k"]
    told: Callable[[_Amounts, _Shift, float], Caution]
    tried: int = 1  # alike directions, of which this is the one that was looked for


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
    """Return what the residuals say against the data or the law.

    Parameters
    ----------
    data : Data
    law : Law
        As fitted.
    off : array (n)
        Predicted less observed over `spread`.
    sensitivities : array (n, p)
        Change of `off` with each fitted constant.
    spread : array (n)
        Expected errors in Pa up to a factor.

    Returns
    -------
    list of Caution
        Empty where residuals are as noise would have them, or smaller than rounding.
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
    """Orthonormal basis of the directions already known."""
    scaled = known / np.maximum(np.linalg.norm(known, axis=0), np.finfo(float).tiny)
    left, sizes, _ = np.linalg.svd(scaled, full_matrices=False)
    return left[:, sizes > 1e-10 * sizes[0]]


def _verdict(
    off: Float[np.ndarray, " n"], basis: Float[np.ndarray, "n r"], mistake: _Mistake, level: float
) -> _Verdict | None:
    """F test of the directions of a mistake beside those already known; None where it passes."""
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
    criterion = count * np.log(after / count) + rank * np.log(count)
    return _Verdict(mistake, chance, criterion, found / sizes, new @ found)


def _mistakes(
    data: Data,
    law: Any,
    spread: Float[np.ndarray, " n"],
) -> list[_Mistake]:
    predicted = data.predicted(law)
    found = [_offset(spread), *_sizes(data, law, spread)]
    found += _of_branches(branches(data), predicted, spread)
    return [*found, _shape(data, predicted, spread)]


def _offset(spread: Float[np.ndarray, " n"]) -> _Mistake:
    def told(amounts: _Amounts, shift: _Shift, chance: float) -> Caution:
        # Predicted less observed is −offset.
        return caution("zero_offset", offset_kPa=-float(amounts[0]) / 1e3, chance=chance)

    return _Mistake("zero_offset", (1.0 / spread)[:, None], told)


def _sizes(data: Data, law: Any, spread: Float[np.ndarray, " n"]) -> list[_Mistake]:
    found = []
    for code, changed in data.mistaken.items():
        sides = [changed(sign * SMALL_PART).predicted(law) for sign in (1.0, -1.0)]
        slope = (sides[0] - sides[1]) / (2.0 * SMALL_PART) / spread
        if not np.all(np.isfinite(slope)):
            continue

        def told(amounts: _Amounts, shift: _Shift, chance: float, code: str = code) -> Caution:
            # Predicted less observed falls by the slope times what is missing from each size.
            return caution(code, part=-float(amounts[0]), chance=chance)

        found.append(_Mistake(code, slope[:, None], told))
    return found + _slack(data, law, spread)


def _slack(data: Data, law: Any, spread: Float[np.ndarray, " n"]) -> list[_Mistake]:
    """Strips that hang loose up to a stretch: several of them, of which the best counts."""
    found, predicted = [], data.predicted(law)
    for stretch in SLACK:
        taut = data.taut_from(stretch)
        if taut is None or np.sum(taut.abscissa == 1.0) < FEWEST_OF_TOE:
            continue
        shift = (taut.predicted(law) - predicted) / spread

        def told(amounts: _Amounts, shift: _Shift, chance: float, x: float = stretch) -> Caution:
            return caution("slack", stretch=x, chance=chance)

        if np.all(np.isfinite(shift)):
            found.append(_Mistake("slack", shift[:, None], told, tried=len(SLACK)))
    return found


def _of_branches(
    found: Branches, predicted: Float[np.ndarray, " n"], spread: Float[np.ndarray, " n"]
) -> list[_Mistake]:
    """Loading apart from unloading, and one run apart from another."""
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
    """The law times a curve of second order over the abscissa: any smooth law near this one."""
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
    """The point whose residual is largest beside what noise leaves of it after the fit."""
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
    """Whether neighbours along the curve have residuals that are alike.

    The statistic is that of Durbin and Watson 1950, Biometrika 37, 409–428, d = Σ (e_k+1 − e_k)²/
    Σ e_k², with their approximation of d/4 by a beta distribution of its exact mean and variance.
    """
    names = list(dict.fromkeys(data.groups))
    group = np.array([names.index(each) for each in data.groups])
    order = np.lexsort((data.abscissa, group))
    basis = known[order]
    free = len(off) - basis.shape[1]
    left = off[order] - basis @ (basis.T @ off[order])
    if free < FEWEST_FREE or not float(left @ left) > 0.0:
        return []
    # A = DᵀD for the differences D between neighbours of a curve, applied to columns; M is 1 less
    # the known directions. tr MA and tr MAMA follow from tr A, tr A² and the basis alone.
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
