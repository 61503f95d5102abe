"""Comparison of published passage rates with the model's fraction below the pressure limit."""

from __future__ import annotations

from stonepass.studies.censored_samples import Fraction

__all__ = ["FEWER", "MORE", "contradiction"]

MORE, FEWER, NEAR = "more than in the model", "fewer than in the model", "near the model"
UNDECIDED = "undecided by the model"
FAR_APART = 0.2  # difference of two fractions above which they contradict one another


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
