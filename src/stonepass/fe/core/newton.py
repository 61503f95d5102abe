"""Damped Newton iteration with a line search, reuse of factorisations and a homotopy."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Protocol, runtime_checkable

__all__ = [
    "Report",
    "RestartableSystem",
    "SingularTangent",
    "System",
    "newton",
    "newton_or_homotopy",
]

SMALLEST_STEP = 0.02
SUFFICIENT_DECREASE = 0.05
LADDER = (0.05, 0.02, 0.01, 0.005, 0.0)
# After a step that cuts the norm to FAST of what it was, its factorisation serves again, as long
# as each further step cuts it to STEADY.
FAST, STEADY = 0.1, 0.3


@dataclass(frozen=True)
class Report:
    """How a Newton iteration ended.

    Attributes
    ----------
    steps : int
        Newton steps for which a new tangent was factorised.
    residual : float
        Last norm of the residual.
    reason : str
        Why the iteration did not converge; empty where it did.
    """

    steps: int
    residual: float
    reason: str

    @property
    def converged(self) -> bool:
        """Whether the tolerance was met."""
        return not self.reason


class SingularTangent(Exception):
    """The tangent could not be factorised, or does not determine the scalar unknowns."""


@runtime_checkable
class System(Protocol):
    """A nonlinear system whose current state can be moved along a direction."""

    def residual(self) -> float:
        """Norm of the residual at the current state."""

    def direction(self, *, again: bool = False) -> None:
        """Compute the Newton direction and keep the current state as its origin.

        With `again` the last factorisation is used instead of a new one.
        """

    def move(self, step: float) -> None:
        """Set the state to origin + `step` × direction."""


@runtime_checkable
class RestartableSystem(System, Protocol):
    """A system that can also copy its state and return to a copy."""

    def remember(self) -> Any:
        """Return a copy of the current state."""

    def recall(self, kept: Any) -> None:
        """Set the state to a copy that `remember` returned."""


def newton(system: System, tolerance: float, most: int = 40, polish: float = 1.0) -> Report:
    """Iterate until the norm of the residual is at most `tolerance`.

    The step is halved until the norm falls by `SUFFICIENT_DECREASE` × step. The smallest step,
    `SMALLEST_STEP`, is taken in any case, because with contact the norm may have to rise first.
    After a step that reduces the norm to `FAST` of its value, the same factorisation is used for
    further steps as long as each of them reduces the norm to `STEADY` of its value. These steps
    are not counted, since each costs about a tenth of a step with a new factorisation.

    Parameters
    ----------
    system : System
        Its state is the starting point; afterwards it holds the last state.
    tolerance : float
        Largest norm of the residual that counts as converged, in the units of the system.
    most : int
        Largest number of steps with a new tangent.
    polish : float
        After convergence the last factorisation is used to reduce the norm further, to
        `polish` × `tolerance`, as long as that succeeds; in (0, 1].

    Returns
    -------
    Report
        Not converged if the tangent is singular, if the state is not finite even after the
        smallest step, or after `most` steps.
    """
    norm = system.residual()
    for count in range(most):
        if norm <= tolerance:
            if count > 0:
                norm = _same_tangent(system, norm, polish * tolerance)
            return Report(count, norm, "")
        try:
            system.direction()
        except SingularTangent:
            return Report(count, norm, "the tangent matrix is singular")
        norm, last = _line_search(system, norm), norm
        if not math.isfinite(norm):
            return Report(count + 1, last, "the wall turned inside out during the iteration")
        if norm <= FAST * last:
            norm = _same_tangent(system, norm, tolerance)
    if norm <= tolerance:
        return Report(most, norm, "")
    return Report(most, norm, f"no convergence in {most} Newton steps")


def newton_or_homotopy(
    system: RestartableSystem,
    stiffen: Callable[[float], None],
    tolerance: float,
    most: int = 30,
    polish: float = 1.0,
) -> Report:
    """Iterate directly; if that fails, restart and follow a sequence of stiffer problems.

    Parameters
    ----------
    system : RestartableSystem
    stiffen : callable
        Sets the shear modulus of a matrix that is added to the wall, in units of the modulus of
        the problem. It is called with the values of `LADDER`, of which the last is zero.
    tolerance, most, polish
        See `newton`.

    Returns
    -------
    Report
        `steps` counts the steps of all attempts.
    """
    start = system.remember()
    report = newton(system, tolerance, most, polish)
    if report.converged:
        return report
    steps = report.steps
    system.recall(start)
    for rung in LADDER:
        stiffen(rung)
        last = newton(system, tolerance, most, polish)
        steps += last.steps
        if not last.converged:
            break
    stiffen(0.0)
    return Report(steps, last.residual, last.reason)


def _line_search(system: System, start: float) -> float:
    """Halve the step until the norm falls sufficiently from `start`; return the new norm."""
    step = 1.0
    while True:
        system.move(step)
        norm = system.residual()
        if norm <= start * (1.0 - SUFFICIENT_DECREASE * step):  # False for NaN
            return norm
        if step <= SMALLEST_STEP:
            return norm
        step = max(step / 2.0, SMALLEST_STEP)


def _same_tangent(system: System, norm: float, tolerance: float) -> float:
    """Iterate with the last factorisation while the norm falls fast; undo a step that does not."""
    while norm > tolerance:
        try:
            system.direction(again=True)
        except SingularTangent:
            return norm
        system.move(1.0)
        found = system.residual()
        if not found <= STEADY * norm:  # NaN too
            system.move(0.0)
            return norm
        norm = found
    return norm
