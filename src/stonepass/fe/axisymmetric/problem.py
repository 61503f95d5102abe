"""The description of a problem for the finite elements: tube, loading path, mesh, first guess."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from stonepass.array_types import Float
from stonepass.fe.axisymmetric.profile import Profile
from stonepass.strain import CauchyGreen, Place

__all__ = ["Energy", "Failure", "LoadingPath", "Resolution", "Tube", "Wrap"]

# energy(C, place, xp): any hyperelastic law, dimensionless.
Energy = Callable[[CauchyGreen, Place, Any], Any]


@dataclass(frozen=True)
class Tube:
    """A tube in units of its inner radius and of a modulus of its law.

    `wall_ratio` R_b/R_a, `half_length` L/R_a in the reference state, `axial_stretch` imposed at
    the ends, `outside_pressure` dead (radial resultant kept) or `hydrostatic`. `tether` is the
    stiffness, per reference area of the outer wall, of springs that hold it along the axis.
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
    """First guess of the deformed wall: a uniform tube at every station.

    Attributes
    ----------
    station : array (n,)
        Reference coordinates Z, in inner radii, increasing; for a stone whose halves are mirror
        images those of the half Z ≥ 0.
    inner_radius : array (n,)
        Deformed inner radius there, in inner radii.
    pressure : array (n,)
        Inner pressure of a uniform tube of that radius, in units of the modulus.
    contact : (float, float)
        Stations between which the wall touches the stone.
    """

    station: Float[np.ndarray, " n"]
    inner_radius: Float[np.ndarray, " n"]
    pressure: Float[np.ndarray, " n"]
    contact: tuple[float, float]


@dataclass(frozen=True)
class LoadingPath:
    """How the stone comes to its final place, with friction on the way.

    Attributes
    ----------
    friction : float
        Coulomb coefficient during the path.
    place : callable
        ``place(t)`` gives the stone for t from 0, where it just touches the lumen of the tube
        without a stone, to 1, its final place.
    """

    friction: float
    place: Callable[[float], Profile]


@dataclass(frozen=True)
class Resolution:
    """How fine the fitted mesh is; the defaults meet 0.05° in the contact edge.

    Attributes
    ----------
    order : int
        Polynomial order of the displacements; the pressure has one less.
    closed : int
        Columns in contact, graded towards the edge.
    edge : float
        Length of the columns next to the edge, as a fraction of the contact length.
    growth : float
        Largest ratio of neighbouring columns beyond the edge and of rows through the wall.
    increments : int
        Increments of a path with friction, at least 2.
    path_columns : int
        Columns in contact at the end of that path.
    """

    order: int = 4
    closed: int = 10
    edge: float = 0.02
    growth: float = 1.6
    increments: int = 8
    path_columns: int = 10

    def refined(self, factor: float = 2.0) -> Resolution:
        """Return a finer mesh of the same kind, and a path of more increments."""
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
    """No equilibrium was found.

    Attributes
    ----------
    reason : str
        Why, as a part of a sentence.
    steps : int
        Newton steps that were spent.
    """

    reason: str
    steps: int
