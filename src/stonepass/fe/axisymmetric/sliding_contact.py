"""The loaded tube: a fluid pushes from upstream, and the wall slides on the held stone.

The mesh covers the whole tube, upstream first. Up to the first edge of the contact the inner wall
carries the fluid's pressure P as a follower load, beyond the last edge nothing; between them the
wall lies on the arc. There the total contact pressure is

    λ = P φ(Z) + λ_n,    φ falling linearly from 1 at the first edge to 0 at the last,

so that the multiplier λ_n vanishes at both edges, λ is continuous there, and λ ≥ P holds where
fluid stands before the contact. Sliding is imminent everywhere, so the friction is known: a
traction μ λ on the wall, downstream. Nothing sticks, and the result does not depend on a path. Both
edges are grid lines whose stations are unknowns. P may be another unknown; its equation is then a
condition for the axial force on the stone, or for the seal.

The seal is where λ is largest. In a wetted contact the fluid carries its share of the contact up to
the seal: there the traction is μ (λ − P). That makes a dip in λ where the wetted part ends, so the
place of the seal is taken from the dry state; the seal is a grid line.
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

MOST_STEPS = 16  # Newton steps after which a load step is bisected
MOST_HALVINGS = 3
PRESSURE_SCALE = 0.05  # least scale of the pressure as an unknown, in units of the modulus
NEAREST_SEAL = 0.05  # of the seal to an edge, as a fraction of the contact
# Largest penetration of the open wall into the stone, in radii of the stone. At the first edge
# friction begins with a step, μ P, which tilts the wall on both sides: the open wall may pass
# through the stone a little, and λ fall below P within the first node. Fluid would enter there,
# without friction, and the step would move with it, so it has no place of its own. The error of the
# force is of the order of the penetration, which is therefore bounded.
PENETRATION = 1e-3

# A scalar, evaluated from what the workspace holds, that must vanish.
Condition = Callable[[], float]


def solve_at_pressure(
    workspace: Workspace, start: Configuration, pressure: float, friction: float
) -> SlidingState | Failure:
    """Solve for the held stone at a given pressure of the fluid.

    Parameters
    ----------
    workspace : Workspace
        Its content before the call has no influence on the result.
    start : Configuration
        The load is applied in one step from here, or in smaller steps where that fails.
    pressure : float
        P in units of the modulus, zero or positive.
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
    """Solve for the pressure at which no axial force remains on the stone.

    The parameters are those of `solve_at_pressure`, with `guess` a first guess of the pressure.
    """
    return _solve(workspace, start, guess, friction, partial(axial_force, workspace))


def solve_at_seal(
    workspace: Workspace, start: Configuration, excess: float, guess: float, friction: float
) -> SlidingState | Failure:
    """Solve for the pressure at which the largest contact pressure is (1 + excess) P.

    The parameters are those of `solve_at_pressure`, with `guess` a first guess of the pressure and
    `excess` positive.
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
    """Solve the dry contact, then the wetted one where the problem asks for it.

    With a `condition` the pressure is an unknown, and `pressure` its first guess.
    """
    found, report = _dry(workspace, start, pressure, friction, condition)
    steps = report.steps
    if report.converged and workspace.problem.wetted:
        found, report = _wetted(workspace, found, condition)
        steps += report.steps
    if not report.converged:
        return Failure(report.reason, steps)
    load(workspace, found)
    forces = contact_forces(workspace)
    flaw = contact_flaw(workspace.discretisation, forces.normal, PENETRATION)
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


def _dry(
    workspace: Workspace,
    start: Configuration,
    pressure: float,
    friction: float,
    condition: Condition | None,
) -> tuple[Configuration, Report]:
    """Go from the start to a pressure and friction; the condition counts at the end only."""
    begin = np.array([start.pressure, start.friction])
    way = np.array([pressure, friction]) - begin

    def attempt(reached: Configuration, fraction: float) -> tuple[Configuration, Report]:
        at_pressure, at_friction = (float(value) for value in begin + fraction * way)
        last = condition if fraction == 1.0 else None
        return _newton(workspace, replace(reached, friction=at_friction), at_pressure, last)

    return _bisected(replace(start, wetting=0.0), attempt)


def _wetted(
    workspace: Workspace, dry: Configuration, condition: Condition | None
) -> tuple[Configuration, Report]:
    """Let the fluid carry its share of the contact up to the seal of the dry state."""
    load(workspace, dry)
    first, last = dry.edges
    fraction = (seal_pressure(workspace)[0] - first) / (last - first)
    seal = min(max(fraction, NEAREST_SEAL), 1.0 - NEAREST_SEAL)

    def attempt(reached: Configuration, wetting: float) -> tuple[Configuration, Report]:
        return _newton(workspace, replace(reached, wetting=wetting), reached.pressure, condition)

    return _bisected(replace(dry, seal=seal), attempt)


def _bisected(
    start: Configuration, attempt: Callable[[Configuration, float], tuple[Configuration, Report]]
) -> tuple[Configuration, Report]:
    """Apply a load in one step; bisect the step where it fails, down to 1/8 of the load.

    `attempt` takes the configuration reached and the fraction of the load to go to.
    """
    reached, fraction, step, steps = start, 0.0, 1.0, 0
    while True:
        ahead = min(fraction + step, 1.0)
        found, report = attempt(reached, ahead)
        steps += report.steps
        if report.converged:
            reached, fraction, step = found, ahead, 2.0 * step
        else:
            step /= 2.0
        if fraction == 1.0 or step < 0.9 / 2.0**MOST_HALVINGS:
            return reached, replace(report, steps=steps)


def _newton(
    workspace: Workspace, start: Configuration, pressure: float, condition: Condition | None
) -> tuple[Configuration, Report]:
    """Newton's method at a pressure or, with a condition, for it; edges are unknowns in both.

    Returns what the engine holds at the end; it is a solution where the report says converged.
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
    )
    tolerance = residual_tolerance(system, problem.force, 2.0 * TOLERANCE)
    report = newton(system, tolerance, most=MOST_STEPS, polish=POLISH)
    return capture(workspace, start.seal), report
