"""Contact of the inner wall with a rigid arc: kinematics, and the frictionless forms.

The normal multiplier λ ≥ 0 is the contact force per *reference* area. It is collocated at the
Gauss–Lobatto points of each edge, where the trace of the displacement has its nodes: contact
holds, or pressure vanishes, exactly at each of them, and no penalty error remains. See "Seated
state" in docs/theory.md.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import ngsolve as ng

from stonepass.fe.axisymmetric.profile import Profile
from stonepass.fe.axisymmetric.wall import SYMBOLS

__all__ = ["AUGMENTATION", "Arc", "bilateral", "unilateral"]

AUGMENTATION = 8.0  # factor of gap and slip in the augmented forms, in units of the modulus


@dataclass(frozen=True)
class Arc:
    """The meridian of the stone as symbols of the engine, which a loading path can move.

    Attributes
    ----------
    profile : Profile
        Its radius and offset are parameters of the engine, so a form with this arc is set up once.
    """

    profile: Profile

    @classmethod
    def at(cls, place: Profile) -> Arc:
        """Make an arc at a place given in numbers."""
        moved = {"radius": ng.Parameter(place.radius), "offset": ng.Parameter(place.offset)}
        return cls(replace(place, **moved))

    @property
    def place(self) -> Profile:
        """The present place, in numbers."""
        radius, offset = self.profile.radius.Get(), self.profile.offset.Get()
        return replace(self.profile, radius=radius, offset=offset)

    def move(self, place: Profile) -> None:
        """Move to another place of the same aspect and outline."""
        self.profile.radius.Set(place.radius)
        self.profile.offset.Set(place.offset)

    def gap(self, u: Any, w: Any) -> Any:
        """Distance of the deformed wall point from the arc, in inner radii, positive outside."""
        return self.profile.gap(ng.x + u, ng.y + w, SYMBOLS)

    def along(self, u: Any, w: Any) -> Any:
        """Place of the wall point on the arc: arc length from the equator over the radius."""
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

    The density is (⟨λ − c gap⟩₊² − λ²)/2c; its derivative changes branch where λ = c gap.

    Parameters
    ----------
    multiplier, gap : symbols
        Normal contact force per reference area λ, and the gap.
    c : float or symbol
        Factor of the gap, in units of the modulus, positive.
    """
    trial = multiplier - c * gap
    active = ng.IfPos(trial, trial, 0.0 * trial)
    return (active * active - multiplier * multiplier) / (2.0 * c) * ng.x


def bilateral(multiplier: Any, gap: Any) -> Any:
    """Lagrangian of gap = 0, per reference length (2π left out)."""
    return -1.0 * multiplier * gap * ng.x
