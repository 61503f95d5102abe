"""The answer to one case, and the interface of the models that compute it."""

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

__all__ = ["Answer", "Detail", "Model", "NamedQuantity", "unanswered"]


@dataclass(frozen=True)
class NamedQuantity:
    """A result that only one of the models has, for tables and records.

    Attributes
    ----------
    key : str
        Name of the quantity in records, without the unit.
    value : float or tuple of float or None
        Value in `unit`; None if it does not exist.
    unit : str
        Unit of the value. Records append ``kPa``, ``Pa`` or ``deg`` to the key. The unit is ``R_a``
        for a length in inner radii, and empty for a dimensionless number.
    title : str
        Name of the quantity in tables; tables leave out a quantity without a title.
    """

    key: str
    value: float | tuple[float, ...] | None
    unit: str = ""
    title: str = ""

    @property
    def name(self) -> str:
        """Name of the quantity in records, with the unit."""
        return f"{self.key}_{self.unit}" if self.unit in ("kPa", "Pa", "deg") else self.key


@runtime_checkable
class Detail(Protocol):
    """The additional results of one of the models."""

    def quantities(self) -> tuple[NamedQuantity, ...]:
        """Return the additional results in the order in which tables list them."""


@runtime_checkable
class Model(Protocol):
    """A model that computes the critical pressure of a stuck stone.

    A model is a frozen dataclass whose fields are its options. Each field is declared as an input
    (see `stonepass.declaration`), and the class has ``SECTION = "method"``, so that the command
    line, case files and the documentation offer the options. Models are registered by their names
    in `model.models.registry`.

    Attributes
    ----------
    NAME : str
        Name of the model on the command line (``--model NAME``), in case files and in records.
    MEANING : str
        Description of the model in a few words, for the help.
    NEEDS_ELEMENTS : bool
        True if the model uses finite elements. They cannot resolve a stone that exceeds the lumen
        by less than the fraction 1e-4.
    """

    NAME: ClassVar[str]
    MEANING: ClassVar[str]
    NEEDS_ELEMENTS: ClassVar[bool]

    @property
    def far_field_ground(self) -> bool:
        """True if the far field includes the ground matrix of the law."""

    def require_any_size(self) -> None:
        """Raise `Misplaced` if an option of the model is valid for a single stone size only.

        This method is called before the model is used for stones of other sizes.
        """

    def largest_size(self, case: Problem) -> float:
        """Return the largest size ratio at which a critical size is searched with this model."""

    def solve(
        self,
        case: Problem,
        numerics: Numerics,
        states: StateSolver,
        resolution: Resolution | None = None,
    ) -> Answer:
        """Compute the critical pressure of a stone that is larger than the lumen.

        Parameters
        ----------
        case : Problem
            The stone must be larger than the lumen of the loaded tube.
        numerics : Numerics
            Accuracy of the solution and length of the tube.
        states : StateSolver
            Source of the finite-element states.
        resolution : Resolution, optional
            Resolution of a single solve without an error estimate. By default both resolutions of
            the accuracy level are solved, and the error is estimated from their difference.

        Returns
        -------
        Answer
            If no critical pressure exists, its `outcome` and `reason` say why.

        Raises
        ------
        BadInput
            The model does not apply to this case, e.g. because of the shape of the stone.
        """


@array_dataclass
@dataclass(frozen=True, repr=False)
class Answer(Result):
    """The critical pressure of one case, or the reason why it does not exist.

    Two answers are equal if all their attributes except `seconds` are equal.

    Attributes
    ----------
    case : Problem
        Stone, ureter and load.
    model : Model
        The model that computed the answer.
    numerics : Numerics
        Accuracy of the solution and length of the tube.
    outcome : Outcome
        Outcome of the calculation; `outcome.answered` is False if there is no answer.
    reason : str
        Reason why there is no answer; empty if there is one.
    pressure : float or None
        Critical urine pressure P_ucr in Pa. It is 0 for a loose stone, and None if it does not
        exist.
    critical_angle : float or None
        Contact angle α_cr in rad at which the stone starts to move.
    contact : ContactState or None
        Contact of stone and wall. With the paper's model it is that of the seated state. With the
        direct model it is that of the loaded state in which the stone starts to move, or of the
        last state before urine passes the stone. With the beam model it is that of sphere and beam.
    detail : Detail or None
        Additional results that only this model has.
    error : ErrorEstimate or None
        Estimated discretisation errors of the contact angle, of σ(π/2) and of P_ucr. The contact
        angle is α₀, or the angle of the upstream contact edge in the direct model. None if there
        was no solve with a second resolution.
    newton_steps : int
        Number of Newton steps of all finite-element solves, including those that failed.
    seconds : float
        Wall-clock time of the solves in s.
    warnings : tuple of Caution
        Warnings about the answer; ``str(warning)`` returns the sentence of a warning.

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
        """P_ucr in kPa; None if it does not exist."""
        return self._pressure_in("kPa")

    @property
    def pressure_mmHg(self) -> float | None:
        """P_ucr in mmHg; None if it does not exist."""
        return self._pressure_in("mmHg")

    @property
    def pressure_cmH2O(self) -> float | None:
        """P_ucr in cmH₂O; None if it does not exist."""
        return self._pressure_in("cmH2O")

    def _pressure_in(self, unit: str) -> float | None:
        return None if self.pressure is None else self.pressure / PASCAL_PER[unit]

    @property
    def message(self) -> str:
        """The outcome as a sentence, which includes the reason if there is one."""
        return self.outcome.sentence(self.reason)

    @property
    def closure_end_pressure(self) -> float | None:
        """P_u in Pa at the end of the closure (r_a = R_s); None for a model without a closure."""
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
    """Return the answer to a case for which no equilibrium was found.

    Parameters
    ----------
    case, model, numerics
        See `Answer`.
    reason : str
        Reason why no equilibrium was found, as part of a sentence.
    steps : int
        Number of Newton steps.
    seconds : float
        Wall-clock time in s.
    """
    return Answer(
        case,
        model,
        numerics,
        Outcome.NO_SOLUTION,
        reason,
        newton_steps=steps,
        seconds=seconds,
    )
