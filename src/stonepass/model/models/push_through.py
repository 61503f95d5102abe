"""The direct model: finite-element solution of the push-through, without a closure.

See "The push-through, solved directly" in docs/theory.md.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import ClassVar

from stonepass.caution import caution
from stonepass.declaration import Kind, check_inputs, declared, described
from stonepass.errors import Outcome
from stonepass.fe.axisymmetric.problem import Resolution
from stonepass.model.accuracy import AccuracyLevel, ErrorEstimate
from stonepass.model.answer import Answer, NamedQuantity, unanswered
from stonepass.model.models.shared_options import far_field_ground
from stonepass.model.numerics import Numerics
from stonepass.model.problem import Problem
from stonepass.model.states.loaded_state import Critical, NoPush, PushedState
from stonepass.model.states.state_solver import StateSolver
from stonepass.model.validity import law_cautions, ring_buckling, strain_range

__all__ = ["PushThrough", "PushThroughDetail"]

# Hint for a case that has a solution on a coarser mesh only.
COARSER = "; there is a state on a coarser mesh, so the accuracy 'fast' may have an answer"


@dataclass(frozen=True)
class PushThrough:
    """The direct model: wall and held stone are solved under the urine pressure.

    The critical pressure is the urine pressure at which the axial force on the held stone vanishes.
    See "The push-through, solved directly" in docs/theory.md.

    Parameters
    ----------
    wetted : bool
        True if urine enters the contact between its upstream edge and the seal, the place of the
        largest contact pressure. There friction then acts on the contact pressure minus the urine
        pressure. False for a dry contact.
    far_field_ground : bool
        True if the far field of an assessment includes the ground matrix of the law. The
        push-through solution always includes it.
    """

    SECTION: ClassVar[str] = "method"
    NAME: ClassVar[str] = "direct"
    MEANING: ClassVar[str] = "finite elements of wall and stone under the urine pressure"
    NEEDS_ELEMENTS: ClassVar[bool] = True

    wetted: bool = declared(
        Kind.FLAG,
        "--wetted/--dry",
        "Let urine enter the contact up to the seal, which reduces friction; otherwise the contact "
        "stays dry.",
        default=False,
        shown_default="dry",
    )
    far_field_ground: bool = far_field_ground()

    __repr__ = described

    def __post_init__(self) -> None:
        check_inputs(self)

    def require_any_size(self) -> None:
        """Do nothing: no option of this model restricts it to one stone."""

    def largest_size(self, case: Problem) -> float:
        """Return the upper end of the material's strain range as the largest size ratio."""
        return case.ureter.material.strain_range[1]

    def solve(
        self,
        case: Problem,
        numerics: Numerics,
        states: StateSolver,
        resolution: Resolution | None = None,
    ) -> Answer:
        """Find the urine pressure at which the axial force on the stone vanishes.

        For the parameters and exceptions see `Model.solve`.
        """
        level = numerics.level
        wanted = (level.companion, level.resolution) if resolution is None else (resolution,)
        *coarser, found = states.push(
            case, numerics, wanted, wetted=self.wetted, leak=resolution is None
        )
        if isinstance(found, NoPush):
            on_coarser = any(isinstance(each, Critical) for each in coarser)
            hint = COARSER if on_coarser and numerics.accuracy != "fast" else ""
            return unanswered(case, self, numerics, found.reason + hint, steps=found.newton_steps,
                              seconds=found.seconds)  # fmt: skip
        coarse = coarser[0] if coarser and isinstance(coarser[0], Critical) else None
        state = found.state
        undecided = coarse is not None and coarse.leaks != found.leaks
        leak = found.leak_pressure if coarse is None else coarse.leak_pressure
        answer = Answer(
            case,
            self,
            numerics,
            Outcome.LEAKS if found.leaks else Outcome.MOVES,
            contact=state,
            detail=PushThroughDetail(leak, state.seal_angle),
            newton_steps=sum(each.newton_steps for each in (*coarser, found)),
            seconds=found.seconds,
            warnings=(
                *case.stone.shape.warnings(),
                *law_cautions(case.ureter.material),
                *strain_range(case),
                *ring_buckling(case),
                *state.warnings(),
                *([caution("leak_undecided")] if undecided else []),
            ),
        )
        if not found.leaks:
            # Without friction the exact result is 0; the computed root differs by rounding only.
            pressure = 0.0 if case.stone.friction == 0.0 else state.urine_pressure
            answer = replace(answer, pressure=pressure, critical_angle=state.contact_angle)
        if coarse is None or undecided:
            return answer
        return replace(answer, error=_error(level, coarse.state, state, answer.pressure))


@dataclass(frozen=True)
class PushThroughDetail:
    """Additional results of the direct model.

    Attributes
    ----------
    leak_pressure : float or None
        Urine pressure in Pa at which urine passes the held stone; None if it was not computed or
        not found.
    seal_angle : float
        Angle θ in rad of the largest contact pressure, which holds back the urine.
    """

    leak_pressure: float | None
    seal_angle: float

    def quantities(self) -> tuple[NamedQuantity, ...]:
        """Return leak pressure and angle of the seal."""
        leak = None if self.leak_pressure is None else self.leak_pressure / 1e3
        return (
            NamedQuantity("leak_pressure", leak, "kPa", "leak pressure"),
            NamedQuantity("seal_angle", math.degrees(self.seal_angle), "deg", "seal"),
        )


def _error(
    level: AccuracyLevel, coarse: PushedState, fine: PushedState, pressure: float | None
) -> ErrorEstimate:
    width = fine.downstream_angle - fine.contact_angle
    equator = fine.equator_contact_pressure
    return ErrorEstimate(
        contact_angle=level.contact_claim(coarse.contact_angle - fine.contact_angle, width),
        equator_contact_pressure=level.contact_claim(
            coarse.equator_contact_pressure - equator, equator
        ),
        critical_pressure=(
            None
            if pressure is None
            else level.pressure_claim(coarse.urine_pressure - pressure, pressure)
        ),
    )
