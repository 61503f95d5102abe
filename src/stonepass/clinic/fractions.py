"""Monte Carlo samples of one patient, and intervals and fractions computed from them."""

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

INTERVAL = (0.05, 0.5, 0.95)  # quantiles of the interval and the median
# A quantile is stated only if replacing the censored values by infinity changes it by at most this
# fraction.
AGREE = 0.02
MORE, FEWER, NEAR = "more than in the model", "fewer than in the model", "near the model"
UNDECIDED = "undecided by the model"
FAR_APART = 0.2  # difference of two fractions above which they contradict one another


@dataclass(frozen=True)
class Range:
    """Median and 90 % interval of a pressure, some samples of which may be censored.

    Attributes
    ----------
    low, median, high : float or None
        5th, 50th and 95th percentile in Pa; None if censored samples leave the percentile unknown.
    at_least : float or None
        Lower bound in Pa of the first percentile that is None; None if all percentiles are known.

    References
    ----------
    docs/assess.md, "What is done".
    """

    low: float | None
    median: float | None
    high: float | None
    at_least: float | None = None


@dataclass(frozen=True)
class Fraction:
    """A fraction of the samples, which is an interval if censored samples leave it open.

    Attributes
    ----------
    low, high : float
        Smallest and largest possible value of the fraction, 0 to 1.

    References
    ----------
    docs/assess.md, "What is done".
    """

    low: float
    high: float

    def noise(self, count: int) -> float:
        """Return the standard error of the fraction for `count` independent samples.

        It is the larger one of the standard errors of both ends.
        """
        return max((each * (1.0 - each) / count) ** 0.5 for each in (self.low, self.high))

    def describe(self) -> str:
        """Return the fraction as text, e.g. ``60 %``, ``fewer than 1 %`` or ``55 to 62 %``."""
        low, high = (round(100.0 * each) for each in (self.low, self.high))
        if low != high:
            return f"{low} to {high} %"
        if low == 0:
            return "fewer than 1 %"
        return "more than 99 %" if low == 100 else f"{low} %"


@array_dataclass
@dataclass(frozen=True)
class Present:
    """Present urine pressure of n samples, from the diameter of the dilated segment.

    Attributes
    ----------
    pressure : array (n)
        Urine pressure in Pa.
    censored : array (n) of bool
        True for a sample whose pressure is only a lower bound.
    opening : array (n)
        Radius ratio r_a/R_a of the dilated segment.

    References
    ----------
    docs/theory.md, "Far field".
    """

    pressure: Float[np.ndarray, " n"]
    censored: Bool[np.ndarray, " n"]
    opening: Float[np.ndarray, " n"]


@array_dataclass
@dataclass(frozen=True)
class Samples:
    """The n Monte Carlo samples of a patient.

    Attributes
    ----------
    critical : array (n)
        Critical pressure P_ucr in Pa.
    censored : array (n) of bool
        True for a sample whose P_ucr is only a lower bound.
    loose : array (n) of bool
        True for a sample in which the stone is not larger than the lumen, so that P_ucr = 0.
    size_ratio : array (n)
        Size ratio ξ.
    diameter : array (n)
        Diameter of the stone in mm.

    References
    ----------
    docs/assess.md, "What is done".
    """

    critical: Float[np.ndarray, " n"]
    censored: Bool[np.ndarray, " n"]
    loose: Bool[np.ndarray, " n"]
    size_ratio: Float[np.ndarray, " n"]
    diameter: Float[np.ndarray, " n"]

    def below(
        self, pressure: float | Present, chosen: Bool[np.ndarray, " n"] | None = None
    ) -> Fraction:
        """Return the fraction of samples whose P_ucr is below a pressure.

        Parameters
        ----------
        pressure : float or Present
            A pressure in Pa for all samples, or one for each sample.
        chosen : array (n) of bool, optional
            The samples that count; by default all of them.

        References
        ----------
        docs/assess.md, "What is done".
        """
        some = np.ones(len(self.critical), dtype=bool) if chosen is None else chosen
        if isinstance(pressure, Present):
            less = self.critical < pressure.pressure
            possible = less | pressure.censored
        else:
            less = possible = self.critical < pressure
        certain = less & ~self.censored
        return Fraction(float(np.mean(certain[some])), float(np.mean(possible[some])))


def interval(values: Float[np.ndarray, " n"], censored: Bool[np.ndarray, " n"]) -> Range:
    """Return the median and the 90 % interval of right-censored samples.

    A quantile is None if it changes by more than 2 % when the censored values are replaced by
    infinity.

    Parameters
    ----------
    values : array (n)
        Values in Pa.
    censored : array (n) of bool
        True for a value that is only a lower bound.

    References
    ----------
    docs/assess.md, "What is done".
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
    """Return the standard error of the median of n independent samples.

    The rank of the true median among the sorted values is n/2 with the standard deviation √n/2.
    The standard error is therefore half the difference of the values with the ranks n/2 ± √n/2.
    Samples of a Sobol sequence usually have a smaller error.

    Parameters
    ----------
    values : array (n)
        Values in Pa.
    censored : array (n) of bool
        True for a value that is only a lower bound.

    Returns
    -------
    float or None
        Standard error in Pa; None if it depends on censored values.

    References
    ----------
    docs/assess.md, "What is done".
    """
    count = len(values)
    ordered = np.sort(np.where(censored, np.inf, values))
    ranks = np.array([count - count**0.5, count + count**0.5]) / 2.0
    low, high = ordered[np.clip(ranks.round().astype(int), 0, count - 1)]
    return float(high - low) / 2.0 if np.isfinite(high) else None


def contradiction(passed: float, fraction: Fraction | None) -> str:
    """Compare a published passage rate with the fraction of samples below the pressure limit.

    Parameters
    ----------
    passed : float
        Fraction of the stones of a cohort that passed, 0 to 1.
    fraction : Fraction or None
        Fraction of the samples whose critical pressure is below the limit.

    Returns
    -------
    str
        The result in words; empty without a fraction.

    References
    ----------
    docs/assess.md, "What is done".
    """
    if fraction is None:
        return ""
    if fraction.high - fraction.low > FAR_APART:
        return UNDECIDED
    if passed > fraction.high + FAR_APART:
        return MORE
    if passed < fraction.low - FAR_APART:
        return FEWER
    return NEAR
