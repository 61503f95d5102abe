"""Constants of a law from bench data: least squares, with intervals and what the data cannot tell.

The fit and the profile likelihood behind the intervals are lmfit's. A fit that is none is refused
with its reason: constants that the data cannot tell from one another, that end where the search
ends, or that explain the data no better than no law at all.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.stats import spearmanr

from stonepass.array_types import Float
from stonepass.bench.confidence_band import confidence_band
from stonepass.bench.fit_checks import check_enough, check_fit, check_told, r_squared_of
from stonepass.bench.fit_search import Search, best_fit, proportional_spread, search_for
from stonepass.bench.lack_of_fit import lack_of_fit
from stonepass.bench.least_squares import correlations, intervals
from stonepass.bench.objective import Data, Objective
from stonepass.caution import Caution, caution
from stonepass.equality import compared_by_value
from stonepass.errors import BadInput, UnstableLaw
from stonepass.materials.constants import Unit, shown_constant
from stonepass.materials.known_laws import constants_by_name, name_of_law
from stonepass.materials.protocol import Law, Material
from stonepass.materials.stability import SOFTEST_WALL, check

__all__ = ["Constant", "Data", "FittedLaw", "fit_law"]

FEWEST_OF_A_TREND = 8  # points
UNLIKELY = 0.01  # chance of so clear a trend where there is none
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
    predicted, band : array (n)
        In Pa: the law at each point, and half the width of its 95 % confidence band there.
    rmse : float
        Root mean square of the residuals in Pa.
    r_squared : float
        1 − Σ residual²/Σ (observed − mean)²; not negative.
    correlations : dict
        Pairs of fitted constants and the correlation of their estimates.
    unstable : str
        Why the law describes no solid; empty where it does.
    warnings : tuple of Caution
        Cautions that speak against the fit come first.
    """

    material: Material
    constants: tuple[Constant, ...]
    data: Data
    predicted: Float[np.ndarray, " n"]
    band: Float[np.ndarray, " n"]
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
    search = search_for(data, law, given or {}, free)
    check_enough(data, search.free)
    even = np.full(len(data.observed), float(np.ptp(data.observed)))
    objective = Objective(data, search.made, even)
    check_told(objective, search)
    objective, minimizer, result = best_fit(objective, search, relative)
    at_bounds = check_fit(objective, search, result)
    values = {each: float(value) for each, value in result.params.valuesdict().items()}
    predicted = objective.predicted(values)
    off = predicted - data.observed
    growing = _growing(off, data.observed, relative)
    material = _material(search.made(**values), data, name)
    doubts = _doubts(objective, material.law, values, search.free, proportional=bool(growing))
    held = {dict(one.values)["name"] for one in at_bounds}
    inside = [each for each in search.free if each not in held]
    bounds, open_ends = intervals(minimizer, result, inside, search.declared)
    unstable, soft = _unstable(material, data)
    return FittedLaw(
        material=material,
        constants=_constants(search, values, bounds),
        data=data,
        predicted=predicted,
        band=confidence_band(objective, values, inside),
        rmse=float(np.sqrt(np.mean(off**2))),
        r_squared=r_squared_of(off, data.observed),
        correlations=correlations(result, search.free),
        unstable=unstable,
        warnings=(*(doubts or growing), *at_bounds, *soft, *open_ends),
    )


def _material(law: Law, data: Data, name: str) -> Material:
    low, high = data.strain_range
    return Material(
        name=name,
        law=law,
        source=f"fitted to {len(data.observed)} points of {data.measured}",
        test=data.measured,
        verified="fitted, not verified",
        strain_range=(min(1.0, low), max(high, 1.0 + 1e-3)),
    )


def _constants(
    search: Search,
    values: Mapping[str, float],
    bounds: Mapping[str, tuple[float | None, float | None]],
) -> tuple[Constant, ...]:
    return tuple(
        Constant(
            name,
            values[name],
            declared.unit,
            *bounds.get(name, (None, None)),
            given=name in search.fixed,
        )
        for name, declared in search.declared.items()
    )


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
        spread = proportional_spread(objective.predicted(values))
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
    if state.shear < SOFTEST_WALL:
        return "", [caution("soft_fit", modulus_Pa=state.shear, measured=data.measured)]
    return "", []


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
