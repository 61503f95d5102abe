"""What the models ask of the finite elements, so that it may be remembered, not solved again."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Protocol, runtime_checkable

from stonepass.model.case import Case
from stonepass.model.opening_curve import OpeningCurve

if TYPE_CHECKING:  # each loads the finite elements
    from stonepass.fe.axisymmetric.problem import Resolution
    from stonepass.model.states.loaded import Critical, NoPush
    from stonepass.model.states.seated import NoSeat, SeatedState

__all__ = ["StateSolver"]


@runtime_checkable
class StateSolver(Protocol):
    """A source of finite-element results: `uncached` solves, `studies.solution_cache` remembers."""

    def seat(self, case: Case, resolution: Resolution | None) -> SeatedState | NoSeat:
        """See `model.states.seated.seat`."""

    def push(
        self, case: Case, resolutions: Sequence[Resolution], *, leak: bool
    ) -> list[Critical | NoPush]:
        """See `model.states.loaded.critical_push`."""

    def pairs(self, case: Case) -> OpeningCurve | None:
        """See `model.states.opening.solve_opening_curve`."""
