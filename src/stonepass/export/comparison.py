"""The contact that another program found, beside the contact of our own seated state."""

from __future__ import annotations

from dataclasses import dataclass

from stonepass.errors import require
from stonepass.model.answer import Answer
from stonepass.model.case import Case
from stonepass.model.critical import solve
from stonepass.model.models.seated_balance import (
    SeatedBalance,
    SeatedBalanceDetail,
    balance_pressure,
)
from stonepass.model.states.seated_state import Contact, SeatedState

__all__ = ["Comparison", "compare"]


@dataclass(frozen=True)
class Comparison:
    """One case, solved here and by another program.

    Attributes
    ----------
    answer : Answer
        Our answer.
    seated : SeatedState
        The seated state of our answer.
    contact : Contact
        The contact that the other program found.
    pressure : float or None
        P_ucr in Pa by the paper's balance and closure with the other contact; None where the forces
        do not balance.
    """

    answer: Answer
    seated: SeatedState
    contact: Contact
    pressure: float | None


def compare(case: Case, contact: Contact) -> Comparison | Answer:
    """Solve a case and put the contact of another program beside it.

    Parameters
    ----------
    case : Case
        A case with the linear closure.
    contact : Contact
        As `read_contact` returns it for the same case.

    Returns
    -------
    Comparison or Answer
        The answer alone where it has no seated state.

    Raises
    ------
    BadInput
        The closure is not linear.
    """
    model = case.model
    closure = model.closure if isinstance(model, SeatedBalance) else f"that of '{model.NAME}'"
    require(closure == "linear", "closure", closure, "'linear' beside another program's contact")
    answer = solve(case)
    seated, detail = answer.contact, answer.detail
    if not isinstance(seated, SeatedState) or not isinstance(detail, SeatedBalanceDetail):
        return answer
    printed = isinstance(model, SeatedBalance) and model.as_printed
    pressure = balance_pressure(contact, detail.closure, as_printed=printed)
    return Comparison(answer, seated, contact, pressure)
