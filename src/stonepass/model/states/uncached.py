"""Finite-element results, solved every time."""

from __future__ import annotations

from collections.abc import Sequence

from stonepass.fe.axisymmetric.problem import Resolution
from stonepass.model.case import Case
from stonepass.model.opening_curve import OpeningCurve
from stonepass.model.states.loaded import Critical, NoPush, critical_push
from stonepass.model.states.opening import solve_opening_curve
from stonepass.model.states.seated import NoSeat, SeatedState, seat
from stonepass.model.states.state_solver import StateSolver

__all__ = ["UNCACHED"]


class _Uncached:
    def seat(self, case: Case, resolution: Resolution | None) -> SeatedState | NoSeat:
        return seat(case, resolution)

    def push(
        self, case: Case, resolutions: Sequence[Resolution], *, leak: bool
    ) -> list[Critical | NoPush]:
        return critical_push(case, resolutions, leak=leak)

    def pairs(self, case: Case) -> OpeningCurve | None:
        return solve_opening_curve(case)


UNCACHED: StateSolver = _Uncached()
