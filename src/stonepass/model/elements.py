"""What the models ask of the finite elements, so that it may be remembered, not solved again."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Protocol, runtime_checkable

from stonepass.model.case import Case
from stonepass.model.opening import Pairs

if TYPE_CHECKING:  # each loads the finite elements
    from stonepass.fe.problem import Resolution
    from stonepass.model.push_through import Critical, NoPush
    from stonepass.model.seated import NoSeat, SeatedState

__all__ = ["Elements"]


@runtime_checkable
class Elements(Protocol):
    """A source of finite-element results: `model.afresh` solves, `studies.store` remembers."""

    def seat(self, case: Case, resolution: Resolution | None) -> SeatedState | NoSeat:
        """See `model.seated.seat`."""

    def push(
        self, case: Case, resolutions: Sequence[Resolution], *, leak: bool
    ) -> list[Critical | NoPush]:
        """See `model.push_through.critical_push`."""

    def pairs(self, case: Case) -> Pairs | None:
        """See `model.direct_pairs.opening_pairs`."""
