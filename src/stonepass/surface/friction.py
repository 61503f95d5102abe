"""The friction coefficient from the slopes of a stone's surface (Liu et al. 2022, section 2.3).

Grey levels are converted to heights by scaling their range to the known height range. The profiles
along several paths are averaged. A baseline is fitted to the mean profile; its largest slope is k₀.
A second baseline of higher order is fitted to the deviation of the mean profile from the first; its
largest slope is k₁. The friction coefficient is μ_f = tan(arctan k₀ + arctan k₁) (Eq. 18). The
method, its accuracy and its limits are described in docs/friction.md.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from math import degrees, tan
from numbers import Integral
from typing import Any

import numpy as np

from stonepass.array_types import Float
from stonepass.caution import Caution, caution
from stonepass.errors import BadInput, require
from stonepass.model.stone import FRICTION
from stonepass.surface.analysis import MARGIN, ORDER, PATHS, Analysis
from stonepass.surface.baseline import POWERS, Baseline, fit_baseline
from stonepass.surface.friction_result import Spread, SurfaceFriction
from stonepass.surface.gaps import BRIDGED
from stonepass.surface.grey_scale import Greys, check_surface, grey_ranges, to_heights
from stonepass.surface.height_range import height_scale
from stonepass.surface.levelling import Plane, fit_plane
from stonepass.surface.lost_points import without_lost_points
from stonepass.surface.paths import (
    Profiles,
    StraightPath,
    evenly_spaced,
    profiles_along,
    rows_moved,
)
from stonepass.surface.roughness import roughness
from stonepass.surface.surface_image import SurfaceImage
from stonepass.units import Length, Quantity

__all__ = ["friction_of_slopes", "surface_friction"]

SAMPLES = 4  # least number of samples per term of a baseline
FACTORS = (0.5, 0.75, 1.0, 1.25, 1.5)  # factors on both orders, for the spread
MARGINS = (0.0, 0.25, MARGIN, 1.0)  # margins in shortest wavelengths, for the spread
# The plane is ignored if it changes along the paths by less than this fraction of the range of the
# profiles.
DRIFT = 0.01
TELL_TILT = 0.02  # slope of the plane, divided by μ_f, above which a warning is given


def friction_of_slopes(k0: float, k1: float) -> float:
    """Compute μ_f = tan(arctan k₀ + arctan k₁) = (k₀ + k₁)/(1 − k₀ k₁).

    Parameters
    ----------
    k0, k1 : float
        Largest slopes of the two baselines, dimensionless, at least 0, with k₀ k₁ < 1.

    Raises
    ------
    BadInput
        A slope is negative, or k₀ k₁ ≥ 1, so that the sum of both angles is 90° or more.

    References
    ----------
    Liu et al. 2022, Eq. 18; docs/theory.md, "Friction from a surface".
    """
    require(k0 >= 0.0 and k1 >= 0.0, "pair of slopes k0, k1", f"{k0:g}, {k1:g}", "not negative")
    if k0 * k1 >= 1.0:
        raise BadInput("product of the slopes k0 and k1", f"{k0:.3g} × {k1:.3g}", "below 1",
                       "check the height range and the pixel size")  # fmt: skip
    return (k0 + k1) / (1.0 - k0 * k1)


@dataclass(frozen=True, eq=False)
class _Surface:
    """Sampled profiles, the same profiles as heights in m, and the range of each grey scaling."""

    sampled: Float[np.ndarray, "paths n"]
    heights: Float[np.ndarray, "paths n"]
    ranges: list[tuple[str, Greys]]


def surface_friction(
    picture: SurfaceImage,
    height_range: str | Length | Quantity | None = None,
    paths: int | Sequence[StraightPath] = PATHS.default,
    baseline_order: int = Analysis.baseline_order,
    deviation_order: int | None = Analysis.deviation_order,
    level: bool = Analysis.level,
    margin: float = Analysis.margin,
) -> SurfaceFriction:
    """Compute the friction coefficient of a surface from a micrograph or height map.

    Parameters
    ----------
    picture : SurfaceImage
        Grey levels or heights; its pixel size must be known.
    height_range : str or Length, optional
        Height of the brightest grey level above the darkest, 1 nm to 10 mm, in m or as text with a
        unit. Both levels are extremes of means over 5 × 5 pixels. The paper takes √3 times the
        edge of its cubic crystals. It is required for grey levels and refused for heights.
    paths : int or sequence of StraightPath
        Number of evenly spaced horizontal paths, 1 to 100, or the paths themselves. In a height map
        gaps are bridged up to a quarter of the shortest wavelength of the second baseline; a row
        with longer gaps is replaced by the nearest row without them. Lost points and spikes are
        gaps too.
    baseline_order, deviation_order, level, margin
        See `Analysis`. Without `level` a warning is given if the tilt influences the result.

    Returns
    -------
    SurfaceFriction

    Raises
    ------
    BadInput
        The picture is flat or saturated, more than a tenth of the points of a height map are lost
        points (see `lost_points`), the height range is missing or superfluous, the paths are
        too short for the baselines or have too long gaps, or k₀ k₁ ≥ 1.

    References
    ----------
    Liu et al. 2022, section 2.3 and Eq. 18; docs/friction.md, "What is done".
    """
    scale = height_scale(picture, height_range)
    choices = Analysis(baseline_order, deviation_order, level, margin)
    picture, warnings = without_lost_points(picture)
    warnings += check_surface(picture)
    longest_gap = BRIDGED * 2.0 / choices.second_order
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
        roughness(sampled.distance, surface.heights, sampled.known),
        spread,
        _tilt(picture, plane, scale, surface),
        level,
        friction if level else _friction_levelled(picture, sampled, scale, plane, choices),
    )
    return replace(found, warnings=(*warnings, *_warnings(found), *moved, *sampled.warnings))


def _warnings(found: SurfaceFriction) -> list[Caution]:
    """Return the warnings about a result."""
    told, spread, levelled = [], found.spread, found.friction_levelled
    if len(found.paths) == 1:
        told.append(caution("single_path"))
    if spread.sd is None:
        told.append(caution("friction_spread_missing"))
    if len(spread.orders) < len(FACTORS):
        told.append(caution("paths_too_short"))
    if any(part.at_edge for part in (found.baseline, found.deviation_baseline)):
        told.append(caution("baseline_at_path_end"))
    if found.friction > FRICTION[1]:
        told.append(caution("friction_beyond_range", largest=FRICTION[1]))
    tilted = not found.levelled and tan(found.tilt) > TELL_TILT * found.friction
    if tilted and levelled is not None:
        told.append(caution("tilted", tilt_deg=degrees(found.tilt), levelled=levelled))
    return told


def _surface(
    picture: SurfaceImage, sampled: Profiles, scale: float | None, plane: Plane | None
) -> _Surface:
    """Convert the profiles to heights, after subtraction of the plane if one is given."""
    values = sampled.values
    if plane is not None:
        values = values - plane.at(sampled.columns, sampled.rows)
    ranges = [] if scale is None else grey_ranges(picture, plane)
    heights = to_heights(values, scale, ranges[0][1] if ranges else (0.0, 1.0))
    return _Surface(values, heights, ranges)


def _tilt(picture: SurfaceImage, plane: Plane, scale: float | None, surface: _Surface) -> float:
    """Return the angle in rad between the plane of the surface and that of the picture."""
    assert picture.pixel is not None
    if scale is None:
        return plane.tilt(picture.pixel, 1.0)
    low, high = surface.ranges[0][1]
    return plane.tilt(picture.pixel, scale / (high - low))


def _friction_levelled(
    picture: SurfaceImage, sampled: Profiles, scale: float | None, plane: Plane, choices: Analysis
) -> float | None:
    """Return μ_f with the plane subtracted; None if the plane is flat or μ_f does not exist."""
    values = sampled.values
    drift = np.ptp(plane.at(sampled.columns, sampled.rows))
    if drift < DRIFT * np.ptp(values):
        return None
    try:
        levelled = _surface(picture, sampled, scale, plane)
        return _fit(sampled.distance, levelled.heights.mean(axis=0), choices)[2]
    except BadInput:
        return None


def _check_samples(samples: int, choices: Analysis) -> None:
    require(
        choices.second_order <= _most(samples),
        "order of the deviation's baseline",
        choices.second_order,
        f"at most {_most(samples)} for paths of {samples} pixels",
        "choose longer paths or a smaller order",
    )


def _chosen(
    picture: SurfaceImage, paths: Any, longest_gap: float
) -> tuple[list[StraightPath], list[Caution]]:
    """Return the paths, and a caution if evenly spaced ones were moved because of gaps."""
    if isinstance(paths, Integral) and not isinstance(paths, bool):
        chosen = evenly_spaced(picture, int(paths), longest_gap)
        moved = rows_moved(picture.area, chosen)
        return chosen, [caution("paths_moved", moved=moved, paths=len(chosen))] if moved else []
    listed = list(paths) if isinstance(paths, Iterable) else [paths]
    for each in listed:
        require(isinstance(each, StraightPath), "paths", each,
                "a whole number, or a sequence of StraightPath")  # fmt: skip
    return listed, []


def _fit(
    distance: Float[np.ndarray, " n"], mean: Float[np.ndarray, " n"], choices: Analysis
) -> tuple[Baseline, Baseline, float]:
    baseline = fit_baseline(distance, mean, choices.baseline_order, choices.margin)
    left = mean - baseline.at(distance)
    rest = fit_baseline(distance, left, choices.second_order, choices.margin)
    return baseline, rest, friction_of_slopes(baseline.steepest, rest.steepest)


def _spread(
    distance: Float[np.ndarray, " n"],
    surface: _Surface,
    scale: float | None,
    choices: Analysis,
    fitted: tuple[Baseline, Baseline],
) -> Spread:
    heights = surface.heights
    count = len(heights)

    def friction(profile: Float[np.ndarray, " n"], other: Analysis = choices) -> float:
        """Return μ_f for other choices; NaN if it does not exist."""
        try:
            return _fit(distance, profile, other)[2]
        except BadInput:
            return np.nan

    total, raw = heights.sum(axis=0), surface.sampled.mean(axis=0)[None]
    without = [(total - row) / (count - 1) for row in heights] if count > 1 else []
    by_order = []
    for order in dict.fromkeys(round(choices.baseline_order * factor) for factor in FACTORS):
        rest = round(order * choices.second_order / choices.baseline_order)
        if ORDER[0] <= order < rest <= min(_most(len(distance)), ORDER[1]):
            other = replace(choices, baseline_order=order, deviation_order=rest)
            by_order.append((order, friction(total / count, other)))
    by_scale = []
    for how, greys in surface.ranges:
        flat = not greys[1] > greys[0]
        by_scale.append((how, np.nan if flat else friction(to_heights(raw, scale, greys)[0])))
    by_margin = [(margin, _at_margin(*fitted, margin)) for margin in {*MARGINS, choices.margin}]
    return Spread(tuple(map(friction, without)), tuple(by_order), tuple(by_scale), tuple(by_margin))


def _at_margin(first: Baseline, rest: Baseline, margin: float) -> float:
    """Return μ_f with another margin; NaN if it does not exist."""
    steep = [replace(each, margin=margin).steepest for each in (first, rest)]
    return friction_of_slopes(*steep) if steep[0] * steep[1] < 1.0 else np.nan


def _most(samples: int) -> int:
    """Return the largest order of a baseline that can be fitted to so many samples."""
    return samples // SAMPLES - POWERS
