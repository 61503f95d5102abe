"""The push-through: the loaded problem itself, solved (`model: direct`; beyond the paper).

The stone is held at mid-length while urine of pressure P_u stands upstream. Up to the contact the
wall carries P_u, and it slides on the stone with its friction fully mobilised. The net axial force
on the stone, N(P_u), is negative while the stone is stuck; its root is the critical pressure. The
largest contact pressure seals; at the *leak pressure* P_u reaches it, and urine passes.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from stonepass.errors import require
from stonepass.fe.axisymmetric.contact import joined, resampling
from stonepass.fe.axisymmetric.discrete import inner_wall
from stonepass.fe.axisymmetric.fitted_contact import Fitted
from stonepass.fe.axisymmetric.postprocessing import (
    deformation,
    field,
    loaded_balance,
    volume,
)
from stonepass.fe.axisymmetric.problem import Failure, Resolution
from stonepass.fe.axisymmetric.seating import seat_on_stone
from stonepass.fe.axisymmetric.sliding_contact import Slid, Slide
from stonepass.fe.core.threads import one_thread
from stonepass.materials.derivatives import hoop_modulus
from stonepass.materials.relaxed_energy import Relaxed, relaxed
from stonepass.materials.stability import check
from stonepass.model.energy_balance import opening_pressure
from stonepass.model.far_field import stuck_lumen
from stonepass.model.numerics import Numerics
from stonepass.model.problem import Problem
from stonepass.model.states.first_guess import wrap_round_arc
from stonepass.model.states.loaded_state import Critical, NoPush, PushedState, PushReport
from stonepass.model.states.nondimensional import profile_of, tube_of
from stonepass.model.states.stability import (
    far_field_hint,
    oversize_hint,
    stability_of,
    waves,
)
from stonepass.units import Pressure, pressure

__all__ = ["solve_critical", "solve_loaded"]

SAMPLES = 33  # of each column in contact
# In units of the pressure that opens the tube to R_s: largest first guess, and a low start.
HIGHEST_GUESS, LOW_START = 1.2, 0.3
# Excess of the seal over P_u, relative: where the search for the leak begins and ends, its step.
# From farther than the last no leak pressure is extrapolated.
HIGHEST_EXCESS, LEAK_EXCESS, LEAK_STEP, LEAK_FAR = 3.0, 0.06, 0.6, 0.4
NO_PRESSURE = 1e-9  # in units of the modulus: rounding around none
LEAKS = "urine passes the stone: no contact pressure is above that of the urine"
UNSEALED = "the state that balances does not hold the urine back"


def solve_loaded(
    case: Problem,
    numerics: Numerics,
    urine: Sequence[str | Pressure],
    resolution: Resolution | None = None,
    *,
    wetted: bool = False,
    tether: float = 0.0,
    offset: float = 0.0,
) -> list[PushedState | NoPush]:
    """Hold the stone under one pressure after the other, each state the start of the next.

    The slide is imminent everywhere (theory: the push-through, solved directly). Once a state is
    not found, the rest is not tried.

    Parameters
    ----------
    case : Problem
    numerics : Numerics
    urine : sequence of str or Pressure
        P_u above the stone, e.g. ``"8 kPa"``; zero or positive.
    resolution : Resolution, optional
        The mesh; by default the finer one of the accuracy.
    wetted : bool
        Whether urine takes its pressure off the friction, from the contact's upstream edge to the
        seal.
    tether : float
        Stiffness of springs that hold the outer wall along the axis, per reference area, in units
        of w″(1)/R_a. The ends hold the wall only far away, so it shortens upstream and lengthens
        downstream; a weak tether leaves the same stretch on both sides.
    offset : float
        How far downstream of mid-length the stone is held, in inner radii.

    Raises
    ------
    UnstableLaw
        The material law is no solid.
    BadInput
        The stone is not larger than the lumen, or a number is out of range.
    """
    bounds = [pressure(each, "urine pressure") for each in urine]
    for bound, each in zip(bounds, urine, strict=True):
        require(0.0 <= bound < np.inf, "urine pressure", each, "zero or positive")
    started = time.perf_counter()
    wanted = resolution or numerics.resolution
    (ready,) = _slides(case, numerics, [wanted], wetted=wetted, tether=tether, offset=offset)
    if isinstance(ready, Failure):
        return [_no_push(case, ready, started)] * len(bounds)
    states: list[PushedState | NoPush] = []
    with one_thread():
        for bound in bounds:
            found = ready.slide.held(bound / ready.modulus, case.stone.friction)
            if isinstance(found, Slid) and not _sealed(found):
                found = Failure(LEAKS, found.steps)
            if isinstance(found, Failure):
                lost = _no_push(case, found, started)
                return states + [lost] * (len(bounds) - len(states))
            states.append(_state(case, ready, found, started))
    return states


def solve_critical(
    case: Problem,
    numerics: Numerics,
    resolutions: Sequence[Resolution],
    *,
    wetted: bool = False,
    leak: bool = True,
) -> list[Critical | NoPush]:
    """Find the pressure that moves the stone, once for each resolution, coarse before fine.

    The first one also looks for the leak pressure where it is asked for; the others start from its
    answer.
    """
    started, found = time.perf_counter(), list[Critical | NoPush]()
    guess = None
    for ready in _slides(case, numerics, resolutions, wetted=wetted):
        if isinstance(ready, Failure):
            found.append(_no_push(case, ready, started))
            continue
        with one_thread():
            critical = _critical(case, ready, guess, started, leak=leak and not found)
        if isinstance(critical, Critical) and not critical.leaks:
            guess = critical.state.urine_pressure / ready.modulus
        found.append(critical)
    return found


@dataclass(frozen=True)
class _Ready:
    """A tube ready to be loaded: first guess of P_ucr, and the pressure that opens it to R_s."""

    slide: Slide
    modulus: float
    guess: float
    opening: float
    steps: int


def _slides(
    case: Problem,
    numerics: Numerics,
    resolutions: Sequence[Resolution],
    *,
    wetted: bool,
    tether: float = 0.0,
    offset: float = 0.0,
) -> list[_Ready | Failure]:
    """Seat the stone without friction, for each resolution, and make a loaded tube of it."""
    check(case.ureter.material)
    lumen = stuck_lumen(case)
    unstable = waves(case, numerics.half_length)
    if unstable:
        return [Failure(unstable, 0)] * len(resolutions)
    law = relaxed(case.ureter.material.law)
    modulus = hoop_modulus(law)
    tube = tube_of(law, case.wall_ratio, case.load, numerics.half_length)
    wrap_at = partial(wrap_round_arc, case, numerics.half_length, lumen, modulus)
    opening = opening_pressure(case)
    found: list[_Ready | Failure] = []
    for half, resolution in zip(
        seat_on_stone(tube, profile_of(case), wrap_at, resolutions), resolutions, strict=True
    ):
        if isinstance(half, Failure):
            found.append(half)
            continue
        slide = Slide(
            replace(tube, tether=tether),
            half,
            resolution,
            wetted=wetted,
            offset=offset,
        )
        guess = _guess(case, half, opening / modulus)
        found.append(_Ready(slide, modulus, guess, opening / modulus, half.steps))
    return found


def _guess(case: Problem, half: Fitted, opening: float) -> float:
    """P_ucr by energy from the unloaded contact: P V = ∫ μ λ dA for an advance by one length."""
    wall = inner_wall(half.discrete, "closed")
    halves = 1.0 if half.layout.whole else 2.0
    normal = halves * 2.0 * np.pi * float((wall.weight * wall.normal).sum())
    rubbed = case.stone.friction * normal
    section = np.pi * ((1.0 + case.size_ratio) / 2.0) ** 2
    return min(rubbed / section, HIGHEST_GUESS * opening)


def _critical(
    case: Problem, ready: _Ready, guess: float | None, started: float, *, leak: bool
) -> Critical | NoPush:
    slide, friction = ready.slide, case.stone.friction
    found = slide.moving(ready.guess if guess is None else guess, friction)
    if isinstance(found, Slid) and _sealed(found):
        state = _state(case, ready, found, started)
        passed = _leak(slide, found, ready.opening)[0] if leak else None
        return Critical(state, None if passed is None else passed * ready.modulus, leaks=False)
    start = slide.held(LOW_START * ready.opening, friction)
    if isinstance(start, Slid):
        passed, last = _leak(slide, start, ready.opening)
        # Only from close by: what is extrapolated from afar says nothing of the force there.
        if passed is not None and last.force < 0.0 and _excess(last) <= 2.0 * LEAK_EXCESS:
            again = slide.held(last.pressure, friction)  # the search may have gone on from there
            if isinstance(again, Slid):
                state = _state(case, ready, again, started)
                return Critical(state, passed * ready.modulus, leaks=True)
    reason = found if isinstance(found, Failure) else Failure(UNSEALED, found.steps)
    return _no_push(case, reason, started)


def _sealed(state: Slid) -> bool:
    """Whether the contact pressure rises above that of the fluid behind the first edge."""
    return int(np.argmax(state.contact_pressure)) > 0


def _leak(slide: Slide, start: Slid, opening: float) -> tuple[float | None, Slid]:
    """The leak pressure, and the last state before it.

    The excess of the largest contact pressure over P is lowered in steps, and P found for each.
    It falls like a root of the distance to the leak pressure, so its square is extrapolated.
    """
    states, pressure = [start], max(start.pressure, LOW_START * opening)
    excess = min(_excess(start), HIGHEST_EXCESS)
    while excess > LEAK_EXCESS or len(states) < 3:
        excess *= LEAK_STEP
        found = slide.sealing(excess, pressure, start.friction)
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


def _excess(state: Slid) -> float:
    """How far the seal is above the fluid, in units of the fluid's pressure."""
    if state.pressure <= NO_PRESSURE:
        return np.inf
    return float(state.contact_pressure.max()) / state.pressure - 1.0


def _no_push(case: Problem, failure: Failure, started: float) -> NoPush:
    reason = failure.reason + far_field_hint(case) + oversize_hint(case)
    return NoPush(reason, failure.steps, time.perf_counter() - started)


def _state(case: Problem, ready: _Ready, found: Slid, started: float) -> PushedState:
    slide, modulus = ready.slide, ready.modulus
    order = found.station.shape[1] - 1
    fine = resampling(order, SAMPLES)[0].T
    r, z, sigma = (joined(x @ fine) for x in (found.r, found.z, found.contact_pressure))
    in_pascals = field(slide).in_units(modulus)
    far = slide.far_field()
    return PushedState(
        case=case,
        urine_pressure=modulus * found.pressure,
        net_force=modulus * found.force / (np.pi * case.size_ratio**2),
        friction_work=modulus
        * found.friction_work
        / (np.pi * case.size_ratio**2 * case.load.prestretch),
        theta=slide.stone.parametric(r, z),
        contact_pressure=modulus * np.maximum(sigma, 0.0),
        upstream_radius=far.radius,
        upstream_stretch=far.upstream,
        downstream_stretch=far.downstream,
        wall=in_pascals,
        solver=PushReport(
            dofs=slide.dofs,
            newton_steps=ready.steps + found.steps,
            seconds=time.perf_counter() - started,
            residual=found.residual,
            volume=volume(slide),
            axial_balance=loaded_balance(slide, found.pressure, found.force),
            penetration=found.penetration,
        ),
        stability=stability_of(case, slide, in_pascals),
        kinked=_kinked(case, slide),
    )


def _kinked(case: Problem, slide: Slide) -> bool:
    """Whether C_zz is anywhere below that at which the relaxed law begins."""
    law = relaxed(case.ureter.material.law)
    if not isinstance(law, Relaxed):
        return False
    F = deformation(slide)
    return bool((F.F_rz**2 + F.F_zz**2 < law.kink(F.F_tt**2, np)).any())
