"""What a question about one case comes to, and the contract of the models that answer it."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import ClassVar, Protocol, runtime_checkable

from stonepass.array_dataclass import array_dataclass
from stonepass.caution import Caution
from stonepass.errors import Outcome
from stonepass.fe.axisymmetric.problem import Resolution
from stonepass.model.accuracy import ErrorEstimate
from stonepass.model.contact_state import ContactState
from stonepass.model.numerics import Numerics
from stonepass.model.problem import Problem
from stonepass.model.states.state_solver import StateSolver
from stonepass.result import Result
from stonepass.units import PASCAL_PER

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


@array_dataclass
@dataclass(frozen=True, repr=False)
class Answer(Result):
    """The critical pressure of one case, or why there is none.

    Two answers are equal where all their numbers are; the time that they took does not count.

    Attributes
    ----------
    case : Problem
        The stone, the ureter and the load.
    model : Model
        The model that answered.
    numerics : Numerics
        Accuracy and length of the tube.
    outcome : Outcome
        How the question ended; `outcome.answered` is False where there is no answer.
    reason : str
        Why there is no answer; empty where there is one.
    pressure : float or None
        Critical urine pressure P_ucr in Pa; None where there is none, 0 for a loose stone.
    critical_angle : float or None
        α_cr in rad, the contact angle at which the stone starts to move.
    contact : ContactState or None
        Where stone and wall touch: the seated state of the paper's model, the loaded state of the
        direct model in which the stone starts to move (or the last one before urine passes), or the
        contact of sphere and beam.
    detail : Detail or None
        The numbers that only this model knows.
    error : ErrorEstimate or None
        Estimated discretisation error of α₀ (in the direct model, of the upstream edge of the
        contact), σ(π/2) and P_ucr; None where there is no state or no second solve could be made.
    newton_steps : int
        Newton steps of all finite-element solves, also of those that failed.
    seconds : float
        Wall-clock time of the solves in s.
    warnings : tuple of Caution
        Where the answer must be read with care; ``str`` of one is its sentence.

    Examples
    --------
    >>> import stonepass as sp
    >>> sp.critical_pressure(sp.Stone(size_ratio=0.9), sp.Ureter(wall_ratio=1.5))
    <Answer: LOOSE, P_ucr 0 kPa; ξ 0.9, η 1.5, ureter, friction 0.5, model paper>
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
    seconds: float = field(default=0.0, compare=False)
    warnings: tuple[Caution, ...] = ()

    def summary(self) -> str:
        """Return outcome, pressure and case in one line."""
        return f"{self.outcome.name}{self._pressure_in_words()}; {self._case_in_words()}"

    def _pressure_in_words(self) -> str:
        if self.pressure is None:
            return ""
        error = None if self.error is None else self.error.critical_pressure
        shown = f", P_ucr {self.pressure / 1e3:.4g}"
        return f"{shown} kPa" if error is None else f"{shown} ± {error / 1e3:.1g} kPa"

    def _case_in_words(self) -> str:
        case = self.case
        return (
            f"ξ {case.size_ratio:.4g}, η {case.wall_ratio:.4g}, {case.ureter.material.name}, "
            f"friction {case.stone.friction:g}, model {self.model.NAME}"
        )

    @property
    def pressure_kPa(self) -> float | None:
        """P_ucr in kPa; None where there is none."""
        return self._pressure_in("kPa")

    @property
    def pressure_mmHg(self) -> float | None:
        """P_ucr in mmHg; None where there is none."""
        return self._pressure_in("mmHg")

    @property
    def pressure_cmH2O(self) -> float | None:
        """P_ucr in cmH₂O; None where there is none."""
        return self._pressure_in("cmH2O")

    def _pressure_in(self, unit: str) -> float | None:
        return None if self.pressure is None else self.pressure / PASCAL_PER[unit]

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
