"""Finite-element results, solved every time."""

from __future__ import annotations

from collections.abc import Sequence

from stonepass.fe.axisymmetric.problem import Resolution
from stonepass.model.case import Case
from stonepass.model.opening_curve import Pairs
from stonepass.model.states.loaded import Critical, NoPush, critical_push
from stonepass.model.states.opening import opening_pairs
from stonepass.model.states.seated import NoSeat, SeatedState, seat
from stonepass.model.states.state_solver import Elements

__all__ = ["AFRESH"]


class _Afresh:
    def seat(self, case: Case, resolution: Resolution | None) -> SeatedState | NoSeat:
        return seat(case, resolution)

    def push(
        self, case: Case, resolutions: Sequence[Resolution], *, leak: bool
    ) -> list[Critical | NoPush]:
        return critical_push(case, resolutions, leak=leak)

    def pairs(self, case: Case) -> Pairs | None:
        return opening_pairs(case)


AFRESH: Elements = _Afresh()
