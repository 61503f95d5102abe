"""Finite-element results, solved every time."""

from __future__ import annotations

from collections.abc import Sequence

from stonepass.fe.problem import Resolution
from stonepass.model.case import Case
from stonepass.model.direct_pairs import opening_pairs
from stonepass.model.elements import Elements
from stonepass.model.opening import Pairs
from stonepass.model.push_through import Critical, NoPush, critical_push
from stonepass.model.seated import NoSeat, SeatedState, seat

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
