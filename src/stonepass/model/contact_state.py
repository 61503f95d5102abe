"""The interface to the contact of stone and wall that the states of all models share."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Protocol, Self, runtime_checkable

import numpy as np

from stonepass.array_types import Float

if TYPE_CHECKING:  # at run time the import would load the finite elements
    from stonepass.fe.axisymmetric.wall_values import Field

__all__ = ["ContactState", "SolvedState"]


@runtime_checkable
class ContactState(Protocol):
    """Extent and pressure of the contact between stone and wall.

    θ is the angle from the upstream axis in rad: the angle at the centre of a sphere, and the
    parametric angle of other stones (see "Stones that are not spheres" in docs/theory.md). σ(θ) is
    the contact pressure: normal force per deformed area, compression positive.
    """

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
        """Return the pressure on the stone in Pa at any angles θ in [0, π]."""

    def without_wall(self) -> Self:
        """Return the same state without the stress field, which takes most of its memory."""


@runtime_checkable
class SolvedState(ContactState, Protocol):
    """The contact in a finite-element solution.

    Attributes
    ----------
    wall : Field or None
        Deformed wall and Cauchy stress; None if it was not kept.
    solver : SolverReport or PushReport
        Size, cost and checks of the solution.
    stability : StabilityReport
        Stability of the solved wall.
    """

    wall: Field | None
    solver: Any
    stability: Any
