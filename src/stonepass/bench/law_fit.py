"""Constants of a law from bench data: least squares, with intervals and what the data cannot tell.

The fit and the profile likelihood behind the intervals are lmfit's.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Protocol, runtime_checkable

import numpy as np
from scipy.stats import spearmanr

from stonepass.array_types import Float
from stonepass.bench.least_squares import correlations, intervals, lmfit
from stonepass.caution import Caution, caution
from stonepass.errors import BadInput, UnstableLaw, refuse_unknown, require
from stonepass.materials.constants import ConstantDeclaration, Unit
from stonepass.materials.known_laws import constants_by_name, known_law
from stonepass.materials.protocol import Law, Material
from stonepass.materials.stability import check

__all__ = ["Constant", "Data", "FittedLaw", "fit_law"]

STARTS = (0.1, 1.0, 5.0)  # of the numbers of a law, each tried
INDISTINCT = 1e-6  # of singular values of the sensitivities, relative
SMALLEST_SHARE = 0.01  # of the largest stress: below it an error is no longer proportional
FEWEST_OF_A_TREND = 8  # points
UNLIKELY = 0.01  # chance of so clear a trend where there is none
SHARE = 0.3  # of a constant in what the data cannot tell, for it to be named
NUMBER = (1e-6, 1e3)  # widest interval of a positive constant that is no modulus
ANY_SIGN = (-1e2, 1e2)  # widest interval of one that may be negative
SPAN = 1e6  # of moduli over the first guess
IMPOSSIBLE = 1e3  # times the data, where a law has no stress


@runtime_checkable
class Data(Protocol):
    """What was measured, and what a law predicts for it."""

    measured: str

    @property
    def observed(self) -> Float[np.ndarray, " n"]:
        """The measured quantity, in Pa."""

    @property
    def abscissa(self) -> Float[np.ndarray, " n"]:
        """The quantity on the horizontal axis of a drawing."""

    @property
    def groups(self) -> tuple[str, ...]:
        """Name of the curve that each point belongs to."""

    @property
    def strain_range(self) -> tuple[float, float]:
        """Smallest and largest stretch."""

    def predicted(self, law: Law) -> Float[np.ndarray, " n"]:
        """The measured quantity as a law predicts it, in Pa."""


@dataclass(frozen=True)
class Constant:
    """A constant of a law.

    `low` and `high` bound its 95 % interval; None where it was given, and one of them None where
    the data set no bound on that side. `unit` is that of the stored numbers.
    """

    name: str
    value: float
    unit: Unit
    low: float | None = None
    high: float | None = None
    given: bool = False


@dataclass(frozen=True)
class FittedLaw:
    """A law fitted to data.

    Attributes
    ----------
    material : Material
    constants : tuple of Constant
    data : Data
    predicted : array (n)
        In Pa.
    rmse : float
        Root mean square of the residuals in Pa.
    r_squared : float
        1 − Σ residual²/Σ (observed − mean)².
    correlations : dict
        Pairs of fitted constants and the correlation of their estimates.
    unstable : str
        Why the law describes no solid; empty where it does.
    warnings : tuple of Caution
    """

    material: Material
    constants: tuple[Constant, ...]
    data: Data
    predicted: Float[np.ndarray, " n"]
    rmse: float
    r_squared: float
    correlations: dict[tuple[str, str], float]
    unstable: str = ""
    warnings: tuple[Caution, ...] = ()

    @property
    def residuals(self) -> Float[np.ndarray, " n"]:
        """Predicted less observed in Pa."""
        return self.predicted - self.data.observed


def fit_law(
    data: Data,
    law: str,
    given: Mapping[str, float] | None = None,
    name: str = "fitted",
    *,
    relative: bool = False,
    free: Sequence[str] = (),
) -> FittedLaw:
    """Fit the constants of a law to data by least squares.

    Parameters
    ----------
    data : Data
        `bench.Tension` or `bench.Inflation`.
    law : str
        A name in `materials.known_laws.KNOWN_LAWS`.
    given : mapping, optional
        Constants that are not fitted, in SI units.
    name : str
        Name of the material.
    relative : bool
        Whether errors are proportional to what was measured, as a gauge's often are, instead of
        equally large everywhere. Intervals are right only for the one that is true.
    free : sequence of str
        Constants to be fitted that otherwise keep their default, as the second and third term of
        the Ogden law and the dispersion of fibres.

    Raises
    ------
    BadInput
        An unknown law or constant, fewer points than constants, or constants that the data cannot
        tell from one another, naming them.
    """
    fitting = lmfit()
    make, declared, fixed = known_law(law), constants_by_name(law), dict(given or {})
    for each in (*fixed, *free):
        if each not in declared:
            refuse_unknown(f"constant of law '{law}'", each, list(declared))
    for constant in declared.values():
        if constant.held and constant.default is not None and constant.name not in free:
            fixed.setdefault(constant.name, constant.default)
    free = [each for each in declared if each not in fixed]
    points = len(data.observed)
    require(len(free) > 0, "constants", "all given", "some to be fitted")
    require(points > len(free), "data", f"{points} points", f"more than the {len(free)} constants")
    scale = float(np.abs(data.observed).max())
    require(scale > 0.0, "data", "zero throughout", "measured under load")

    spread = np.full(points, scale)
    if relative:
        spread = np.maximum(np.abs(data.observed), SMALLEST_SHARE * scale)

    def residuals(parameters: Any) -> Float[np.ndarray, " n"]:
        """Predicted less observed over what is expected; far off where the law has no stress."""
        try:
            found = data.predicted(make(**parameters.valuesdict()))
        except BadInput:
            found = np.full(points, np.nan)
        off = (found - data.observed) / spread
        return np.where(np.isfinite(off), off, IMPOSSIBLE)

    best = None
    for start in STARTS:
        parameters = _parameters(fitting, declared, fixed, _modulus(data), start)
        minimizer = fitting.Minimizer(residuals, parameters)
        with np.errstate(all="ignore"):
            found = minimizer.minimize(method="least_squares")
        if best is None or found.chisqr < best[1].chisqr:
            best = (minimizer, found)
    assert best is not None
    minimizer, result = best
    values = {each: float(value) for each, value in result.params.valuesdict().items()}
    _check_told(residuals, result, free)
    bounds, warnings = intervals(minimizer, result, free)
    fitted = make(**values)
    predicted = data.predicted(fitted)
    off = predicted - data.observed
    warnings += _growing(off, data.observed, relative)
    low, high = data.strain_range
    material = Material(
        name=name,
        law=fitted,
        source=f"fitted to {points} points of {data.measured}",
        test=data.measured,
        verified="fitted, not verified",
        strain_range=(min(1.0, low), min(max(high, 1.0 + 1e-3), 3.0)),
    )
    try:
        check(material)
        unstable = ""
    except UnstableLaw as problem:
        unstable = problem.allowed
    return FittedLaw(
        material=material,
        constants=tuple(
            Constant(each, values[each], declared[each].unit, *bounds.get(each, (None, None)),
                     given=each in fixed)
            for each in declared
        ),
        data=data,
        predicted=predicted,
        rmse=float(np.sqrt(np.mean(off**2))),
        r_squared=1.0 - float(np.sum(off**2) / np.sum((data.observed - data.observed.mean()) ** 2)),
        correlations=correlations(result, free),
        unstable=unstable,
        warnings=tuple(warnings),
    )  # fmt: skip


def _modulus(data: Data) -> float:
    """First guess of a shear modulus in Pa: what was measured over the strain, the median of it."""
    strain = np.abs(data.abscissa - 1.0)
    loaded = strain > 0.2 * strain.max()
    return float(max(np.median(np.abs(data.observed[loaded]) / strain[loaded]) / 3.0, 1.0))


def _parameters(
    fitting: Any,
    declared: Mapping[str, ConstantDeclaration],
    fixed: Mapping[str, float],
    modulus: float,
    start: float,
) -> Any:
    parameters = fitting.Parameters()
    for name, each in declared.items():
        if name in fixed:
            parameters.add(name, fixed[name], vary=False)
        elif each.unit == "Pa":
            low = modulus / SPAN if each.positive else -SPAN * modulus
            parameters.add(name, each.guess * modulus, min=low, max=SPAN * modulus)
        else:
            low, high = NUMBER if each.positive else ANY_SIGN
            low, high = max(low, each.low), min(high, each.high)
            # A first guess beyond a bound would be put on it, where nothing changes any more.
            guess = each.guess * start
            inside = guess if low < guess < high else (low + high) / 2.0
            parameters.add(name, inside, min=low, max=high)
    return parameters


def _check_told(residuals: Any, result: Any, free: list[str]) -> None:
    """Refuse constants whose changes cancel: the data cannot tell them from one another."""
    columns = []
    for name in free:
        sides = []
        for sign in (1.0, -1.0):
            moved = result.params.copy()
            moved[name].set(value=moved[name].value * (1.0 + sign * 1e-4) + sign * 1e-9)
            sides.append(residuals(moved))
        columns.append((sides[0] - sides[1]) / 2e-4)
    _, sizes, directions = np.linalg.svd(np.array(columns).T, full_matrices=False)
    blind = directions[sizes <= INDISTINCT * sizes[0]]
    if not len(blind):
        return
    named = [n for n, shares in zip(free, blind.T, strict=True) if np.abs(shares).max() > SHARE]
    raise BadInput(
        "data",
        f"blind to {' and '.join(named)}",
        "such that every constant changes what is predicted",
        f"give one of them, e.g. --fix {named[-1]}=VALUE, or another test",
    )


def _growing(
    off: Float[np.ndarray, " n"], observed: Float[np.ndarray, " n"], relative: bool
) -> list[Caution]:
    """Whether residuals grow with what was measured, although they were taken as equal."""
    if relative or len(off) < FEWEST_OF_A_TREND or np.ptp(np.abs(off)) == 0.0:
        return []
    trend = spearmanr(np.abs(off), np.abs(observed))
    if not (trend.statistic > 0.0 and trend.pvalue < UNLIKELY):
        return []
    return [caution("residuals_grow")]
