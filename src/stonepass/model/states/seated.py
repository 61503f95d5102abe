"""The seated state: the wall stretched over the stone, no urine pressure (paper, section 2.4)."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from jaxtyping import Float

from stonepass.fe.axisymmetric.fitted_contact import Fitted
from stonepass.fe.axisymmetric.postprocessing import (
    ContactProfile,
    Field,
    Volume,
    axial_balance,
    cone_excess,
    contact_profile,
    field,
    volume,
)
from stonepass.fe.axisymmetric.problem import Failure, Path, Resolution
from stonepass.fe.axisymmetric.seating import seat_on_stone
from stonepass.materials.derivatives import hoop_modulus
from stonepass.materials.stability import check
from stonepass.model.accuracy import LEVELS, ErrorEstimate, Level
from stonepass.model.case import Case
from stonepass.model.far_field import stuck_lumen
from stonepass.model.states.first_guess import wrap_round_arc
from stonepass.model.states.nondimensional import profile_of, tube_of
from stonepass.model.states.stability_report import (
    StabilityReport,
    far_field_hint,
    oversize_hint,
    stability_of,
    waves,
)

__all__ = ["Contact", "NoSeat", "SeatedState", "SolverReport", "seat"]


IMBALANCE = 0.02
CONE_EXCESS = 1e-6
INNER = 0.5  # share of the contact whose pressure tells the error at the equator


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
    seconds: float
    residual: float
    volume: Volume
    axial_balance: float
    cone_excess: float
    dissipated: float


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

    case: Case
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
    contact_angle_slack : float
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
    contact_angle_slack: float = 0.0
    coarse: Contact | None = None
    error: ErrorEstimate | None = None

    def warnings(self) -> list[str]:
        """What a reader of the state must know."""
        found = self.stability.warnings()
        if self.solver.axial_balance > IMBALANCE:
            found.append(
                f"the axial forces on the tube miss their balance by "
                f"{self.solver.axial_balance:.1%} of the contact force"
            )
        if self.solver.cone_excess > CONE_EXCESS:
            found.append("friction exceeds its coefficient somewhere: Coulomb's law is violated")
        if self.error is None:
            found.append("the error is not estimated: no coarser solve stands beside this one")
        if self.contact_angle_slack > 0.0:
            found.append(
                f"the contact angle is known to {np.degrees(self.contact_angle_slack):.2f}° only, "
                "because no smooth contact edge was found"
            )
        return found


@dataclass(frozen=True)
class NoSeat:
    """The finite elements found no seated state."""

    reason: str
    newton_steps: int
    seconds: float


def seat(case: Case, resolution: Resolution | None = None) -> SeatedState | NoSeat:
    """Solve the seated state of a stone that is larger than the lumen.

    By default at the accuracy the case asks for, with an estimate of the error from a second,
    coarser solve; with a `resolution` on that mesh alone, without an estimate.

    Raises
    ------
    UnstableLaw
        The material law is no solid.
    BadInput
        The stone is not larger than the lumen, so it is not seated at all.
    """
    check(case.ureter.material)
    started = time.perf_counter()
    lumen = stuck_lumen(case)
    unstable = waves(case)
    if unstable:
        return NoSeat(unstable, 0, time.perf_counter() - started)
    level = LEVELS[case.method.accuracy]
    wanted = (level.companion, level.resolution) if resolution is None else (resolution,)
    *coarser, solved = _solve(case, lumen, wanted)
    steps = sum(result.steps for result in (*coarser, solved))
    if isinstance(solved, Failure):
        reason = solved.reason + far_field_hint(case) + oversize_hint(case)
        return NoSeat(reason, steps, time.perf_counter() - started)
    state = _state(case, replace(solved, steps=steps), started)
    if coarser and isinstance(coarser[0], Fitted):
        coarse = _contact(case, contact_profile(coarser[0]))
        return replace(state, coarse=coarse, error=_error(state, coarse, level))
    return state


def _solve(case: Case, lumen: float, wanted: Sequence[Resolution]) -> list[Fitted | Failure]:
    law, load = case.ureter.material.law, case.load
    tube = tube_of(law, case.wall_ratio, load, case.method.half_length)
    wrap_at = partial(wrap_round_arc, case, lumen, hoop_modulus(law))
    return seat_on_stone(tube, profile_of(case), wrap_at, wanted, _path(case, lumen))


def _error(state: SeatedState, coarse: Contact, level: Level) -> ErrorEstimate:
    """Claim the error of α₀ and σ(π/2).

    σ(θ) of a path keeps ripples of its increments, and two of them may cross at the equator; so
    the largest difference within the inner half of the contact counts.
    """
    width = (state.downstream_angle - state.contact_angle) / 2.0
    middle = (state.downstream_angle + state.contact_angle) / 2.0
    inner = np.abs(state.theta - middle) <= INNER * width
    ripple = np.abs(state.contact_pressure - coarse.pressure_at(state.theta))[inner].max()
    angle = level.claim(state.contact_angle - coarse.contact_angle, width)
    return ErrorEstimate(
        contact_angle=float(angle + state.contact_angle_slack),
        equator_contact_pressure=level.claim(float(ripple), state.equator_contact_pressure),
    )


def _path(case: Case, lumen: float) -> Path | None:
    """How the stone comes to its place; None where no friction acts on the way."""
    friction, last = case.seating_friction, profile_of(case)
    if friction == 0.0:
        return None
    more = last.radius - lumen
    if case.method.seating == "growing":
        return Path(friction, lambda t: replace(last, radius=lumen + t * more))
    return Path(friction, lambda t: replace(last, offset=(t - 1.0) * more))


def _contact(case: Case, profile: ContactProfile) -> Contact:
    pressure = hoop_modulus(case.ureter.material.law) * np.maximum(profile.pressure, 0.0)
    return Contact(case, float(profile.theta[0]), profile.theta, pressure)


def _state(case: Case, solved: Fitted, started: float) -> SeatedState:
    modulus = hoop_modulus(case.ureter.material.law)
    profile, kept = contact_profile(solved), volume(solved)
    in_pascals = field(solved).in_units(modulus)
    cone = case.seating_friction * np.maximum(profile.pressure, 0.0)
    contact = _contact(case, profile)
    return SeatedState(
        case=case,
        contact_angle=contact.contact_angle,
        theta=contact.theta,
        contact_pressure=contact.contact_pressure,
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
            dissipated=(1.0 if solved.layout.whole else 2.0) * modulus * solved.dissipated,
        ),
        stability=stability_of(case, solved, in_pascals),
        contact_angle_slack=solved.slack
        * case.load.prestretch
        / (case.size_ratio * case.stone.aspect),
    )
