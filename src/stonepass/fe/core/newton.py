"""Damped Newton iteration on a condensed system, optionally with extra scalar unknowns."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Protocol, runtime_checkable

import ngsolve as ng
import numpy as np
from jaxtyping import Float

__all__ = ["Bordered", "Plain", "Report", "SingularTangent", "newton", "newton_or_homotopy"]

SMALLEST_STEP = 0.02
SUFFICIENT_DECREASE = 0.05
LADDER = (0.05, 0.02, 0.01, 0.005, 0.0)
# After a step that cuts the norm to FAST of what it was, its factorisation serves again, as long
# as each further step cuts it to STEADY.
FAST, STEADY = 0.1, 0.3
MOST = 0.3  # of its scale that a scalar unknown changes in one step
DIFFERENCE = 1e-6  # of the scale, for difference quotients


@dataclass(frozen=True)
class Report:
    """How an iteration went: `residual` is its last norm, `reason` empty where it converged.

    `steps` counts the steps with a tangent of their own.
    """

    steps: int
    residual: float
    reason: str

    @property
    def converged(self) -> bool:
        """Whether the tolerance was met."""
        return not self.reason


class SingularTangent(Exception):
    """The tangent could not be factorised, or says nothing of the scalar unknown."""


@runtime_checkable
class System(Protocol):
    """A nonlinear system with a current state that can be moved along a direction."""

    def residual(self) -> float:
        """Norm of the residual at the current state."""

    def direction(self, *, again: bool = False) -> None:
        """Compute the Newton direction and remember the current state as its origin.

        `again` takes the last factorisation instead of a new one.
        """

    def move(self, step: float) -> None:
        """Go to origin + `step` × direction."""


def newton(system: System, tolerance: float, most: int = 40, polish: float = 1.0) -> Report:
    """Iterate until the residual norm is at most `tolerance`; polish down to `polish` × that.

    The step is halved until the norm falls by `SUFFICIENT_DECREASE` × step, down to
    `SMALLEST_STEP`, which is taken as it is: with contact a step may have to climb. A state that
    is not finite even there ends the iteration, as does a singular matrix. Where a step cuts the
    norm to `FAST` of what it was, its factorisation serves for more steps, as long as each cuts
    it to `STEADY`; these do not count, since they cost a tenth. Polishing takes such steps only.
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
        norm, last = _search(system, norm), norm
        if not math.isfinite(norm):
            return Report(count + 1, last, "the wall turned inside out during the iteration")
        if norm <= FAST * last:
            norm = _same_tangent(system, norm, tolerance)
    if norm <= tolerance:
        return Report(most, norm, "")
    return Report(most, norm, f"no convergence in {most} Newton steps")


def newton_or_homotopy(
    system: Plain,
    stiffen: Callable[[float], None],
    tolerance: float,
    most: int = 30,
    polish: float = 1.0,
) -> Report:
    """Iterate directly; where that fails, from the same start down a ladder of stiffer walls.

    `stiffen` sets the shear modulus of the matrix that is added to the wall, in units of its
    modulus; the last rung is the wall itself.
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


def _search(system: System, start: float) -> float:
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
    """Go on with the last factorisation while the norm falls fast; undo the step that does not."""
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


class Plain:
    """The residual of a form in its free unknowns."""

    def __init__(self, form: Any, state: Any, free: Any) -> None:
        self.form, self.state, self.free = form, state, free
        self._keep = ng.Projector(free, True)
        self._inverse: Any = None
        self._coupling = free & state.space.FreeDofs(True)
        self._force, self._change, self._origin = (state.vec.CreateVector() for _ in range(3))
        self._known = False  # whether `_force` is the residual at the current state

    def evaluate(self, into: Any) -> None:
        """Write the residual vector at the current state into `into`."""
        self.form.Apply(self.state.vec, into)
        self._keep.Project(into)

    def residual(self) -> float:
        """Norm of the residual at the current state."""
        self.evaluate(self._force)
        self._known = True
        return float(ng.Norm(self._force))

    def direction(self, *, again: bool = False) -> None:
        """Linearise and factorise, unless `again`, and solve."""
        self._origin.data = self.state.vec
        if not self._known:
            self.evaluate(self._force)
        if not again:
            self.factorise()
        self.solve(self._force, self._change)
        self._known = False

    def move(self, step: float) -> None:
        """Go to origin − step × change."""
        self._known = False
        self.state.vec.data = self._origin
        if step != 0.0:  # 0 × NaN is NaN, and this is the way back
            self.state.vec.data -= step * self._change

    def remember(self) -> Any:
        """Copy the current state."""
        kept = self.state.vec.CreateVector()
        kept.data = self.state.vec
        return kept

    def recall(self, kept: Any) -> None:
        """Go back to a remembered state."""
        self._known = False
        self.state.vec.data = kept

    def factorise(self) -> None:
        """Assemble the tangent at the current state and factorise its condensed part.

        The pattern of the matrix stays, so it is analysed once.
        """
        try:
            self.form.AssembleLinearization(self.state.vec)
            if self._inverse is None:
                self._inverse = self.form.mat.Inverse(self._coupling, inverse="umfpack")
            else:
                self._inverse.Update()
        except Exception as problem:  # the engine's own kinds have no public name
            raise SingularTangent from problem

    def solve(self, rhs: Any, into: Any) -> None:
        """Solve tangent × into = rhs, element interiors included; overwrites `rhs`."""
        form = self.form
        rhs.data += form.harmonic_extension_trans * rhs
        into.data = self._inverse * rhs
        into.data += form.harmonic_extension * into
        into.data += form.inner_solve * rhs


class Bordered(Plain):
    """A form with some scalar unknowns more (`values`) and as many conditions, all to vanish.

    The scalars enter the form through `apply`, e.g. by moving mesh nodes, which says whether they
    are possible, and `conditions` reads the state. What either gives to the tangent is a difference
    quotient, so each Newton step costs one factorisation, and one solve more for each scalar. A
    step changes no scalar by more than the share `MOST` of its `scale`.
    """

    def __init__(
        self,
        form: Any,
        state: Any,
        free: Any,
        *,
        values: Float[np.ndarray, " scalars"],
        scale: Float[np.ndarray, " scalars"],
        apply: Callable[[Float[np.ndarray, " scalars"]], bool],
        conditions: Callable[[], Float[np.ndarray, " scalars"]],
    ) -> None:
        super().__init__(form, state, free)
        self.values, self._scale, self._apply, self._conditions = values, scale, apply, conditions
        self._columns = [state.vec.CreateVector() for _ in values]
        self._shifted = state.vec.CreateVector()
        self._possible = apply(values)

    def remember(self) -> Any:
        """Copy the current state and the scalars."""
        return super().remember(), self.values

    def recall(self, kept: Any) -> None:
        """Go back to a remembered state and scalars."""
        state, self.values = kept
        super().recall(state)
        self._possible = self._apply(self.values)

    def residual(self) -> float:
        """Norm of the residual and the conditions together; infinite where it is impossible."""
        if not self._possible:
            return math.inf
        self._missed = self._conditions()
        # Of huge numbers the norm is still a number, so that a step there is only refused.
        return math.hypot(super().residual(), *self._missed.tolist())

    def direction(self, *, again: bool = False) -> None:
        """Solve the bordered system by block elimination."""
        self._origin_values = self.values
        if not again:
            if not self._known:
                self.residual()
            partial = self._by_values()
        super().direction(again=again)
        missed = self._missed - self._along(self._change)
        if not again:
            for column in self._columns:
                self._shifted.data = column
                self.solve(self._shifted, column)
            by_state = [self._along(column) for column in self._columns]
            self._schur = np.column_stack(by_state) - partial
        try:
            self._rates = np.linalg.solve(self._schur, missed)
        except np.linalg.LinAlgError as problem:
            raise SingularTangent from problem
        if not np.all(np.isfinite(self._rates)):
            raise SingularTangent

    def move(self, step: float) -> None:
        """Go to origin + step × direction."""
        farthest = np.abs(step * self._rates / self._scale).max() / MOST
        if farthest > 1.0:
            step /= farthest
        super().move(step)
        self.values = self._origin_values + step * self._rates
        self._possible = self._apply(self.values)
        if step == 0.0:
            return
        for rate, column in zip(self._rates, self._columns, strict=True):
            self.state.vec.data -= step * rate * column

    def _by_values(self) -> Float[np.ndarray, "scalars scalars"]:
        """Slopes of the residual, into the columns, and of the conditions, by the scalars."""
        slopes = []
        for k, column in enumerate(self._columns):
            increment = DIFFERENCE * self._scale[k]
            moved = self.values.copy()
            moved[k] += increment
            self._apply(moved)
            self.evaluate(column)
            column.data = (1.0 / increment) * (column - self._force)
            slopes.append((self._conditions() - self._missed) / increment)
        self._apply(self.values)
        return np.column_stack(slopes)

    def _along(self, way: Any) -> Float[np.ndarray, " scalars"]:
        """Slope of the conditions along a change of the state."""
        length = float(ng.Norm(way))
        if length == 0.0:
            return np.zeros_like(self._missed)
        increment = DIFFERENCE * max(float(ng.Norm(self._origin)), 1.0) / length
        self.state.vec.data = self._origin + increment * way
        slope = (self._conditions() - self._missed) / increment
        self.state.vec.data = self._origin
        return slope
