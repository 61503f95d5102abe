"""Results for the loaded state of a held stone: contact, force on the stone, wall.

See "The push-through, solved directly" in docs/theory.md.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Float
from stonepass.caution import Caution, caution
from stonepass.model.problem import Problem
from stonepass.model.states.stability_report import StabilityReport

if TYPE_CHECKING:  # at run time the import would load the finite elements
    from stonepass.fe.axisymmetric.wall_values import Field, Volume

__all__ = ["Critical", "NoPush", "PushReport", "PushedState"]

LOADED_IMBALANCE = 0.01  # imbalance above which a warning is given, relative to the end forces


@dataclass(frozen=True)
class PushReport:
    """Size and cost of a finite-element solution, and independent checks of it.

    Attributes
    ----------
    dofs : int
        Number of unknowns of the mesh.
    newton_steps : int
        Number of Newton steps with a newly factorised tangent, including the seated state.
    seconds : float
        Wall-clock time in s of all solves for this result.
    residual : float
        Norm of the residual relative to the contact force.
    volume : Volume
        Error of the volume of the wall.
    axial_balance : float
        Unbalanced axial force on tube and stone, relative to the forces at the ends of the tube.
    penetration : float
        Largest penetration of the open wall into the stone at the upstream contact edge, where the
        friction traction begins with a step, in radii of the stone.
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
    """The loaded wall round the held stone, in SI units.

    Attributes
    ----------
    case : Problem
        The problem that was solved.
    urine_pressure : float
        Urine pressure P_u in Pa upstream of the stone.
    net_force : float
        Axial force on the stone divided by its cross-section, N/(π R_s²), in Pa. It is positive
        downstream, and negative while the stone is stuck.
    friction_work : float
        Frictional dissipation D/(π R_s²) in Pa, per unit advance of the stone along the
        pre-stretched but otherwise unloaded wall. D = ∫ μ σ λ_s dA with the meridional stretch λ_s
        of the wall. The energy balance is N = I − D (`model.energy_balance`).
    theta : array (n,)
        Angles θ in rad, from the upstream to the downstream edge of the contact, as in `Contact`.
    contact_pressure : array (n,)
        Total contact pressure in Pa at `theta` (true stress, compression positive).
    upstream_radius, upstream_stretch : float
        Inner radius r_a/R_a and axial stretch far upstream of the stone.
    downstream_stretch : float
        Axial stretch far downstream of the stone.
    wall : Field or None
        Deformed wall of the whole tube, lengths in inner radii, with z = 0 at the widest place of
        the stone and z positive downstream; Cauchy stress in Pa, tension positive. None if it was
        not kept.
    solver : PushReport
    stability : StabilityReport
        Stability of the law without relaxation, in this state of the wall.
    microbuckled : bool
        True if axial fibres are buckled somewhere in the wall, so that its relaxed energy differs
        from that of the law.
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
        """Angle α in rad at which the contact begins; upstream of it the wall has opened."""
        return float(self.theta[0])

    @property
    def downstream_angle(self) -> float:
        """Angle θ in rad at which the contact ends."""
        return float(self.theta[-1])

    @property
    def seal_angle(self) -> float:
        """Angle θ in rad of the largest contact pressure, which holds back the urine."""
        return float(self.theta[np.argmax(self.contact_pressure)])

    @property
    def peak_contact_pressure(self) -> float:
        """Largest contact pressure in Pa."""
        return float(self.contact_pressure.max())

    @property
    def equator_contact_pressure(self) -> float:
        """Pressure on the equator of the stone in Pa, see `pressure_at`."""
        return float(self.pressure_at(np.array(np.pi / 2)))

    def warnings(self) -> list[Caution]:
        """Return the cautions that apply to this state."""
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
        """Return the pressure on the stone in Pa at angles θ in [0, π] in rad.

        It is P_u upstream of the contact, the contact pressure within it, and 0 downstream of it.
        """
        inside = np.interp(
            theta, self.theta, self.contact_pressure, left=self.urine_pressure, right=0.0
        )
        return np.asarray(inside)  # NumPy returns a scalar for an array without dimensions


@dataclass(frozen=True)
class NoPush:
    """Result of a solve that found no loaded state.

    Attributes
    ----------
    reason : str
        Reason of the failure, as part of a sentence.
    newton_steps : int
        Number of Newton steps with a newly factorised tangent.
    seconds : float
        Wall-clock time in s.
    """

    reason: str
    newton_steps: int
    seconds: float = field(compare=False)


@dataclass(frozen=True)
class Critical:
    """The critical state of a held stone: it moves, or urine passes it.

    Attributes
    ----------
    state : PushedState
        The state in which the axial force on the stone vanishes. If urine passes first, the last
        state that was solved below the leak pressure.
    leak_pressure : float or None
        Urine pressure in Pa at which urine passes the held stone; None if it was not computed or
        not found.
    leaks : bool
        True if urine passes before the stone moves.
    """

    state: PushedState
    leak_pressure: float | None
    leaks: bool

    @property
    def newton_steps(self) -> int:
        """Number of Newton steps with a newly factorised tangent."""
        return self.state.solver.newton_steps

    @property
    def seconds(self) -> float:
        """Wall-clock time in s of all solves for this result."""
        return self.state.solver.seconds
