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

from stonepass.fe.axisymmetric.contact import Arc
from stonepass.fe.axisymmetric.discrete import (
    Discrete,
    discretise,
    free_unknowns,
    wall_form,
)
from stonepass.fe.axisymmetric.mesh import Layout, place
from stonepass.fe.axisymmetric.problem import Tube
from stonepass.fe.axisymmetric.profile import Profile
from stonepass.fe.core.newton import Plain, newton

__all__ = ["unstable_motions", "unstable_wave"]

ORDER, ROWS = 6, 2
STEP = 1.3  # between the half-waves tried, from a third of the wall's thickness to L
TOLERANCE = 1e-12


def unstable_wave(tube: Tube, lumen: float) -> float | None:
    """Half-length, in inner radii, of a wave that lowers the energy of the loaded tube, or None.

    `lumen` is the inner radius of the uniform tube in equilibrium. One column of elements is half a
    wave long; the wave lowers the energy where the tangent has more negative eigenvalues than it
    has pressure unknowns, which are as many as its constraints of volume.
    """
    d = discretise(tube, Arc.at(Profile(lumen)), _half_wave(tube, 1.0), ORDER)
    _uniform(d, lumen)
    free = free_unknowns(d, "")
    if not newton(Plain(wall_form(d), d.state, free), TOLERANCE).converged:
        return None
    shortest = (tube.wall_ratio - 1.0) / 3.0
    count = 1 + int(np.ceil(np.log(tube.half_length / shortest) / np.log(STEP)))
    for length in np.geomspace(shortest, tube.half_length, count):
        place(d.mesh, _half_wave(tube, length))
        _stretch(d)
        if unstable_motions(d, free) > 0:
            return float(length)
    return None


def unstable_motions(d: Discrete, free: Any) -> int:
    """How many independent motions that keep volume lower the energy of the wall as it is.

    The tangent's negative eigenvalues, less one for each free pressure unknown: each constrains
    the volume once.
    """
    tangent = wall_form(d, condense=False)
    tangent.AssembleLinearization(d.state.vec)
    rows, columns, values = (np.asarray(part) for part in tangent.mat.COO())
    matrix = np.zeros((len(free), len(free)))
    matrix[rows, columns] = values
    used = np.flatnonzero(np.array(list(free)))
    pressure = d.state.space.Range(2)
    constraints = ((used >= pressure.start) & (used < pressure.stop)).sum()
    return int((np.linalg.eigvalsh(matrix[np.ix_(used, used)]) < 0.0).sum() - constraints)


def _half_wave(tube: Tube, length: float) -> Layout:
    return Layout(np.linspace(1.0, tube.wall_ratio, ROWS + 1), np.array([0.0, length]), 1)


def _uniform(d: Discrete, lumen: float) -> None:
    r = ng.sqrt((ng.x * ng.x - 1.0) / d.tube.axial_stretch + lumen * lumen)
    d.state.components[0].Set(r - ng.x)
    _stretch(d)


def _stretch(d: Discrete) -> None:
    d.state.components[1].Set((d.tube.axial_stretch - 1.0) * ng.y)
