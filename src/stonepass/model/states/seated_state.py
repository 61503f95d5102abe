"""The seated state as values: contact, wall, and what the finite elements did."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Float
from stonepass.caution import Caution, caution
from stonepass.model.accuracy import ErrorEstimate
from stonepass.model.problem import Problem
from stonepass.model.states.stability_report import StabilityReport

if TYPE_CHECKING:  # loads the finite elements
    from stonepass.fe.axisymmetric.wall_values import Field, Volume

__all__ = ["Contact", "NoSeat", "SeatedState", "SolverReport"]

SEATED_IMBALANCE = 0.02  # of the contact force
CONE_EXCESS = 1e-6  # of the largest contact pressure


@dataclass(frozen=True)
class SolverReport:
    """What the finite elements did, and how well the state obeys what they were not told.

    Attributes
    ----------
    dofs, newton_steps, seconds : int, int, float
        Unknowns of the last mesh; Newton steps with a tangent of their own and seconds of all
        that was solved, the coarser solve included.
    residual : float
        Relative to the contact force.
    volume : Volume
        How well volume is kept.
    axial_balance : float
        Axial force left over on a half of the tube (for a stone without mirror image the whole),
        relative to the normal contact force.
    cone_excess : float
        Largest excess of friction over its coefficient times the pressure, at the nodes, relative
        to the largest pressure.
    dissipated : float
        Energy that friction took, whole tube, per cube of the inner radius (J/m³ = Pa).
    """

    dofs: int
    newton_steps: int
    seconds: float = field(compare=False)
    residual: float
    volume: Volume
    axial_balance: float
    cone_excess: float
    dissipated: float


@array_dataclass
@dataclass(frozen=True)
class Contact:
    """Where stone and wall touch in the seated state, and how hard: all that the balance needs.

    Attributes
    ----------
    contact_angle : float
        α₀ in rad, where the contact begins; of a stone whose halves are mirror images it ends at
        π − α₀.
    theta, contact_pressure : arrays
        σ(θ) in Pa, true stress on the deformed wall, compression positive, on a fine grid from the
        upstream edge of the contact, θ = α₀, to the downstream one. θ is the angle at the centre of
        a sphere, from the upstream axis; of other stones the parametric one (`model.shape`), π/2
        where the stone is widest.
    """

    case: Problem
    contact_angle: float
    theta: Float[np.ndarray, " n"]
    contact_pressure: Float[np.ndarray, " n"]

    @property
    def downstream_angle(self) -> float:
        """θ in rad, where the contact ends."""
        return float(self.theta[-1])

    @property
    def equator_contact_pressure(self) -> float:
        """σ(π/2) in Pa."""
        return float(self.pressure_at(np.array(np.pi / 2)))

    @property
    def peak_contact_pressure(self) -> float:
        """Largest σ(θ) in Pa."""
        return float(self.contact_pressure.max())

    def pressure_at(self, theta: Float[np.ndarray, "*m"]) -> Float[np.ndarray, "*m"]:
        """σ(θ) in Pa at any θ in [0, π]; zero outside contact."""
        return np.asarray(np.interp(theta, self.theta, self.contact_pressure, left=0.0, right=0.0))


@array_dataclass
@dataclass(frozen=True)
class SeatedState(Contact):
    """The solved seated state, in SI.

    Attributes
    ----------
    friction_traction : array
        Traction of the stone on the wall along it in Pa at `theta`, positive downstream; zero where
        the seating is frictionless.
    wall : Field
        Deformed wall and Cauchy stress (Pa, tension positive), lengths in inner radii, z from the
        stone's widest place downstream; of a stone whose halves are mirror images the half z ≥ 0.
        None where it was not kept (curves).
    solver : SolverReport
    stability : StabilityReport
        Stability of the wall, and whether it would fold.
    contact_angle_uncertainty : float
        How far α₀ is known in rad where the contact edge could not be made an unknown, else 0.
    coarse : Contact or None
        The same contact from a coarser solve; None where none was asked for, or none was found.
    error : ErrorEstimate or None
        What the two say of the error of α₀ and σ(π/2).
    """

    friction_traction: Float[np.ndarray, " n"]
    wall: Field | None
    solver: SolverReport
    stability: StabilityReport
    contact_angle_uncertainty: float = 0.0
    coarse: Contact | None = None
    error: ErrorEstimate | None = None

    def warnings(self) -> list[Caution]:
        """What a reader of the state must know."""
        found = self.stability.warnings()
        if self.solver.axial_balance > SEATED_IMBALANCE:
            found.append(caution("seated_imbalance", imbalance=self.solver.axial_balance))
        if self.solver.cone_excess > CONE_EXCESS:
            found.append(caution("friction_cone"))
        if self.error is None:
            found.append(caution("error_not_estimated"))
        if self.contact_angle_uncertainty > 0.0:
            uncertainty = float(np.degrees(self.contact_angle_uncertainty))
            found.append(caution("contact_angle_uncertain", uncertainty_deg=uncertainty))
        return found

    def without_wall(self) -> SeatedState:
        """Return the same state without the stress field."""
        return replace(self, wall=None)


@dataclass(frozen=True)
class NoSeat:
    """The finite elements found no seated state."""

    reason: str
    newton_steps: int
    seconds: float = field(compare=False)
