"""What a question about one case comes to, and the contract of the models that answer it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar, Protocol, runtime_checkable

from stonepass.caution import Caution
from stonepass.errors import Outcome
from stonepass.fe.axisymmetric.problem import Resolution
from stonepass.model.accuracy import ErrorEstimate
from stonepass.model.contact_state import ContactState
from stonepass.model.numerics import Numerics
from stonepass.model.problem import Problem
from stonepass.model.states.state_solver import StateSolver

__all__ = ["Answer", "Detail", "Model", "Quantity", "unanswered"]


@dataclass(frozen=True)
class Quantity:
    """A number that only one model knows, as tables and records show it.

    Attributes
    ----------
    key : str
        Its name in records, without the unit.
    value : float or tuple of float or None
        In `unit`; None where there is none.
    unit : str
        ``kPa``, ``Pa`` or ``deg``, which records append to the key; ``R_a``; or empty.
    title : str
        Its name in tables; a quantity without a title is not shown there.
    """

    key: str
    value: float | tuple[float, ...] | None
    unit: str = ""
    title: str = ""

    @property
    def name(self) -> str:
        """Its name in records."""
        return f"{self.key}_{self.unit}" if self.unit in ("kPa", "Pa", "deg") else self.key


@runtime_checkable
class Detail(Protocol):
    """What only one model knows beside the answer."""

    def quantities(self) -> tuple[Quantity, ...]:
        """Its numbers, in the order of tables."""


@runtime_checkable
class Model(Protocol):
    """A model that finds the critical pressure of a stuck stone.

    A model is a frozen dataclass: its fields are its options, each declared as an input (see
    `stonepass.declaration`) with ``SECTION = "method"``, so that the command line, case files and
    the documentation offer them. It is registered by its name in `model.models.registry`.

    Attributes
    ----------
    NAME : str
        The word at the doors (``--model NAME``).
    MEANING : str
        What the model is, in a few words for the help.
    NEEDS_ELEMENTS : bool
        Whether its answers are finite-element solutions, which do not resolve an oversize below
        1e-4 of the lumen.
    """

    NAME: ClassVar[str]
    MEANING: ClassVar[str]
    NEEDS_ELEMENTS: ClassVar[bool]

    @property
    def far_field_ground(self) -> bool:
        """Whether the far field contains the ground matrix of the law."""

    def require_any_size(self) -> None:
        """Refuse a case whose size varies where an option belongs to one stone (`BadInput`)."""

    def largest_size(self, case: Problem) -> float:
        """The largest size ratio that the model is used for (the search of a critical size)."""

    def solve(
        self,
        case: Problem,
        numerics: Numerics,
        states: StateSolver,
        resolution: Resolution | None = None,
    ) -> Answer:
        """Answer a stone that is larger than the lumen.

        Parameters
        ----------
        case : Problem
            Its stone exceeds the lumen that the load leaves open.
        numerics : Numerics
        states : StateSolver
            Where finite-element states come from.
        resolution : Resolution, optional
            Solve on this mesh alone, without an estimate of the error; by default both meshes of
            the accuracy are solved.

        Returns
        -------
        Answer
            Every way the physics can end is an `Outcome`.

        Raises
        ------
        BadInput
            The case lies outside what the model is for.
        """


@dataclass(frozen=True)
class Answer:
    """The critical pressure of one case, or why there is none.

    Attributes
    ----------
    case : Problem
    model : Model
    numerics : Numerics
    outcome : Outcome
    reason : str
        Why there is no answer; empty where there is one.
    pressure : float or None
        Critical urine pressure P_ucr in Pa.
    critical_angle : float or None
        α_cr in rad, the contact angle at which the stone starts to move.
    contact : ContactState or None
        Where stone and wall touch: the seated state of the paper's model, the loaded state in which
        the stone starts to move (or the last one before urine passes) of the direct model, or the
        contact of sphere and beam.
    detail : Detail or None
        What only this model knows, in a record of its own file.
    error : ErrorEstimate or None
        Estimated discretisation error of α₀ (in the direct model of the contact's upstream edge),
        σ(π/2) and P_ucr; None where there is no state or no second solve could be made.
    newton_steps, seconds : int, float
        Work of the finite elements, also where they failed.
    warnings : tuple of Caution
        Where the answer leaves what its parts are known for; ``str`` of one is its sentence.
    """

    case: Problem
    model: Model
    numerics: Numerics
    outcome: Outcome
    reason: str = ""
    pressure: float | None = None
    critical_angle: float | None = None
    contact: ContactState | None = None
    detail: Detail | None = None
    error: ErrorEstimate | None = None
    newton_steps: int = 0
    seconds: float = 0.0
    warnings: tuple[Caution, ...] = ()

    @property
    def message(self) -> str:
        """The outcome as a sentence, with the reason where there is one."""
        return self.outcome.sentence(self.reason)

    @property
    def closure_end_pressure(self) -> float | None:
        """P_u in Pa at which a closure ends (r_a = R_s); None in models without one."""
        found: float | None = getattr(self.detail, "closure_end_pressure", None)
        return found

    def without_wall(self) -> Answer:
        """Return the same answer without the stress field, which is most of its size."""
        return self if self.contact is None else replace(self, contact=self.contact.without_wall())


def unanswered(
    case: Problem,
    model: Model,
    numerics: Numerics,
    reason: str,
    *,
    steps: int = 0,
    seconds: float = 0.0,
) -> Answer:
    """Make the answer of a case for which no equilibrium was found, with the reason."""
    return Answer(
        case,
        model,
        numerics,
        Outcome.NO_SOLUTION,
        reason,
        newton_steps=steps,
        seconds=seconds,
    )
