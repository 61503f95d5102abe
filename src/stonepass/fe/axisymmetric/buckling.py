"""Axisymmetric buckling of the uniform loaded tube, far from the stone.

An outside pressure shortens hoop and axial fibres. Beyond some pressure the uniform tube is still
an equilibrium, but not a stable one: waves u(R) cos qZ, w(R) sin qZ lower its energy, as in a shell
under axial thrust, or as microbuckling in a wall without shear stiffness. No real tube stays in
such a state, and a solver that starts from it finds no solution, or a meaningless one.
"""

from __future__ import annotations

from typing import Any

import ngsolve as ng
import numpy as np

from stonepass.fe.axisymmetric.contact import Arc
from stonepass.fe.axisymmetric.discretisation import (
    PRESSURE,
    Discretisation,
    discretise,
    free_unknowns,
    wall_form,
)
from stonepass.fe.axisymmetric.mesh import Layout, place
from stonepass.fe.axisymmetric.problem import Tube
from stonepass.fe.axisymmetric.profile import Profile
from stonepass.fe.core.newton import newton
from stonepass.fe.core.systems import FormSystem

__all__ = ["buckling_half_wave", "unstable_motions"]

ORDER, ROWS = 6, 2
STEP = 1.3  # between the half-waves tried, from a third of the wall's thickness to L
TOLERANCE = 1e-12


def buckling_half_wave(tube: Tube, lumen: float) -> float | None:
    """Shortest half-wave length found at which the loaded tube buckles axisymmetrically.

    One column of elements is half a wave long. The wave lowers the energy where the tangent has
    more negative eigenvalues than pressure unknowns, each of which constrains the volume once. A
    law that varies along the tube is taken as it is next to Z = 0.

    Parameters
    ----------
    tube : Tube
        With its axial stretch and outside pressure.
    lumen : float
        Inner radius of the uniform tube in equilibrium, in undeformed inner radii.

    Returns
    -------
    float or None
        Reference length in inner radii, among lengths that grow by the factor `STEP`; None where
        the tube is stable against all of them.
    """
    d = discretise(tube, Arc.at(Profile(lumen)), _half_wave(tube, 1.0), ORDER)
    _uniform(d, lumen)
    free = free_unknowns(d, "")
    if not newton(FormSystem(wall_form(d), d.state, free), TOLERANCE).converged:
        return None
    shortest = (tube.wall_ratio - 1.0) / 3.0
    count = 1 + int(np.ceil(np.log(tube.half_length / shortest) / np.log(STEP)))
    for length in np.geomspace(shortest, tube.half_length, count):
        place(d.mesh, _half_wave(tube, length))
        _stretch(d)
        if unstable_motions(d, free) > 0:
            return float(length)
    return None


def unstable_motions(d: Discretisation, free: Any) -> int:
    """Number of independent volume-preserving motions that lower the energy of the current state.

    It is the number of negative eigenvalues of the tangent, less the number of free pressure
    unknowns, each of which constrains the volume once.

    Parameters
    ----------
    d : Discretisation
        Holds an equilibrium.
    free : ngsolve.BitArray
        Unknowns that may change.
    """
    tangent = wall_form(d, condense=False)
    tangent.AssembleLinearization(d.state.vec)
    rows, columns, values = (np.asarray(part) for part in tangent.mat.COO())
    matrix = np.zeros((len(free), len(free)))
    matrix[rows, columns] = values
    used = np.flatnonzero(np.array(list(free)))
    pressure = d.state.space.Range(PRESSURE)
    constraints = ((used >= pressure.start) & (used < pressure.stop)).sum()
    return int((np.linalg.eigvalsh(matrix[np.ix_(used, used)]) < 0.0).sum() - constraints)


def _half_wave(tube: Tube, length: float) -> Layout:
    return Layout(np.linspace(1.0, tube.wall_ratio, ROWS + 1), np.array([0.0, length]), 1)


def _uniform(d: Discretisation, lumen: float) -> None:
    r = ng.sqrt((ng.x * ng.x - 1.0) / d.tube.axial_stretch + lumen * lumen)
    d.fields.u.Set(r - ng.x)
    _stretch(d)


def _stretch(d: Discretisation) -> None:
    d.fields.w.Set((d.tube.axial_stretch - 1.0) * ng.y)
