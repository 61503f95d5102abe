"""The scout: frictionless contact as an inequality on a coarse mesh, to find the contact edge."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import ngsolve as ng
import numpy as np
from jaxtyping import Float

from stonepass.fe.axisymmetric.contact import Arc, unilateral
from stonepass.fe.axisymmetric.discrete import (
    Discrete,
    contact_force,
    discretise,
    free_unknowns,
    inner_wall,
    wall_form,
)
from stonepass.fe.axisymmetric.mesh import INNER, Layout
from stonepass.fe.axisymmetric.problem import Failure, Tube, Wrap
from stonepass.fe.axisymmetric.profile import Profile
from stonepass.fe.axisymmetric.wall import SYMBOLS
from stonepass.fe.core.grading import growing
from stonepass.fe.core.newton import Plain, newton_or_homotopy

__all__ = ["SCOUT_ORDER", "Start", "contact_edges", "scout", "scout_layout", "wrap_round"]

SCOUT_ORDER = 4
SCOUT_TOLERANCE = 1e-6  # of the contact force


@dataclass(frozen=True)
class Start:
    """A solution to start from: stations of the contact's edges, norm of its force, steps so far.

    With friction, `origin` has the stations and the places on the arc from which the last
    increment slips, and `dissipated` the energy that the increments before it took.
    """

    discrete: Discrete
    contact: tuple[float, float]
    force: float
    steps: int
    origin: tuple[Float[np.ndarray, " n"], Float[np.ndarray, " n"]] | None = None
    dissipated: float = 0.0


def scout(tube: Tube, stone: Profile, wrap: Wrap, columns: int, weight: float) -> Start | Failure:
    """Solve the contact inequality on `columns` equal columns over the guessed contact.

    `weight` is the factor of the gap in the augmented Lagrangian, in units of the modulus.
    """
    layout = scout_layout(tube, wrap.contact, columns, growth=2.0, whole=not stone.symmetric)
    d = discretise(tube, Arc.at(stone), layout, SCOUT_ORDER)
    wrap_round(d, wrap)
    system = Plain(_form(d, weight), d.state, free_unknowns(d, INNER))
    force = contact_force(d, system)
    report = newton_or_homotopy(system, d.stiffening.Set, SCOUT_TOLERANCE * force)
    if not report.converged:
        return Failure(report.reason, report.steps)
    edges = contact_edges(d)
    if edges is None:
        return Failure("the wall left the stone", report.steps)
    return Start(d, edges, force, report.steps)


def _form(d: Discrete, weight: float) -> Any:
    u, w, _, multiplier, _ = d.state.space.TrialFunction()
    form = wall_form(d)
    form += ng.Variation(
        unilateral(multiplier, d.arc.gap(u, w), ng.Parameter(weight)).Compile()
        * ng.ds(INNER, intrules={ng.SEGM: d.rule})
    )
    return form


def scout_layout(
    tube: Tube, contact: tuple[float, float], columns: int, growth: float, *, whole: bool
) -> Layout:
    """Equal columns over the contact, `columns` in each half; growing ones beyond."""
    first, last = contact
    equal = np.linspace(first, last, 2 * columns + 1)
    size = (last - first) / (2 * columns)
    downstream = last + growing(size, tube.half_length - last, growth)
    radial = 1.0 + growing(size, tube.wall_ratio - 1.0, 1.5 * growth)
    if not whole:
        half = equal[columns:] - equal[columns]
        return Layout(radial, np.concatenate([half, downstream[1:]]), closed=columns)
    upstream = first - growing(size, tube.half_length + first, growth)[::-1]
    axial = np.concatenate([upstream[:-1], equal, downstream[1:]])
    return Layout(radial, axial, closed=2 * columns, wet=len(upstream) - 1)


def contact_edges(d: Discrete) -> tuple[float, float] | None:
    """First and last station of the inner wall with contact force; None where there is none.

    On a half the first is the mirror image of the last.
    """
    wall = inner_wall(d)
    touching = wall.station[wall.normal > 1e-6 * wall.normal.max()]
    if not touching.size:
        return None
    last = float(touching.max())
    return (float(touching.min()) if d.whole else -last), last


def wrap_round(d: Discrete, wrap: Wrap) -> None:
    """Wrap the wall isochorically round the arc, with plane-strain pressures and no friction."""
    tube = d.tube
    stretch = tube.axial_stretch

    def along(values: Float[np.ndarray, " n"]) -> Any:
        knots = [wrap.station[0], *wrap.station, wrap.station[-1]]
        return ng.BSpline(2, [float(k) for k in knots], [float(v) for v in values])(ng.y)

    inner = along(wrap.inner_radius)
    r = ng.sqrt((ng.x * ng.x - 1.0) / stretch + inner * inner)
    u, w, p, multiplier, tangential = d.state.components
    u.Set(r - ng.x)
    w.Set((stretch - 1.0) * ng.y)
    hoop = r / ng.x
    c_rr = (1.0 / (hoop * hoop * stretch**2)).MakeVariable()
    zero, axial = ng.CF(0.0), ng.CF(stretch**2)
    U = ng.CF(tube.energy(c_rr, hoop * hoop, axial, zero, SYMBOLS))
    pressure = along(wrap.pressure)
    depth = (ng.x - 1.0) / (tube.wall_ratio - 1.0)
    p.Set(2.0 * c_rr * U.Diff(c_rr) + pressure * (1.0 - depth) + tube.outside_pressure * depth)
    first, last = wrap.contact
    force = pressure * inner * stretch
    multiplier.Set(
        ng.IfPos(last - ng.y, ng.IfPos(ng.y - first, force, 0.0), 0.0),
        definedon=d.mesh.Boundaries(INNER),
    )
    tangential.vec[:] = 0.0
