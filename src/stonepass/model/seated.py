"""The seated state: the wall stretched over the stone, no urine pressure (paper, section 2.4)."""

from __future__ import annotations

import time
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Float

from stonepass.errors import BadInput, SolverFault
from stonepass.fe.problem import Failure, Fitted, Resolution, Tube, Wrap
from stonepass.fe.readout import Field, Volume, contact_profile, field, volume
from stonepass.fe.tube import seat_on_sphere
from stonepass.materials.derivatives import hoop_modulus
from stonepass.materials.stability import check
from stonepass.model.case import Case
from stonepass.model.far_field import inflation, lumen_ratio

__all__ = ["NoSeat", "SeatedState", "SolverReport", "seat"]


@dataclass(frozen=True)
class SolverReport:
    """What the finite elements did: unknowns, Newton steps, seconds, relative residual (of the
    contact force), and how well volume is kept."""

    dofs: int
    newton_steps: int
    seconds: float
    residual: float
    volume: Volume


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
    wall : Field
        Deformed wall and Cauchy stress (Pa, tension positive) of the half Z ≥ 0, lengths in
        inner radii; None where it was not kept (curves).
    solver : SolverReport
    """

    case: Case
    contact_angle: float
    theta: Float[np.ndarray, " n"]
    contact_pressure: Float[np.ndarray, " n"]
    wall: Field | None
    solver: SolverReport

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
    modulus = hoop_modulus(case.ureter.material.law)
    law, load = case.ureter.material.law, case.load

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
    solved = seat_on_sphere(tube, case.size_ratio, _wrap(case, modulus), resolution)
    if isinstance(solved, Failure):
        return NoSeat(solved.reason, solved.steps, time.perf_counter() - started)
    return _state(case, solved, modulus, started)


def _wrap(case: Case, modulus: float) -> Wrap:
    """First guess: the wall on the sphere, then an exponential return to the lumen.

    The wall is taken to leave the sphere where the axial coordinate is half that of the place at
    which the sphere has the radius of the lumen, with the slope it has there. The inner pressure
    is that of a uniform tube of the local radius.
    """
    radius, stretch, law = case.size_ratio, case.load.prestretch, case.ureter.material.law
    lumen = lumen_ratio(case.wall_ratio, law, case.load)
    if lumen is None or radius <= lumen:
        raise BadInput(
            "size ratio",
            round(radius, 6),
            "larger than the lumen" + ("" if lumen is None else f", {lumen:.6g}"),
            "a smaller stone is loose",
        )
    leave = 0.5 * np.sqrt(radius**2 - lumen**2)
    rim = np.sqrt(radius**2 - leave**2)
    rate = leave / (rim * (rim - lumen))
    z = np.concatenate(
        [
            np.linspace(0.0, leave, 200, endpoint=False),
            leave + np.geomspace(1.0, 1.0 + 40.0 / rate, 800) - 1.0,
        ]
    )
    z = np.append(z[z < case.method.half_length * stretch], case.method.half_length * stretch)
    inner = np.where(
        z < leave,
        np.sqrt(np.maximum(radius**2 - z**2, 0.0)),
        lumen + (rim - lumen) * np.exp(-rate * (z - leave)),
    )
    pressure = np.asarray(inflation(inner, case.wall_ratio, law, stretch)) / modulus
    return Wrap(
        station=z / stretch,
        inner_radius=inner,
        pressure=pressure,
        reach=1.2 * leave / stretch,
    )


def _state(case: Case, solved: Fitted, modulus: float, started: float) -> SeatedState:
    profile, wall, kept = contact_profile(solved), field(solved), volume(solved)
    if not (np.all(np.isfinite(profile.pressure)) and kept.smallest > 0.0):
        raise SolverFault(
            f"the solved wall is not a wall (smallest J {kept.smallest:.3g}); please report "
            f"this case: size ratio {case.size_ratio:.6g}, wall ratio {case.wall_ratio:.6g}"
        )
    stresses = ("stress_rr", "stress_tt", "stress_zz", "stress_rz")
    return SeatedState(
        case=case,
        contact_angle=float(profile.theta[0]),
        theta=profile.theta,
        contact_pressure=modulus * np.maximum(profile.pressure, 0.0),
        wall=replace(wall, **{name: modulus * getattr(wall, name) for name in stresses}),
        solver=SolverReport(
            dofs=solved.dofs,
            newton_steps=solved.steps,
            seconds=time.perf_counter() - started,
            residual=solved.residual,
            volume=kept,
        ),
    )
