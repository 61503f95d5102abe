"""Axisymmetric buckling of the uniform loaded tube, far from the stone.

A pressure on the outer wall compresses the tube around its circumference and along its axis. Beyond
a critical pressure the uniform tube is still in equilibrium, but the equilibrium is unstable:
displacements u(R) cos qZ, w(R) sin qZ lower its energy. Examples are the wrinkling of a shell under
axial thrust and the microbuckling of a wall without shear stiffness. No real tube stays in such a
state, and a solver that starts from it finds no solution or a meaningless one. See "Stability" in
docs/theory.md.
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
from stonepass.fe.core.threads import one_thread

__all__ = ["buckling_half_wave", "unstable_motions"]

ORDER, ROWS = 6, 2
STEP = 1.3  # largest ratio of successive trial lengths, from a third of the thickness to L
TOLERANCE = 1e-12


def buckling_half_wave(tube: Tube, lumen: float) -> float | None:
    """Find the shortest half-wave length at which the loaded tube buckles axisymmetrically.

    Half a wave is discretised by one column of elements, and `unstable_motions` counts the motions
    that lower its energy. Half-wave lengths from a third of the wall's thickness to the half-length
    of the tube are tried. The law is evaluated near Z = 0, even if it varies along the tube.

    Parameters
    ----------
    tube : Tube
        Its axial stretch and outside pressure are the loads.
    lumen : float
        Inner radius of the uniform tube in equilibrium, in undeformed inner radii.

    Returns
    -------
    float or None
        Reference half-wave length in inner radii, from a geometric sequence whose ratio is at most
        `STEP`. None if the tube is stable for all lengths of the sequence, or if the solution for
        the uniform tube does not converge.
    """
    d = discretise(tube, Arc.at(Profile(lumen)), _half_wave(tube, 1.0), ORDER)
    _uniform(d, lumen)
    free = free_unknowns(d, "")
    if not newton(FormSystem(wall_form(d), d.state, free), TOLERANCE).converged:
        return None
    shortest = (tube.wall_ratio - 1.0) / 3.0
    count = 1 + int(np.ceil(np.log(tube.half_length / shortest) / np.log(STEP)))
    # Threads of the linear algebra would slow down matrices as small as these.
    with one_thread():
        for length in np.geomspace(shortest, tube.half_length, count):
            place(d.mesh, _half_wave(tube, length))
            _stretch(d)
            if unstable_motions(d, free) > 0:
                return float(length)
    return None


def unstable_motions(d: Discretisation, free: Any) -> int:
    """Count independent motions that preserve volume and lower the energy of the current state.

    In a stable state the tangent of the mixed problem has exactly one negative eigenvalue for each
    pressure unknown, because each pressure unknown is the multiplier of one volume constraint. The
    count is the number of negative eigenvalues in excess of that.

    Parameters
    ----------
    d : Discretisation
        Its current state is an equilibrium.
    free : ngsolve.BitArray
        Mask of the unknowns that may change.

    Returns
    -------
    int
        Zero if the equilibrium is stable. See "Stability" in docs/theory.md.
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
