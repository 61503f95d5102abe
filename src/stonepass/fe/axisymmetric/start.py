"""A starting point for the solves of the seated contact."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from stonepass.array_types import Float
from stonepass.fe.axisymmetric.discretisation import Discretisation

__all__ = ["Start"]


@dataclass(frozen=True, eq=False)
class Start:
    """An approximate solution from which a finer solve starts.

    Attributes
    ----------
    discretisation : Discretisation
        Its state is the approximate solution, which the finer solve interpolates.
    contact : (float, float)
        Stations of the contact edges, in inner radii.
    force : float
        Norm of the nodal contact forces, in units of modulus × inner radius².
    steps : int
        Number of Newton steps with a newly factorised tangent so far.
    origin : (array (n,), array (n,)), optional
        Stations along the wall, in inner radii, and the slip origins of these wall points in the
        last increment (see `friction`). None if there is no friction.
    dissipated : float
        Energy that friction dissipated in all increments except the last one, in the meshed part of
        the tube, in units of modulus × inner radius³.
    """

    discretisation: Discretisation
    contact: tuple[float, float]
    force: float
    steps: int
    origin: tuple[Float[np.ndarray, " n"], Float[np.ndarray, " n"]] | None = None
    dissipated: float = 0.0
