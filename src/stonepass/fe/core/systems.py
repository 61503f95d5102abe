"""Nonlinear systems for Newton's method: a form, and a form bordered by scalar unknowns."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import ngsolve as ng
import numpy as np

from stonepass.array_types import Float
from stonepass.fe.core.newton import SingularTangent

__all__ = ["BorderedSystem", "FormSystem"]

MOST = 0.3  # largest change of a scalar unknown in one step, as a fraction of its scale
DIFFERENCE = 1e-6  # increment of a difference quotient, as a fraction of the unknown's scale
ROUNDED = 2.0**-30  # relative change of the unknowns by which the effect of rounding is measured


class FormSystem:
    """The nonlinear system "residual of a finite-element form = 0" in the free unknowns.

    The object changes `state` in place and keeps the factorisation of the condensed tangent.

    Parameters
    ----------
    form : ngsolve.BilinearForm
        The nonlinear form, created with static condensation.
    state : ngsolve.GridFunction
        The current state.
    free : ngsolve.BitArray
        Mask of the unknowns that are solved for; the others keep their values.
    kink_width : ngsolve.Parameter, optional
        Width over which the form rounds kinks of its energy; zero outside of `factorise`.
    """

    def __init__(self, form: Any, state: Any, free: Any, kink_width: Any = None) -> None:
        self.form, self.state, self.free, self._kink_width = form, state, free, kink_width
        self._keep = ng.Projector(free, True)
        self._inverse: Any = None
        self._coupling = free & state.space.FreeDofs(True)
        self._force, self._change, self._origin = (state.vec.CreateVector() for _ in range(3))
        self._known = False  # true if `_force` is the residual at the current state

    def evaluate(self, into: Any) -> None:
        """Write the residual vector at the current state into `into`."""
        self.form.Apply(self.state.vec, into)
        self._keep.Project(into)

    def residual(self) -> float:
        """Return the norm of the residual at the current state."""
        self.evaluate(self._force)
        self._known = True
        return float(ng.Norm(self._force))

    def rounding(self) -> float:
        """Estimate the norm of the residual that is due to rounding of the unknowns.

        Every unknown is changed by the small fraction `ROUNDED` of itself, with random signs. The
        resulting change of the residual is scaled down to the relative precision of a
        floating-point number.
        """
        self.evaluate(self._force)
        kept = self.remember()
        unknowns = self.state.vec.FV().NumPy()
        signs = np.random.default_rng(0).choice((-ROUNDED, ROUNDED), unknowns.size)
        unknowns *= 1.0 + signs
        self.evaluate(self._change)
        self._change.data -= self._force
        self.recall(kept)
        return float(ng.Norm(self._change)) * np.finfo(float).eps / ROUNDED

    def direction(self, *, again: bool = False, width: float = 0.0) -> None:
        """Compute the Newton direction; with `again`, reuse the last factorisation."""
        self._origin.data = self.state.vec
        if not self._known:
            self.evaluate(self._force)
        if not again:
            self.factorise(width)
        self.solve(self._force, self._change)
        self._known = False

    def move(self, step: float) -> None:
        """Set the state to origin − `step` × change, where change = tangent⁻¹ × residual."""
        self._known = False
        self.state.vec.data = self._origin
        if step != 0.0:  # step 0 restores the origin even where the change is NaN
            self.state.vec.data -= step * self._change

    def remember(self) -> Any:
        """Return a copy of the current state."""
        kept = self.state.vec.CreateVector()
        kept.data = self.state.vec
        return kept

    def recall(self, kept: Any) -> None:
        """Set the state to a copy that `remember` returned."""
        self._known = False
        self.state.vec.data = kept

    def factorise(self, width: float = 0.0) -> None:
        """Assemble the tangent at the current state and factorise its condensed part.

        The sparsity pattern never changes, so it is analysed only once.

        Parameters
        ----------
        width : float
            Width over which kinks of the energy are rounded in the tangent, zero or positive.

        Raises
        ------
        SingularTangent
            The factorisation failed.
        """
        try:
            self._linearise(width)
            if self._inverse is None:
                self._inverse = self.form.mat.Inverse(self._coupling, inverse="umfpack")
            else:
                self._inverse.Update()
        except Exception as problem:  # NGSolve's exception types have no public names
            raise SingularTangent from problem

    def _linearise(self, width: float) -> None:
        if width == 0.0 or self._kink_width is None:
            self.form.AssembleLinearization(self.state.vec)
            return
        self._kink_width.Set(width)
        try:
            self.form.AssembleLinearization(self.state.vec)
        finally:
            self._kink_width.Set(0.0)

    def solve(self, rhs: Any, into: Any) -> None:
        """Solve tangent × `into` = `rhs`, including the condensed unknowns; overwrite `rhs`."""
        form = self.form
        rhs.data += form.harmonic_extension_trans * rhs
        into.data = self._inverse * rhs
        into.data += form.harmonic_extension * into
        into.data += form.inner_solve * rhs


class BorderedSystem(FormSystem):
    """A form with additional scalar unknowns and the same number of additional scalar equations.

    The derivatives with respect to the scalars are difference quotients, so a Newton step costs one
    factorisation and, for each scalar, one additional solve. No step changes a scalar by more than
    the fraction `MOST` of its scale.

    Parameters
    ----------
    form, state, free
        See `FormSystem`.
    values : array (scalars,)
        First guess of the scalar unknowns.
    scale : array (scalars,)
        Typical magnitudes of the scalar unknowns, positive, in their units.
    apply : callable
        ``apply(values)`` makes the form depend on the scalars, e.g. by moving mesh nodes. It
        returns False if the values are not admissible.
    conditions : callable
        ``conditions()`` returns the left-hand sides of the scalar equations at the current state,
        as an array (scalars,); they vanish at the solution.
    kink_width
        See `FormSystem`.
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
        kink_width: Any = None,
    ) -> None:
        super().__init__(form, state, free, kink_width)
        self.values, self._scale, self._apply, self._conditions = values, scale, apply, conditions
        self._columns = [state.vec.CreateVector() for _ in values]
        self._shifted = state.vec.CreateVector()
        self._possible = apply(values)

    def remember(self) -> Any:
        """Return copies of the current state and of the scalar unknowns."""
        return super().remember(), self.values

    def recall(self, kept: Any) -> None:
        """Set the state and the scalar unknowns to copies that `remember` returned."""
        state, self.values = kept
        super().recall(state)
        self._possible = self._apply(self.values)

    def residual(self) -> float:
        """Return the norm of residual and conditions; infinity if the scalars are inadmissible."""
        if not self._possible:
            return math.inf
        self._missed = self._conditions()
        # `math.hypot` does not overflow, so the line search also rejects a step to huge numbers.
        return math.hypot(super().residual(), *self._missed.tolist())

    def direction(self, *, again: bool = False, width: float = 0.0) -> None:
        """Compute the Newton direction of the bordered system by block elimination."""
        self._origin_values = self.values
        if not again:
            if not self._known:
                self.residual()
            partial = self._by_values()
        super().direction(again=again, width=width)
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
        """Set the state and the scalars to origin + `step` × direction, with a limited step."""
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
        """Differentiate with respect to the scalars.

        The derivatives of the residual are written into `_columns`; those of the conditions are
        returned.
        """
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
        """Return the directional derivative of the conditions for the change `way` of the state."""
        length = float(ng.Norm(way))
        if length == 0.0:
            return np.zeros_like(self._missed)
        if not math.isfinite(length):
            return np.full_like(self._missed, np.nan)
        increment = DIFFERENCE * max(float(ng.Norm(self._origin)), 1.0) / length
        self.state.vec.data = self._origin + increment * way
        slope = (self._conditions() - self._missed) / increment
        self.state.vec.data = self._origin
        return slope
