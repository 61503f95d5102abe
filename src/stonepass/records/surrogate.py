"""The record of one answer of a surrogate."""

from __future__ import annotations

from pydantic import Field

from stonepass.records.base import PartRecord
from stonepass.studies.surrogates.answers import SurrogateAnswers

__all__ = ["SurrogateAnswerRecord", "surrogate_records"]


class SurrogateAnswerRecord(PartRecord):
    """The answer of a surrogate for one condition."""

    size_ratio: float = Field(description="ξ, stone diameter divided by inner diameter")
    wall_ratio: float = Field(description="η, outer diameter divided by inner diameter")
    friction: float = Field(description="μ_f, friction coefficient")
    confining_pressure_kPa: float = Field(description="P_out, pressure on the outer wall")
    stiffness: float = Field(description="stiffness of the wall relative to the material")
    outcome: str = Field(description="outcome of the calculation (glossary: outcomes)")
    outside: bool = Field(description="whether the surrogate does not cover the condition")
    critical_pressure_kPa: float | None = Field(description="critical urine pressure P_ucr")
    critical_pressure_error_kPa: float | None = Field(
        description="claimed error (±) of `critical_pressure_kPa` relative to the model"
    )
    lower_bound_kPa: float = Field(
        description=(
            "pressure that P_ucr exceeds: the end of the closure for BEYOND_CLOSURE, or the "
            "largest pressure of a surrogate of the direct model; otherwise 0"
        )
    )
    contact_angle_deg: float | None = Field(description="angle at which the contact begins")
    leak_pressure_kPa: float | None = Field(
        None, description="direct model: urine pressure at which urine passes the stone"
    )
    friction_work_kPa: float | None = Field(
        None, description="direct model: dissipation D at P_ucr, divided by π R_s²"
    )
    opened_radius: float | None = Field(
        None, description="direct model: r_a/R_a of the tube under P_ucr, far from the stone"
    )


def surrogate_records(answers: SurrogateAnswers) -> list[SurrogateAnswerRecord]:
    """Make the records of the answers of a surrogate."""
    return [SurrogateAnswerRecord.model_validate(row) for row in answers.to_rows()]
