"""Least-squares fit of the constants of a law to laboratory data, with confidence intervals.

The package lmfit does the fit and the profile likelihood of the intervals. A fit is refused if the
data do not identify the constants separately, if a constant ends at a bound of the search, or if
the law describes the data no better than chance.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.stats import spearmanr

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Float
from stonepass.bench.ambiguity import ambiguous
from stonepass.bench.confidence_band import confidence_band
from stonepass.bench.fit_checks import check_enough, check_fit, check_told, r_squared_of
from stonepass.bench.fit_search import Search, best_fit, proportional_spread, search_for
from stonepass.bench.lack_of_fit import NEGLIGIBLE, lack_of_fit
from stonepass.bench.least_squares import correlations, intervals
from stonepass.bench.objective import Data, Objective
from stonepass.caution import Caution, caution
from stonepass.errors import BadInput, UnstableLaw
from stonepass.materials.constants import Unit, shown_constant
from stonepass.materials.known_laws import constants_by_name, name_of_law
from stonepass.materials.protocol import Law, Material
from stonepass.materials.stability import SOFTEST_WALL, check
from stonepass.result import Result

__all__ = ["Constant", "Data", "FittedLaw", "fit_law", "refuse_gross_error"]

FEWEST_OF_A_TREND = 8  # smallest number of points for the test of a trend
# Smallest error of a point, as a fraction of the largest, in the test for lack of fit if residuals
# grow with the values. Without it the points at rest, whose noise does not vanish, would decide.
SHARE_OF_REST = 0.05
UNLIKELY = 0.01  # significance level of the test of a trend
# A load is a gross error if it exceeds the largest of the others this many times, if the law
# describes the others with at least this R², and if it differs from the prediction by at least this
# fraction.
GROSS, WELL, FAR = 10.0, 0.9, 0.5
# A specimen is broken where it carries less than this fraction of the largest load, in at least so
# many rows at its end.
BROKEN, FEWEST_AFTER = 0.2, 2
# Young's modulus in Pa at rest that no soft tissue of a tube and no rubber has. The hardest rubber
# of the scale Shore A, 95, has 44 MPa (Gent 1958, IRI Trans. 34, 46-57); beyond it lie plastics.
STIFFEST_WALL = 5e7
# Codes of the cautions after which the 95 % intervals are only approximate.
UNSURE = ("residuals_grow", "residuals_correlated", "lack_of_fit",
          "zero_offset", "rest_size", "slack", "axial_rest_length", "hysteresis", "runs_differ",
          "outlier")  # fmt: skip


@dataclass(frozen=True)
class Constant:
    """A constant of a fitted law.

    Attributes
    ----------
    name : str
        Name of the constant in law files.
    value : float
        Fitted or given value, in `unit`.
    unit : {"Pa", "rad", "1"}
        Unit of `value`, `low` and `high`.
    low, high : float or None
        Lower and upper end of the 95 % confidence interval. Both are None if the constant was
        given; one is None if the data do not bound the constant on that side.
    given : bool
        True if the constant was given instead of fitted.
    """

    name: str
    value: float
    unit: Unit
    low: float | None = None
    high: float | None = None
    given: bool = False


@array_dataclass
@dataclass(frozen=True, repr=False)
class FittedLaw(Result):
    """A law fitted to laboratory data.

    Attributes
    ----------
    material : Material
        Material with the fitted law; its strain range is that of the data.
    constants : tuple of Constant
        All constants of the law, fitted and given.
    data : Data
        The n measured values.
    predicted : array (n)
        Predicted stresses or pressures in Pa.
    band : array (n)
        Half the width of the 95 % confidence band of `predicted` in Pa.
    rmse : float
        Root mean square of the residuals in Pa.
    r_squared : float
        Coefficient of determination 1 − Σ residual²/Σ (observed − mean)², 0 to 1.
    correlations : dict of (str, str) to float
        Correlation of the estimates of each pair of fitted constants, −1 to 1.
    unstable : str
        Reason why the fitted law is not stable; empty if it is stable.
    warnings : tuple of Caution
        Warnings; those that concern the agreement of law and data come first.

    References
    ----------
    docs/bench.md, "The fit".
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

    def summary(self) -> str:
        """Return the law, its constants and how well it fits in one line."""
        law = name_of_law(self.material.law)
        return f"{law}, {self.told}; R² {self.r_squared:.4f}, RMSE {self.rmse / 1e3:.3g} kPa"

    @property
    def told(self) -> str:
        """Names and values of all constants, as text."""
        known = constants_by_name(name_of_law(self.material.law))
        return ", ".join(
            f"{c.name} {shown_constant(c.value, known[c.name])}" for c in self.constants
        )

    @property
    def approximate(self) -> bool:
        """True if the residuals violate the assumptions of the 95 % intervals."""
        return any(each.code in UNSURE for each in self.warnings)

    @property
    def residuals(self) -> Float[np.ndarray, " n"]:
        """Predicted minus observed values in Pa, an array (n)."""
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
        Measured values: `Tension` or `Inflation`.
    law : str
        Name of the law in `materials.known_laws.KNOWN_LAWS`.
    given : mapping of str to float, optional
        Constants that are not fitted, in SI units.
    name : str
        Name of the fitted material.
    relative : bool
        True if the measuring errors are proportional to the predicted values. By default they have
        the same size at all points. The intervals are right only if this choice is right.
    free : sequence of str
        Names of constants to be fitted although they normally keep their default value. Examples
        are the second and third term of the Ogden law and the dispersion of the fibres.

    Returns
    -------
    FittedLaw
        It is returned for unstable laws too; `FittedLaw.unstable` then has the reason.

    Raises
    ------
    BadInput
        The law or a constant is unknown, no constant is to be fitted, there are no more points than
        constants, all points have the same stretch or the same load, the data do not identify some
        constants separately, a constant ends at a bound of the search, the law describes the data
        no better than chance, or a single point prevents the fit.

    References
    ----------
    docs/bench.md, "The fit".
    """
    fixed = dict(given or {})
    search = search_for(data, law, fixed, free)
    check_enough(data, search.free)
    even = np.full(len(data.observed), float(np.ptp(data.observed)))
    objective = Objective(data, search.made, even)
    starts = search.starts(objective)
    check_told(objective, search, starts)
    best = best_fit(objective, search, starts, relative)
    objective, minimizer, result = best.objective, best.minimizer, best.result
    try:
        at_bounds = check_fit(objective, search, result)
    except BadInput:
        refuse_gross_error(data, law, fixed, free)
        _refuse_rupture(data)
        raise
    values = {each: float(value) for each, value in result.params.valuesdict().items()}
    predicted = objective.predicted(values)
    off = predicted - data.observed
    growing = _growing(off, data.observed, relative)
    material = _material(_made(search, values), data, name)
    doubts = _doubts(objective, material.law, values, search.free, proportional=bool(growing))
    held = {dict(one.values)["name"] for one in at_bounds}
    inside = [each for each in search.free if each not in held]
    bounds, open_ends = intervals(minimizer, result, inside, best.others)
    unstable, odd = _unstable(material, data)
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
        warnings=(
            *ambiguous(search, material.law, best.as_good),
            *(doubts or growing),
            *at_bounds,
            *odd,
            *open_ends,
        ),
    )


def _made(search: Search, values: Mapping[str, float]) -> Law:
    """Return the fitted law; refuse constants that contradict each other."""
    try:
        made: Law = search.made(**values)
    except BadInput as problem:
        raise BadInput(
            f"fit of law '{search.law}'",
            search.shown(values),
            f"constants of a stable solid ({problem.argument} {problem.allowed})",
            "the law does not describe these data: use a smaller range of stretches, or fit "
            "another law",
        ) from problem
    return made


def _refuse_rupture(data: Data) -> None:
    """Refuse rows after the largest load in which the specimen carries nearly nothing."""
    load, stretch = np.abs(data.observed), np.abs(data.abscissa - 1.0)
    last = int(np.argmax(load))
    later = slice(last + 1, None)
    if len(load[later]) < FEWEST_AFTER or stretch[later].min() < stretch[last]:
        return
    if load[later].max() < BROKEN * load[last]:
        row = f"row {data.lines[last]}" if data.lines else f"point {last + 1}"
        raise BadInput(
            f"{data.measured} after {row}",
            f"at most {load[later].max() / 1e3:.3g} kPa, after {load[last] / 1e3:.4g} kPa",
            "that of an intact specimen",
            f"leave out the rows after {row} if the specimen broke there",
        )


def refuse_gross_error(
    data: Data, law: str, given: Mapping[str, float], free: Sequence[str]
) -> None:
    """Refuse data without a fit by the name of a single point, if the others have one.

    The point with the largest load is left out. It is named if the law describes the others well,
    its load exceeds 10 times the largest load of the others, and the law does not predict it.

    Parameters
    ----------
    data, law, given, free
        See `fit_law`.

    Raises
    ------
    BadInput
        There is such a point.
    """
    worst = int(np.argmax(np.abs(data.observed)))
    others = data.without(worst)
    if not abs(data.observed[worst]) > GROSS * float(np.abs(others.observed).max()):
        return
    try:
        search = search_for(others, law, given, free)
        check_enough(others, search.free)
    except BadInput:
        return
    spread = np.full(len(others.observed), float(np.ptp(others.observed)))
    objective = Objective(others, search.made, spread)
    result = best_fit(objective, search, search.starts(objective), relative=False).result
    expected = Objective(data, search.made, data.observed).predicted(result.params.valuesdict())
    r_squared = r_squared_of(np.delete(expected - data.observed, worst), others.observed)
    apart = abs(expected[worst] - data.observed[worst]) > FAR * abs(data.observed[worst])
    if r_squared > WELL and np.isfinite(expected[worst]) and apart:
        point = f"row {data.lines[worst]}" if data.lines else f"point {worst + 1}"
        raise BadInput(f"{data.measured} of {point}", f"{data.observed[worst] / 1e3:.6g} kPa",
                       f"near the {expected[worst] / 1e3:.3g} kPa that the fit to all other points "
                       "predicts", "check the decimal sign and the unit of this value, or leave "
                       "it out")  # fmt: skip


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
    """Test for lack of fit with the errors of the fit.

    If the residuals show that the errors are `proportional`, only those mistakes are told that are
    found with both kinds of errors. A single outlier can make the residuals appear to grow.
    """
    slopes, off = objective.sensitivities(values, free), objective.off(values)
    told = lack_of_fit(objective.data, law, off, slopes, objective.spread)
    if not proportional:
        return told
    spread = proportional_spread(objective.predicted(values), SHARE_OF_REST)
    ratio = objective.spread / spread
    found = lack_of_fit(objective.data, law, off * ratio, slopes * ratio[:, None], spread)
    return [each for each in found if each.code in {one.code for one in told}]


def _unstable(material: Material, data: Data) -> tuple[str, list[Caution]]:
    """Return why the law is unstable (empty if stable), and a caution if its modulus is odd."""
    try:
        state = check(material)
    except UnstableLaw as problem:
        return problem.allowed, []
    except BadInput as problem:
        raise BadInput(problem.argument, problem.value, problem.allowed,
                       f"check the unit of the {data.measured}") from problem  # fmt: skip
    at = data.unstable_at(material.law)
    if at is not None:
        return f"the width of a strip is unstable at stretch {at:.3g}", []
    if state.shear < SOFTEST_WALL:
        return "", [caution("soft_fit", modulus_Pa=state.shear, measured=data.measured)]
    young = max(state.hoop, state.axial)
    if young > STIFFEST_WALL:
        return "", [caution("stiff_fit", modulus_MPa=young / 1e6, measured=data.measured)]
    return "", []


def _growing(
    off: Float[np.ndarray, " n"], observed: Float[np.ndarray, " n"], relative: bool
) -> list[Caution]:
    """Return a caution if the residuals grow with the observed values (Spearman's rank test)."""
    size = np.abs(off)
    if relative or len(off) < FEWEST_OF_A_TREND or np.ptp(size) == 0.0:
        return []
    if size.max() <= NEGLIGIBLE * np.abs(observed).max():
        return []
    trend = spearmanr(size, np.abs(observed))
    if not (trend.statistic > 0.0 and trend.pvalue < UNLIKELY):
        return []
    return [caution("residuals_grow")]
