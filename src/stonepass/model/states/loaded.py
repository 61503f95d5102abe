"""The loaded state of the direct model: wall and held stone under urine pressure.

The stone is held at mid-length, and urine of the pressure P_u stands upstream. P_u acts on the wall
upstream of the contact. Friction between wall and stone is fully mobilised. The axial force on the
stone, N(P_u), is negative while the stone is stuck, and its root is the critical pressure. Urine
cannot pass as long as P_u is below the largest contact pressure; the P_u at which both are equal is
the *leak pressure*. See "The push-through, solved directly" in docs/theory.md. The paper has no
such model.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from stonepass.errors import require
from stonepass.fe.axisymmetric.equilibrium import EquilibriumState
from stonepass.fe.axisymmetric.inner_wall import inner_wall
from stonepass.fe.axisymmetric.loaded_wall import loaded_wall
from stonepass.fe.axisymmetric.problem import Failure, Resolution
from stonepass.fe.axisymmetric.seating import seat_on_stone
from stonepass.fe.axisymmetric.sliding_contact import (
    solve_at_pressure,
    solve_at_seal,
    solve_critical,
)
from stonepass.fe.axisymmetric.sliding_state import Configuration, SlidingState, sliding_problem
from stonepass.fe.axisymmetric.sliding_workspace import (
    Workspace,
    seated_configuration,
    workspace_for,
)
from stonepass.fe.axisymmetric.wall_values import Deformation
from stonepass.fe.core.lobatto import joined, resampling
from stonepass.fe.core.threads import one_thread
from stonepass.materials.derivatives import hoop_modulus
from stonepass.materials.relaxed_energy import RelaxedEnergy, relaxed
from stonepass.materials.stability import check
from stonepass.model.energy_balance import opening_pressure
from stonepass.model.far_field import stuck_lumen
from stonepass.model.numerics import Numerics
from stonepass.model.problem import Problem
from stonepass.model.states.first_guess import wrap_round_arc
from stonepass.model.states.loaded_state import Critical, NoPush, PushedState, PushReport
from stonepass.model.states.nondimensional import profile_of, tube_of
from stonepass.model.states.stability import (
    axisymmetric_buckling,
    far_field_hint,
    oversize_hint,
    stability_of,
)
from stonepass.units import Pressure, Quantity, pressure

__all__ = ["find_critical", "solve_loaded"]

SAMPLES = 33  # number of samples of the contact pressure in each column
# Largest first guess of P_ucr, and pressure at which the search for a leak starts if no critical
# state was found, as fractions of the pressure that opens the tube to R_s.
HIGHEST_GUESS, LOW_START = 1.2, 0.3
# The excess is the largest contact pressure minus P_u, divided by P_u. The search for the leak
# pressure lowers it from at most HIGHEST_EXCESS, by the factor LEAK_STEP in each step, until it is
# below LEAK_EXCESS. No leak pressure is extrapolated from an excess above LEAK_FAR.
HIGHEST_EXCESS, LEAK_EXCESS, LEAK_STEP, LEAK_FAR = 3.0, 0.06, 0.6, 0.4
NO_PRESSURE = 1e-9  # pressures below this count as zero, in units of the modulus
LEAKS = "urine passes the stone, because its pressure exceeds the contact pressure everywhere"
UNSEALED = "the axial forces balance, but the contact pressure does not hold the urine back"


def solve_loaded(
    case: Problem,
    numerics: Numerics,
    urine: Sequence[str | Pressure | Quantity],
    resolution: Resolution | None = None,
    *,
    wetted: bool = False,
    tether: float = 0.0,
    offset: float = 0.0,
) -> list[PushedState | NoPush]:
    """Solve the states of a held stone under a sequence of urine pressures.

    Friction is fully mobilised, because sliding is imminent. Each state is the starting point of
    the next one. After the first pressure for which no state is found, the remaining ones are not
    tried.

    Parameters
    ----------
    case : Problem
    numerics : Numerics
    urine : sequence of str or Pressure
        Urine pressures P_u upstream of the stone, zero or positive, e.g. ``"8 kPa"``.
    resolution : Resolution, optional
        Resolution of the finite elements; by default the finer one of the accuracy level.
    wetted : bool
        True for a contact that urine enters between its upstream edge and the seal, see
        `PushThrough`.
    tether : float
        Stiffness of springs that resist axial displacement of the outer wall, per reference area,
        in units of w″(1)/R_a. Without a tether the wall is held only at the ends of the tube, so it
        shortens on one side of the stone and lengthens on the other. A weak tether keeps the axial
        stretch equal on both sides.
    offset : float
        Distance by which the stone is held downstream of mid-length, in inner radii.

    Returns
    -------
    list of PushedState or NoPush
        One result for each pressure, in the same order. It is `NoPush` for the first pressure for
        which no state is found, and for all pressures after it.

    Raises
    ------
    UnstableLaw
        The material law is not stable.
    BadInput
        The stone is not larger than the lumen, or a number is out of range.

    Notes
    -----
    See "The push-through, solved directly" in docs/theory.md.
    """
    bounds = [pressure(each, "urine pressure") for each in urine]
    for bound, each in zip(bounds, urine, strict=True):
        require(0.0 <= bound < np.inf, "urine pressure", each, "zero or positive")
    started = time.perf_counter()
    wanted = resolution or numerics.resolution
    (setup,) = _set_up(case, numerics, [wanted], wetted=wetted, tether=tether, offset=offset)
    if isinstance(setup, Failure):
        return [_no_push(case, setup, started)] * len(bounds)
    states: list[PushedState | NoPush] = []
    workspace, at, friction = setup.workspace, setup.seated, case.stone.friction
    with one_thread():
        for bound in bounds:
            found = solve_at_pressure(workspace, at, bound / setup.modulus, friction)
            if isinstance(found, SlidingState) and not _sealed(found):
                found = Failure(LEAKS, found.steps)
            if isinstance(found, Failure):
                lost = _no_push(case, found, started)
                return states + [lost] * (len(bounds) - len(states))
            states.append(_state(case, setup, found, started))
            at = found.configuration
    return states


def find_critical(
    case: Problem,
    numerics: Numerics,
    resolutions: Sequence[Resolution],
    *,
    wetted: bool = False,
    leak: bool = True,
) -> list[Critical | NoPush]:
    """Find the urine pressure at which the stone moves, once for each resolution.

    The first solve also determines the leak pressure, if `leak` is true. Each further solve takes
    the critical pressure of the previous one as its first guess.

    Parameters
    ----------
    case : Problem
    numerics : Numerics
    resolutions : sequence of Resolution
        Coarse resolutions first.
    wetted : bool
        See `solve_loaded`.
    leak : bool
        True to determine the leak pressure as well.

    Returns
    -------
    list of Critical or NoPush
        One result for each resolution, in the same order.

    Raises
    ------
    UnstableLaw, BadInput
        See `solve_loaded`.
    """
    started, found = time.perf_counter(), list[Critical | NoPush]()
    guess = None
    for setup in _set_up(case, numerics, resolutions, wetted=wetted):
        if isinstance(setup, Failure):
            found.append(_no_push(case, setup, started))
            continue
        with one_thread():
            critical = _critical(case, setup, guess, started, leak=leak and not found)
        if isinstance(critical, Critical) and not critical.leaks:
            guess = critical.state.urine_pressure / setup.modulus
        found.append(critical)
    return found


@dataclass(frozen=True)
class _Setup:
    """A seated tube that is ready to be loaded.

    `modulus` is w″(1) in Pa. `guess` is a first guess of P_ucr, and `opening` is the pressure that
    opens the tube to R_s, both in units of the modulus. `steps` is the number of Newton steps of
    the seated state.
    """

    workspace: Workspace
    seated: Configuration
    modulus: float
    guess: float
    opening: float
    steps: int


def _set_up(
    case: Problem,
    numerics: Numerics,
    resolutions: Sequence[Resolution],
    *,
    wetted: bool,
    tether: float = 0.0,
    offset: float = 0.0,
) -> list[_Setup | Failure]:
    """Solve the seated state without friction for each resolution, and prepare the loading."""
    check(case.ureter.material)
    lumen = stuck_lumen(case)
    unstable = axisymmetric_buckling(case, numerics.half_length)
    if unstable:
        return [Failure(unstable, 0)] * len(resolutions)
    law = relaxed(case.ureter.material.law)
    modulus = hoop_modulus(law)
    tube = tube_of(law, case.wall_ratio, case.load, numerics.half_length)
    wrap_at = partial(wrap_round_arc, case, numerics.half_length, lumen, modulus)
    opening = opening_pressure(case)
    found: list[_Setup | Failure] = []
    for half, resolution in zip(
        seat_on_stone(tube, profile_of(case), wrap_at, resolutions), resolutions, strict=True
    ):
        if isinstance(half, Failure):
            found.append(half)
            continue
        problem = sliding_problem(
            replace(tube, tether=tether),
            half,
            resolution,
            wetted=wetted,
            offset=offset,
        )
        workspace = workspace_for(problem)
        seated = seated_configuration(workspace, half)
        guess = _guess(case, half, opening / modulus)
        found.append(_Setup(workspace, seated, modulus, guess, opening / modulus, half.steps))
    return found


def _guess(case: Problem, seated: EquilibriumState, opening: float) -> float:
    """Guess P_ucr in units of the modulus by an energy balance with the contact force of the seat.

    The work of the pressure on the mean section of the lumen equals the work of friction.
    """
    wall = inner_wall(seated.discretisation, "closed")
    halves = 1.0 if seated.layout.whole else 2.0
    normal = halves * 2.0 * np.pi * float((wall.weight * wall.normal).sum())
    rubbed = case.stone.friction * normal
    section = np.pi * ((1.0 + case.size_ratio) / 2.0) ** 2
    return min(rubbed / section, HIGHEST_GUESS * opening)


def _critical(
    case: Problem, setup: _Setup, guess: float | None, started: float, *, leak: bool
) -> Critical | NoPush:
    workspace, friction = setup.workspace, case.stone.friction
    first_guess = setup.guess if guess is None else guess
    found = solve_critical(workspace, setup.seated, first_guess, friction)
    if isinstance(found, SlidingState) and _sealed(found):
        passed = _leak(workspace, found, setup.opening)[0] if leak else None
        state = _state(case, setup, found, started)
        return Critical(state, None if passed is None else passed * setup.modulus, leaks=False)
    low = solve_at_pressure(workspace, setup.seated, LOW_START * setup.opening, friction)
    if isinstance(low, SlidingState):
        passed, last = _leak(workspace, low, setup.opening)
        # The sign of the force at the leak pressure is known only from a state close to it.
        if passed is not None and last.force < 0.0 and _excess(last) <= 2.0 * LEAK_EXCESS:
            state = _state(case, setup, last, started)
            return Critical(state, passed * setup.modulus, leaks=True)
    reason = found if isinstance(found, Failure) else Failure(UNSEALED, found.steps)
    return _no_push(case, reason, started)


def _sealed(state: SlidingState) -> bool:
    """Return True if the contact pressure exceeds the fluid pressure somewhere in the contact."""
    return int(np.argmax(state.contact_pressure)) > 0


def _leak(
    workspace: Workspace, start: SlidingState, opening: float
) -> tuple[float | None, SlidingState]:
    """Return the leak pressure in units of the modulus, or None, and the last state below it.

    The excess of the largest contact pressure over P is lowered in steps, and P is solved for in
    each step. Close to the leak pressure the excess is proportional to the square root of the
    distance from it, so the square of the excess is extrapolated linearly to zero.
    """
    states, pressure = [start], max(start.pressure, LOW_START * opening)
    excess = min(_excess(start), HIGHEST_EXCESS)
    while excess > LEAK_EXCESS or len(states) < 3:
        excess *= LEAK_STEP
        at = states[-1].configuration
        found = solve_at_seal(workspace, at, excess, pressure, start.friction)
        if isinstance(found, Failure) or found.pressure <= states[-1].pressure:
            break
        states.append(found)
        pressure = found.pressure
    if len(states) < 3 or _excess(states[-1]) > LEAK_FAR:
        return None, states[-1]
    before, now = states[-2:]
    first, second = ((_excess(each) * each.pressure) ** 2 for each in (before, now))
    if not second < first:
        return None, now
    ahead = second * (now.pressure - before.pressure) / (first - second)
    return now.pressure + ahead, now


def _excess(state: SlidingState) -> float:
    """Return the largest contact pressure minus the fluid pressure, divided by the latter."""
    if state.pressure <= NO_PRESSURE:
        return np.inf
    return float(state.contact_pressure.max()) / state.pressure - 1.0


def _no_push(case: Problem, failure: Failure, started: float) -> NoPush:
    reason = failure.reason + far_field_hint(case) + oversize_hint(case)
    return NoPush(reason, failure.steps, time.perf_counter() - started)


def _state(case: Problem, setup: _Setup, found: SlidingState, started: float) -> PushedState:
    modulus, wall = setup.modulus, loaded_wall(setup.workspace, found)
    order = found.station.shape[1] - 1
    fine = resampling(order, SAMPLES)[0].T
    r, z, sigma = (joined(x @ fine) for x in (found.r, found.z, found.contact_pressure))
    in_pascals, far = wall.field.in_units(modulus), wall.far_field
    return PushedState(
        case=case,
        urine_pressure=modulus * found.pressure,
        net_force=modulus * found.force / (np.pi * case.size_ratio**2),
        friction_work=modulus
        * found.friction_work
        / (np.pi * case.size_ratio**2 * case.load.prestretch),
        theta=setup.workspace.problem.stone.parametric(r, z),
        contact_pressure=modulus * np.maximum(sigma, 0.0),
        upstream_radius=far.radius,
        upstream_stretch=far.upstream,
        downstream_stretch=far.downstream,
        wall=in_pascals,
        solver=PushReport(
            dofs=setup.workspace.dofs,
            newton_steps=setup.steps + found.steps,
            seconds=time.perf_counter() - started,
            residual=found.residual,
            volume=wall.volume,
            axial_balance=wall.axial_balance,
            penetration=found.penetration,
        ),
        stability=stability_of(case, wall.deformation, in_pascals),
        microbuckled=_microbuckled(case, wall.deformation),
    )


def _microbuckled(case: Problem, F: Deformation) -> bool:
    """Return True if C_zz is anywhere below the value at which the axial fibres buckle."""
    law = relaxed(case.ureter.material.law)
    if not isinstance(law, RelaxedEnergy):
        return False
    return bool((F.F_rz**2 + F.F_zz**2 < law.threshold(F.F_tt**2, np)).any())
