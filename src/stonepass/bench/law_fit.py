"""Constants of a law from bench data: least squares, with intervals and what the data cannot tell.

The fit and the profile likelihood behind the intervals are lmfit's. A fit that is none is refused
with its reason: constants that the data cannot tell from one another, that end where the search
ends, or that explain the data no better than no law at all.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from scipy.stats import f as f_distribution
from scipy.stats import spearmanr

from stonepass.array_types import Float
from stonepass.bench.lack_of_fit import lack_of_fit
from stonepass.bench.least_squares import LEVEL, correlations, intervals, lmfit
from stonepass.bench.objective import (
    Data,
    Objective,
    at_an_end,
    starting_parameters,
    stiffness_guess,
)
from stonepass.caution import Caution, caution
from stonepass.equality import compared_by_value
from stonepass.errors import BadInput, UnstableLaw, refuse_unknown, require
from stonepass.materials.constants import ConstantDeclaration, Unit, shown_constant
from stonepass.materials.known_laws import constants_by_name, known_law, name_of_law
from stonepass.materials.protocol import Law, Material
from stonepass.materials.stability import check

__all__ = ["Constant", "Data", "FittedLaw", "fit_law"]

STARTS = (0.1, 1.0, 5.0)  # of the numbers of a law, each tried
INDISTINCT = 1e-6  # of singular values of the sensitivities, relative
SMALLEST_SHARE = 0.01  # of the largest stress: below it an error is no longer proportional
REWEIGHTED = 3  # times that proportional errors are taken anew from what the law predicts
FEWEST_OF_A_TREND = 8  # points
UNLIKELY = 0.01  # chance of so clear a trend where there is none
SHARE = 0.3  # of a constant in what the data cannot tell, for it to be named
SOFT = 1e3  # Pa: no wall is as soft, a shear modulus below is probably in other units
# Cautions after which 95 % intervals are approximate.
UNSURE = ("residuals_grow", "residuals_correlated", "interval_by_curvature", "lack_of_fit",
          "zero_offset", "rest_size", "slack", "axial_rest_length", "hysteresis", "runs_differ",
          "outlier")  # fmt: skip


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


@compared_by_value
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
        1 − Σ residual²/Σ (observed − mean)²; not negative.
    correlations : dict
        Pairs of fitted constants and the correlation of their estimates.
    unstable : str
        Why the law describes no solid; empty where it does.
    warnings : tuple of Caution
        What speaks against the fit comes first.
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
    def told(self) -> str:
        """The constants in words."""
        known = constants_by_name(name_of_law(self.material.law))
        return ", ".join(
            f"{c.name} {shown_constant(c.value, known[c.name])}" for c in self.constants
        )

    @property
    def approximate(self) -> bool:
        """Whether the residuals are not those that the 95 % intervals assume."""
        return any(each.code in UNSURE for each in self.warnings)

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
        An unknown law or constant, fewer points than constants, constants that the data cannot
        tell from one another or that end where the search ends, naming them, and data that no
        constants meet better than no law would.
    """
    made, declared, fixed = known_law(law), constants_by_name(law), dict(given or {})
    for each in (*fixed, *free):
        if each not in declared:
            refuse_unknown(f"constant of law '{law}'", each, list(declared))
    for constant in declared.values():
        if constant.held and constant.default is not None and constant.name not in free:
            fixed.setdefault(constant.name, constant.default)
    free = [each for each in declared if each not in fixed]
    _check_enough(data, free)
    objective = Objective(data, made, np.full(len(data.observed), float(np.ptp(data.observed))))
    search = _Search(law, declared, fixed, tuple(free), stiffness_guess(data))
    _check_told(objective, search)
    objective, minimizer, result = _best(objective, search, relative)
    values = {each: float(value) for each, value in result.params.valuesdict().items()}
    predicted = objective.predicted(values)
    off = predicted - data.observed
    told = _check_fit(objective, search, result)
    fitted = made(**values)
    growing = _growing(off, data.observed, relative)
    inside = [each for each in free if each not in {dict(one.values)["name"] for one in told}]
    doubts = _doubts(objective, fitted, values, free, proportional=bool(growing))
    bounds, open_ends = intervals(minimizer, result, inside, declared)
    low, high = data.strain_range
    material = Material(
        name=name,
        law=fitted,
        source=f"fitted to {len(off)} points of {data.measured}",
        test=data.measured,
        verified="fitted, not verified",
        strain_range=(min(1.0, low), max(high, 1.0 + 1e-3)),
    )
    unstable, soft = _unstable(material, data)
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
        r_squared=_r_squared(off, data.observed),
        correlations=correlations(result, free),
        unstable=unstable,
        warnings=(*(doubts or growing), *told, *soft, *open_ends),
    )  # fmt: skip


@dataclass(frozen=True)
class _Search:
    """Which constants are looked for, and where it begins."""

    law: str
    declared: Mapping[str, ConstantDeclaration]
    fixed: Mapping[str, float]
    free: tuple[str, ...]
    modulus: float

    def parameters(self, start: float) -> Any:
        return starting_parameters(lmfit(), self.declared, self.fixed, self.modulus, start)


def _check_enough(data: Data, free: Sequence[str]) -> None:
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


def _check_told(objective: Objective, search: _Search) -> None:
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


def _refuse_blind(named: Sequence[str]) -> None:
    raise BadInput(
        "data",
        f"blind to {' and '.join(named)}",
        "such that every constant changes what is predicted",
        f"give one of them, e.g. --fix {named[-1]}=VALUE, or another test",
    )


def _best(objective: Objective, search: _Search, relative: bool) -> tuple[Objective, Any, Any]:
    """The best of the fits from several starts; proportional errors follow what it predicts."""
    data = objective.data
    if relative:
        objective = replace(objective, spread=_proportional(data.observed))
    starts = [search.parameters(start) for start in STARTS]
    alike = starts[0].valuesdict() == starts[-1].valuesdict()  # where no number is looked for
    found = [_minimized(objective, each) for each in (starts[:1] if alike else starts)]
    minimizer, result = min(found, key=lambda each: float(each[1].chisqr))
    for _ in range(REWEIGHTED if relative else 0):
        predicted = objective.predicted(result.params.valuesdict())
        if not np.all(np.isfinite(predicted)):
            break
        objective = replace(objective, spread=_proportional(predicted))
        minimizer, result = _minimized(objective, result.params)
    return objective, minimizer, result


def _minimized(objective: Objective, parameters: Any) -> tuple[Any, Any]:
    minimizer = lmfit().Minimizer(objective.residuals, parameters)
    with np.errstate(all="ignore"):
        return minimizer, minimizer.minimize(method="least_squares")


def _proportional(level: Float[np.ndarray, " n"]) -> Float[np.ndarray, " n"]:
    size = np.abs(level)
    return np.maximum(size, SMALLEST_SHARE * float(size.max()))


def _check_fit(objective: Objective, search: _Search, result: Any) -> list[Caution]:
    """Refuse a fit that is none; say where a constant is zero, or another end of its own range."""
    law, data, told = search.law, objective.data, []
    values = {each: float(value) for each, value in result.params.valuesdict().items()}
    predicted = objective.predicted(values)
    law_of = f"fit of law '{law}'"
    remedy = "check signs, units and sizes at rest, or fit another law"
    if not np.all(np.isfinite(predicted)):
        raise BadInput(law_of, "without a prediction for some of the data",
                       "one that meets all of them", "fit another law")  # fmt: skip
    r_squared = _r_squared(predicted - data.observed, data.observed)
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


def _doubts(
    objective: Objective,
    law: Law,
    values: Mapping[str, float],
    free: Sequence[str],
    *,
    proportional: bool,
) -> list[Caution]:
    """Lack of fit, with errors in proportion where the residuals are so."""
    spread = objective.spread
    if proportional:
        spread = _proportional(objective.predicted(values))
    ratio = objective.spread / spread
    slopes = objective.sensitivities(values, free) * ratio[:, None]
    return lack_of_fit(objective.data, law, objective.off(values) * ratio, slopes, spread)


def _unstable(material: Material, data: Data) -> tuple[str, list[Caution]]:
    """Why the law is no solid, if so, and whether it is suspiciously soft."""
    try:
        state = check(material)
    except UnstableLaw as problem:
        return problem.allowed, []
    except BadInput as problem:
        raise BadInput(problem.argument, problem.value, problem.allowed,
                       f"check the unit of the {data.measured}") from problem  # fmt: skip
    at = data.unstable_at(material.law)
    if at is not None:
        return f"at stretch {at:.3g} a strip would not keep its shape", []
    if state.shear < SOFT:
        return "", [caution("soft_fit", modulus_Pa=state.shear, measured=data.measured)]
    return "", []


def _r_squared(off: Float[np.ndarray, " n"], observed: Float[np.ndarray, " n"]) -> float:
    return 1.0 - float(np.sum(off**2) / np.sum((observed - observed.mean()) ** 2))


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
