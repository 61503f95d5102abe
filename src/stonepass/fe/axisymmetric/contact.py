"""Contact of the inner wall with a rigid arc: kinematics, and the frictionless forms.

The *arc* is the meridian of the stone. The normal multiplier λ ≥ 0 is the contact force per
*reference* area. It is collocated at the Gauss–Lobatto points of each edge, which are also the
nodes of the displacement on that edge. At each of these points either the gap or the contact force
vanishes exactly, so there is no penalty error. See "Seated state" in docs/theory.md.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import ngsolve as ng

from stonepass.fe.axisymmetric.profile import Profile
from stonepass.fe.axisymmetric.wall import SYMBOLS

__all__ = ["AUGMENTATION", "Arc", "bilateral", "unilateral"]

AUGMENTATION = 8.0  # factor of gap and slip in the augmented forms, modulus per inner radius


@dataclass(frozen=True)
class Arc:
    """The meridian of the stone in NGSolve symbols; a loading path can move it.

    The displacements u, w and du, dw of its methods are coefficient functions on the inner wall, in
    inner radii.

    Attributes
    ----------
    profile : Profile
        Its radius and offset are NGSolve parameters, so a form that contains the arc need not be
        set up again when the arc moves.
    """

    profile: Profile

    @classmethod
    def at(cls, place: Profile) -> Arc:
        """Create an arc from a profile whose radius and offset are numbers."""
        moved = {"radius": ng.Parameter(place.radius), "offset": ng.Parameter(place.offset)}
        return cls(replace(place, **moved))

    @property
    def place(self) -> Profile:
        """The current profile, with radius and offset as numbers."""
        radius, offset = self.profile.radius.Get(), self.profile.offset.Get()
        return replace(self.profile, radius=radius, offset=offset)

    def move(self, place: Profile) -> None:
        """Set radius and offset to those of `place`, whose aspect and outline must be the same."""
        self.profile.radius.Set(place.radius)
        self.profile.offset.Set(place.offset)

    def gap(self, u: Any, w: Any) -> Any:
        """Return the distance of the deformed wall from the arc, positive outside the stone."""
        return self.profile.gap(ng.x + u, ng.y + w, SYMBOLS)

    def along(self, u: Any, w: Any) -> Any:
        """Return the arc-length coordinate of the deformed wall, see `Profile.along`."""
        return self.profile.along(ng.x + u, ng.y + w, SYMBOLS)

    def virtual_gap(self, u: Any, w: Any, du: Any, dw: Any) -> Any:
        """Return the first variation of the gap for points on the arc: n · (du, dw)."""
        n_r, n_z = self.profile.normal(ng.x + u, ng.y + w, SYMBOLS)
        return n_r * du + n_z * dw

    def virtual_slip(self, u: Any, w: Any, du: Any, dw: Any) -> Any:
        """Return the first variation of the position along the arc, for points on it: t · (du, dw).

        The unit tangent t points downstream.
        """
        n_r, n_z = self.profile.normal(ng.x + u, ng.y + w, SYMBOLS)
        return n_r * dw - n_z * du


def unilateral(multiplier: Any, gap: Any, c: Any) -> Any:
    """Return the augmented Lagrangian of gap ≥ 0, λ ≥ 0, λ gap = 0, per reference length.

    The density is R (⟨λ − c gap⟩₊² − λ²)/2c; the factor 2π is omitted. It is continuously
    differentiable, and its second derivative jumps at λ = c gap.

    Parameters
    ----------
    multiplier : symbol
        Normal contact force λ per reference area, in units of the modulus.
    gap : symbol
        Gap, in inner radii.
    c : float or symbol
        Factor of the gap, positive, in units of modulus per inner radius.
    """
    trial = multiplier - c * gap
    active = ng.IfPos(trial, trial, 0.0 * trial)
    return (active * active - multiplier * multiplier) / (2.0 * c) * ng.x


def bilateral(multiplier: Any, gap: Any) -> Any:
    """Return the Lagrangian −λ gap R of the constraint gap = 0, per reference length.

    The factor 2π is omitted. For the parameters see `unilateral`.
    """
    return -1.0 * multiplier * gap * ng.x
