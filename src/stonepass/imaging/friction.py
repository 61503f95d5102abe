"""The friction coefficient from the slopes of a stone's surface (paper, section 2.3 and Eq. 18).

Grey values become heights by scaling their range to the known relief; the profiles of several
paths are averaged; the mean profile has a baseline, whose largest slope is k₀, and the deviation
from it a richer baseline, whose largest slope is k₁; μ_f = tan(arctan k₀ + arctan k₁) (Popov 2017).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import sqrt

import numpy as np
from jaxtyping import Float, Num

from stonepass.errors import BadInput, require
from stonepass.imaging.baseline import POWERS, Baseline, fit_baseline
from stonepass.imaging.paths import Profiles, StraightPath, evenly_spaced, profiles_along
from stonepass.imaging.picture import Picture
from stonepass.units import Length, length

__all__ = [
    "CRYSTAL_DIAGONAL",
    "Roughness",
    "Spread",
    "SurfaceFriction",
    "friction_of_slopes",
    "surface_friction",
]

CRYSTAL_DIAGONAL = sqrt(3.0)  # relief over the edge of a cubic crystal (section 2.3)
RELIEF = (1e-9, 1e-2)  # m
ORDER = (1, 200)
RICHER = 2  # order of the deviation's baseline over that of the first
SAMPLES = 4  # least number of samples for each term of a baseline
LEVELS = 16  # least number of grey levels of a picture that is not flat
SATURATED = 0.25  # of the pixels at one end of the grey scale, at which heights are cut off
TELL_SATURATED = 0.05  # more than the tops and bottoms of a smooth surface take
SMOOTHED = 5  # pixels along each side, over which grey is averaged before its range is taken
PERCENTILES = (0.1, 99.9)
SCALINGS = ("smoothed range", "range", "percentiles")
LARGEST = 2.0  # μ_f that a case takes


@dataclass(frozen=True)
class Roughness:
    """Roughness of the single profiles less their mean lines, averaged over the paths (ISO 21920).

    `Ra` and `Rq` are in m; `RdeltaQ` is the root mean square of dz/dx, seven-point differences.
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
    relief : tuple of (str, float)
        How grey is scaled to the relief, and μ_f; empty for heights.
    """

    paths: tuple[float, ...]
    orders: tuple[tuple[int, float], ...]
    relief: tuple[tuple[str, float], ...]

    @property
    def sd(self) -> float | None:
        """Standard deviation of μ_f: jackknife over paths, orders and scalings, put together.

        None where μ_f does not exist for one of the choices.
        """
        parts = [_sd([mu for _, mu in self.orders]), _sd([mu for _, mu in self.relief])]
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
    picture : Picture
    friction : float
        μ_f (Eq. 18).
    baseline, deviation_baseline : Baseline
        Of the mean profile, and of what is left of it; their largest slopes are k₀ and k₁.
    relief : float or None
        In m; None for a height map.
    distance, profiles, mean : array
        Distance from the start of the paths in m, heights along each, and their mean.
    roughness : Roughness
    spread : Spread
    warnings : tuple of str
    """

    picture: Picture
    friction: float
    baseline: Baseline
    deviation_baseline: Baseline
    relief: float | None
    paths: tuple[StraightPath, ...]
    distance: Float[np.ndarray, " n"]
    profiles: Float[np.ndarray, "paths n"]
    roughness: Roughness
    spread: Spread
    warnings: tuple[str, ...] = ()

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
                       "check the relief and the pixel size")  # fmt: skip
    return (k0 + k1) / (1.0 - k0 * k1)


def surface_friction(
    picture: Picture,
    relief: str | Length | None = None,
    paths: int | Sequence[StraightPath] = 6,
    baseline_order: int = 8,
    deviation_order: int | None = None,
) -> SurfaceFriction:
    """Find the friction coefficient of a surface from its picture.

    Parameters
    ----------
    picture : Picture
        With a pixel size.
    relief : str or Length
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
        A flat or saturated picture, a relief that is missing or too much, paths too short for the
        baselines, or slopes with k₀ k₁ ≥ 1.
    """
    scale = _relief(picture, relief)
    second = RICHER * baseline_order if deviation_order is None else deviation_order
    _check_orders(baseline_order, second)
    warnings = list(_check_grey(picture))
    chosen = evenly_spaced(picture, paths) if isinstance(paths, int) else list(paths)
    sampled = profiles_along(picture, chosen)
    samples = len(sampled.distance)
    require(
        second <= _most(samples),
        "order of the deviation's baseline",
        second,
        f"at most {_most(samples)} for paths of {samples} pixels",
        "choose longer paths or a smaller order",
    )
    heights = _heights(picture, sampled.values, scale)
    first, rest, friction = _fit(sampled.distance, heights.mean(axis=0), baseline_order, second)
    spread = _spread(picture, sampled, heights, scale, baseline_order, second)
    if len(chosen) == 1:
        warnings.append("one path alone: how the friction varies over the surface is not known")
    if spread.sd is None:
        warnings.append("for some of the choices the slopes are too steep: no spread is given")
    if friction > LARGEST:
        warnings.append(f"the friction coefficient lies above {LARGEST:g}, which no case takes")
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


def _relief(picture: Picture, relief: str | Length | None) -> float | None:
    if picture.has_heights:
        if relief is not None:
            raise BadInput("relief", str(relief), "left out", "a height map has its own")
        return None
    if relief is None:
        raise BadInput("relief", "missing", "given for a grey picture, as --relief or --crystal")
    scale = length(relief, "relief")
    low, high = RELIEF
    require(low <= scale <= high, "relief", str(relief), "1 nm to 10 mm")
    return float(scale)


def _check_orders(first: int, second: int) -> None:
    low, high = ORDER
    for name, order in (("baseline", first), ("deviation's baseline", second)):
        whole = isinstance(order, int) and not isinstance(order, bool)
        allowed = f"a whole number from {low} to {high}"
        require(whole and low <= order <= high, f"order of the {name}", order, allowed)
    why = "in the same basis the deviation has no slope"
    require(second > first, "order of the deviation's baseline", second,
            f"larger than that of the first, {first}", why)  # fmt: skip


def _check_grey(picture: Picture) -> list[str]:
    """Refuse a picture without relief, or cut off at an end of the grey scale; warn of some."""
    values = picture.surface
    if picture.has_heights:
        known = values[np.isfinite(values)]
        flat = known.size == 0 or not float(np.ptp(known)) > 0.0
        require(not flat, "height map", "flat or empty", "of a rough surface")
        return []
    low, high = int(values.min()), int(values.max())
    shown = f"flat, with greys from {low} to {high}"
    require(high - low >= LEVELS, "picture", shown, f"of at least {LEVELS} grey levels")
    ends = max(float(np.mean(values == end)) for end in (0, picture.full_scale))
    allowed = f"less than {SATURATED:.0%} of it"
    require(ends < SATURATED, "black or white", f"{ends:.0%} of the picture", allowed,
            "take one that is not saturated")  # fmt: skip
    if ends > TELL_SATURATED:
        return [f"{ends:.0%} of the pixels are black or white, where heights are cut off"]
    return []


def _grey_range(picture: Picture, how: str) -> tuple[float, float]:
    """Greys of height nought and of the whole relief (`SCALINGS`).

    Single pixels reach further than the surface does, by their noise; their mean over a few does so
    less.
    """
    values: Num[np.ndarray, "rows columns"] = picture.surface
    if how == "percentiles":
        low, high = np.percentile(values, PERCENTILES)
        return float(low), float(high)
    if how == "smoothed range":
        from scipy.ndimage import uniform_filter

        values = uniform_filter(values, SMOOTHED, np.float32)
    return float(values.min()), float(values.max())


def _heights(
    picture: Picture,
    values: Float[np.ndarray, "paths n"],
    relief: float | None,
    how: str = SCALINGS[0],
) -> Float[np.ndarray, "paths n"]:
    if relief is None:
        return values
    low, high = _grey_range(picture, how)
    require(high > low, "picture", f"flat in its {how}", "of a rough surface")
    return relief * (values - low) / (high - low)


def _fit(
    distance: Float[np.ndarray, " n"], mean: Float[np.ndarray, " n"], first: int, second: int
) -> tuple[Baseline, Baseline, float]:
    baseline = fit_baseline(distance, mean, first)
    rest = fit_baseline(distance, mean - baseline.at(distance), second)
    return baseline, rest, friction_of_slopes(baseline.steepest, rest.steepest)


def _spread(
    picture: Picture,
    sampled: Profiles,
    heights: Float[np.ndarray, "paths n"],
    relief: float | None,
    first: int,
    second: int,
) -> Spread:
    distance, mean = sampled.distance, heights.mean(axis=0)

    def friction(profile: Float[np.ndarray, " n"], order: int = first, rest: int = second) -> float:
        """μ_f by other choices; NaN where it does not exist."""
        try:
            return _fit(distance, profile, order, rest)[2]
        except BadInput:
            return np.nan

    def scaled(how: str) -> float:
        """μ_f by another scaling; NaN where it does not exist."""
        try:
            return friction(_heights(picture, sampled.values, relief, how).mean(axis=0))
        except BadInput:
            return np.nan

    count = len(heights)
    without = [np.delete(heights, k, axis=0).mean(axis=0) for k in range(count if count > 1 else 0)]
    orders = []
    for order in dict.fromkeys(round(first * factor) for factor in (0.5, 0.75, 1.0, 1.25, 1.5)):
        rest = round(order * second / first)
        if ORDER[0] <= order < rest <= min(_most(len(distance)), ORDER[1]):
            orders.append((order, friction(mean, order, rest)))
    scalings = [] if relief is None else [(how, scaled(how)) for how in SCALINGS]
    return Spread(tuple(map(friction, without)), tuple(orders), tuple(scalings))


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
