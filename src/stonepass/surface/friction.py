"""The friction coefficient from the slopes of a stone's surface (paper, section 2.3 and Eq. 18).

Grey values become heights by scaling their range to the known height range; the profiles of several
paths are averaged; the mean profile has a baseline, whose largest slope is k₀, and the deviation
from it a richer baseline, whose largest slope is k₁; μ_f = tan(arctan k₀ + arctan k₁) (Popov 2017).
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from math import degrees, sqrt, tan
from numbers import Integral, Real
from typing import Any

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Bool, Float
from stonepass.caution import Caution, caution
from stonepass.errors import BadInput, require
from stonepass.result import Result
from stonepass.surface.baseline import MARGIN, POWERS, Baseline, fit_baseline
from stonepass.surface.gaps import BRIDGED
from stonepass.surface.grey_scale import Greys, check_surface, grey_ranges, to_heights
from stonepass.surface.levelling import Plane, fit_plane
from stonepass.surface.paths import (
    Profiles,
    StraightPath,
    evenly_spaced,
    profiles_along,
    rows_moved,
)
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
WIDEST = 2.0  # shortest waves: the widest margin that may be asked for
SAMPLES = 4  # least number of samples for each term of a baseline
FACTORS = (0.5, 0.75, 1.0, 1.25, 1.5)  # of the first order, both together
MARGINS = (0.0, 0.25, MARGIN, 1.0)  # shortest waves, for the spread
LARGEST = 2.0  # μ_f that a case takes
DRIFT = 0.01  # of the height range over the area, from which levelling is tried
TELL_TILT = 0.02  # slope of the plane over μ_f, from which a tilt is told of


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
    margins : tuple of (float, float)
        Margin at the ends of the paths in shortest waves, and μ_f.
    """

    paths: tuple[float, ...]
    orders: tuple[tuple[int, float], ...]
    height_range: tuple[tuple[str, float], ...]
    margins: tuple[tuple[float, float], ...] = ()

    @property
    def sd(self) -> float | None:
        """Standard deviation of μ_f: jackknife over paths, orders and scalings, put together.

        Margins do not count: with none at all the ends of the paths are looked at, where a slope
        is several times less certain.


        None where μ_f does not exist for one of the choices.
        """
        parts = [_sd([mu for _, mu in self.orders]), _sd([mu for _, mu in self.height_range])]
        count = len(self.paths)
        if count > 1:
            parts.append(_sd(self.paths) * (count - 1) / sqrt(count))
        total = sqrt(sum(part**2 for part in parts))
        return total if np.isfinite(total) else None


@array_dataclass
@dataclass(frozen=True, repr=False)
class SurfaceFriction(Result):
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
    tilt : float
        Angle in rad between the least-squares plane of the surface and the picture's.
    levelled : bool
        Whether that plane was subtracted.
    friction_levelled : float or None
        μ_f with the plane subtracted; None where it was not tried, because the plane changes by
        less than 1 % of the height range over the area, or has no answer.
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
    tilt: float = 0.0
    levelled: bool = False
    friction_levelled: float | None = None
    warnings: tuple[Caution, ...] = ()

    def summary(self) -> str:
        """Return the friction coefficient and its spread in one line."""
        spread = "" if self.spread.sd is None else f" ± {self.spread.sd:.2g}"
        return (
            f"friction {self.friction:.3g}{spread} (spread over analysis choices), "
            f"{len(self.paths)} paths"
        )

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


@dataclass(frozen=True)
class _Choices:
    """Orders of both baselines, and the margin at the ends of the paths in shortest waves."""

    first: int
    second: int
    margin: float


@dataclass(frozen=True, eq=False)
class _Surface:
    """Profiles as they are sampled, and as heights; how grey becomes height, by each scaling."""

    sampled: Float[np.ndarray, "paths n"]
    heights: Float[np.ndarray, "paths n"]
    ranges: list[tuple[str, Greys]]


def surface_friction(
    picture: SurfaceImage,
    height_range: str | Length | None = None,
    paths: int | Sequence[StraightPath] = 6,
    baseline_order: int = 8,
    deviation_order: int | None = None,
    level: bool = False,
    margin: float = MARGIN,
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
        A number of horizontal paths, evenly spaced; or the paths themselves. In a height map gaps
        of up to a quarter of the deviation's shortest wave are bridged, and a row with longer ones
        is replaced by the nearest row without.
    baseline_order : int
        N of the mean profile's baseline: it follows waves down to 2L/N. 1 to 200.
    deviation_order : int, optional
        That of the deviation's baseline, larger; twice as large by default. In the same basis
        a least-squares residual has no baseline, so its slope would be zero.
    level : bool
        Whether the least-squares plane of the area is subtracted first, which takes out the tilt of
        a specimen on its stage. Without it a tilt that matters is told of.
    margin : float
        How far from the ends of the paths the steepest slopes are looked for, in shortest waves of
        each baseline, 0 to 2; a quarter of the path at most.

    Raises
    ------
    BadInput
        A flat or saturated picture, a height range that is missing or too much, paths too short
        for the baselines or with gaps too long, or slopes with k₀ k₁ ≥ 1.
    """
    scale = _height_range(picture, height_range)
    choices = _choices(baseline_order, deviation_order, margin)
    warnings = check_surface(picture)
    longest_gap = BRIDGED * 2.0 / choices.second
    chosen, moved = _chosen(picture, paths, longest_gap)
    sampled = profiles_along(picture, chosen, longest_gap)
    _check_samples(len(sampled.distance), choices)
    plane = fit_plane(picture)
    surface = _surface(picture, sampled, scale, plane if level else None)
    mean = surface.heights.mean(axis=0)
    first, rest, friction = _fit(sampled.distance, mean, choices)
    spread = _spread(sampled.distance, surface, scale, choices, (first, rest))
    found = SurfaceFriction(
        picture,
        friction,
        first,
        rest,
        scale,
        tuple(chosen),
        sampled.distance,
        surface.heights,
        _roughness(sampled.distance, surface.heights, sampled.known),
        spread,
        _tilt(picture, plane, scale, surface),
        level,
        friction if level else _friction_levelled(picture, sampled, scale, plane, choices),
    )
    return replace(found, warnings=(*warnings, *_warnings(found), *moved, *sampled.warnings))


def _warnings(found: SurfaceFriction) -> list[Caution]:
    """Return the cautions about a result."""
    told, spread, levelled = [], found.spread, found.friction_levelled
    if len(found.paths) == 1:
        told.append(caution("single_path"))
    if spread.sd is None:
        told.append(caution("friction_spread_missing"))
    if len(spread.orders) < len(FACTORS):
        told.append(caution("paths_too_short"))
    if any(part.at_edge for part in (found.baseline, found.deviation_baseline)):
        told.append(caution("baseline_at_path_end"))
    if found.friction > LARGEST:
        told.append(caution("friction_beyond_range", largest=LARGEST))
    tilted = not found.levelled and tan(found.tilt) > TELL_TILT * found.friction
    if tilted and levelled is not None:
        told.append(caution("tilted", tilt_deg=degrees(found.tilt), levelled=levelled))
    return told


def _surface(
    picture: SurfaceImage, sampled: Profiles, scale: float | None, plane: Plane | None
) -> _Surface:
    """Profiles as heights, less a plane where one is given."""
    values = sampled.values
    if plane is not None:
        values = values - plane.at(sampled.columns, sampled.rows)
    ranges = [] if scale is None else grey_ranges(picture, plane)
    heights = to_heights(values, scale, ranges[0][1] if ranges else (0.0, 1.0))
    return _Surface(values, heights, ranges)


def _tilt(picture: SurfaceImage, plane: Plane, scale: float | None, surface: _Surface) -> float:
    """Angle of the surface's plane in rad."""
    assert picture.pixel is not None
    if scale is None:
        return plane.tilt(picture.pixel, 1.0)
    low, high = surface.ranges[0][1]
    return plane.tilt(picture.pixel, scale / (high - low))


def _friction_levelled(
    picture: SurfaceImage, sampled: Profiles, scale: float | None, plane: Plane, choices: _Choices
) -> float | None:
    """μ_f less the plane; None where that changes next to nothing, or has no answer."""
    values = sampled.values
    drift = np.ptp(plane.at(sampled.columns, sampled.rows))
    if drift < DRIFT * np.ptp(values):
        return None
    try:
        levelled = _surface(picture, sampled, scale, plane)
        return _fit(sampled.distance, levelled.heights.mean(axis=0), choices)[2]
    except BadInput:
        return None


def _check_samples(samples: int, choices: _Choices) -> None:
    require(
        choices.second <= _most(samples),
        "order of the deviation's baseline",
        choices.second,
        f"at most {_most(samples)} for paths of {samples} pixels",
        "choose longer paths or a smaller order",
    )


def _chosen(
    picture: SurfaceImage, paths: Any, longest_gap: float
) -> tuple[list[StraightPath], list[Caution]]:
    """The paths; whether some of the evenly spaced ones were moved."""
    if isinstance(paths, Integral) and not isinstance(paths, bool):
        chosen = evenly_spaced(picture, int(paths), longest_gap)
        moved = rows_moved(picture.area, chosen)
        return chosen, [caution("paths_moved", moved=moved, paths=len(chosen))] if moved else []
    listed = list(paths) if isinstance(paths, Iterable) else [paths]
    for each in listed:
        require(isinstance(each, StraightPath), "paths", each, "a whole number, or paths")
    return listed, []


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


def _choices(first: int, second: int | None, margin: float) -> _Choices:
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
    number = isinstance(margin, Real) and not isinstance(margin, bool)
    within = number and 0.0 <= margin <= WIDEST
    require(within, "margin", margin, f"a number from 0 to {WIDEST:g}, in shortest waves")
    return _Choices(found[0], found[1], float(margin))


def _fit(
    distance: Float[np.ndarray, " n"], mean: Float[np.ndarray, " n"], choices: _Choices
) -> tuple[Baseline, Baseline, float]:
    baseline = fit_baseline(distance, mean, choices.first, choices.margin)
    left = mean - baseline.at(distance)
    rest = fit_baseline(distance, left, choices.second, choices.margin)
    return baseline, rest, friction_of_slopes(baseline.steepest, rest.steepest)


def _spread(
    distance: Float[np.ndarray, " n"],
    surface: _Surface,
    scale: float | None,
    choices: _Choices,
    fitted: tuple[Baseline, Baseline],
) -> Spread:
    heights = surface.heights
    count = len(heights)

    def friction(profile: Float[np.ndarray, " n"], other: _Choices = choices) -> float:
        """μ_f by other choices; NaN where it does not exist."""
        try:
            return _fit(distance, profile, other)[2]
        except BadInput:
            return np.nan

    total, raw = heights.sum(axis=0), surface.sampled.mean(axis=0)[None]
    without = [(total - row) / (count - 1) for row in heights] if count > 1 else []
    by_order = []
    for order in dict.fromkeys(round(choices.first * factor) for factor in FACTORS):
        rest = round(order * choices.second / choices.first)
        if ORDER[0] <= order < rest <= min(_most(len(distance)), ORDER[1]):
            by_order.append((order, friction(total / count, _Choices(order, rest, choices.margin))))
    by_scale = []
    for how, greys in surface.ranges:
        flat = not greys[1] > greys[0]
        by_scale.append((how, np.nan if flat else friction(to_heights(raw, scale, greys)[0])))
    by_margin = [(margin, _at_margin(*fitted, margin)) for margin in {*MARGINS, choices.margin}]
    return Spread(tuple(map(friction, without)), tuple(by_order), tuple(by_scale), tuple(by_margin))


def _at_margin(first: Baseline, rest: Baseline, margin: float) -> float:
    """μ_f with another margin; NaN where it does not exist."""
    steep = [replace(each, margin=margin).steepest for each in (first, rest)]
    return friction_of_slopes(*steep) if steep[0] * steep[1] < 1.0 else np.nan


def _most(samples: int) -> int:
    """The largest order of a baseline that so many samples bear."""
    return samples // SAMPLES - POWERS


def _roughness(
    distance: Float[np.ndarray, " n"],
    heights: Float[np.ndarray, "paths n"],
    known: Bool[np.ndarray, "paths n"],
) -> Roughness:
    """Roughness where heights are known; slopes where those of all seven samples are."""
    powers = np.column_stack([np.ones_like(distance), distance / distance[-1]])
    lines = powers @ np.linalg.lstsq(powers, heights.T, rcond=None)[0]
    levelled = heights - lines.T
    step = float(distance[1] - distance[0])
    weights = np.array([-1.0, 9.0, -45.0, 0.0, 45.0, -9.0, 1.0]) / (60.0 * step)
    slopes = np.array([np.correlate(row, weights, "valid") for row in levelled])
    all_known = np.array([np.correlate(row, np.ones(7), "valid") > 6.5 for row in known * 1.0])
    if not all_known.any(axis=1).all():  # gaps so many that bridged ones are all there is
        all_known[:] = True
    return Roughness(
        float(
            np.mean([np.abs(row[have]).mean() for row, have in zip(levelled, known, strict=True)])
        ),
        float(np.mean([_rms(row[have]) for row, have in zip(levelled, known, strict=True)])),
        float(np.mean([_rms(row[have]) for row, have in zip(slopes, all_known, strict=True)])),
    )


def _rms(values: Float[np.ndarray, " n"]) -> float:
    return float(np.sqrt((values**2).mean()))


def _sd(values: Sequence[float]) -> float:
    return float(np.std(values, ddof=1)) if len(values) > 1 else 0.0
