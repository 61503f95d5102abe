"""Intervals and fractions of samples, some of which are only lower bounds (right-censored)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from stonepass.array_types import Bool, Float

__all__ = ["Fraction", "PercentileRange", "fraction_below", "interval", "median_noise"]

INTERVAL = (0.05, 0.5, 0.95)  # quantiles of the interval and the median
# A quantile is stated only if replacing the censored values by infinity changes it by at most this
# fraction.
AGREE = 0.02


@dataclass(frozen=True)
class PercentileRange:
    """Median and 90 % interval of a quantity, some samples of which may be censored.

    Attributes
    ----------
    low, median, high : float or None
        5th, 50th and 95th percentile in the unit of the samples, which is Pa for pressures; None if
        censored samples leave the percentile unknown.
    at_least : float or None
        Lower bound of the first percentile that is None; None if all percentiles are known.

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


def interval(values: Float[np.ndarray, " n"], censored: Bool[np.ndarray, " n"]) -> PercentileRange:
    """Return the median and the 90 % interval of right-censored samples.

    A quantile is None if it changes by more than 2 % when the censored values are replaced by
    infinity.

    Parameters
    ----------
    values : array (n)
        Values of the samples, at least 0.
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
        return PercentileRange(low, median, high)
    return PercentileRange(low, median, high, float(least[ends.index(None)]))


def median_noise(values: Float[np.ndarray, " n"], censored: Bool[np.ndarray, " n"]) -> float | None:
    """Return the standard error of the median of n independent samples.

    The rank of the true median among the sorted values is n/2 with the standard deviation √n/2.
    The standard error is therefore half the difference of the values with the ranks n/2 ± √n/2.
    Samples of a Sobol sequence usually have a smaller error.

    Parameters
    ----------
    values : array (n)
        Values of the samples.
    censored : array (n) of bool
        True for a value that is only a lower bound.

    Returns
    -------
    float or None
        Standard error in the unit of the values; None if it depends on censored values.

    References
    ----------
    docs/assess.md, "What is done".
    """
    count = len(values)
    ordered = np.sort(np.where(censored, np.inf, values))
    ranks = np.array([count - count**0.5, count + count**0.5]) / 2.0
    low, high = ordered[np.clip(ranks.round().astype(int), 0, count - 1)]
    return float(high - low) / 2.0 if np.isfinite(high) else None


def fraction_below(
    values: Float[np.ndarray, " n"],
    censored: Bool[np.ndarray, " n"],
    limit: float | Float[np.ndarray, " n"],
    limit_censored: Bool[np.ndarray, " n"] | None = None,
) -> Fraction:
    """Return the fraction of samples whose value is below a limit.

    A censored value below the limit leaves its sample undecided, and so does a censored limit below
    the value.

    Parameters
    ----------
    values : array (n)
        Values of the samples.
    censored : array (n) of bool
        True for a value that is only a lower bound.
    limit : float or array (n)
        The limit in the unit of the values, for all samples or for each of them.
    limit_censored : array (n) of bool, optional
        True for a limit that is only a lower bound; by default no limit is.

    References
    ----------
    docs/assess.md, "What is done".
    """
    less = values < limit
    possible = less if limit_censored is None else less | limit_censored
    return Fraction(float(np.mean(less & ~censored)), float(np.mean(possible)))
