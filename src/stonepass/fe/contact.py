"""Frictionless contact of the inner wall with a rigid profile, by a multiplier.

The multiplier λ ≥ 0 is the contact force per *reference* area. It is collocated at the
Gauss–Lobatto points of each edge, where the trace of the displacement has its nodes: contact
holds, or pressure vanishes, exactly at each of them, and no penalty error remains.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import ngsolve as ng
import numpy as np
from jaxtyping import Float

__all__ = ["bilateral", "lobatto", "lobatto_rule", "sphere_gap", "unilateral"]


def sphere_gap(u: Any, w: Any, radius: Any) -> Any:
    """Distance of the deformed wall point from a sphere centred at the origin."""
    r, z = ng.x + u, ng.y + w
    return ng.sqrt(r * r + z * z) - radius


def unilateral(multiplier: Any, gap: Any, c: Any) -> Any:
    """Augmented Lagrangian of gap ≥ 0, λ ≥ 0, λ gap = 0, per reference length (2π left out).

    (⟨λ − c gap⟩₊² − λ²)/2c; its semi-smooth derivative changes branch where λ = c gap.
    """
    trial = multiplier - c * gap
    active = ng.IfPos(trial, trial, 0.0 * trial)
    return (active * active - multiplier * multiplier) / (2.0 * c) * ng.x


def bilateral(multiplier: Any, gap: Any) -> Any:
    """Lagrangian of gap = 0, per reference length (2π left out)."""
    return -1.0 * multiplier * gap * ng.x


@lru_cache(maxsize=8)
def lobatto(order: int) -> tuple[Float[np.ndarray, " n"], Float[np.ndarray, " n"]]:
    """Gauss–Lobatto points and weights on [0, 1], `order` + 1 of them.

    ``lobatto(2)`` is Simpson's rule: points 0, ½, 1 and weights 1/6, 4/6, 1/6.
    """
    legendre = np.polynomial.legendre.Legendre.basis(order)
    x = np.concatenate([[-1.0], np.sort(legendre.deriv().roots().real), [1.0]])
    weights = 2.0 / (order * (order + 1) * legendre(x) ** 2)
    return (x + 1.0) / 2.0, weights / 2.0


def lobatto_rule(order: int) -> ng.IntegrationRule:
    """The same rule for the engine's edges."""
    points, weights = lobatto(order)
    return ng.IntegrationRule(
        points=[(float(p), 0.0, 0.0) for p in points], weights=[float(w) for w in weights]
    )
