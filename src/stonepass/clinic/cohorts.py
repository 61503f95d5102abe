"""Published cohorts: the fraction of stones that passed, by size and by place in the ureter.

All numbers were read in the publication itself or in another one that quotes it; the attribute
`Cohort.read` says which. The cohorts differ in the definition of size, in the duration of the
follow-up, and in the patients that were excluded.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

__all__ = ["COHORTS", "PLACES", "Cohort", "Rate", "Row", "rows_for"]

PLACES = ("proximal", "mid", "distal", "UVJ")  # UVJ: ureterovesical junction
ITSELF, QUOTED = "itself", "quoted"  # where a number was read


@dataclass(frozen=True)
class Rate:
    """The passage rate of the stones of a size class.

    Attributes
    ----------
    label : str
        Size class as printed.
    low, high : float
        Bounds of the class in mm: low ≤ size < high.
    passed : float or None
        Fraction of stones that passed, 0 to 1; None if only the time was published.
    days : float or None
        Mean time to passage in days; None if it was not published.
    count : int or None
        Number of stones; None if it was not published.
    """

    label: str
    low: float
    high: float
    passed: float | None
    days: float | None = None
    count: int | None = None


@dataclass(frozen=True)
class Cohort:
    """A published cohort.

    Attributes
    ----------
    name : str
        Author and year.
    source : str
        Publication, as a DOI or a citation.
    read : {"itself", "quoted"}
        Whether the numbers were read in the publication itself or in another one that quotes it.
    about : str
        Imaging method, number of patients and follow-up.
    by_size : tuple of Rate
        Passage rates by size class.
    by_place : tuple of (str, float)
        Fraction of stones that passed by place in the ureter (`PLACES`).
    """

    name: str
    source: str
    read: str
    about: str
    by_size: tuple[Rate, ...] = ()
    by_place: tuple[tuple[str, float], ...] = ()


@dataclass(frozen=True)
class Row:
    """One passage rate of a cohort that applies to a stone.

    Attributes
    ----------
    cohort : Cohort
        The cohort.
    group : str
        Size class or place, as printed.
    passed : float or None
        Fraction of stones that passed, 0 to 1; None if only the time was published.
    sizes : (float, float) or None
        Bounds of the size class in mm; None for a place.
    days : float or None
        Mean time to passage in days.
    count : int or None
        Number of stones.
    """

    cohort: Cohort
    group: str
    passed: float | None
    sizes: tuple[float, float] | None = None
    days: float | None = None
    count: int | None = None


COHORTS = (
    Cohort(
        "Jendeberg 2017",
        "doi 10.1007/s00330-017-4852-6",
        QUOTED,
        "CT, width, within 20 weeks",
        (
            Rate("0–2 mm", 0.0, 2.5, 0.98),
            Rate("3 mm", 2.5, 3.5, 0.98),
            Rate("4 mm", 3.5, 4.5, 0.81),
            Rate("5 mm", 4.5, 5.5, 0.65),
            Rate("6 mm", 5.5, 6.5, 0.33),
            Rate("≥ 6.5 mm", 6.5, math.inf, 0.09),
        ),
    ),
    Cohort(
        "Coll 2002",
        "doi 10.2214/ajr.178.1.1780101",
        ITSELF,
        "CT, largest axial diameter, 172 stones",
        (
            Rate("1 mm", 0.0, 1.5, 0.87),
            Rate("2–4 mm", 1.5, 4.5, 0.76),
            Rate("5–7 mm", 4.5, 7.0, 0.60),
            Rate("7–9 mm", 7.0, 9.0, 0.48),
            Rate("> 9 mm", 9.0, math.inf, 0.25),
        ),
        (("proximal", 0.48), ("mid", 0.60), ("distal", 0.75), ("UVJ", 0.79)),
    ),
    Cohort(
        "Miller & Kane 1999",
        "J Urol 162:688–691",
        ITSELF,
        "75 patients, passed without intervention",
        (
            Rate("≤ 2 mm", 0.0, 2.0, 39 / 41, 8.2, 41),
            Rate("2–4 mm", 2.0, 4.0, 15 / 18, 12.2, 18),
            Rate("≥ 4 mm", 4.0, math.inf, 8 / 16, 22.1, 16),
        ),
    ),
    Cohort(
        "Hübner 1993",
        "Eur Urol 24:172–176",
        ITSELF,
        "6 studies before CT, 2704 patients, selected",
        (Rate("< 4 mm", 0.0, 4.0, 0.38), Rate("> 6 mm", 6.0, math.inf, 0.012)),
        (("proximal", 0.12), ("mid", 0.22), ("distal", 0.45)),
    ),
    Cohort(
        "Park 2021",
        "Park et al. 2021, abstract at yonsei.pure.elsevier.com",
        ITSELF,
        "833 patients",
        (Rate("< 5 mm", 0.0, 5.0, 0.756), Rate("5–10 mm", 5.0, 10.0, 0.682)),
    ),
    Cohort(
        "AUA/EAU analysis",
        "cited in doi 10.29337/j.isjp.2017.09.002",
        QUOTED,
        "pooled; from 46 to 85 and from 36 to 59 %",
        (Rate("≤ 5 mm", 0.0, 5.0, 0.68), Rate("5–10 mm", 5.0, 10.0, 0.47)),
    ),
    Cohort(
        "Tchey 2011",
        "doi 10.4111/kju.2011.52.12.847",
        ITSELF,
        "656 patients, of whom 86.3 % passed; mean time of those",
        (
            Rate("< 2 mm", 0.0, 2.0, None, 6.8),
            Rate("2–4 mm", 2.0, 4.0, None, 12.6),
            Rate("4–6 mm", 4.0, 6.0, None, 14.8),
            Rate("6–8 mm", 6.0, 8.0, None, 21.8),
        ),
    ),
    Cohort(
        "Ongün 2019",
        "doi 10.4274/jus.galenos.2018.2335",
        ITSELF,
        "245 patients, distal stones up to 10 mm",
        by_place=(("distal", 0.776),),
    ),
    Cohort(
        "Ahmed 2014",
        "PMC4561928",
        ITSELF,
        "163 patients; 24.0 ± 8.1 days to pass",
        (Rate("≤ 10 mm", 0.0, 10.0, 0.779, 24.0, 163),),
    ),
    Cohort(
        "Kori Hospital 2019",
        "doi 10.1007/s00345-018-2461-x",
        ITSELF,
        "418 patients, within 4 weeks; 76 % with a wall at the stone below 2.71 mm, 15 % else",
        (Rate("≤ 10 mm", 0.0, 10.0, 0.483, None, 418),),
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
                sizes = (rate.low, rate.high)
                rows.append(Row(cohort, rate.label, rate.passed, sizes, rate.days, rate.count))
        rows += [Row(cohort, name, passed) for name, passed in cohort.by_place if name == place]
    return rows


def _overlap(rate: Rate, low: float, high: float) -> bool:
    """Return whether a size class and a range overlap, in more than a single point."""
    if low == high:
        return rate.low <= low < rate.high
    return rate.low < high and low < rate.high
