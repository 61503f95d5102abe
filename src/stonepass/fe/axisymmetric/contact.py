"""Contact of the inner wall with a rigid arc: kinematics, and the frictionless forms.

The normal multiplier λ ≥ 0 is the contact force per *reference* area. It is collocated at the
Gauss–Lobatto points of each edge, where the trace of the displacement has its nodes: contact
holds, or pressure vanishes, exactly at each of them, and no penalty error remains.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache
from typing import Any

import ngsolve as ng
import numpy as np
from jaxtyping import Float

from stonepass.fe.axisymmetric.profile import Profile
from stonepass.fe.axisymmetric.wall import SYMBOLS

__all__ = [
    "Arc",
    "bilateral",
    "joined",
    "lobatto",
    "lobatto_rule",
    "lobatto_slopes",
    "resampling",
    "unilateral",
]


@dataclass(frozen=True)
class Arc:
    """The rigid meridian as symbols: a profile whose radius and offset are engine parameters.

    So a loading path moves the arc without a new set-up.
    """

    profile: Profile

    @classmethod
    def at(cls, place: Profile) -> Arc:
        """Make an arc at its first place."""
        moved = {"radius": ng.Parameter(place.radius), "offset": ng.Parameter(place.offset)}
        return cls(replace(place, **moved))

    @property
    def place(self) -> Profile:
        """Where it is now, in numbers."""
        radius, offset = self.profile.radius.Get(), self.profile.offset.Get()
        return replace(self.profile, radius=radius, offset=offset)

    def move(self, place: Profile) -> None:
        """Go to another place of the path, of the same aspect and outline."""
        self.profile.radius.Set(place.radius)
        self.profile.offset.Set(place.offset)

    def gap(self, u: Any, w: Any) -> Any:
        """Distance of the deformed wall point from the arc."""
        return self.profile.gap(ng.x + u, ng.y + w, SYMBOLS)

    def along(self, u: Any, w: Any) -> Any:
        """Where the wall point lies on the arc: arc length from the equator over the radius."""
        return self.profile.along(ng.x + u, ng.y + w, SYMBOLS)

    def virtual_gap(self, u: Any, w: Any, du: Any, dw: Any) -> Any:
        """Change of the gap of a point on the arc under virtual displacements."""
        n_r, n_z = self.profile.normal(ng.x + u, ng.y + w, SYMBOLS)
        return n_r * du + n_z * dw

    def virtual_slip(self, u: Any, w: Any, du: Any, dw: Any) -> Any:
        """Change of the arc length of a point on the arc under virtual displacements."""
        n_r, n_z = self.profile.normal(ng.x + u, ng.y + w, SYMBOLS)
        return n_r * dw - n_z * du


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


@lru_cache(maxsize=8)
def resampling(
    order: int, count: int
) -> tuple[Float[np.ndarray, "count n"], Float[np.ndarray, "count n"]]:
    """Matrices from the values of a polynomial at the Gauss–Lobatto points to others.

    To its values and its slopes at `count` equidistant points of [0, 1], both ends included:
    ``resampling(1, 3)`` is [[1, 0], [0.5, 0.5], [0, 1]] and three rows of [-1, 1].
    """
    return _basis_change(order, np.linspace(0.0, 1.0, count))


def joined(samples: Float[np.ndarray, "edges count"]) -> Float[np.ndarray, " n"]:
    """Samples of neighbouring columns in one line, what two columns share once.

    ``joined`` of [[1, 2], [2, 3]] is [1, 2, 3].
    """
    return np.concatenate([samples[0, :1], samples[:, 1:].ravel()])


@lru_cache(maxsize=8)
def lobatto_slopes(order: int) -> Float[np.ndarray, "n n"]:
    """Matrix from the values of a polynomial at the Gauss–Lobatto points to its slopes there.

    ``lobatto_slopes(1)`` is [[-1, 1], [-1, 1]].
    """
    return _basis_change(order, lobatto(order)[0])[1]


def _basis_change(
    order: int, points: Float[np.ndarray, " m"]
) -> tuple[Float[np.ndarray, "m n"], Float[np.ndarray, "m n"]]:
    """Matrices from values at the Gauss–Lobatto points to values and slopes at `points`."""
    basis = [np.polynomial.legendre.Legendre.basis(k, domain=[0.0, 1.0]) for k in range(order + 1)]
    inverse = np.linalg.inv(np.column_stack([b(lobatto(order)[0]) for b in basis]))
    values = np.column_stack([b(points) for b in basis])
    slopes = np.column_stack([b.deriv()(points) for b in basis])
    return values @ inverse, slopes @ inverse


def lobatto_rule(order: int) -> ng.IntegrationRule:
    """The same rule for the engine's edges."""
    points, weights = lobatto(order)
    return ng.IntegrationRule(
        points=[(float(p), 0.0, 0.0) for p in points], weights=[float(w) for w in weights]
    )
