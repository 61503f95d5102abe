"""Postprocessing of the sliding contact: deformed wall, far field and checks, as arrays."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from stonepass.fe.axisymmetric.balances import loaded_balance
from stonepass.fe.axisymmetric.discretisation import Discretisation
from stonepass.fe.axisymmetric.inner_wall import inner_wall
from stonepass.fe.axisymmetric.mesh import Layout
from stonepass.fe.axisymmetric.postprocessing import deformation, field, volume
from stonepass.fe.axisymmetric.sliding_state import SlidingState
from stonepass.fe.axisymmetric.sliding_workspace import Workspace, load
from stonepass.fe.axisymmetric.wall_values import Deformation, Field, Volume

__all__ = ["FarField", "LoadedWall", "loaded_wall"]

# Range in which the far field is evaluated, as fractions of the distance from stone to tube end.
FAR = (0.5, 0.9)


@dataclass(frozen=True)
class FarField:
    """Deformation of the tube far from the stone.

    Attributes
    ----------
    radius : float
        Deformed inner radius r_a/R_a upstream of the stone.
    upstream, downstream : float
        Axial stretch on either side of the stone.
    """

    radius: float
    upstream: float
    downstream: float


@dataclass(frozen=True, eq=False)
class LoadedWall:
    """The deformed wall of a sliding state.

    Attributes
    ----------
    field : Field
        Deformed coordinates in inner radii, and Cauchy stress in units of the modulus.
    deformation : Deformation
        Deformation gradient at the same points.
    volume : Volume
        Error of the volume of the wall.
    axial_balance : float
        Relative imbalance of the axial forces, see `balances.loaded_balance`.
    far_field : FarField
    """

    field: Field
    deformation: Deformation
    volume: Volume
    axial_balance: float
    far_field: FarField


@dataclass(frozen=True)
class _Solved:
    """The state loaded into a workspace, in the form that `postprocessing` requires."""

    discretisation: Discretisation
    layout: Layout


def loaded_wall(workspace: Workspace, state: SlidingState) -> LoadedWall:
    """Evaluate the deformed wall of a sliding state.

    Parameters
    ----------
    workspace : Workspace
        The workspace of the problem that the state solves. Its content is overwritten.
    state : SlidingState
    """
    configuration = state.configuration
    load(workspace, configuration)
    layout = workspace.problem.layout(configuration.edges, configuration.seal)
    solved = _Solved(workspace.discretisation, layout)
    return LoadedWall(
        field=field(solved),
        deformation=deformation(solved),
        volume=volume(solved),
        axial_balance=loaded_balance(solved, configuration.pressure, state.force),
        far_field=_far_field(workspace),
    )


def _far_field(workspace: Workspace) -> FarField:
    """Evaluate the tube at 50 to 90 % of the distance from the stone to each end."""
    wall, problem = inner_wall(workspace.discretisation), workspace.problem
    station, r, z = wall.station.ravel(), wall.r.ravel(), wall.z.ravel()

    def stretch(end: float) -> float:
        near, far = np.interp([fraction * end for fraction in FAR], station, z)
        return float((far - near) / ((FAR[1] - FAR[0]) * end))

    radius = float(np.interp(-sum(FAR) / 2.0 * problem.inlet, station, r))
    return FarField(radius, stretch(-problem.inlet), stretch(problem.outlet))
