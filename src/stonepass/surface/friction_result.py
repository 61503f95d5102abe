"""The result of a friction measurement: the coefficient, its spread and the intermediate data."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import sqrt

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Float
from stonepass.caution import Caution
from stonepass.result import Result
from stonepass.surface.baseline import Baseline
from stonepass.surface.paths import StraightPath
from stonepass.surface.surface_image import SurfaceImage

__all__ = ["Roughness", "Spread", "SurfaceFriction"]


@dataclass(frozen=True)
class Roughness:
    """Roughness of the profiles after subtraction of their mean lines, averaged over the paths.

    Waviness is not filtered out, so that these are the parameters of the primary profile of
    ISO 21920 (named Pa, Pq and PΔq there).

    Attributes
    ----------
    Ra : float
        Arithmetic mean of the absolute heights in m.
    Rq : float
        Root mean square of the heights in m.
    RdeltaQ : float
        Root mean square of the slope dz/dx by seven-point differences, dimensionless.
    """

    Ra: float
    Rq: float
    RdeltaQ: float


@dataclass(frozen=True)
class Spread:
    """Friction coefficients μ_f for other choices of paths, orders, grey scaling and margins.

    A value is NaN if μ_f does not exist for a choice.

    Attributes
    ----------
    paths : tuple of float
        μ_f without the k-th path, for each k; empty for a single path.
    orders : tuple of (int, float)
        Order of the first baseline, and μ_f. The order of the second baseline changes in
        proportion.
    height_range : tuple of (str, float)
        Way in which grey levels are scaled to the height range, and μ_f; empty for height maps.
    margins : tuple of (float, float)
        Margin at the ends of the paths in units of the shortest wavelength, and μ_f.

    References
    ----------
    docs/friction.md, "What is done".
    """

    paths: tuple[float, ...]
    orders: tuple[tuple[int, float], ...]
    height_range: tuple[tuple[str, float], ...]
    margins: tuple[tuple[float, float], ...] = ()

    @property
    def sd(self) -> float | None:
        """Combined standard deviation of μ_f; None if μ_f does not exist for one of the choices.

        It is the root of the sum of squares of three parts: the jackknife standard error over the
        paths, and the standard deviations over the orders and over the grey scalings. The margins
        are left out, because slopes at the very ends of the paths are several times less accurate.
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
    """The friction coefficient of a surface with the data and intermediate results behind it.

    Attributes
    ----------
    picture : SurfaceImage
        Micrograph or height map.
    friction : float
        Friction coefficient μ_f.
    baseline : Baseline
        Baseline of the mean profile; its largest slope is k₀.
    deviation_baseline : Baseline
        Baseline of the deviation from the first one; its largest slope is k₁.
    height_range : float or None
        Height range of the grey levels in m; None for a height map.
    paths : tuple of StraightPath
        Paths in pixels.
    distance : array (n)
        Distance from the start of the paths in m.
    profiles : array (paths, n)
        Heights along each path in m.
    roughness : Roughness
        Roughness of the profiles.
    spread : Spread
        Friction coefficients for other choices.
    tilt : float
        Angle in rad between the least-squares plane of the surface and the plane of the picture.
    levelled : bool
        True if the least-squares plane was subtracted.
    friction_levelled : float or None
        μ_f with the plane subtracted. It is None if the plane changes along the paths by less than
        1 % of the range of the profiles, or if μ_f does not exist with the plane subtracted.
    warnings : tuple of Caution
        Warnings about the picture, the paths and the result.

    References
    ----------
    Liu et al. 2022, Eq. 18; docs/theory.md, "Friction from a surface".
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
        """Mean profile in m, an array (n)."""
        return self.profiles.mean(axis=0)

    @property
    def deviation(self) -> Float[np.ndarray, " n"]:
        """Mean profile minus its baseline in m, an array (n)."""
        return self.mean - self.baseline.at(self.distance)

    @property
    def k0(self) -> float:
        """Largest slope k₀ of the baseline of the mean profile."""
        return self.baseline.steepest

    @property
    def k1(self) -> float:
        """Largest slope k₁ of the baseline of the deviation."""
        return self.deviation_baseline.steepest


def _sd(values: Sequence[float]) -> float:
    return float(np.std(values, ddof=1)) if len(values) > 1 else 0.0
