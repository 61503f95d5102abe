"""A source of finite-element states that solves at each call and stores nothing.

NGSolve is not thread-safe, so only one thread of a process solves at a time while the others wait.
To solve many cases in parallel, use several processes (`studies.executor.process_pool`).
"""

from __future__ import annotations

from collections.abc import Sequence
from threading import RLock

from stonepass.fe.axisymmetric.problem import Resolution
from stonepass.model.numerics import Numerics
from stonepass.model.opening_curve import OpeningCurve
from stonepass.model.problem import Problem
from stonepass.model.seating import Seating
from stonepass.model.states.loaded_state import Critical, NoPush, PushedState
from stonepass.model.states.seated_state import NoSeat, SeatedState
from stonepass.model.states.state_solver import StateSolver
from stonepass.units import Pressure

__all__ = ["UNCACHED"]


_ENGINE = RLock()


class _Uncached:
    """A `StateSolver` that solves at each call; NGSolve is imported at the first call."""

    def seat(
        self,
        case: Problem,
        seating: Seating,
        numerics: Numerics,
        resolution: Resolution | None = None,
    ) -> SeatedState | NoSeat:
        """See `StateSolver.seat`."""
        with _ENGINE:
            from stonepass.model.states.seated import solve_seated

            return solve_seated(case, seating, numerics, resolution)

    def push(
        self,
        case: Problem,
        numerics: Numerics,
        resolutions: Sequence[Resolution],
        *,
        wetted: bool,
        leak: bool,
    ) -> list[Critical | NoPush]:
        """See `StateSolver.push`."""
        with _ENGINE:
            from stonepass.model.states.loaded import find_critical

            return find_critical(case, numerics, resolutions, wetted=wetted, leak=leak)

    def hold(
        self,
        case: Problem,
        numerics: Numerics,
        pressures: Sequence[Pressure],
        resolution: Resolution,
        *,
        wetted: bool,
    ) -> list[PushedState | NoPush]:
        """See `StateSolver.hold`."""
        with _ENGINE:
            from stonepass.model.states.loaded import solve_loaded

            return solve_loaded(case, numerics, pressures, resolution, wetted=wetted)

    def opening_curve(self, case: Problem, numerics: Numerics) -> OpeningCurve | None:
        """See `StateSolver.opening_curve`."""
        with _ENGINE:
            from stonepass.model.states.opening import solve_opening_curve

            return solve_opening_curve(case, numerics)


UNCACHED: StateSolver = _Uncached()
