"""Values of an energy and its derivatives as NGSolve computes them, for comparison with NumPy."""

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
    """Evaluate an energy and its derivatives with respect to C_rr, C_tt, C_zz, C_rz in NGSolve.

    Parameters
    ----------
    energy : Energy
        Function ``energy(C, place, xp)``; the result has its unit.
    C : CauchyGreen
        Components as arrays (points,). The components rt and tz are ignored, because they vanish in
        axisymmetric deformations without torsion.
    R : float
        Reference radius of the place in the wall, in inner radii, above 1; its Z is 0.

    Returns
    -------
    array (points, 5)
        Energy and derivatives with respect to C_rr, C_tt, C_zz and C_rz.
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
