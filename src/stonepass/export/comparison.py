"""Comparison of the contact computed by another program with that of stonepass."""

from __future__ import annotations

from dataclasses import dataclass

from stonepass.errors import require
from stonepass.model.answer import Answer
from stonepass.model.case import Case
from stonepass.model.critical import solve
from stonepass.model.critical_state import balance_pressure
from stonepass.model.models.seated_balance import SeatedBalance, SeatedBalanceDetail
from stonepass.model.states.seated_state import Contact, SeatedState
from stonepass.model.states.state_solver import StateSolver
from stonepass.model.states.uncached import UNCACHED

__all__ = ["DeckComparison", "compare"]


@dataclass(frozen=True)
class DeckComparison:
    """One case, solved by stonepass and by another program.

    Attributes
    ----------
    answer : Answer
        Answer of stonepass.
    seated : SeatedState
        Seated state of this answer.
    contact : Contact
        Contact that the other program computed.
    pressure : float or None
        P_ucr in Pa by the paper's force balance and closure with the contact of the other program;
        None if the forces do not balance.

    References
    ----------
    docs/export.md, "CalculiX and back".
    """

    answer: Answer
    seated: SeatedState
    contact: Contact
    pressure: float | None


def compare(
    case: Case, contact: Contact, states: StateSolver = UNCACHED
) -> DeckComparison | Answer:
    """Solve a case and compare it with the contact that another program computed.

    Parameters
    ----------
    case : Case
        A case of the paper's model with the linear closure.
    contact : Contact
        Contact of the same case, e.g. from `results.read_contact`.
    states : StateSolver, optional
        Source of the finite-element states; by default they are solved.

    Returns
    -------
    Comparison or Answer
        Only the answer if it has no seated state.

    Raises
    ------
    BadInput
        The closure is not linear.
    """
    model = case.model
    closure = model.closure if isinstance(model, SeatedBalance) else f"that of '{model.NAME}'"
    require(closure == "linear", "closure", closure, "'linear' for a comparison of contacts")
    answer = solve(case, states=states)
    seated, detail = answer.contact, answer.detail
    if not isinstance(seated, SeatedState) or not isinstance(detail, SeatedBalanceDetail):
        return answer
    printed = isinstance(model, SeatedBalance) and model.as_printed
    pressure = balance_pressure(contact, detail.closure, as_printed=printed)
    return DeckComparison(answer, seated, contact, pressure)
