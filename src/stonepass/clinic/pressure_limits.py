"""Urine pressures that were measured or proposed as limits, each with its source."""

from __future__ import annotations

from dataclasses import dataclass

from stonepass.units import Pressure

__all__ = ["LIMITS", "PressureLimit", "describe_limit"]


@dataclass(frozen=True)
class PressureLimit:
    """A published pressure limit.

    Attributes
    ----------
    pressure : Pressure
        The pressure in Pa.
    what : str
        How it was measured or why it was proposed.
    source : str
        The publication, as far as it can be cited.
    """

    pressure: Pressure
    what: str
    source: str


_NEPHROSTOMY = "EAU congress 2007, abstract 71, read at urotoday.com"
LIMITS = (
    PressureLimit(
        Pressure(2e3),
        "measured above a stone: basal 19.5 ± 1.5 cmH₂O (1.9 kPa) in 41 patients with nephrostomy",
        _NEPHROSTOMY,
    ),
    PressureLimit(
        Pressure(4e3),
        "peak of an acute obstruction in rabbits, 42 cmH₂O (4.1 kPa) after 3 h",
        "unverified: Time course of ureteral changes with obstruction, authors and journal not "
        "known; abstract read at scilit.com, record 64e68051",
    ),
    PressureLimit(
        Pressure(6e3),
        "largest measured above a stone during lithotripsy: 61 cmH₂O (6.0 kPa), 41 patients",
        _NEPHROSTOMY,
    ),
    PressureLimit(
        Pressure(8e3),
        "about the mean in the renal pelvis while stones are treated by ureteroscopy: 54 ± 18 mmHg "
        "(7.2 ± 2.4 kPa), 12 patients",
        "Intraluminal pressure profiles during flexible ureterorenoscopy 2015, "
        "doi:10.1186/s40064-015-1114-4",
    ),
    PressureLimit(
        Pressure(12e3),
        "the limit of the paper, which cites a study of minipigs; ink entered the veins of pig "
        "kidneys ex vivo from 90 mmHg (12.0 kPa)",
        "Liu et al. 2022, doi:10.1016/j.jmbbm.2022.105432; WCET congress, abstract 4800",
    ),
)


def describe_limit(limit: float) -> str:
    """Return the meaning and source of a limit in Pa; other limits are the user's own."""
    for known in LIMITS:
        if abs(limit - known.pressure) < 1e-6 * known.pressure:
            return f"{known.what} ({known.source})"
    return "chosen by the user, without a published source"
