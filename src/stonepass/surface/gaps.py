"""Gaps in height maps: which gaps may be bridged by straight lines, and where the border lies.

An optical instrument returns no height where too little light comes back, so that most of its maps
have gaps. A straight line across a gap of length g differs from a wave of length λ by at most
(πg/λ)²/2 of the amplitude. Gaps are bridged up to a quarter of the shortest wavelength that a
baseline follows.
"""

from __future__ import annotations

import numpy as np

from stonepass.array_types import Bool, Float, Num
from stonepass.surface.surface_image import PixelArea

__all__ = ["BRIDGED", "MISSING", "bridge", "bridgeable", "gap_length", "known_area"]

# Longest gap that is bridged, divided by the shortest wavelength of the second baseline.
BRIDGED = 0.25
MISSING = 0.25  # largest fraction of a profile without heights that is bridged
SPARSE = 0.25  # an edge of a map belongs to the border if a larger fraction of it is missing


def gap_length(known: Bool[np.ndarray, " n"]) -> int:
    """Return the number of samples in the longest gap; `known` is False in gaps."""
    ends = np.flatnonzero(np.concatenate([[True], known, [True]]))
    return int(np.diff(ends).max()) - 1


def bridgeable(known: Bool[np.ndarray, " n"], longest: float) -> bool:
    """Return whether the gaps of a profile may be bridged.

    This is so if both ends have a height, no gap is longer than `longest`, and at most a quarter of
    the profile is missing.

    Parameters
    ----------
    known : array (n) of bool
        True for a sample with a height.
    longest : float
        Length of the longest gap that may be bridged, in samples.

    References
    ----------
    docs/friction.md, "Which files it reads".
    """
    return bool(
        known[0]
        and known[-1]
        and gap_length(known) <= longest
        and np.count_nonzero(~known) <= MISSING * len(known)
    )


def bridge(
    values: Float[np.ndarray, " n"], known: Bool[np.ndarray, " n"]
) -> Float[np.ndarray, " n"]:
    """Return a profile whose gaps are filled by straight lines between the heights next to them.

    Parameters
    ----------
    values : array (n)
        Heights in m; the values in gaps are ignored.
    known : array (n) of bool
        True for a sample with a height.

    References
    ----------
    docs/friction.md, "Which files it reads".
    """
    places = np.arange(len(values))
    return np.interp(places, places[known], values[known])


def known_area(values: Num[np.ndarray, "rows columns"], area: PixelArea) -> PixelArea | None:
    """Return the part of an area that remains without a border in which many heights are missing.

    The row or column at the edge with the largest fraction of missing heights is removed, until at
    most a quarter of each edge is missing.

    Parameters
    ----------
    values : array (rows, columns)
        Heights in m; NaN where one is missing.
    area : PixelArea
        The area in pixels.

    Returns
    -------
    PixelArea or None
        None if fewer than 2 × 2 pixels are left.

    References
    ----------
    docs/friction.md, "Which files it reads".
    """
    known = np.isfinite(values)
    left, top, right, bottom = area.left, area.top, area.right, area.bottom
    while right - left >= 2 and bottom - top >= 2:
        part = known[top:bottom, left:right]
        edges = (part[:, 0], part[0], part[:, -1], part[-1])
        missing = [1.0 - np.count_nonzero(edge) / len(edge) for edge in edges]
        worst = int(np.argmax(missing))
        if missing[worst] <= SPARSE:
            return PixelArea(left, top, right, bottom)
        left, top = left + (worst == 0), top + (worst == 1)
        right, bottom = right - (worst == 2), bottom - (worst == 3)
    return None
