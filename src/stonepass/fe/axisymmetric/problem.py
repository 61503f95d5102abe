"""Description of a finite-element problem: tube, loading path, resolution, first guess."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from stonepass.array_types import Float
from stonepass.fe.axisymmetric.profile import Profile
from stonepass.strain import CauchyGreen, Place

__all__ = ["Energy", "Failure", "LoadingPath", "Resolution", "Tube", "Wrap"]

# energy(C, place, xp) is the energy density of a hyperelastic law, in units of the modulus.
Energy = Callable[[CauchyGreen, Place, Any], Any]


@dataclass(frozen=True)
class Tube:
    """A tube with its loads other than the stone and the fluid.

    Attributes
    ----------
    energy : callable
        ``energy(C, place, xp)``: energy density of the wall law, in units of the modulus.
    wall_ratio : float
        R_b/R_a, above 1.
    half_length : float
        Half the reference length of the tube, in inner radii.
    axial_stretch : float
        Axial stretch imposed at the ends, positive.
    outside_pressure : float
        Pressure on the outer wall, in units of the modulus.
    hydrostatic : bool
        True if the pressure acts on the deformed area; false for a dead load, which keeps its
        radial resultant (paper, Eq. 10).
    tether : float
        Stiffness of springs that resist axial displacement of the outer wall from the uniformly
        stretched position, per reference area, in units of modulus per inner radius.
    """

    energy: Energy
    wall_ratio: float
    half_length: float
    axial_stretch: float = 1.0
    outside_pressure: float = 0.0
    hydrostatic: bool = False
    tether: float = 0.0


@dataclass(frozen=True, eq=False)
class Wrap:
    """First guess of the deformed wall, whose cross-sections are those of uniform tubes.

    Attributes
    ----------
    station : array (n,)
        Reference coordinates Z, in inner radii, increasing. They cover the half Z ≥ 0 if the stone
        has mirror symmetry, otherwise the whole tube.
    inner_radius : array (n,)
        Deformed inner radius at the stations, in undeformed inner radii.
    pressure : array (n,)
        Inner pressure that holds a uniform tube at that radius, in units of the modulus.
    contact : (float, float)
        First and last station of the guessed contact, in inner radii.
    """

    station: Float[np.ndarray, " n"]
    inner_radius: Float[np.ndarray, " n"]
    pressure: Float[np.ndarray, " n"]
    contact: tuple[float, float]


@dataclass(frozen=True)
class LoadingPath:
    """The motion of the stone into its final position, with friction.

    Attributes
    ----------
    friction : float
        Coulomb coefficient during the motion, positive.
    place : callable
        ``place(t)`` returns the stone at the path parameter t. At t = 0 the stone just touches the
        lumen of the undisturbed tube; at t = 1 it has reached its final position.
    """

    friction: float
    place: Callable[[float], Profile]


@dataclass(frozen=True)
class Resolution:
    """Resolution of the fitted mesh and of the loading path.

    With the default values the error of the contact angle is below 0.05°.

    Attributes
    ----------
    order : int
        Polynomial order of the displacements, at least 2. The order of the pressure is lower by
        one.
    closed : int
        Number of columns in each half of the contact, graded towards its edge.
    edge : float
        Length of the columns next to the edge, as a fraction of half the contact length.
    growth : float
        Largest ratio of the lengths of neighbouring columns outside the contact, above 1. For the
        heights of the rows the largest ratio is 1.5 times that.
    increments : int
        Number of increments of a loading path with friction, at least 2.
    path_columns : int
        Number of equal columns in each half of the contact on the mesh of the loading path.
    """

    order: int = 4
    closed: int = 10
    edge: float = 0.02
    growth: float = 1.6
    increments: int = 8
    path_columns: int = 10

    def refined(self, factor: float = 2.0) -> Resolution:
        """Return a resolution with `factor` times as many columns and increments."""
        return replace(
            self,
            closed=round(self.closed * factor),
            edge=self.edge / factor,
            growth=self.growth ** (1.0 / factor),
            increments=round(self.increments * factor),
            path_columns=round(self.path_columns * factor),
        )


@dataclass(frozen=True)
class Failure:
    """Result of a solve that found no admissible equilibrium.

    Attributes
    ----------
    reason : str
        Reason of the failure, as part of a sentence.
    steps : int
        Number of Newton steps with a newly factorised tangent.
    """

    reason: str
    steps: int
