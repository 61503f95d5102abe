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
        Holds the approximate state, which the finer solve interpolates.
    contact : (float, float)
        Stations of the contact's edges, in inner radii.
    force : float
        Norm of the nodal contact forces, in units of modulus × inner radius².
    steps : int
        Newton steps spent so far.
    origin : (array (n,), array (n,)), optional
        With friction, stations along the wall and the places on the arc from which these wall
        points slip in the last increment.
    dissipated : float
        Energy that friction dissipated in all increments but the last, in units of modulus × inner
        radius³.
    """

    discretisation: Discretisation
    contact: tuple[float, float]
    force: float
    steps: int
    origin: tuple[Float[np.ndarray, " n"], Float[np.ndarray, " n"]] | None = None
    dissipated: float = 0.0
