"""The friction coefficient from the slopes of a stone's surface (paper, section 2.3 and Eq. 18).

Grey values become heights by scaling their range to the known height range; the profiles of several
paths are averaged; the mean profile has a baseline, whose largest slope is k₀, and the deviation
from it a richer baseline, whose largest slope is k₁; μ_f = tan(arctan k₀ + arctan k₁) (Popov 2017).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from math import sqrt
from numbers import Integral
from typing import Any

import numpy as np

from stonepass.array_types import Float, Num
from stonepass.caution import Caution, caution
from stonepass.errors import BadInput, require
from stonepass.surface.baseline import POWERS, Baseline, fit_baseline
from stonepass.surface.paths import Profiles, StraightPath, evenly_spaced, profiles_along
from stonepass.surface.surface_image import SurfaceImage
from stonepass.units import Length, length

__all__ = [
    "CRYSTAL_DIAGONAL",
    "RELIEF",
    "Roughness",
    "Spread",
    "SurfaceFriction",
    "friction_of_slopes",
    "surface_friction",
]

CRYSTAL_DIAGONAL = sqrt(3.0)  # height range over the edge of a cubic crystal (section 2.3)
RELIEF = (1e-9, 1e-2)  # m
ORDER = (1, 200)
RICHER = 2  # order of the deviation's baseline over that of the first
SAMPLES = 4  # least number of samples for each term of a baseline
ROWS = 512  # looked at together
LEVELS = 16  # least number of grey levels of a picture that is not flat
SATURATED = 0.25  # of the pixels at the ends of the greys, at which heights are cut off
TELL_SATURATED = 0.1  # more than the tops and bottoms of a smooth surface take
GAP = 0.1  # of the greys, empty beside the brightest or darkest: what writing leaves
PLAIN_ROWS = 0.01  # of the rows, of one grey or two: a bar, or a part that is missing
SMOOTHED = 5  # pixels along each side, over which grey is averaged before its range is taken
PERCENTILES = (0.1, 99.9)
FACTORS = (0.5, 0.75, 1.0, 1.25, 1.5)  # of the first order, both together
SCALINGS = ("smoothed range", "range", "percentiles")
LARGEST = 2.0  # μ_f that a case takes


@dataclass(frozen=True)
class Roughness:
    """Roughness of the single profiles less their mean lines, averaged over the paths.

    `Ra` and `Rq` are in m; `RdeltaQ` is the root mean square of dz/dx, seven-point differences. No
    filter sets waviness apart, so these are Pa, Pq and PΔq of ISO 21920.
    """

    Ra: float
    Rq: float
    RdeltaQ: float


@dataclass(frozen=True)
class Spread:
    """How μ_f moves with what was chosen.

    Attributes
    ----------
    paths : tuple of float
        μ_f without one path, for each; empty for a single path.
    orders : tuple of (int, float)
        Order of the first baseline and μ_f, the second one as much richer.
    height_range : tuple of (str, float)
        How grey is scaled to the height range, and μ_f; empty for heights.
    """

    paths: tuple[float, ...]
    orders: tuple[tuple[int, float], ...]
    height_range: tuple[tuple[str, float], ...]

    @property
    def sd(self) -> float | None:
        """Standard deviation of μ_f: jackknife over paths, orders and scalings, put together.

        None where μ_f does not exist for one of the choices.
        """
        parts = [_sd([mu for _, mu in self.orders]), _sd([mu for _, mu in self.height_range])]
        count = len(self.paths)
        if count > 1:
            parts.append(_sd(self.paths) * (count - 1) / sqrt(count))
        total = sqrt(sum(part**2 for part in parts))
        return total if np.isfinite(total) else None


@dataclass(frozen=True)
class SurfaceFriction:
    """The friction coefficient of a surface, and all that it was computed from.

    Attributes
    ----------
    picture : SurfaceImage
    friction : float
        μ_f (Eq. 18).
    baseline, deviation_baseline : Baseline
        Of the mean profile, and of what is left of it; their largest slopes are k₀ and k₁.
    height_range : float or None
        In m; None for a height map.
    distance, profiles, mean : array
        Distance from the start of the paths in m, heights along each, and their mean.
    roughness : Roughness
    spread : Spread
    warnings : tuple of Caution
    """

    picture: SurfaceImage
    friction: float
    baseline: Baseline
    deviation_baseline: Baseline
    height_range: float | None
    paths: tuple[StraightPath, ...]
    distance: Float[np.ndarray, " n"]
    profiles: Float[np.ndarray, "paths n"]
    roughness: Roughness
    spread: Spread
    warnings: tuple[Caution, ...] = ()

    @property
    def mean(self) -> Float[np.ndarray, " n"]:
        """The mean profile in m."""
        return self.profiles.mean(axis=0)

    @property
    def deviation(self) -> Float[np.ndarray, " n"]:
        """The mean profile less its baseline, in m."""
        return self.mean - self.baseline.at(self.distance)

    @property
    def k0(self) -> float:
        """Largest slope of the baseline."""
        return self.baseline.steepest

    @property
    def k1(self) -> float:
        """Largest slope of the deviation's baseline."""
        return self.deviation_baseline.steepest


def friction_of_slopes(k0: float, k1: float) -> float:
    """μ_f = tan(arctan k₀ + arctan k₁) (Eq. 18).

    Raises
    ------
    BadInput
        Where k₀ k₁ ≥ 1: the two slopes together are upright or overhang.
    """
    require(k0 >= 0.0 and k1 >= 0.0, "slopes", f"{k0:g} and {k1:g}", "not negative")
    if k0 * k1 >= 1.0:
        raise BadInput("product of the slopes k0 and k1", f"{k0:.3g} × {k1:.3g}", "below 1",
                       "check the height range and the pixel size")  # fmt: skip
    return (k0 + k1) / (1.0 - k0 * k1)


def surface_friction(
    picture: SurfaceImage,
    height_range: str | Length | None = None,
    paths: int | Sequence[StraightPath] = 6,
    baseline_order: int = 8,
    deviation_order: int | None = None,
) -> SurfaceFriction:
    """Find the friction coefficient of a surface from its picture.

    Parameters
    ----------
    picture : SurfaceImage
        With a pixel size.
    height_range : str or Length
        Height from the darkest to the brightest grey, both of means over 5 × 5 pixels, 1 nm to
        10 mm; the paper takes √3 edges of its cubic crystals. Left out for a height map.
    paths : int or sequence of StraightPath
        A number of horizontal paths, evenly spaced; or the paths themselves.
    baseline_order : int
        N of the mean profile's baseline: it follows waves down to 2L/N. 1 to 200.
    deviation_order : int, optional
        That of the deviation's baseline, larger; twice as large by default. In the same basis
        a least-squares residual has no baseline, so its slope would be zero.

    Raises
    ------
    BadInput
        A flat or saturated picture, a height range that is missing or too much, paths too short
        for the baselines, or slopes with k₀ k₁ ≥ 1.
    """
    scale = _height_range(picture, height_range)
    first_order, second_order = _orders(baseline_order, deviation_order)
    warnings = _look_at(picture)
    chosen = _chosen(picture, paths)
    sampled = profiles_along(picture, chosen)
    samples = len(sampled.distance)
    require(
        second_order <= _most(samples),
        "order of the deviation's baseline",
        second_order,
        f"at most {_most(samples)} for paths of {samples} pixels",
        "choose longer paths or a smaller order",
    )
    ranges = [] if scale is None else _grey_ranges(picture)
    heights = _heights(sampled.values, scale, ranges[0][1] if ranges else (0.0, 1.0))
    first, rest, friction = _fit(sampled.distance, heights.mean(axis=0), first_order, second_order)
    spread = _spread(sampled, heights, scale, ranges, (first_order, second_order))
    if len(chosen) == 1:
        warnings.append(caution("single_path"))
    if spread.sd is None:
        warnings.append(caution("friction_spread_missing"))
    if len(spread.orders) < len(FACTORS):
        warnings.append(caution("paths_too_short"))
    if any(part.at_edge for part in (first, rest)):
        warnings.append(caution("baseline_at_path_end"))
    if friction > LARGEST:
        warnings.append(caution("friction_beyond_range", largest=LARGEST))
    return SurfaceFriction(
        picture,
        friction,
        first,
        rest,
        scale,
        tuple(chosen),
        sampled.distance,
        heights,
        _roughness(sampled.distance, heights),
        spread,
        (*warnings, *sampled.warnings),
    )


def _chosen(picture: SurfaceImage, paths: Any) -> list[StraightPath]:
    if isinstance(paths, Integral) and not isinstance(paths, bool):
        return evenly_spaced(picture, int(paths))
    listed = list(paths) if isinstance(paths, Iterable) else [paths]
    for each in listed:
        require(isinstance(each, StraightPath), "paths", each, "a whole number, or paths")
    return listed


def _height_range(picture: SurfaceImage, height_range: str | Length | None) -> float | None:
    if picture.has_heights:
        if height_range is not None:
            raise BadInput(
                "height range", str(height_range), "left out", "a height map has its own"
            )
        return None
    if height_range is None:
        raise BadInput(
            "height range", "missing", "given for a grey picture, as --height-range or --crystal"
        )
    scale = length(height_range, "height range")
    low, high = RELIEF
    require(low <= scale <= high, "height range", str(height_range), "1 nm to 10 mm")
    return float(scale)


def _orders(first: int, second: int | None) -> tuple[int, int]:
    low, high = ORDER
    found: list[int] = []
    for name, order in (("baseline", first), ("deviation's baseline", second)):
        if order is None:
            found.append(min(RICHER * found[0], high))
            continue
        whole = isinstance(order, Integral) and not isinstance(order, bool)
        allowed = f"a whole number from {low} to {high}"
        require(whole and low <= order <= high, f"order of the {name}", order, allowed)
        found.append(int(order))
    why = "in the same basis the deviation has no slope"
    require(found[1] > found[0], "order of the deviation's baseline", found[1],
            f"larger than that of the first, {found[0]}", why)  # fmt: skip
    return found[0], found[1]


def _look_at(picture: SurfaceImage) -> list[Caution]:
    """Refuse what is flat or cut off; warn of what looks like no surface."""
    values = picture.surface
    if picture.has_heights:
        known = values[np.isfinite(values)]
        flat = known.size == 0 or not float(np.ptp(known)) > 0.0
        require(not flat, "height map", "flat or empty", "of a rough surface")
        return []
    counts = np.zeros(picture.full_scale + 1, int)
    for start in range(0, len(values), ROWS):  # each number becomes eight bytes here
        counts += np.bincount(values[start : start + ROWS].ravel(), minlength=len(counts))
    greys = np.flatnonzero(counts)
    low, high = int(greys[0]), int(greys[-1])
    shown = f"flat, with greys from {low} to {high}"
    require(high - low >= LEVELS, "picture", shown, f"of at least {LEVELS} grey levels")
    ends = float(counts[low] + counts[high]) / values.size
    allowed = f"less than {SATURATED:.0%} of it"
    require(ends < SATURATED, "darkest or brightest grey", f"{ends:.0%} of the picture", allowed,
            "take one that is not saturated")  # fmt: skip
    told = []
    if ends > TELL_SATURATED:
        told.append(caution("saturated_greys", fraction=ends))
    gaps = np.diff(greys) > GAP * (high - low)
    if gaps[0] or gaps[-1]:
        told.append(caution("isolated_grey"))
    plain = float(np.mean(np.ptp(values, axis=1) <= 1))
    if plain > PLAIN_ROWS:
        told.append(caution("plain_rows", fraction=plain))
    return told


def _grey_ranges(picture: SurfaceImage) -> list[tuple[str, tuple[float, float]]]:
    """Greys of height nought and of the whole height range, by each of `SCALINGS`.

    Single pixels reach further than the surface does, by their noise; their mean over a few does so
    less.
    """
    from scipy.ndimage import uniform_filter

    values: Num[np.ndarray, "rows columns"] = picture.surface
    smoothed = uniform_filter(values, SMOOTHED, np.float32)
    low, high = np.percentile(values, PERCENTILES)
    ends = (
        (float(smoothed.min()), float(smoothed.max())),
        (float(values.min()), float(values.max())),
        (float(low), float(high)),
    )
    return list(zip(SCALINGS, ends, strict=True))


def _heights(
    values: Float[np.ndarray, "paths n"], height_range: float | None, greys: tuple[float, float]
) -> Float[np.ndarray, "paths n"]:
    if height_range is None:
        return values
    low, high = greys
    require(high > low, "picture", "flat", "of a rough surface")
    return height_range * (values - low) / (high - low)


def _fit(
    distance: Float[np.ndarray, " n"], mean: Float[np.ndarray, " n"], first: int, second: int
) -> tuple[Baseline, Baseline, float]:
    baseline = fit_baseline(distance, mean, first)
    rest = fit_baseline(distance, mean - baseline.at(distance), second)
    return baseline, rest, friction_of_slopes(baseline.steepest, rest.steepest)


def _spread(
    sampled: Profiles,
    heights: Float[np.ndarray, "paths n"],
    height_range: float | None,
    ranges: Sequence[tuple[str, tuple[float, float]]],
    orders: tuple[int, int],
) -> Spread:
    distance, count = sampled.distance, len(heights)
    first, second = orders

    def friction(profile: Float[np.ndarray, " n"], order: int = first, rest: int = second) -> float:
        """μ_f by other choices; NaN where it does not exist."""
        try:
            return _fit(distance, profile, order, rest)[2]
        except BadInput:
            return np.nan

    total, raw = heights.sum(axis=0), sampled.values.mean(axis=0)[None]
    without = [(total - row) / (count - 1) for row in heights] if count > 1 else []
    by_order = []
    for order in dict.fromkeys(round(first * factor) for factor in FACTORS):
        rest = round(order * second / first)
        if ORDER[0] <= order < rest <= min(_most(len(distance)), ORDER[1]):
            by_order.append((order, friction(total / count, order, rest)))
    by_scale = []
    for how, greys in ranges:
        flat = not greys[1] > greys[0]
        scaled = np.nan if flat else friction(_heights(raw, height_range, greys)[0])
        by_scale.append((how, scaled))
    return Spread(tuple(map(friction, without)), tuple(by_order), tuple(by_scale))


def _most(samples: int) -> int:
    """The largest order of a baseline that so many samples bear."""
    return samples // SAMPLES - POWERS


def _roughness(
    distance: Float[np.ndarray, " n"], heights: Float[np.ndarray, "paths n"]
) -> Roughness:
    powers = np.column_stack([np.ones_like(distance), distance / distance[-1]])
    lines = powers @ np.linalg.lstsq(powers, heights.T, rcond=None)[0]
    levelled = heights - lines.T
    step = float(distance[1] - distance[0])
    weights = np.array([-1.0, 9.0, -45.0, 0.0, 45.0, -9.0, 1.0]) / (60.0 * step)
    slopes = np.array([np.correlate(row, weights, "valid") for row in levelled])
    return Roughness(
        float(np.abs(levelled).mean()),
        float(np.sqrt((levelled**2).mean(axis=1)).mean()),
        float(np.sqrt((slopes**2).mean(axis=1)).mean()),
    )


def _sd(values: Sequence[float]) -> float:
    return float(np.std(values, ddof=1)) if len(values) > 1 else 0.0
