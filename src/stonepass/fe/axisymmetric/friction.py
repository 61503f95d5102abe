"""Coulomb friction on the arc, in residual form with a return map.

λ_n and λ_t are normal and tangential contact force per reference area, λ_t positive downstream. In
one increment a wall point slips by s = radius × (place − origin), where `origin` is the place on
the arc at which it sticks, or at which it comes into contact. Then

    λ_t = λ_t − c s   projected on   |λ_t| ≤ μ λ_n :

inside the cone this states s = 0 (stick), on it the traction opposes the slip. See "Friction and
its path" in docs/theory.md.
"""

from __future__ import annotations

from typing import Any

import ngsolve as ng

from stonepass.fe.axisymmetric.contact import Arc
from stonepass.fe.axisymmetric.discretisation import Unknowns

__all__ = ["closed_contact", "open_contact"]


def open_contact(
    trial: Unknowns, test: Unknowns, arc: Arc, origin: Any, friction: Any, c: Any
) -> Any:
    """Residual of contact as an inequality with friction, per reference length (2π left out).

    Parameters
    ----------
    trial, test : Unknowns
    arc : Arc
        The stone.
    origin : symbol
        Place on the arc, arc length over the radius, from which each wall point slips.
    friction : float or symbol
        Coulomb coefficient, zero or positive.
    c : float or symbol
        Factor of gap and slip in the augmented form, in units of the modulus, positive.
    """
    normal = trial.normal
    pressed = normal - c * arc.gap(trial.u, trial.w)
    force = ng.IfPos(pressed, pressed, 0.0 * pressed)
    return _residual(trial, test, arc, origin, friction, c, force, (normal - force) / c)


def closed_contact(
    trial: Unknowns, test: Unknowns, arc: Arc, origin: Any, friction: Any, c: Any
) -> Any:
    """Residual of a wall held on the arc (gap = 0) with friction, per reference length.

    The parameters are those of `open_contact`.
    """
    gap = arc.gap(trial.u, trial.w)
    return _residual(trial, test, arc, origin, friction, c, trial.normal, gap)


def _residual(
    trial: Unknowns,
    test: Unknowns,
    arc: Arc,
    origin: Any,
    friction: Any,
    c: Any,
    force: Any,
    constraint: Any,
) -> Any:
    u, w, tangential = trial.u, trial.w, trial.tangential
    sticking = tangential - c * arc.profile.radius * (arc.along(u, w) - origin)
    traction = _clamp(sticking, friction * ng.IfPos(force, force, 0.0 * force))
    gap = arc.virtual_gap(u, w, test.u, test.w)
    slip = arc.virtual_slip(u, w, test.u, test.w)
    work = force * gap + traction * slip
    rows = constraint * test.normal + (tangential - traction) / c * test.tangential
    return -1.0 * (work + rows) * ng.x


def _clamp(value: Any, bound: Any) -> Any:
    """Project `value` on [−bound, bound]."""
    return ng.IfPos(value - bound, bound, ng.IfPos(-1.0 * bound - value, -1.0 * bound, value))
