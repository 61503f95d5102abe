"""Contact of stone and wall: what the state of every model can say."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol, Self, runtime_checkable

import numpy as np

from stonepass.array_types import Float

if TYPE_CHECKING:  # loads the finite elements
    from stonepass.fe.axisymmetric.wall_values import Field

__all__ = ["ContactState", "SolvedState"]


@runtime_checkable
class ContactState(Protocol):
    """Where stone and wall touch, and how hard."""

    @property
    def contact_angle(self) -> float:
        """θ in rad at which the contact begins."""

    @property
    def downstream_angle(self) -> float:
        """θ in rad at which the contact ends."""

    @property
    def equator_contact_pressure(self) -> float:
        """σ(π/2) in Pa."""

    @property
    def peak_contact_pressure(self) -> float:
        """Largest σ(θ) in Pa."""

    def pressure_at(self, theta: Float[np.ndarray, "*m"]) -> Float[np.ndarray, "*m"]:
        """Pressure on the stone in Pa at any θ in [0, π]."""

    def without_wall(self) -> Self:
        """Return the same state without the stress field, which is most of its size."""


@runtime_checkable
class SolvedState(ContactState, Protocol):
    """A contact that finite elements have solved: with the wall, its stability and the work."""

    wall: Field | None
    solver: Any
    stability: Any
