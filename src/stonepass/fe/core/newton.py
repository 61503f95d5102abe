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
# A factorisation is reused after a step that reduces the norm by the factor FAST, for as long as
# each further step reduces the norm by the factor STEADY.
FAST, STEADY = 0.1, 0.3
# After a step shorter than SHORT, and until a full step, tangents round kinks of the energy: over
# WIDTH times the square root of norm/tolerance, but at most over WIDEST.
SHORT, WIDTH, WIDEST = 0.2, 1e-5, 0.1


@dataclass(frozen=True)
class Report:
    """Result of a Newton iteration.

    Attributes
    ----------
    steps : int
        Number of Newton steps for which a new tangent was factorised.
    residual : float
        Norm of the residual at the last state, in the units of the system.
    reason : str
        Reason why the iteration did not converge; empty if it converged.
    """

    steps: int
    residual: float
    reason: str

    @property
    def converged(self) -> bool:
        """True if the tolerance was met."""
        return not self.reason


class SingularTangent(Exception):
    """The tangent matrix could not be factorised, or the scalar unknowns are not determined."""


@runtime_checkable
class System(Protocol):
    """A nonlinear system whose current state can be moved along a Newton direction."""

    def residual(self) -> float:
        """Return the norm of the residual at the current state."""

    def direction(self, *, again: bool = False, width: float = 0.0) -> None:
        """Compute the Newton direction and store the current state as its origin.

        If `again` is true, the last factorisation is reused instead of a new one. In a new tangent,
        but not in the residual, kinks of the energy are rounded over `width`.
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

    The step is halved until the norm has decreased by the fraction `SUFFICIENT_DECREASE` × step.
    The smallest step, `SMALLEST_STEP`, is accepted in any case, because in contact problems the
    norm may have to increase first. After a step that reduces the norm by the factor `FAST`, the
    same factorisation is reused as long as each further step reduces the norm by the factor
    `STEADY`. These further steps are not counted: each costs about a tenth of a step with a new
    factorisation.

    The slope of the residual may jump where the energy of a wall has a kink, for example where
    fibres begin to buckle. Newton steps then lead from one side of many kinks to the other and
    back, and only short steps reduce the norm. After such a step, and until a full step succeeds,
    the tangent, but not the residual, is that of an energy with rounded kinks (Jacobian smoothing;
    X. Chen, L. Qi and D. Sun, Mathematics of Computation 67, 519–540, 1998). The solution does not
    depend on the rounding.

    Parameters
    ----------
    system : System
        Its state is the starting point. After the call it holds the last state.
    tolerance : float
        Largest norm of the residual that counts as converged, positive, in the units of the system.
    most : int
        Largest number of steps with a new tangent.
    polish : float
        Factor in (0, 1]. After convergence the last factorisation is used to reduce the norm
        further, to `polish` × `tolerance`, as long as the norm keeps falling fast enough.

    Returns
    -------
    Report
        The iteration has not converged if the tangent is singular, if the residual is not finite
        even after the smallest step, or if `most` steps were not enough.
    """
    norm, rounded = system.residual(), False
    for count in range(most):
        if norm <= tolerance:
            if count > 0:
                norm = _same_tangent(system, norm, polish * tolerance)
            return Report(count, norm, "")
        width = min(WIDTH * math.sqrt(norm / tolerance), WIDEST) if rounded else 0.0
        try:
            system.direction(width=width)
        except SingularTangent:
            return Report(count, norm, "the tangent matrix is singular")
        last = norm
        norm, step = _line_search(system, norm)
        rounded = step < SHORT or (rounded and step < 1.0)
        if not math.isfinite(norm):
            return Report(count + 1, last, "an iterate had no finite residual")
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
    """Iterate directly; if that fails, restart and solve a sequence of stiffened walls.

    The sequence (homotopy) adds a neo-Hookean matrix to the wall, whose shear modulus is lowered
    step by step to zero. Each solution is the starting point of the next one. See "Friction and its
    path" in docs/theory.md.

    Parameters
    ----------
    system : RestartableSystem
        Its state is the starting point. After the call it holds the last state.
    stiffen : callable
        ``stiffen(s)`` sets the shear modulus s of the added matrix, in units of the modulus. It is
        called with the values of `LADDER`, the last of which is zero.
    tolerance, most, polish
        See `newton`.

    Returns
    -------
    Report
        Result of the last iteration; `steps` counts the steps of all attempts.
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


def _line_search(system: System, start: float) -> tuple[float, float]:
    """Halve the step until the norm is sufficiently below `start`; return new norm and step."""
    step = 1.0
    while True:
        system.move(step)
        norm = system.residual()
        if norm <= start * (1.0 - SUFFICIENT_DECREASE * step):  # false if the norm is NaN
            return norm, step
        if step <= SMALLEST_STEP:
            return norm, step
        step = max(step / 2.0, SMALLEST_STEP)


def _same_tangent(system: System, norm: float, tolerance: float) -> float:
    """Reuse the last factorisation while each step reduces the norm by the factor `STEADY`.

    The first step that reduces it less is undone. The norm at the last state is returned.
    """
    while norm > tolerance:
        try:
            system.direction(again=True)
        except SingularTangent:
            return norm
        system.move(1.0)
        found = system.residual()
        if not found <= STEADY * norm:  # also true if the norm is NaN
            system.move(0.0)
            return norm
        norm = found
    return norm
