"""The scout: contact as an inequality on a coarse mesh, to find the contact edge roughly."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import ngsolve as ng
import numpy as np
from jaxtyping import Float

from stonepass.fe.contact import unilateral
from stonepass.fe.discrete import Discrete, contact_force, discretise, wall_form
from stonepass.fe.mesh import Layout, growing
from stonepass.fe.newton import Plain, newton
from stonepass.fe.problem import Failure, Tube, Wrap
from stonepass.fe.wall import SYMBOLS

__all__ = ["Scouted", "scout"]

SCOUT_ORDER = 4
SCOUT_TOLERANCE = 1e-6


@dataclass(frozen=True)
class Scouted:
    """The scout's solution: its discretisation, the last station in contact, the contact force."""

    discrete: Discrete
    edge: float
    force: float
    steps: int


def scout(tube: Tube, radius: float, wrap: Wrap, columns: int, weight: float) -> Scouted | Failure:
    """Solve the contact inequality on `columns` equal columns over the guessed contact.

    `weight` is the factor of the gap in the augmented Lagrangian, in units of the modulus.
    """
    d = discretise(tube, radius, _layout(tube, wrap, columns), SCOUT_ORDER)
    form = wall_form(d)
    form += ng.Variation(
        unilateral(d.multiplier, d.gap, ng.Parameter(weight)).Compile()
        * ng.ds("closed|open", intrules={ng.SEGM: d.rule})
    )
    _first_guess(d, tube, wrap)
    system = Plain(form, d.state, d.state.space.FreeDofs())
    force = contact_force(d, system)
    report = newton(system, SCOUT_TOLERANCE * force, most=30)
    if not report.converged:
        return Failure(report.reason, report.steps)
    points = d.mesh.MapToAllElements({ng.SEGM: d.rule}, d.mesh.Boundaries("closed|open"))
    station, multiplier = ng.y(points).ravel(), d.state.components[3](points).ravel()
    touching = multiplier > 1e-6 * multiplier.max()
    if not touching.any():
        return Failure("the wall left the stone", report.steps)
    return Scouted(d, float(station[touching].max()), force, report.steps)


def _layout(tube: Tube, wrap: Wrap, columns: int) -> Layout:
    first = wrap.reach / columns
    beyond = growing(first, tube.half_length - wrap.reach, 2.0)
    return Layout(
        radial=1.0 + growing(first, tube.wall_ratio - 1.0, 3.0),
        axial=np.concatenate([np.linspace(0.0, wrap.reach, columns + 1), wrap.reach + beyond[1:]]),
        closed=columns,
    )


def _first_guess(d: Discrete, tube: Tube, wrap: Wrap) -> None:
    """Wrap the wall isochorically round the sphere, with plane-strain pressures."""
    stretch = tube.axial_stretch

    def along(values: Float[np.ndarray, " n"]) -> Any:
        knots = [wrap.station[0], *wrap.station, wrap.station[-1]]
        return ng.BSpline(2, [float(k) for k in knots], [float(v) for v in values])(ng.y)

    inner = along(wrap.inner_radius)
    r = ng.sqrt((ng.x * ng.x - 1.0) / stretch + inner * inner)
    u, w, p, multiplier = d.state.components
    u.Set(r - ng.x)
    w.Set((stretch - 1.0) * ng.y)
    hoop = r / ng.x
    c_rr = (1.0 / (hoop * hoop * stretch**2)).MakeVariable()
    zero, axial = ng.CF(0.0), ng.CF(stretch**2)
    U = ng.CF(tube.energy(c_rr, hoop * hoop, axial, zero, SYMBOLS))
    pressure = along(wrap.pressure)
    depth = (ng.x - 1.0) / (tube.wall_ratio - 1.0)
    p.Set(2.0 * c_rr * U.Diff(c_rr) + pressure * (1.0 - depth) + tube.outside_pressure * depth)
    multiplier.Set(
        ng.IfPos(wrap.reach - ng.y, pressure * inner * stretch, 0.0),
        definedon=d.mesh.Boundaries("closed|open"),
    )
