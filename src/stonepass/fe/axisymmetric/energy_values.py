"""Values of an energy and of its slopes as the engine computes them, for comparison with NumPy."""

from __future__ import annotations

import ngsolve as ng
import numpy as np

from stonepass.array_types import Float
from stonepass.fe.axisymmetric.mesh import Layout, structured_mesh
from stonepass.fe.axisymmetric.problem import Energy
from stonepass.fe.axisymmetric.wall import PLACE, SYMBOLS
from stonepass.strain import CauchyGreen

__all__ = ["energy_values"]


def energy_values(energy: Energy, C: CauchyGreen, R: float) -> Float[np.ndarray, "points 5"]:
    """Evaluate an energy and its derivatives by C_rr, C_tt, C_zz, C_rz with the engine's symbols.

    Parameters
    ----------
    energy : Energy
    C : CauchyGreen
        Arrays (points,); the components rt and tz are ignored, as they vanish in axisymmetry.
    R : float
        Where in the wall, in inner radii, above 1; Z is 0.
    """
    mesh = structured_mesh(Layout(np.array([1.0, 2.0 * R]), np.array([-1.0, 1.0]), 0))
    symbols = CauchyGreen(*(ng.Parameter(1.0) for _ in range(4)))
    density = ng.CF(energy(symbols, PLACE, SYMBOLS))
    all_values = ng.CF((density, *(density.Diff(symbol) for symbol in symbols[:4])))
    found = []
    for components in zip(*C[:4], strict=True):
        for symbol, value in zip(symbols[:4], components, strict=True):
            symbol.Set(float(value))
        found.append(all_values(mesh(R, 0.0)))
    return np.array(found)
