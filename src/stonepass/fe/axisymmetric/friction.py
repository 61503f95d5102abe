"""Coulomb friction on the arc, in residual form with a return map.

λ_n and λ_t are the normal and the tangential contact force per reference area; λ_t is positive
downstream. The position of a wall point on the arc is measured by its arc-length coordinate
(`Profile.along`). The *slip origin* of a point is its coordinate at the beginning of the increment,
or at first contact if it comes into contact within the increment. The slip of the increment is
s = radius × (coordinate − slip origin). Coulomb's law is the equation

    λ_t = projection of (λ_t − c s) on the interval [−μ λ_n, μ λ_n],    with any constant c > 0.

If |λ_t| < μ λ_n, this equation states s = 0 (stick). If |λ_t| = μ λ_n, it states that s and λ_t
have opposite signs, so that the traction opposes the slip. See "Friction and its path" in
docs/theory.md.
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
    """Return the residual of contact as an inequality, with friction, per reference length.

    The factor 2π is omitted.

    Parameters
    ----------
    trial, test : Unknowns
        Trial and test functions.
    arc : Arc
        The meridian of the stone.
    origin : symbol
        Slip origin of each wall point: arc length divided by the radius of the stone.
    friction : float or symbol
        Coulomb coefficient, zero or positive.
    c : float or symbol
        Factor of gap and slip in the augmented form, positive, in units of modulus per inner
        radius.
    """
    normal = trial.normal
    pressed = normal - c * arc.gap(trial.u, trial.w)
    force = ng.IfPos(pressed, pressed, 0.0 * pressed)
    return _residual(trial, test, arc, origin, friction, c, force, (normal - force) / c)


def closed_contact(
    trial: Unknowns, test: Unknowns, arc: Arc, origin: Any, friction: Any, c: Any
) -> Any:
    """Return the residual of contact as the equation gap = 0, with friction, per reference length.

    The factor 2π is omitted. For the parameters see `open_contact`.
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
    """Return the projection of `value` on the interval [−bound, bound]."""
    return ng.IfPos(value - bound, bound, ng.IfPos(-1.0 * bound - value, -1.0 * bound, value))
