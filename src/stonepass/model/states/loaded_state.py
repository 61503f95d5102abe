"""The loaded push-through state as values: contact, force on the stone, wall."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Float
from stonepass.caution import Caution, caution
from stonepass.model.problem import Problem
from stonepass.model.states.stability_report import StabilityReport

if TYPE_CHECKING:  # loads the finite elements
    from stonepass.fe.axisymmetric.wall_values import Field, Volume

__all__ = ["Critical", "NoPush", "PushReport", "PushedState"]

LOADED_IMBALANCE = 0.01  # of the forces at the ends of the tube


@dataclass(frozen=True)
class PushReport:
    """What the finite elements did.

    Attributes
    ----------
    dofs, newton_steps, seconds : int, int, float
        Unknowns of the mesh; Newton steps with a tangent of their own and seconds of all that was
        solved for the answer.
    residual : float
        Relative to the contact force.
    volume : Volume
        How well volume is kept.
    axial_balance : float
        Axial force left over on tube and stone, relative to the forces at the tube's ends.
    penetration : float
        How far the open wall passes through the stone where friction begins with a step, in radii
        of the stone.
    """

    dofs: int
    newton_steps: int
    seconds: float = field(compare=False)
    residual: float
    volume: Volume
    axial_balance: float
    penetration: float


@array_dataclass
@dataclass(frozen=True)
class PushedState:
    """The loaded wall round the held stone, in SI.

    Attributes
    ----------
    urine_pressure : float
        P_u in Pa.
    net_force : float
        N/(π R_s²) in Pa: axial force on the stone over its cross-section, positive downstream;
        negative while the stone is stuck.
    friction_work : float
        D/(π R_s²) in Pa, D = ∫ μ σ λ_s dA with λ_s the wall's meridional stretch: what friction
        takes as the stone goes on by one length of wall, pre-stretched but not loaded. N = I − D
        (`model.energy_balance`).
    theta, contact_pressure : arrays
        Total contact pressure in Pa (true stress, compression positive) over θ in rad from the
        upstream axis (parametric where the stone is no sphere, `model.shape`), from the upstream
        edge of the contact to the downstream one.
    upstream_radius, upstream_stretch : float
        r_a/R_a and axial stretch far from the stone.
    downstream_stretch : float
        Axial stretch far downstream.
    wall : Field
        Deformed wall and Cauchy stress (Pa, tension positive) of the whole tube, lengths in inner
        radii, z from the stone's widest place downstream.
    solver : PushReport
    stability : StabilityReport
        Stability of the wall's own law in this state, without the relaxation.
    microbuckled : bool
        Whether the law was relaxed somewhere: axial fibres compressed until they buckle.
    """

    case: Problem
    urine_pressure: float
    net_force: float
    friction_work: float
    theta: Float[np.ndarray, " n"]
    contact_pressure: Float[np.ndarray, " n"]
    upstream_radius: float
    upstream_stretch: float
    downstream_stretch: float
    wall: Field | None
    solver: PushReport
    stability: StabilityReport
    microbuckled: bool

    @property
    def contact_angle(self) -> float:
        """α in rad, at which the contact begins; upstream of it the wall has opened."""
        return float(self.theta[0])

    @property
    def downstream_angle(self) -> float:
        """θ in rad at which the contact ends."""
        return float(self.theta[-1])

    @property
    def seal_angle(self) -> float:
        """θ in rad of the largest contact pressure, which holds the urine back."""
        return float(self.theta[np.argmax(self.contact_pressure)])

    @property
    def peak_contact_pressure(self) -> float:
        """Largest σ(θ) in Pa."""
        return float(self.contact_pressure.max())

    @property
    def equator_contact_pressure(self) -> float:
        """σ(π/2) in Pa: the urine pressure where the wall has opened beyond the equator."""
        return float(self.pressure_at(np.array(np.pi / 2)))

    def warnings(self) -> list[Caution]:
        """What a reader of the state must know."""
        found = []
        if self.solver.axial_balance > LOADED_IMBALANCE:
            found.append(caution("loaded_imbalance", imbalance=self.solver.axial_balance))
        if self.microbuckled and self.stability.margin <= 0.0:
            R, Z = self.stability.weakest_at
            return [*found, caution("microbuckling", R=R, Z=Z), *self.stability.folding()]
        return [*found, *self.stability.warnings()]

    def without_wall(self) -> PushedState:
        """Return the same state without the stress field."""
        return replace(self, wall=None)

    def pressure_at(self, theta: Float[np.ndarray, "*m"]) -> Float[np.ndarray, "*m"]:
        """Pressure on the stone in Pa at any θ in [0, π]: P_u before the contact, 0 behind it."""
        inside = np.interp(
            theta, self.theta, self.contact_pressure, left=self.urine_pressure, right=0.0
        )
        return np.asarray(inside)  # NumPy makes a number of an array without dimensions


@dataclass(frozen=True)
class NoPush:
    """The finite elements found no loaded state."""

    reason: str
    newton_steps: int
    seconds: float = field(compare=False)


@dataclass(frozen=True)
class Critical:
    """How a held stone is let go.

    Attributes
    ----------
    state : PushedState
        Where no force is left on the stone; where urine passes first, the last state before.
    leak_pressure : float or None
        P_u in Pa at which urine passes the held stone; None where it was not asked for, or not
        found.
    leaks : bool
        Whether urine passes first.
    """

    state: PushedState
    leak_pressure: float | None
    leaks: bool

    @property
    def newton_steps(self) -> int:
        """Newton steps with a tangent of their own."""
        return self.state.solver.newton_steps

    @property
    def seconds(self) -> float:
        """Seconds of all that was solved for it."""
        return self.state.solver.seconds
