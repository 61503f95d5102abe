"""The seated state: the wall stretched over the stone, no urine pressure (paper, section 2.4)."""

from __future__ import annotations

import time
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from jaxtyping import Float

from stonepass.errors import BadInput
from stonepass.fe.fit import Fitted
from stonepass.fe.problem import Failure, Path, Resolution, Tube
from stonepass.fe.readout import (
    Field,
    Volume,
    axial_balance,
    cone_excess,
    contact_profile,
    field,
    volume,
)
from stonepass.fe.tube import seat_on_sphere
from stonepass.materials.derivatives import hoop_modulus
from stonepass.materials.stability import check
from stonepass.model.case import Case
from stonepass.model.far_field import lumen_ratio
from stonepass.model.first_guess import wrap_round_arc
from stonepass.model.soundness import Soundness, far_field_hint, soundness

__all__ = ["NoSeat", "SeatedState", "SolverReport", "seat"]


IMBALANCE = 0.02
CONE_EXCESS = 1e-6


@dataclass(frozen=True)
class SolverReport:
    """What the finite elements did, and how well the state obeys what they were not told.

    Attributes
    ----------
    dofs, newton_steps, seconds : int, int, float
        Unknowns of the last mesh; Newton steps and seconds of the whole path.
    residual : float
        Relative to the contact force.
    volume : Volume
        How well volume is kept.
    axial_balance : float
        Axial force left over on a half of the tube, relative to the normal contact force.
    cone_excess : float
        Largest excess of friction over its coefficient times the pressure, at the nodes, relative
        to the largest pressure.
    dissipated : float
        Energy that friction took, whole tube, per cube of the inner radius (J/m³ = Pa).
    """

    dofs: int
    newton_steps: int
    seconds: float
    residual: float
    volume: Volume
    axial_balance: float
    cone_excess: float
    dissipated: float


@dataclass(frozen=True)
class SeatedState:
    """The solved seated state, in SI.

    Attributes
    ----------
    contact_angle : float
        α₀ in rad: contact spans θ from α₀ to π − α₀.
    theta, contact_pressure : arrays
        σ(θ) in Pa, true stress on the deformed wall, compression positive, on a fine grid of the
        upstream half, θ from α₀ to π/2; the downstream half is its mirror image.
    friction_traction : array
        Traction of the stone on the wall along it in Pa, positive away from the equator; zero
        where the seating is frictionless.
    wall : Field
        Deformed wall and Cauchy stress (Pa, tension positive) of the half Z ≥ 0, lengths in
        inner radii; None where it was not kept (curves).
    solver : SolverReport
    soundness : Soundness
        Stability of the wall, and whether it would fold.
    contact_angle_slack : float
        How far α₀ is known in rad where the contact edge could not be made an unknown, else 0.
    """

    case: Case
    contact_angle: float
    theta: Float[np.ndarray, " n"]
    contact_pressure: Float[np.ndarray, " n"]
    friction_traction: Float[np.ndarray, " n"]
    wall: Field | None
    solver: SolverReport
    soundness: Soundness
    contact_angle_slack: float = 0.0

    def warnings(self) -> list[str]:
        """What a reader of the state must know."""
        found = self.soundness.warnings()
        if self.solver.axial_balance > IMBALANCE:
            found.append(
                f"the axial forces on half the tube miss their balance by "
                f"{self.solver.axial_balance:.1%} of the contact force"
            )
        if self.solver.cone_excess > CONE_EXCESS:
            found.append("friction exceeds its coefficient somewhere: Coulomb's law is violated")
        if self.contact_angle_slack > 0.0:
            found.append(
                f"the contact angle is known to {np.degrees(self.contact_angle_slack):.2f}° only, "
                "because no smooth contact edge was found"
            )
        return found

    @property
    def equator_contact_pressure(self) -> float:
        """σ(π/2) in Pa."""
        return float(self.contact_pressure[-1])

    @property
    def peak_contact_pressure(self) -> float:
        """Largest σ(θ) in Pa."""
        return float(self.contact_pressure.max())

    def pressure_at(self, theta: Float[np.ndarray, " m"]) -> Float[np.ndarray, " m"]:
        """σ(θ) in Pa at any θ in [0, π]; zero outside contact."""
        folded = np.minimum(theta, np.pi - theta)
        inside = np.interp(folded, self.theta, self.contact_pressure)
        return np.where(folded < self.contact_angle, 0.0, inside)


@dataclass(frozen=True)
class NoSeat:
    """The finite elements found no seated state."""

    reason: str
    newton_steps: int
    seconds: float


def seat(case: Case, resolution: Resolution = Resolution()) -> SeatedState | NoSeat:
    """Solve the seated state of a stone that is larger than the lumen.

    Raises
    ------
    UnstableLaw
        The material law is no solid.
    BadInput
        The stone is not larger than the lumen, so it is not seated at all.
    """
    check(case.ureter.material)
    started = time.perf_counter()
    law, load, radius = case.ureter.material.law, case.load, case.size_ratio
    modulus = hoop_modulus(law)
    lumen = _smaller_lumen(case)

    def energy(C_rr, C_tt, C_zz, C_rz, xp):  # type: ignore[no-untyped-def]
        return law.energy(C_rr, C_tt, C_zz, C_rz, xp) / modulus

    tube = Tube(
        energy=energy,
        wall_ratio=case.wall_ratio,
        half_length=case.method.half_length,
        axial_stretch=load.prestretch,
        outside_pressure=load.confining_pressure / modulus,
        hydrostatic=load.hydrostatic,
    )
    wrap_at = partial(wrap_round_arc, case, lumen, modulus)
    solved = seat_on_sphere(tube, radius, wrap_at, resolution, _path(case, lumen))
    if isinstance(solved, Failure):
        reason = solved.reason + far_field_hint(case)
        return NoSeat(reason, solved.steps, time.perf_counter() - started)
    return _state(case, solved, modulus, started)


def _smaller_lumen(case: Case) -> float:
    """The lumen r_a/R_a that load leaves open, refused where the stone is not larger."""
    lumen = lumen_ratio(case.wall_ratio, case.ureter.material.law, case.load)
    if lumen is None or case.size_ratio <= lumen:
        raise BadInput(
            "size ratio",
            round(case.size_ratio, 6),
            "larger than the lumen" + ("" if lumen is None else f", {lumen:.6g}"),
            "a smaller stone is loose",
        )
    return lumen


def _path(case: Case, lumen: float) -> Path | None:
    """How the stone comes to its place; None where no friction acts on the way."""
    friction, radius = case.seating_friction, case.size_ratio
    if friction == 0.0:
        return None
    if case.method.seating == "growing":
        return Path(friction, lambda t: (lumen + t * (radius - lumen), 0.0))
    return Path(friction, lambda t: (radius, (1.0 - t) * (lumen - radius)))


def _state(case: Case, solved: Fitted, modulus: float, started: float) -> SeatedState:
    profile, wall, kept = contact_profile(solved), field(solved), volume(solved)
    stresses = ("stress_rr", "stress_tt", "stress_zz", "stress_rz")
    in_pascals = replace(wall, **{name: modulus * getattr(wall, name) for name in stresses})
    cone = case.seating_friction * np.maximum(profile.pressure, 0.0)
    return SeatedState(
        case=case,
        contact_angle=float(profile.theta[0]),
        theta=profile.theta,
        contact_pressure=modulus * np.maximum(profile.pressure, 0.0),
        # Between the nodes, where Coulomb's law was solved, the polynomials may leave the cone.
        friction_traction=modulus * np.clip(profile.traction, -cone, cone),
        wall=in_pascals,
        solver=SolverReport(
            dofs=solved.dofs,
            newton_steps=solved.steps,
            seconds=time.perf_counter() - started,
            residual=solved.residual,
            volume=kept,
            axial_balance=axial_balance(solved),
            cone_excess=cone_excess(solved),
            dissipated=2.0 * modulus * solved.dissipated,
        ),
        soundness=soundness(case, solved, in_pascals),
        contact_angle_slack=solved.slack * case.load.prestretch / case.size_ratio,
    )
