"""Data of the sliding contact: the problem, a configuration of its unknowns, a solved state.

The problem is described in the module `sliding_contact`. See "The push-through, solved directly" in
docs/theory.md.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from stonepass.array_types import Float
from stonepass.fe.axisymmetric.equilibrium import EquilibriumState
from stonepass.fe.axisymmetric.layouts import graded_layout
from stonepass.fe.axisymmetric.mesh import Layout
from stonepass.fe.axisymmetric.problem import Resolution, Tube
from stonepass.fe.axisymmetric.profile import Profile

__all__ = ["Configuration", "SlidingProblem", "SlidingState", "sliding_problem"]


@dataclass(frozen=True)
class SlidingProblem:
    """A tube on a held stone that is loaded by a fluid from upstream.

    Attributes
    ----------
    tube : Tube
    stone : Profile
        The held stone, lengths in inner radii.
    resolution : Resolution
    contact : (float, float)
        Stations of the contact edges without fluid, in inner radii. They determine the numbers of
        columns and rows.
    force : float
        Norm of the nodal contact forces without fluid, in units of modulus × inner radius².
    wetted : bool
        True for a wetted contact, false for a dry one (see the module `sliding_contact`).
    offset : float
        Distance in inner radii by which the stone is held downstream of mid-length, measured in the
        reference state.
    """

    tube: Tube
    stone: Profile
    resolution: Resolution
    contact: tuple[float, float]
    force: float
    wetted: bool = False
    offset: float = 0.0

    @property
    def inlet(self) -> float:
        """Distance of the upstream end from the stone, in inner radii."""
        return self.tube.half_length + self.offset

    @property
    def outlet(self) -> float:
        """Distance of the downstream end from the stone, in inner radii."""
        return self.tube.half_length - self.offset

    def layout(self, edges: tuple[float, float], seal: float) -> Layout:
        """Return the grid lines for a contact between two stations.

        Parameters
        ----------
        edges : (float, float)
            Stations of the contact edges, in inner radii.
        seal : float
            Position of the seal, as a fraction of the contact from its first edge.
        """
        return graded_layout(
            self.tube,
            self.resolution,
            edges,
            self.contact,
            whole=True,
            offset=self.offset,
            seal=seal,
        )


def sliding_problem(
    tube: Tube,
    seated: EquilibriumState,
    resolution: Resolution,
    *,
    wetted: bool = False,
    offset: float = 0.0,
) -> SlidingProblem:
    """Describe the loading of a tube, starting from its seated state without friction.

    Parameters
    ----------
    tube : Tube
        The tube of the seated state; it may have a tether in addition.
    seated : EquilibriumState
        The seated state; it supplies stone, contact edges and contact force.
    resolution, wetted, offset
        See `SlidingProblem`.
    """
    stone, contact = seated.discretisation.arc.place, seated.layout.contact
    return SlidingProblem(tube, stone, resolution, contact, seated.force, wetted, offset)


@dataclass(frozen=True, eq=False)
class Configuration:
    """Values of all unknowns and parameters of a sliding problem; the starting point of a solve.

    Attributes
    ----------
    unknowns : array (unknowns,)
        Coefficients of the finite-element fields.
    edges : (float, float)
        Stations of the contact edges, in inner radii.
    pressure : float
        Pressure P of the fluid, in units of the modulus.
    friction : float
        Coulomb coefficient.
    seal : float
        Position of the grid line of the seal, as a fraction of the contact from its first edge.
    wetting : float
        Factor ω in [0, 1]. Between the first edge and the seal the friction traction is
        μ (λ − ω P). It is 0 for a dry contact and 1 for a wetted contact.
    """

    unknowns: Float[np.ndarray, " unknowns"]
    edges: tuple[float, float]
    pressure: float
    friction: float
    seal: float = 0.5
    wetting: float = 0.0


@dataclass(frozen=True, eq=False)
class SlidingState:
    """A solved state of the loaded tube.

    Attributes
    ----------
    configuration : Configuration
        All unknowns; another solve may start from it.
    force : float
        Axial force on the stone, positive downstream, in units of modulus × inner radius².
    station, r, z : arrays (edges, points)
        Reference coordinate Z and deformed coordinates of the wall in contact, in inner radii, at
        the Gauss–Lobatto points of each element edge, ordered from upstream to downstream.
    contact_pressure : array (edges, points)
        Total contact pressure per deformed area (true stress, compression positive), in units of
        the modulus.
    steps : int
        Number of Newton steps with a newly factorised tangent in this solve.
    residual : float
        Norm of the residual, relative to twice the contact force without fluid.
    penetration : float
        Largest penetration of the open wall into the stone, in radii of the stone.
    friction_work : float
        Frictional dissipation per unit advance of the stone along the reference wall, in units of
        modulus × inner radius².
    """

    configuration: Configuration
    force: float
    station: Float[np.ndarray, "edges points"]
    r: Float[np.ndarray, "edges points"]
    z: Float[np.ndarray, "edges points"]
    contact_pressure: Float[np.ndarray, "edges points"]
    steps: int
    residual: float
    penetration: float
    friction_work: float

    @property
    def pressure(self) -> float:
        """Pressure P of the fluid, in units of the modulus."""
        return self.configuration.pressure

    @property
    def friction(self) -> float:
        """Coulomb coefficient."""
        return self.configuration.friction
