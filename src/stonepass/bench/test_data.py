"""Laboratory data of strips in tension and of tubes under pressure."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Bool, Float
from stonepass.bench.bench_stress import strip_stress, tube_pressure
from stonepass.materials.protocol import Law

__all__ = ["AXES", "Inflation", "Tension"]

AXES = ("circumferential", "axial")  # directions of the wall along which a strip is cut


@array_dataclass
@dataclass(frozen=True)
class Tension:
    """Uniaxial tension tests of strips that were cut along an axis of the wall.

    Attributes
    ----------
    stretch : array (n)
        Stretch, the length over the length at rest.
    stress : array (n)
        Nominal stress, the force over the cross-section at rest, in Pa.
    axis : tuple of str
        Direction of the strip of each point, "circumferential" or "axial".
    lines : tuple of int
        Line number in the file of each point; empty if the data were not read from a file.

    References
    ----------
    docs/bench.md, "The data".
    """

    stretch: Float[np.ndarray, " n"]
    stress: Float[np.ndarray, " n"]
    axis: tuple[str, ...]
    lines: tuple[int, ...] = ()

    measured = "nominal stress"

    @property
    def observed(self) -> Float[np.ndarray, " n"]:
        """Measured nominal stress in Pa."""
        return self.stress

    @property
    def abscissa(self) -> Float[np.ndarray, " n"]:
        """Stretch of each point."""
        return self.stretch

    @property
    def groups(self) -> tuple[str, ...]:
        """Name of the curve that each point belongs to: the direction of its strip."""
        return self.axis

    @property
    def strain_range(self) -> tuple[float, float]:
        """Smallest and largest stretch of the data."""
        return float(self.stretch.min()), float(self.stretch.max())

    def predicted(self, law: Law) -> Float[np.ndarray, " n"]:
        """Return the nominal stress that a law predicts in Pa; NaN where it predicts none."""
        return strip_stress(law, self.stretch, self._around)[0]

    def unstable_at(self, law: Law) -> float | None:
        """Return the stretch nearest to 1 at which the width of a strip is unstable, or None."""
        _, stiffness = strip_stress(law, self.stretch, self._around)
        lost = self.stretch[~(stiffness > 0.0)]
        return float(lost[np.argmin(np.abs(lost - 1.0))]) if len(lost) else None

    @property
    def mistaken(self) -> Mapping[str, Callable[[float], Tension]]:
        """Function that changes all stretches by a fraction, for a wrong length at rest."""
        return {"rest_size": lambda part: replace(self, stretch=self.stretch * (1.0 + part))}

    def taut_from(self, stretch: float) -> Tension:
        """Return the data corrected for strips that are slack up to a stretch.

        The length at which the strips become taut becomes the length at rest, so that all stretches
        are divided by `stretch`. A point at which a strip was slack gets the stretch 1, at which it
        carries no load. Stretches below 1 are unchanged.
        """
        loose = np.minimum(self.stretch, 1.0)
        return replace(self, stretch=np.maximum(self.stretch / stretch, loose))

    def without(self, point: int) -> Tension:
        """Return the data without a point."""
        kept = [k for k in range(len(self.stress)) if k != point]
        lines = tuple(self.lines[k] for k in kept if self.lines)
        axis = tuple(self.axis[k] for k in kept)
        return Tension(self.stretch[kept], self.stress[kept], axis, lines)

    @property
    def _around(self) -> Bool[np.ndarray, " n"]:
        return np.array(self.axis) == AXES[0]


@array_dataclass
@dataclass(frozen=True)
class Inflation:
    """Inflation test of a tube whose ends are held at a given axial stretch.

    Attributes
    ----------
    radius_ratio : array (n)
        Inner radius over the inner radius at rest, r_a/R_a.
    pressure : array (n)
        Transmural pressure, inside minus outside, in Pa.
    wall_ratio : float
        Wall ratio η = R_b/R_a of the tube at rest.
    axial_stretch : array (n)
        Axial stretch λ_z of each point.
    lines : tuple of int
        Line number in the file of each point; empty if the data were not read from a file.

    References
    ----------
    Liu et al. 2022, Eq. 12; docs/theory.md, "Far field".
    """

    radius_ratio: Float[np.ndarray, " n"]
    pressure: Float[np.ndarray, " n"]
    wall_ratio: float
    axial_stretch: Float[np.ndarray, " n"]
    lines: tuple[int, ...] = ()

    measured = "transmural pressure"

    @property
    def observed(self) -> Float[np.ndarray, " n"]:
        """Measured transmural pressure in Pa."""
        return self.pressure

    @property
    def abscissa(self) -> Float[np.ndarray, " n"]:
        """Radius ratio r_a/R_a of each point."""
        return self.radius_ratio

    @property
    def groups(self) -> tuple[str, ...]:
        """Name of the curve that each point belongs to: its axial stretch."""
        return tuple(f"axial stretch {stretch:g}" for stretch in self.axial_stretch)

    @property
    def strain_range(self) -> tuple[float, float]:
        """Smallest and largest circumferential stretch of the inner wall."""
        return float(self.radius_ratio.min()), float(self.radius_ratio.max())

    def predicted(self, law: Law) -> Float[np.ndarray, " n"]:
        """Return the transmural pressure that a law predicts in Pa; NaN where it predicts none."""
        return tube_pressure(law, self.radius_ratio, self.wall_ratio, self.axial_stretch)

    def unstable_at(self, law: Law) -> float | None:
        """Return None: the radius of the tube is prescribed and its ends are held."""
        return None

    @property
    def mistaken(self) -> Mapping[str, Callable[[float], Inflation]]:
        """Functions that change all radius ratios, or all axial stretches, by a fraction.

        They correct the data for a wrong diameter or a wrong length at rest.
        """
        return {
            "rest_size": lambda part: replace(self, radius_ratio=self.radius_ratio * (1.0 + part)),
            "axial_rest_length": lambda part: replace(
                self, axial_stretch=self.axial_stretch * (1.0 + part)
            ),
        }

    def without(self, point: int) -> Inflation:
        """Return the data without a point."""
        kept = [k for k in range(len(self.pressure)) if k != point]
        lines = tuple(self.lines[k] for k in kept if self.lines)
        ratio, axial = self.radius_ratio[kept], self.axial_stretch[kept]
        return Inflation(ratio, self.pressure[kept], self.wall_ratio, axial, lines)

    def taut_from(self, stretch: float) -> None:
        """Return None: a tube cannot be slack."""
        return
