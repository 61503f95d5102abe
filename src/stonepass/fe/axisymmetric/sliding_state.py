"""Values of the sliding contact: the problem, a configuration of its unknowns, a solved state."""

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
    """A tube on a held stone, to be loaded by a fluid from upstream.

    Attributes
    ----------
    tube : Tube
    stone : Profile
        The held stone, lengths in inner radii.
    resolution : Resolution
    contact : (float, float)
        Edges of the contact without fluid, in inner radii; they determine the number of columns.
    force : float
        Norm of the nodal contact forces without fluid, in units of modulus × inner radius².
    wetted : bool
        Whether the fluid carries its share of the contact up to the seal.
    offset : float
        How far downstream of mid-length the stone is held in the reference state, in inner radii.
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
        """Grid lines for a contact between two stations, with the seal at a fraction of it."""
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
    """Describe the loading of a tube that is seated without friction.

    Parameters
    ----------
    tube : Tube
        Like that of the seated state, with a tether where one is wanted.
    seated : EquilibriumState
    resolution, wetted, offset
        See `SlidingProblem`.
    """
    stone, contact = seated.discretisation.arc.place, seated.layout.contact
    return SlidingProblem(tube, stone, resolution, contact, seated.force, wetted, offset)


@dataclass(frozen=True, eq=False)
class Configuration:
    """Values of all unknowns and parameters of a sliding problem; each solve starts from one.

    Attributes
    ----------
    unknowns : array (unknowns,)
        Coefficients of the finite-element fields.
    edges : (float, float)
        Stations of the contact's edges, in inner radii.
    pressure : float
        Pressure P of the fluid, in units of the modulus.
    friction : float
        Coulomb coefficient.
    seal : float
        Station of the seal's grid line, as a fraction of the contact from its first edge.
    wetting : float
        Fraction of the fluid's pressure that is taken off the contact pressure in the friction law
        between the first edge and the seal; 0 for a dry contact, 1 for a wetted one.
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
        Where the next solve may start.
    force : float
        Axial force on the stone, positive downstream, in units of modulus × inner radius².
    station, r, z : arrays (edges, points)
        Reference coordinate Z and deformed coordinates of the contact, from upstream, in inner
        radii, at the Gauss–Lobatto points of each edge.
    contact_pressure : array (edges, points)
        Total contact pressure per deformed area (true stress, compression positive), in units of
        the modulus.
    steps : int
        Newton steps with a tangent of their own since the configuration from which it started.
    residual : float
        Norm of the residual, relative to twice the contact force.
    penetration : float
        How far the open wall passes through the stone, in radii of the stone.
    friction_work : float
        Energy that friction dissipates per length of reference wall by which the stone advances,
        in units of modulus × inner radius².
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
