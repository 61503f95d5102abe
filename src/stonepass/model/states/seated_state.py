"""Results for the seated state: contact, wall, and report of the finite elements.

See "Seated state" in docs/theory.md.
"""

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

if TYPE_CHECKING:  # at run time the import would load the finite elements
    from stonepass.fe.axisymmetric.wall_values import Field, Volume

__all__ = ["Contact", "NoSeat", "SeatedState", "SolverReport"]

SEATED_IMBALANCE = 0.02  # imbalance above which a warning is given, relative to the contact force
CONE_EXCESS = 1e-6  # excess above which a warning is given, relative to the largest pressure


@dataclass(frozen=True)
class SolverReport:
    """Size and cost of a finite-element solution, and independent checks of it.

    Attributes
    ----------
    dofs : int
        Number of unknowns on the finer mesh.
    newton_steps : int
        Number of Newton steps with a newly factorised tangent, including the coarser solve.
    seconds : float
        Wall-clock time in s, including the coarser solve.
    residual : float
        Norm of the residual relative to the contact force.
    volume : Volume
        Error of the volume of the wall.
    axial_balance : float
        Unbalanced axial force on the meshed part of the tube, relative to the normal contact force.
        The meshed part is one half, or the whole tube for a stone without mirror symmetry.
    cone_excess : float
        Largest excess of the friction traction over μ times the contact pressure at the nodes,
        relative to the largest contact pressure.
    dissipated : float
        Energy dissipated by friction during the seating, for the whole tube, divided by the cube of
        the inner radius, in J/m³ (= Pa).
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
    """The contact of stone and wall in the seated state, as the force balance needs it.

    Attributes
    ----------
    case : Problem
        The problem that was solved.
    contact_angle : float
        Angle α₀ in rad at which the contact begins. If the halves of the stone are mirror images,
        the contact ends at π − α₀.
    theta : array (n,)
        Angles θ in rad, increasing from α₀ to the downstream edge of the contact. θ is measured
        from the upstream axis: it is the angle at the centre of a sphere, and the parametric angle
        of other stones (`model.shape`). It is π/2 where the stone is widest.
    contact_pressure : array (n,)
        Contact pressure σ(θ) in Pa: force per deformed area (true stress), compression positive.
    """

    case: Problem
    contact_angle: float
    theta: Float[np.ndarray, " n"]
    contact_pressure: Float[np.ndarray, " n"]

    @property
    def downstream_angle(self) -> float:
        """Angle θ in rad at which the contact ends."""
        return float(self.theta[-1])

    @property
    def equator_contact_pressure(self) -> float:
        """Contact pressure σ(π/2) in Pa."""
        return float(self.pressure_at(np.array(np.pi / 2)))

    @property
    def peak_contact_pressure(self) -> float:
        """Largest contact pressure in Pa."""
        return float(self.contact_pressure.max())

    def pressure_at(self, theta: Float[np.ndarray, "*m"]) -> Float[np.ndarray, "*m"]:
        """Return σ(θ) in Pa at angles θ in [0, π] in rad; it is zero outside the contact."""
        return np.asarray(np.interp(theta, self.theta, self.contact_pressure, left=0.0, right=0.0))


@array_dataclass
@dataclass(frozen=True)
class SeatedState(Contact):
    """The solved seated state, in SI units.

    The attributes of `Contact` are not repeated here.

    Attributes
    ----------
    friction_traction : array (n,)
        Tangential traction of the stone on the wall in Pa at `theta`, positive downstream; zero if
        the seating is frictionless.
    wall : Field or None
        Deformed wall, lengths in inner radii, with z = 0 at the widest place of the stone and z
        positive downstream; Cauchy stress in Pa, tension positive. If the halves of the stone are
        mirror images, it covers the half z ≥ 0. None if it was not kept.
    solver : SolverReport
    stability : StabilityReport
        Strong ellipticity and hoop compression of the wall.
    contact_angle_uncertainty : float
        Uncertainty of α₀ in rad if the contact edge was found by the active-set solve, otherwise 0.
    coarse : Contact or None
        The contact from the coarser solve; None if there was no such solve, or if it failed.
    error : ErrorEstimate or None
        Estimated errors of α₀ and σ(π/2), from the difference of both solves; None without
        `coarse`.
    """

    friction_traction: Float[np.ndarray, " n"]
    wall: Field | None
    solver: SolverReport
    stability: StabilityReport
    contact_angle_uncertainty: float = 0.0
    coarse: Contact | None = None
    error: ErrorEstimate | None = None

    def warnings(self) -> list[Caution]:
        """Return the cautions that apply to this state."""
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
    """Result of a solve that found no seated state.

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
