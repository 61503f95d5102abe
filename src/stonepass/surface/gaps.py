"""Gaps in a height map: which of them a profile may bridge, and where the map's border lies.

Optical instruments return no height where too little light comes back, so most of their maps have
gaps. A straight line over a gap of length g misses a wave of length λ by at most (πg/λ)²/2 of its
amplitude; gaps of up to a quarter of the shortest wave that a baseline follows are bridged.
"""

from __future__ import annotations

import numpy as np

from stonepass.array_types import Bool, Float, Num
from stonepass.surface.surface_image import Area

__all__ = ["BRIDGED", "bridge", "bridgeable", "gap_length", "known_area"]

BRIDGED = 0.25  # of the shortest wave of the deviation's baseline: the longest gap that is bridged
MISSING = 0.25  # of a profile: the largest fraction without heights that is bridged
SPARSE = 0.25  # of an edge of a map: with more than this missing it belongs to the border


def gap_length(known: Bool[np.ndarray, " n"]) -> int:
    """Number of samples in the longest run without a height."""
    ends = np.flatnonzero(np.concatenate([[True], known, [True]]))
    return int(np.diff(ends).max()) - 1


def bridgeable(known: Bool[np.ndarray, " n"], longest: float) -> bool:
    """Whether a profile has heights at both ends and gaps of at most `longest` samples between."""
    return bool(
        known[0]
        and known[-1]
        and gap_length(known) <= longest
        and np.count_nonzero(~known) <= MISSING * len(known)
    )


def bridge(
    values: Float[np.ndarray, " n"], known: Bool[np.ndarray, " n"]
) -> Float[np.ndarray, " n"]:
    """Return a profile whose gaps are straight lines between the heights beside them."""
    places = np.arange(len(values))
    return np.interp(places, places[known], values[known])


def known_area(values: Num[np.ndarray, "rows columns"], area: Area) -> Area | None:
    """Return the part of an area that is left without the border where heights are missing.

    The edge with the largest missing fraction is taken away until no edge misses more than a
    quarter of its heights.

    Returns
    -------
    area : Area or None
        None where fewer than 2 × 2 pixels are left.
    """
    known = np.isfinite(values)
    left, top, right, bottom = area.left, area.top, area.right, area.bottom
    while right - left >= 2 and bottom - top >= 2:
        part = known[top:bottom, left:right]
        edges = (part[:, 0], part[0], part[:, -1], part[-1])
        missing = [1.0 - np.count_nonzero(edge) / len(edge) for edge in edges]
        worst = int(np.argmax(missing))
        if missing[worst] <= SPARSE:
            return Area(left, top, right, bottom)
        left, top = left + (worst == 0), top + (worst == 1)
        right, bottom = right - (worst == 2), bottom - (worst == 3)
    return None
