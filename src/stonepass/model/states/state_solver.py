"""The contract of whoever finds finite-element states: solved afresh, or remembered."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol, runtime_checkable

from stonepass.fe.axisymmetric.problem import Resolution
from stonepass.model.numerics import Numerics
from stonepass.model.opening_curve import OpeningCurve
from stonepass.model.problem import Problem
from stonepass.model.seating import Seating
from stonepass.model.states.loaded_state import Critical, NoPush
from stonepass.model.states.seated_state import NoSeat, SeatedState

__all__ = ["StateSolver"]


@runtime_checkable
class StateSolver(Protocol):
    """A source of finite-element states.

    `uncached.UNCACHED` solves each time, `studies.solution_cache` remembers. Whoever
    implements it must return what the functions named below return for the same arguments, to the
    bit, and must not keep anything that a caller could change.
    """

    def seat(
        self,
        case: Problem,
        seating: Seating,
        numerics: Numerics,
        resolution: Resolution | None = None,
    ) -> SeatedState | NoSeat:
        """See `model.states.seated.solve_seated`."""

    def push(
        self,
        case: Problem,
        numerics: Numerics,
        resolutions: Sequence[Resolution],
        *,
        wetted: bool,
        leak: bool,
    ) -> list[Critical | NoPush]:
        """See `model.states.loaded.find_critical`."""

    def opening_curve(self, case: Problem, numerics: Numerics) -> OpeningCurve | None:
        """See `model.states.opening.solve_opening_curve`."""
