"""Another program's contact beside our own, in the numbers that matter."""

from __future__ import annotations

from dataclasses import dataclass

from stonepass.errors import require
from stonepass.model.answer import Answer
from stonepass.model.case import Case
from stonepass.model.critical import solve
from stonepass.model.models.seated_balance import balance_pressure
from stonepass.model.states.seated_state import Contact, SeatedState

__all__ = ["Comparison", "compare"]


@dataclass(frozen=True)
class Comparison:
    """One case, solved here and elsewhere.

    Attributes
    ----------
    answer : Answer
        Ours.
    seated : SeatedState
        The contact behind it.
    contact : Contact
        The other program's.
    pressure : float or None
        P_ucr in Pa by the paper's balance and closure with the other contact; None where the forces
        do not balance.
    """

    answer: Answer
    seated: SeatedState
    contact: Contact
    pressure: float | None


def compare(case: Case, contact: Contact) -> Comparison | Answer:
    """Solve the case and put the other contact beside it; the answer alone where none is seated."""
    require(case.method.closure == "linear", "closure", case.method.closure,
            "'linear' beside another program's contact")  # fmt: skip
    answer = solve(case)
    if answer.seated is None:
        return answer
    return Comparison(answer, answer.seated, contact, balance_pressure(contact))
