"""Published cohorts: how many stones of a size, or at a place, passed without intervention.

Every number was read in the source itself or in a secondary source that quotes it; `Cohort.read`
says which. The cohorts differ in the definition of the size of a stone, in the duration of the
follow-up, and in the patients that were excluded.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

__all__ = ["COHORTS", "PLACES", "Cohort", "PassageRate", "Row", "place_meant", "rows_for", "wilson"]

PLACES = ("proximal", "mid", "distal", "UVJ")
# Other words for the places; only words with a single meaning are listed.
_OTHER_WORDS = {
    "upper": "proximal", "upj": "proximal", "pelviureteric junction": "proximal",
    "ureteropelvic junction": "proximal", "middle": "mid", "lower": "distal",
    "vuj": "UVJ", "ureterovesical junction": "UVJ", "vesicoureteric junction": "UVJ",
}  # fmt: skip
ITSELF, QUOTED = "itself", "quoted"
NORMAL_95 = 1.959963984540054  # quantile of the standard normal distribution at 97.5 %


@dataclass(frozen=True)
class PassageRate:
    """The fraction of stones of a size class, or at a place, that passed.

    Attributes
    ----------
    label : str
        Size class or place as printed in the source.
    low, high : float
        Bounds of the class in mm: low ≤ size < high.
    passed : float or None
        Fraction of stones that passed, 0 to 1; None if the source has only a time to passage.
    days : float or None
        Mean time to passage in days; None if it is not known.
    count : int or None
        Number of stones in the class; None if it is not known.
    published : (float, float) or None
        Confidence interval of the fraction, if the source states one.
    """

    label: str
    low: float
    high: float
    passed: float | None
    days: float | None = None
    count: int | None = None
    published: tuple[float, float] | None = None


@dataclass(frozen=True)
class Cohort:
    """A published cohort.

    Attributes
    ----------
    name : str
        First authors and year.
    source : str
        Citation as far as it is known; it begins with "unverified" if no citable publication is
        known, or if the numbers could not be compared with it.
    read : str
        ``itself`` if the source was read, at least its abstract; ``quoted`` if its numbers were
        read in another source.
    about : str
        Which stones were observed, how and for how long.
    by_size, by_place : tuple of PassageRate
        Rates of size classes, and of places in the ureter.
    """

    name: str
    source: str
    read: str
    about: str
    by_size: tuple[PassageRate, ...] = ()
    by_place: tuple[PassageRate, ...] = ()


@dataclass(frozen=True)
class Row:
    """One rate of a cohort that concerns a stone.

    Attributes
    ----------
    cohort : Cohort
        The cohort.
    group : str
        Size class or place as printed.
    passed, days, count, published
        Attributes of the `PassageRate`.
    sizes : (float, float) or None
        Size class in mm; None for a place.
    """

    cohort: Cohort
    group: str
    passed: float | None
    sizes: tuple[float, float] | None = None
    days: float | None = None
    count: int | None = None
    published: tuple[float, float] | None = None

    @property
    def interval(self) -> tuple[float, float] | None:
        """Published interval of `passed`, or else Wilson's 95 % interval; None if it is unknown."""
        if self.published is not None or self.passed is None or self.count is None:
            return self.published
        return wilson(self.passed, self.count)


def wilson(fraction: float, count: int) -> tuple[float, float]:
    """Return Wilson's 95 % confidence interval of an observed fraction.

    Parameters
    ----------
    fraction : float
        Observed fraction, 0 to 1.
    count : int
        Number of observed cases, at least 1.

    Returns
    -------
    (float, float)
        Lower and upper end, 0 to 1.

    References
    ----------
    Wilson 1927, Journal of the American Statistical Association 22, 209–212.

    Examples
    --------
    >>> tuple(round(end, 3) for end in wilson(8 / 16, 16))
    (0.28, 0.72)
    """
    square = NORMAL_95**2 / count
    centre = (fraction + square / 2.0) / (1.0 + square)
    variance = fraction * (1.0 - fraction) / count + square / (4.0 * count)
    half = NORMAL_95 * math.sqrt(variance) / (1.0 + square)
    return max(centre - half, 0.0), min(centre + half, 1.0)


def place_meant(word: str) -> str:
    """Return the place in `PLACES` that another common word means; empty for an unknown word."""
    return _OTHER_WORDS.get(word.strip().casefold(), "")


def _places(*rates: tuple[str, float, int | None]) -> tuple[PassageRate, ...]:
    return tuple(PassageRate(name, 0.0, math.inf, passed, None, n) for name, passed, n in rates)


COHORTS = (
    Cohort(
        "Jendeberg 2017",
        "Jendeberg et al. 2017, Eur Radiol, doi:10.1007/s00330-017-4852-6",
        QUOTED,
        "width in CT, passed within 20 weeks; 391 stones in the companion paper",
        (
            PassageRate("0–2 mm", 0.0, 2.5, 0.98),
            PassageRate("3 mm", 2.5, 3.5, 0.98),
            PassageRate("4 mm", 3.5, 4.5, 0.81),
            PassageRate("5 mm", 4.5, 5.5, 0.65),
            PassageRate("6 mm", 5.5, 6.5, 0.33),
            PassageRate("≥ 6.5 mm", 6.5, math.inf, 0.09),
        ),
    ),
    Cohort(
        "Coll 2002",
        "Coll, Varanelli, Smith 2002, AJR 178(1):101–103, doi:10.2214/ajr.178.1.1780101",
        ITSELF,
        "172 stones, largest diameter in the axial plane of CT",
        (
            PassageRate("1 mm", 0.0, 1.5, 0.87),
            PassageRate("2–4 mm", 1.5, 4.5, 0.76),
            PassageRate("5–7 mm", 4.5, 7.0, 0.60),
            PassageRate("7–9 mm", 7.0, 9.0, 0.48),
            PassageRate("> 9 mm", 9.0, math.inf, 0.25),
        ),
        _places(
            ("proximal", 0.48, None),
            ("mid", 0.60, None),
            ("distal", 0.75, None),
            ("UVJ", 0.79, None),
        ),
    ),
    Cohort(
        "Miller & Kane 1999",
        "Miller, Kane 1999, J Urol 162:688–691",
        ITSELF,
        "75 patients, passed without intervention",
        (
            PassageRate("≤ 2 mm", 0.0, 2.0, 39 / 41, 8.2, 41),
            PassageRate("2–4 mm", 2.0, 4.0, 15 / 18, 12.2, 18),
            PassageRate("≥ 4 mm", 4.0, math.inf, 8 / 16, 22.1, 16),
        ),
    ),
    Cohort(
        "Hübner 1993",
        "Hübner et al. 1993, Eur Urol 24:172–176, PubMed 8375436",
        ITSELF,
        "6 studies before CT, 2704 patients in all, selected",
        (PassageRate("< 4 mm", 0.0, 4.0, 0.38), PassageRate("> 6 mm", 6.0, math.inf, 0.012)),
        _places(("proximal", 0.12, None), ("mid", 0.22, None), ("distal", 0.45, None)),
    ),
    Cohort(
        "Park 2021",
        "Park JS et al. 2021, PLoS One 16(12):e0260517, doi:10.1371/journal.pone.0260517",
        ITSELF,
        "833 patients in all",
        (PassageRate("< 5 mm", 0.0, 5.0, 0.756), PassageRate("5–10 mm", 5.0, 10.0, 0.682)),
    ),
    Cohort(
        "AUA/EAU analysis",
        "unverified in the source: EAU/AUA guideline (Preminger et al. 2007, Eur Urol "
        "52:1610–1631), as quoted in doi:10.29337/j.isjp.2017.09.002",
        QUOTED,
        "pooled studies; the intervals are those of the analysis",
        (
            PassageRate("≤ 5 mm", 0.0, 5.0, 0.68, published=(0.46, 0.85)),
            PassageRate("5–10 mm", 5.0, 10.0, 0.47, published=(0.36, 0.59)),
        ),
    ),
    Cohort(
        "Tchey 2011",
        "Tchey et al. 2011, Korean J Urol 52(12):847–851, doi:10.4111/kju.2011.52.12.847",
        ITSELF,
        "656 patients; mean time of the stones that passed",
        (
            PassageRate("all sizes", 0.0, math.inf, 566 / 656, None, 656),
            PassageRate("< 2 mm", 0.0, 2.0, None, 6.8),
            PassageRate("2–4 mm", 2.0, 4.0, None, 12.6),
            PassageRate("4–6 mm", 4.0, 6.0, None, 14.8),
            PassageRate("6–8 mm", 6.0, 8.0, None, 21.8),
        ),
    ),
    Cohort(
        "Ongün 2019",
        "Ongün, Dursun 2019, J Urol Surg 6(2):139–143, doi:10.4274/jus.galenos.2018.2335",
        ITSELF,
        "distal stones up to 10 mm",
        by_place=_places(("distal", 0.776, 245)),
    ),
    Cohort(
        "Ahmed 2014",
        "Ahmed et al. 2014, Arab J Urol 13(2):84–90, doi:10.1016/j.aju.2014.11.004",
        ITSELF,
        "stones up to 10 mm; 24.0 ± 8.1 days to pass",
        (PassageRate("≤ 10 mm", 0.0, 10.0, 0.779, 24.0, 163),),
    ),
    Cohort(
        "Kori Hospital 2019",
        "Ureteral wall thickness as a significant factor in predicting spontaneous passage 2019, "
        "World J Urol 37(5):913–919, doi:10.1007/s00345-018-2461-x",
        ITSELF,
        "stones up to 10 mm, passed within 4 weeks; 76 % where the wall at the stone was thinner "
        "than 2.71 mm, 15 % where it was thicker",
        (PassageRate("≤ 10 mm", 0.0, 10.0, 0.483, None, 418),),
    ),
)  # fmt: skip


def rows_for(low: float, high: float, place: str | None) -> list[Row]:
    """Return the published passage rates for a range of sizes and for a place in the ureter.

    Parameters
    ----------
    low, high : float
        Smallest and largest diameter of the stone in mm.
    place : str or None
        Place in the ureter, one of `PLACES`; None if it is unknown.

    References
    ----------
    docs/assess.md, "What is done".
    """
    rows = []
    for cohort in COHORTS:
        for rate in cohort.by_size:
            if _overlap(rate, low, high):
                rows.append(_row(cohort, rate, (rate.low, rate.high)))
        rows += [_row(cohort, rate, None) for rate in cohort.by_place if rate.label == place]
    return rows


def _row(cohort: Cohort, rate: PassageRate, sizes: tuple[float, float] | None) -> Row:
    return Row(cohort, rate.label, rate.passed, sizes, rate.days, rate.count, rate.published)


def _overlap(rate: PassageRate, low: float, high: float) -> bool:
    """Return whether a size class and a range overlap in more than a single point."""
    if low == high:
        return rate.low <= low < rate.high
    return rate.low < high and low < rate.high
