"""Does the loaded tube stay straight far from the stone, or do axisymmetric waves run along it?

A pressure from outside shortens hoop and axial fibres. Beyond some pressure the uniform tube is an
equilibrium still, but not a stable one: waves u(R) cos qZ, w(R) sin qZ lower its energy, as they do
in a shell under axial thrust, or kinks in a wall without shear stiffness. No tube stays so, and a
solver that starts from it finds no state, or one that means nothing.
"""

from __future__ import annotations

from typing import Any

import ngsolve as ng
import numpy as np
from jaxtyping import Float

from stonepass.fe.contact import Arc
from stonepass.fe.discrete import (
    NORMAL,
    TANGENTIAL,
    Discrete,
    discretise,
    free_unknowns,
    wall_form,
)
from stonepass.fe.mesh import Layout, place
from stonepass.fe.newton import Plain, newton
from stonepass.fe.problem import Tube

__all__ = ["unstable_wave"]

ORDER, ROWS = 6, 2
STEP = 1.3  # between the half-waves tried, from a third of the wall's thickness to L
TOLERANCE = 1e-12


def unstable_wave(tube: Tube, lumen: float) -> float | None:
    """Half-length, in inner radii, of a wave that lowers the energy of the loaded tube, or None.

    `lumen` is the inner radius of the uniform tube in equilibrium. One column of elements is half a
    wave long; the wave lowers the energy where the tangent has more negative eigenvalues than it
    has pressure unknowns, which are as many as its constraints of volume.
    """
    d = discretise(tube, Arc.at(lumen), _half_wave(tube, 1.0), ORDER)
    _uniform(d, lumen)
    free = free_unknowns(d, friction=False, closed_only=True)
    for component in (NORMAL, TANGENTIAL):
        for index in d.state.space.Range(component):
            free[index] = False
    if not newton(Plain(wall_form(d), d.state, free), TOLERANCE).converged:
        return None
    tangent = wall_form(d, condense=False)
    used = np.flatnonzero(np.array(list(free)))
    pressure = d.state.space.Range(2)
    constraints = int(((used >= pressure.start) & (used < pressure.stop)).sum())
    shortest = (tube.wall_ratio - 1.0) / 3.0
    count = 1 + int(np.ceil(np.log(tube.half_length / shortest) / np.log(STEP)))
    for length in np.geomspace(shortest, tube.half_length, count):
        place(d.mesh, _half_wave(tube, length))
        _stretch(d)
        tangent.AssembleLinearization(d.state.vec)
        if int((np.linalg.eigvalsh(_dense(tangent.mat, used)) < 0.0).sum()) > constraints:
            return float(length)
    return None


def _half_wave(tube: Tube, length: float) -> Layout:
    return Layout(np.linspace(1.0, tube.wall_ratio, ROWS + 1), np.array([0.0, length]), 1)


def _uniform(d: Discrete, lumen: float) -> None:
    r = ng.sqrt((ng.x * ng.x - 1.0) / d.tube.axial_stretch + lumen * lumen)
    d.state.components[0].Set(r - ng.x)
    _stretch(d)


def _stretch(d: Discrete) -> None:
    d.state.components[1].Set((d.tube.axial_stretch - 1.0) * ng.y)


def _dense(matrix: Any, used: Any) -> Float[np.ndarray, "n n"]:
    rows, columns, values = (np.asarray(part) for part in matrix.COO())
    full = np.zeros((matrix.height, matrix.width))
    full[rows, columns] = values
    return full[np.ix_(used, used)]
