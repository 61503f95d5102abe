"""The contact predictor: frictionless contact on a coarse mesh, which locates the contact edges.

See "The contact edge" in docs/theory.md, section "Seated state".
"""

from __future__ import annotations

from typing import Any

import ngsolve as ng
import numpy as np

from stonepass.array_types import Float
from stonepass.fe.axisymmetric.contact import Arc, unilateral
from stonepass.fe.axisymmetric.discretisation import (
    Discretisation,
    contact_force,
    discretise,
    free_unknowns,
    wall_form,
)
from stonepass.fe.axisymmetric.equilibrium import residual_tolerance
from stonepass.fe.axisymmetric.inner_wall import contact_edges
from stonepass.fe.axisymmetric.layouts import equal_layout
from stonepass.fe.axisymmetric.mesh import INNER
from stonepass.fe.axisymmetric.problem import Failure, Tube, Wrap
from stonepass.fe.axisymmetric.profile import Profile
from stonepass.fe.axisymmetric.start import Start
from stonepass.fe.axisymmetric.wall import PLACE, SYMBOLS
from stonepass.fe.core.newton import newton_or_homotopy
from stonepass.fe.core.systems import FormSystem
from stonepass.strain import CauchyGreen

__all__ = ["PREDICTOR_ORDER", "predict_contact", "wrap_round"]

PREDICTOR_ORDER = 4  # polynomial order of the displacements
PREDICTOR_TOLERANCE = 1e-6  # tolerance of the residual, relative to the contact force


def predict_contact(
    tube: Tube, stone: Profile, wrap: Wrap, columns: int, weight: float
) -> Start | Failure:
    """Solve the contact inequality without friction on a coarse mesh.

    Parameters
    ----------
    tube : Tube
    stone : Profile
        The stone, lengths in inner radii.
    wrap : Wrap
        First guess of the deformed wall.
    columns : int
        Number of equal columns over each half of the guessed contact, at least 1.
    weight : float
        Factor c of the gap in the augmented Lagrangian, positive (see `contact.unilateral`).

    Returns
    -------
    Start or Failure
        The contact edges of the start are accurate to one nodal spacing.
    """
    layout = equal_layout(tube, wrap.contact, columns, growth=2.0, whole=not stone.symmetric)
    d = discretise(tube, Arc.at(stone), layout, PREDICTOR_ORDER)
    wrap_round(d, wrap)
    system = FormSystem(_form(d, weight), d.state, free_unknowns(d, INNER))
    force = contact_force(d, system)
    tolerance = residual_tolerance(system, force, PREDICTOR_TOLERANCE)
    report = newton_or_homotopy(system, d.stiffening.Set, tolerance)
    if not report.converged:
        return Failure(report.reason, report.steps)
    edges = contact_edges(d)
    if edges is None:
        return Failure("the wall lost contact with the stone", report.steps)
    return Start(d, edges, force, report.steps)


def _form(d: Discretisation, weight: float) -> Any:
    trial = d.trial
    form = wall_form(d)
    form += ng.Variation(
        unilateral(trial.normal, d.arc.gap(trial.u, trial.w), ng.Parameter(weight)).Compile()
        * ng.ds(INNER, intrules={ng.SEGM: d.rule})
    )
    return form


def wrap_round(d: Discretisation, wrap: Wrap) -> None:
    """Set the state of `d` to a first guess: the wall wrapped round the arc at constant volume.

    Every cross-section is deformed like that of a long uniform tube. The inner radius and the inner
    pressure of that tube are the values of `wrap` at the station, and its axial stretch is the
    imposed one. The tangential contact force is zero. See "First guess" in docs/theory.md.

    Parameters
    ----------
    d : Discretisation
        Its state is overwritten.
    wrap : Wrap
        Inner radius and inner pressure along the tube.
    """
    tube = d.tube
    stretch = tube.axial_stretch

    def along(values: Float[np.ndarray, " n"]) -> Any:
        knots = [wrap.station[0], *wrap.station, wrap.station[-1]]
        return ng.BSpline(2, [float(k) for k in knots], [float(v) for v in values])(ng.y)

    inner = along(wrap.inner_radius)
    r = ng.sqrt((ng.x * ng.x - 1.0) / stretch + inner * inner)
    u, w, p, normal, tangential = d.fields
    u.Set(r - ng.x)
    w.Set((stretch - 1.0) * ng.y)
    hoop = r / ng.x
    c_rr = (1.0 / (hoop * hoop * stretch**2)).MakeVariable()
    zero, axial = ng.CF(0.0), ng.CF(stretch**2)
    U = ng.CF(tube.energy(CauchyGreen(c_rr, hoop * hoop, axial, zero), PLACE, SYMBOLS))
    pressure = along(wrap.pressure)
    depth = (ng.x - 1.0) / (tube.wall_ratio - 1.0)
    # `Compile` evaluates common terms of the law once instead of at each occurrence.
    wall_pressure = (2.0 * c_rr * U.Diff(c_rr)).Compile()
    p.Set(wall_pressure + pressure * (1.0 - depth) + tube.outside_pressure * depth)
    first, last = wrap.contact
    force = pressure * inner * stretch
    normal.Set(
        ng.IfPos(last - ng.y, ng.IfPos(ng.y - first, force, 0.0), 0.0),
        definedon=d.mesh.Boundaries(INNER),
    )
    tangential.vec[:] = 0.0
