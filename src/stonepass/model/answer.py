"""What a question about one case comes to, whichever model answers it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Protocol, runtime_checkable

import numpy as np
from jaxtyping import Float

from stonepass.errors import Outcome
from stonepass.model.case import Case

if TYPE_CHECKING:  # each loads the finite elements
    from stonepass.model.accuracy import ErrorEstimate
    from stonepass.model.closure import Series
    from stonepass.model.models.elastic_foundation import BeamState
    from stonepass.model.states.loaded import PushedState
    from stonepass.model.states.seated import SeatedState

__all__ = ["Answer", "ContactState", "unanswered"]


@runtime_checkable
class ContactState(Protocol):
    """Where stone and wall touch, and how hard: what every model's state can say."""

    @property
    def contact_angle(self) -> float:
        """θ in rad at which the contact begins."""

    @property
    def downstream_angle(self) -> float:
        """θ in rad at which it ends."""

    @property
    def equator_contact_pressure(self) -> float:
        """σ(π/2) in Pa."""

    @property
    def peak_contact_pressure(self) -> float:
        """Largest σ(θ) in Pa."""

    def pressure_at(self, theta: Float[np.ndarray, "*m"]) -> Float[np.ndarray, "*m"]:
        """Pressure on the stone in Pa at any θ in [0, π]."""


@dataclass(frozen=True)
class Answer:
    """The critical pressure of one case, or why there is none.

    Attributes
    ----------
    outcome : Outcome
    message : str
        Its sentence, with the cause where there is one.
    pressure : float or None
        Critical urine pressure P_ucr in Pa.
    critical_angle : float or None
        α_cr in rad, the contact angle at which the stone starts to move.
    closure_end_pressure : float or None
        P_u in Pa at which the closure ends (r_a = R_s), not a physical bound.
    seated : SeatedState or None
        Paper's model: the finite-element state behind it.
    pushed : PushedState or None
        Direct model: the loaded state in which the stone starts to move; where urine passes first,
        the last one before.
    series : Series or None
        Paper's model with ``closure="series"``: the closure that was fitted; `seated` has the case
        with the far field that turns it back to a pressure.
    beam : BeamState or None
        Beam model: the contact of sphere and beam.
    leak_pressure : float or None
        Direct model: urine pressure in Pa at which urine passes the held stone.
    error : ErrorEstimate or None
        Estimated discretisation error of α₀ (in the direct model of the contact's upstream edge),
        σ(π/2) and P_ucr; None where there is no state or no second solve could be made.
    newton_steps, seconds : int, float
        Work of the finite elements, also where they failed.
    warnings : tuple of str
        Where the answer leaves what its parts are known for.
    """

    case: Case
    outcome: Outcome
    message: str
    pressure: float | None = None
    critical_angle: float | None = None
    closure_end_pressure: float | None = None
    seated: SeatedState | None = None
    pushed: PushedState | None = None
    series: Series | None = None
    beam: BeamState | None = None
    leak_pressure: float | None = None
    error: ErrorEstimate | None = None
    newton_steps: int = 0
    seconds: float = 0.0
    warnings: tuple[str, ...] = ()

    def without_wall(self) -> Answer:
        """Return the same answer without the stress field, which is most of its size."""
        seated, pushed = self.seated, self.pushed
        return replace(
            self,
            seated=None if seated is None else replace(seated, wall=None),
            pushed=None if pushed is None else replace(pushed, wall=None),
        )

    @property
    def state(self) -> SeatedState | PushedState | None:
        """The finite-element state behind it, whichever model it is of."""
        return self.seated if self.pushed is None else self.pushed

    @property
    def touch(self) -> ContactState | None:
        """Where stone and wall touch, in whichever model."""
        return self.beam if self.state is None else self.state


def unanswered(
    case: Case, outcome: Outcome, reason: str, steps: int = 0, seconds: float = 0.0
) -> Answer:
    """Make the answer of a case that has none, with the reason."""
    message = f"{outcome.value[:-1]}: {reason}."
    return Answer(case, outcome, message, newton_steps=steps, seconds=seconds)
