"""Results of the Monte Carlo samples of one patient: pressure intervals, fractions of samples."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Bool, Float

__all__ = [
    "FEWER",
    "MORE",
    "Fraction",
    "Present",
    "Range",
    "Samples",
    "contradiction",
    "interval",
    "median_noise",
]

INTERVAL = (0.05, 0.5, 0.95)
AGREE = 0.02  # largest relative effect of censored samples on a quantile that is stated
MORE, FEWER, NEAR = "more than in the model", "fewer than in the model", "near the model"
UNDECIDED = "undecided by the model"
FAR_APART = 0.2  # difference of two fractions that contradict each other


@dataclass(frozen=True)
class Range:
    """Median and 90 % interval in Pa.

    An end that the model cannot determine is None; it exceeds `at_least`.
    """

    low: float | None
    median: float | None
    high: float | None
    at_least: float | None = None


@dataclass(frozen=True)
class Fraction:
    """A fraction of the samples: from `low` to `high`, which differ if some are undecided."""

    low: float
    high: float

    def noise(self, count: int) -> float:
        """Return the standard error for `count` independent samples, the larger of both ends."""
        return max((each * (1.0 - each) / count) ** 0.5 for each in (self.low, self.high))

    def describe(self) -> str:
        """Write the fraction: ``60 %``, ``fewer than 1 %``, ``55 to 62 %``."""
        low, high = (round(100.0 * each) for each in (self.low, self.high))
        if low != high:
            return f"{low} to {high} %"
        if low == 0:
            return "fewer than 1 %"
        return "more than 99 %" if low == 100 else f"{low} %"


@array_dataclass
@dataclass(frozen=True)
class Present:
    """The present urine pressure in every sample.

    Attributes
    ----------
    pressure : array (n)
        In Pa.
    censored : array (n)
        True where the pressure is only a lower bound.
    opening : array (n)
        r_a/R_a of the dilated segment.
    """

    pressure: Float[np.ndarray, " n"]
    censored: Bool[np.ndarray, " n"]
    opening: Float[np.ndarray, " n"]


@array_dataclass
@dataclass(frozen=True)
class Samples:
    """The Monte Carlo samples of a patient.

    Attributes
    ----------
    critical : array (n)
        P_ucr in Pa.
    censored : array (n)
        True where P_ucr is only a lower bound.
    loose : array (n)
        True where the stone is no larger than the lumen.
    size_ratio : array (n)
        ξ.
    diameter : array (n)
        Diameter of the stone in mm.
    """

    critical: Float[np.ndarray, " n"]
    censored: Bool[np.ndarray, " n"]
    loose: Bool[np.ndarray, " n"]
    size_ratio: Float[np.ndarray, " n"]
    diameter: Float[np.ndarray, " n"]

    def below(
        self, pressure: float | Present, chosen: Bool[np.ndarray, " n"] | None = None
    ) -> Fraction:
        """Return the fraction of all samples, or of those `chosen`, with P_ucr below a pressure."""
        some = np.ones(len(self.critical), dtype=bool) if chosen is None else chosen
        if isinstance(pressure, Present):
            less = self.critical < pressure.pressure
            possible = less | pressure.censored
        else:
            less = possible = self.critical < pressure
        certain = less & ~self.censored
        return Fraction(float(np.mean(certain[some])), float(np.mean(possible[some])))


def interval(values: Float[np.ndarray, " n"], censored: Bool[np.ndarray, " n"]) -> Range:
    """Return median and 90 % interval of values, some of which are only lower bounds.

    A quantile is stated if the true values behind the lower bounds cannot change it by more than
    the fraction `AGREE`.
    """
    least = np.quantile(values, INTERVAL, method="higher")
    most = np.quantile(np.where(censored, np.inf, values), INTERVAL, method="higher")
    low, median, high = (
        float(other) if other <= (1.0 + AGREE) * known else None
        for known, other in zip(least, most, strict=True)
    )
    ends = (low, median, high)
    if None not in ends:
        return Range(low, median, high)
    return Range(low, median, high, float(least[ends.index(None)]))


def median_noise(values: Float[np.ndarray, " n"], censored: Bool[np.ndarray, " n"]) -> float | None:
    """Return the standard error in Pa of the median of independent samples; None where unknown.

    The rank of the true median among n values is n/2 ± √n/2, so the error is half of the distance
    of the values with these ranks. Samples of a Sobol sequence, as here, usually err by less.
    """
    count = len(values)
    ordered = np.sort(np.where(censored, np.inf, values))
    ranks = np.array([count - count**0.5, count + count**0.5]) / 2.0
    low, high = ordered[np.clip(ranks.round().astype(int), 0, count - 1)]
    return float(high - low) / 2.0 if np.isfinite(high) else None


def contradiction(passed: float, fraction: Fraction | None) -> str:
    """Compare the fraction of stones that passed with the model's fraction below the limit."""
    if fraction is None:
        return ""
    if fraction.high - fraction.low > FAR_APART:
        return UNDECIDED
    if passed > fraction.high + FAR_APART:
        return MORE
    if passed < fraction.low - FAR_APART:
        return FEWER
    return NEAR
