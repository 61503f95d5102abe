"""What Monte Carlo samples of one patient say: intervals of pressures and fractions of samples."""

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
AGREE = 0.02  # of a quantile with and without censored samples: then it is stated
MORE, FEWER, NEAR = "more than the model expects", "fewer than the model expects", "near the model"
UNDECIDED = "the model does not decide"
FAR_APART = 0.2  # of two fractions, to be called a contradiction


@dataclass(frozen=True)
class Range:
    """Median and 90 % interval in Pa.

    An end that lies beyond what the model can tell is None; `at_least` is then what it exceeds.
    """

    low: float | None
    median: float | None
    high: float | None
    at_least: float | None = None


@dataclass(frozen=True)
class Fraction:
    """A fraction of the samples: at least `low`, and at most `high` where some are not decided."""

    low: float
    high: float

    def noise(self, count: int) -> float:
        """Return its standard error for `count` independent samples, that of the larger end."""
        return max((each * (1.0 - each) / count) ** 0.5 for each in (self.low, self.high))

    def describe(self) -> str:
        """Return it in words: ``60 %``, ``fewer than 1 %``, ``55 to 62 %``."""
        low, high = (round(100.0 * each) for each in (self.low, self.high))
        if low != high:
            return f"{low} to {high} %"
        if low == 0:
            return "fewer than 1 %"
        return "more than 99 %" if low == 100 else f"{low} %"


@array_dataclass
@dataclass(frozen=True)
class Present:
    """Present urine pressure of every sample.

    Attributes
    ----------
    pressure : array (n)
        In Pa.
    censored : array (n)
        Where the pressure is only a lower bound.
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
        Where P_ucr is only a lower bound.
    loose : array (n)
        Where the stone is no larger than the lumen.
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
        """Return the fraction with P_ucr below a pressure, of all samples or of those `chosen`."""
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

    A quantile is stated only where it stays, to within `AGREE`, however far the censored values
    are exceeded.
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
    """Return whether the fraction of stones that passed is far from that below the limit."""
    if fraction is None:
        return ""
    if fraction.high - fraction.low > FAR_APART:
        return UNDECIDED
    if passed > fraction.high + FAR_APART:
        return MORE
    if passed < fraction.low - FAR_APART:
        return FEWER
    return NEAR
