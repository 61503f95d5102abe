"""Coulomb friction on the arc, in residual form with a return map.

λ_n and λ_t are normal and tangential contact force per reference area, λ_t positive downstream. In
one increment the wall point slips by s = radius × (place − origin), where `origin` is the place on
the arc at which it stuck, or at which it came into contact. Then

    λ_t = λ_t − c s   projected on   |λ_t| ≤ μ λ_n :

inside the cone this says s = 0 (stick), on it the traction opposes the slip.
"""

from __future__ import annotations

from typing import Any

import ngsolve as ng

from stonepass.fe.axisymmetric.contact import Arc

__all__ = ["closed_contact", "open_contact"]


def open_contact(trial: Any, test: Any, arc: Arc, origin: Any, friction: Any, c: Any) -> Any:
    """Residual of contact as an inequality with friction, per reference length (2π left out)."""
    u, w, _, normal, _ = trial
    pressed = normal - c * arc.gap(u, w)
    force = ng.IfPos(pressed, pressed, 0.0 * pressed)
    return _residual(trial, test, arc, origin, friction, c, force, (normal - force) / c)


def closed_contact(trial: Any, test: Any, arc: Arc, origin: Any, friction: Any, c: Any) -> Any:
    """Residual of a wall held on the arc (gap = 0) with friction, per reference length."""
    u, w, _, normal, _ = trial
    return _residual(trial, test, arc, origin, friction, c, normal, arc.gap(u, w))


def _residual(
    trial: Any,
    test: Any,
    arc: Arc,
    origin: Any,
    friction: Any,
    c: Any,
    force: Any,
    constraint: Any,
) -> Any:
    u, w, _, _, tangential = trial
    du, dw, _, d_normal, d_tangential = test
    sticking = tangential - c * arc.profile.radius * (arc.along(u, w) - origin)
    traction = _clamp(sticking, friction * ng.IfPos(force, force, 0.0 * force))
    work = force * arc.virtual_gap(u, w, du, dw) + traction * arc.virtual_slip(u, w, du, dw)
    rows = constraint * d_normal + (tangential - traction) / c * d_tangential
    return -1.0 * (work + rows) * ng.x


def _clamp(value: Any, bound: Any) -> Any:
    """Project `value` on [−bound, bound]."""
    return ng.IfPos(value - bound, bound, ng.IfPos(-1.0 * bound - value, -1.0 * bound, value))
