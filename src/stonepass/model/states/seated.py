"""The seated state: the wall stretched over the stone, without urine pressure (paper, section 2.4).

See "Seated state" in docs/theory.md.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from stonepass.fe.axisymmetric.balances import axial_balance, cone_excess
from stonepass.fe.axisymmetric.equilibrium import EquilibriumState
from stonepass.fe.axisymmetric.postprocessing import contact_profile, deformation, field, volume
from stonepass.fe.axisymmetric.problem import Failure, LoadingPath, Resolution
from stonepass.fe.axisymmetric.seating import seat_on_stone
from stonepass.fe.axisymmetric.wall_values import ContactProfile
from stonepass.materials.derivatives import hoop_modulus
from stonepass.materials.stability import check
from stonepass.model.accuracy import AccuracyLevel, ErrorEstimate
from stonepass.model.far_field import stuck_lumen
from stonepass.model.numerics import Numerics
from stonepass.model.problem import Problem
from stonepass.model.seating import Seating
from stonepass.model.states.first_guess import wrap_round_arc
from stonepass.model.states.nondimensional import profile_of, tube_of
from stonepass.model.states.seated_state import Contact, NoSeat, SeatedState, SolverReport
from stonepass.model.states.stability import (
    axisymmetric_buckling,
    far_field_hint,
    oversize_hint,
    stability_of,
)

__all__ = ["solve_seated"]

INNER = 0.5  # central fraction of the contact over which the pressure error is evaluated


def solve_seated(
    case: Problem, seating: Seating, numerics: Numerics, resolution: Resolution | None = None
) -> SeatedState | NoSeat:
    """Solve the seated state of a stone that is larger than the lumen.

    Parameters
    ----------
    case : Problem
    seating : Seating
        The way in which the stone is brought into the wall.
    numerics : Numerics
        Accuracy and length of the tube.
    resolution : Resolution, optional
        Resolution of a single solve without an error estimate. By default the accuracy in
        `numerics` is used, with an error estimate from a second, coarser solve.

    Returns
    -------
    SeatedState or NoSeat

    Raises
    ------
    UnstableLaw
        The material law is not stable.
    BadInput
        The stone is not larger than the lumen, so it is not seated.
    """
    check(case.ureter.material)
    started = time.perf_counter()
    lumen = stuck_lumen(case)
    unstable = axisymmetric_buckling(case, numerics.half_length)
    if unstable:
        return NoSeat(unstable, 0, time.perf_counter() - started)
    level = numerics.level
    wanted = (level.companion, level.resolution) if resolution is None else (resolution,)
    *coarser, solved = _solve(case, seating, numerics, lumen, wanted)
    steps = sum(result.steps for result in (*coarser, solved))
    if isinstance(solved, Failure):
        reason = solved.reason + far_field_hint(case) + oversize_hint(case)
        return NoSeat(reason, steps, time.perf_counter() - started)
    state = _state(case, seating, replace(solved, steps=steps), started)
    if coarser and isinstance(coarser[0], EquilibriumState):
        coarse = _contact(case, contact_profile(coarser[0]))
        return replace(state, coarse=coarse, error=_error(state, coarse, level))
    return state


def _solve(
    case: Problem,
    seating: Seating,
    numerics: Numerics,
    lumen: float,
    wanted: Sequence[Resolution],
) -> list[EquilibriumState | Failure]:
    law, load = case.ureter.material.law, case.load
    tube = tube_of(law, case.wall_ratio, load, numerics.half_length)
    wrap_at = partial(wrap_round_arc, case, numerics.half_length, lumen, hoop_modulus(law))
    return seat_on_stone(tube, profile_of(case), wrap_at, wanted, _path(case, seating, lumen))


def _error(state: SeatedState, coarse: Contact, level: AccuracyLevel) -> ErrorEstimate:
    """Estimate the errors of α₀ and σ(π/2).

    The increments of a loading path leave ripples in σ(θ). The curves of two paths may therefore
    cross at the equator by chance, so the largest difference in the central half of the contact is
    used for σ(π/2).
    """
    width = (state.downstream_angle - state.contact_angle) / 2.0
    middle = (state.downstream_angle + state.contact_angle) / 2.0
    inner = np.abs(state.theta - middle) <= INNER * width
    ripple = np.abs(state.contact_pressure - coarse.pressure_at(state.theta))[inner].max()
    angle = level.contact_claim(state.contact_angle - coarse.contact_angle, width)
    return ErrorEstimate(
        contact_angle=float(angle + state.contact_angle_uncertainty),
        equator_contact_pressure=level.contact_claim(float(ripple), state.equator_contact_pressure),
    )


def _path(case: Problem, seating: Seating, lumen: float) -> LoadingPath | None:
    """Return the loading path of a seating; None for a seating without friction."""
    friction, last = seating.friction, profile_of(case)
    if friction == 0.0:
        return None
    more = last.radius - lumen
    if seating.kind == "growing":
        return LoadingPath(friction, lambda t: replace(last, radius=lumen + t * more))
    return LoadingPath(friction, lambda t: replace(last, offset=(t - 1.0) * more))


def _contact(case: Problem, profile: ContactProfile) -> Contact:
    pressure = hoop_modulus(case.ureter.material.law) * np.maximum(profile.pressure, 0.0)
    return Contact(case, float(profile.theta[0]), profile.theta, pressure)


def _state(
    case: Problem, seating: Seating, solved: EquilibriumState, started: float
) -> SeatedState:
    modulus = hoop_modulus(case.ureter.material.law)
    profile, kept = contact_profile(solved), volume(solved)
    in_pascals = field(solved).in_units(modulus)
    cone = seating.friction * np.maximum(profile.pressure, 0.0)
    contact = _contact(case, profile)
    return SeatedState(
        case=case,
        contact_angle=contact.contact_angle,
        theta=contact.theta,
        contact_pressure=contact.contact_pressure,
        # Coulomb's law holds at the nodes; between them the polynomials may leave the cone.
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
        stability=stability_of(case, deformation(solved), in_pascals),
        contact_angle_uncertainty=solved.edge_uncertainty
        * case.load.prestretch
        / (case.size_ratio * case.stone.aspect),
    )
