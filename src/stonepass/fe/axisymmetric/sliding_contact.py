"""The sliding contact: fluid pressure acts upstream of a held stone, and the wall slides on it.

The mesh covers the whole tube, beginning at the upstream end. Upstream of the first contact edge
the fluid pressure P acts on the inner wall as a follower load. Between the edges the wall lies on
the stone. Downstream of the last edge the inner wall is free. The total contact pressure is

    λ = P φ(Z) + λ_n,    where φ falls linearly from 1 at the first edge to 0 at the last.

The multiplier λ_n vanishes at both edges. Therefore λ is continuous there, and at the first edge it
equals the pressure P of the fluid. Friction is fully mobilised everywhere: the traction on the wall
is μ λ and points downstream. No point sticks, so the result does not depend on a loading path. Both
edges are grid lines whose stations are unknowns. P may be one more unknown; its equation is then a
condition on the axial force on the stone or on the largest contact pressure.

The *seal* is the station at which λ is largest. In a *dry* contact friction acts on the whole λ. In
a *wetted* contact the fluid carries the part P of the contact pressure between the first edge and
the seal, so there the friction traction is μ (λ − P). This traction ends with a step at the seal,
which causes a local minimum of λ; the position of the seal is therefore taken from the dry state.
The seal is a grid line too. See "The push-through, solved directly" in docs/theory.md.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

from stonepass.array_types import Float
from stonepass.fe.axisymmetric.equilibrium import (
    POLISH,
    TOLERANCE,
    contact_flaw,
    penetration,
    residual_tolerance,
)
from stonepass.fe.axisymmetric.problem import Failure
from stonepass.fe.axisymmetric.sliding_forces import (
    axial_force,
    contact_forces,
    friction_work,
    seal_pressure,
)
from stonepass.fe.axisymmetric.sliding_state import Configuration, SlidingState
from stonepass.fe.axisymmetric.sliding_workspace import Workspace, capture, load, move_contact
from stonepass.fe.core.newton import Report, newton
from stonepass.fe.core.systems import BorderedSystem

__all__ = ["solve_at_pressure", "solve_at_seal", "solve_critical"]

# Newton steps after which a load step is bisected. A wall whose fibres microbuckle needs many,
# because its tangent jumps at the onset of microbuckling.
MOST_STEPS = 32
MOST_HALVINGS = 3
PRESSURE_SCALE = 0.05  # smallest scale of the unknown pressure, in units of the modulus
NEAREST_SEAL = 0.05  # smallest distance of the seal from an edge, as a fraction of the contact
# Largest allowed penetration of the open wall into the stone, in radii of the stone. At the first
# edge the friction traction begins with a step of size μ P, which tilts the wall on both sides of
# the edge. The open wall may then penetrate the stone slightly, and λ may fall below P within one
# nodal spacing. In reality fluid would enter there and remove the friction, so that the step would
# move downstream; the model has no well-defined position for it. The error of the axial force is of
# the order of the penetration, which is therefore limited.
LARGEST_PENETRATION = 1e-3

# A function that evaluates the current state of the workspace and returns a scalar, which vanishes
# at the solution.
Condition = Callable[[], float]


def solve_at_pressure(
    workspace: Workspace, start: Configuration, pressure: float, friction: float
) -> SlidingState | Failure:
    """Solve for the state at a given pressure of the fluid.

    Parameters
    ----------
    workspace : Workspace
        Its content is overwritten and has no influence on the result.
    start : Configuration
        Starting point. The load is applied in one step; if that fails, the step is bisected.
    pressure : float
        P, zero or positive, in units of the modulus.
    friction : float
        Coulomb coefficient, zero or positive.

    Returns
    -------
    SlidingState or Failure
    """
    return _solve(workspace, start, pressure, friction, None)


def solve_critical(
    workspace: Workspace, start: Configuration, guess: float, friction: float
) -> SlidingState | Failure:
    """Solve for the pressure at which the axial force on the stone is zero.

    Parameters
    ----------
    workspace, start, friction
        See `solve_at_pressure`.
    guess : float
        First guess of the pressure, zero or positive, in units of the modulus.

    Returns
    -------
    SlidingState or Failure
    """
    return _solve(workspace, start, guess, friction, partial(axial_force, workspace))


def solve_at_seal(
    workspace: Workspace, start: Configuration, excess: float, guess: float, friction: float
) -> SlidingState | Failure:
    """Solve for the pressure P at which the largest contact pressure is (1 + excess) P.

    Parameters
    ----------
    workspace, start, friction
        See `solve_at_pressure`.
    excess : float
        Relative excess of the largest contact pressure over P, positive.
    guess : float
        First guess of P, zero or positive, in units of the modulus.

    Returns
    -------
    SlidingState or Failure
    """

    def beyond() -> float:
        return seal_pressure(workspace)[1] - (1.0 + excess) * workspace.pressure.Get()

    return _solve(workspace, start, guess, friction, beyond)


def _solve(
    workspace: Workspace,
    start: Configuration,
    pressure: float,
    friction: float,
    condition: Condition | None,
) -> SlidingState | Failure:
    """Solve the dry contact and then, if the problem is wetted, the wetted contact.

    If there is a `condition`, the pressure is an unknown and `pressure` is its first guess. If the
    first route to the state fails, or ends at a state that is not admissible, a second one is
    tried, which may end at another state.
    """
    dry = replace(start, wetting=0.0)
    if condition is None:
        return _finished(workspace, _loaded(workspace, dry, pressure, friction), None)
    found = _finished(workspace, _imposed(workspace, dry, pressure, friction, condition), condition)
    if isinstance(found, SlidingState) or (dry.pressure, dry.friction) == (pressure, friction):
        return found
    other = _finished(
        workspace, _loaded(workspace, dry, pressure, friction, condition, step=0.5), condition
    )
    steps = found.steps + other.steps
    return replace(other if isinstance(other, SlidingState) else found, steps=steps)


def _finished(
    workspace: Workspace, reached: tuple[Configuration, Report], condition: Condition | None
) -> SlidingState | Failure:
    """Apply the wetting, check the state, and evaluate it."""
    found, report = reached
    steps = report.steps
    if report.converged and workspace.problem.wetted:
        found, report = _wetted(workspace, found, condition)
        steps += report.steps
    if not report.converged:
        return Failure(report.reason, steps)
    load(workspace, found)
    forces = contact_forces(workspace)
    flaw = contact_flaw(workspace.discretisation, forces.normal, LARGEST_PENETRATION)
    if flaw:
        return Failure(flaw, steps)
    return SlidingState(
        configuration=found,
        force=axial_force(workspace),
        station=forces.wall.station,
        r=forces.wall.r,
        z=forces.wall.z,
        contact_pressure=forces.normal / forces.area,
        steps=steps,
        residual=report.residual / (2.0 * workspace.problem.force),
        penetration=penetration(workspace.discretisation),
        friction_work=friction_work(workspace),
    )


def _loaded(
    workspace: Workspace,
    dry: Configuration,
    pressure: float,
    friction: float,
    condition: Condition | None = None,
    step: float = 1.0,
) -> tuple[Configuration, Report]:
    """Apply pressure and friction; a condition is imposed only when both have been reached.

    `step` is the first part of the load that is tried.
    """
    begin = np.array([dry.pressure, dry.friction])
    way = np.array([pressure, friction]) - begin

    def attempt(reached: Configuration, fraction: float) -> tuple[Configuration, Report]:
        at_pressure, at_friction = (float(value) for value in begin + fraction * way)
        last = condition if fraction == 1.0 else None
        return _newton(workspace, replace(reached, friction=at_friction), at_pressure, last)

    return _bisected(dry, attempt, step)


def _imposed(
    workspace: Workspace, dry: Configuration, guess: float, friction: float, condition: Condition
) -> tuple[Configuration, Report]:
    """Apply friction and impose the condition, in one step or in several.

    Every step solves for the pressure at which the condition is violated by a part of what it is at
    the start. If the stone is seated without friction and without fluid there, and the condition is
    that the axial force vanishes, every step is thus a critical state.
    """
    load(workspace, dry)
    missed, trail = condition(), [dry]

    def attempt(reached: Configuration, fraction: float) -> tuple[Configuration, Report]:
        at_friction = dry.friction + fraction * (friction - dry.friction)
        if reached is not trail[-1]:
            trail.append(reached)
        if len(trail) > 1:
            pressure = _extrapolated(trail[-2], trail[-1], at_friction)
        else:
            pressure = dry.pressure + fraction * (guess - dry.pressure)

        def partly() -> float:
            return condition() - (1.0 - fraction) * missed

        return _newton(workspace, replace(reached, friction=at_friction), pressure, partly)

    return _bisected(dry, attempt)


def _extrapolated(before: Configuration, now: Configuration, friction: float) -> float:
    """Return the pressure at a friction coefficient on the straight line through two states."""
    change = now.friction - before.friction
    slope = 0.0 if change == 0.0 else (now.pressure - before.pressure) / change
    return max(now.pressure + slope * (friction - now.friction), 0.0)


def _wetted(
    workspace: Workspace, dry: Configuration, condition: Condition | None
) -> tuple[Configuration, Report]:
    """Apply the wetting between the first edge and the seal of the dry state."""
    load(workspace, dry)
    first, last = dry.edges
    fraction = (seal_pressure(workspace)[0] - first) / (last - first)
    seal = min(max(fraction, NEAREST_SEAL), 1.0 - NEAREST_SEAL)

    def attempt(reached: Configuration, wetting: float) -> tuple[Configuration, Report]:
        return _newton(workspace, replace(reached, wetting=wetting), reached.pressure, condition)

    return _bisected(replace(dry, seal=seal), attempt)


def _bisected(
    start: Configuration,
    attempt: Callable[[Configuration, float], tuple[Configuration, Report]],
    step: float = 1.0,
) -> tuple[Configuration, Report]:
    """Apply a load in one step; if a step fails, bisect it, down to 1/8 of the load.

    ``attempt(reached, fraction)`` solves for a fraction of the load, starting from the
    configuration that has been reached, which it does not change. `step` is the first fraction.
    """
    reached, fraction, steps = start, 0.0, 0
    while True:
        ahead = min(fraction + step, 1.0)
        found, report = attempt(reached, ahead)
        steps += report.steps
        if report.converged:
            reached, fraction = found, ahead
            step = min(2.0 * step, 1.0 - fraction)
        else:
            step /= 2.0
        if fraction == 1.0 or step < 0.9 / 2.0**MOST_HALVINGS:
            return reached, replace(report, steps=steps)


def _newton(
    workspace: Workspace, start: Configuration, pressure: float, condition: Condition | None
) -> tuple[Configuration, Report]:
    """Run Newton's method, with the contact edges as unknowns.

    Without a condition the pressure is given. With a condition the pressure is an unknown too. The
    result is the last configuration of the iteration; it is a solution only if the report has
    converged.
    """
    load(workspace, start)
    d, problem = workspace.discretisation, workspace.problem
    unknown = 2 if condition is None else 3
    known = np.array([pressure])[: 3 - unknown]

    def apply(values: Float[np.ndarray, " n"]) -> bool:
        first, last, at_pressure = (float(value) for value in np.concatenate([values, known]))
        return move_contact(workspace, (first, last), at_pressure, start.seal)

    def conditions() -> Float[np.ndarray, " n"]:
        at_edges = [d.state.vec[index] for index in workspace.at_edges]
        return np.array(at_edges if condition is None else [*at_edges, condition()])

    half = (problem.contact[1] - problem.contact[0]) / 2.0
    system = BorderedSystem(
        workspace.form,
        d.state,
        workspace.free,
        values=np.array([*start.edges, pressure])[:unknown],
        scale=np.array([half, half, max(pressure, PRESSURE_SCALE)])[:unknown],
        apply=apply,
        conditions=conditions,
        kink_width=d.kink_width,
    )
    tolerance = residual_tolerance(system, problem.force, 2.0 * TOLERANCE)
    report = newton(system, tolerance, most=MOST_STEPS, polish=POLISH)
    return capture(workspace, start.seal), report
