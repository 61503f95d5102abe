"""The answer of one case as a record."""

from __future__ import annotations

from typing import Any

from pydantic import BaseModel, ConfigDict, Field

from stonepass.inputs.case_record import describe
from stonepass.model.answer import Answer
from stonepass.model.contact_state import SolvedState
from stonepass.records.base import CautionRecord, Record, degrees, kilo

__all__ = ["AnswerRecord", "SolverRecord", "answer_record"]


class SolverRecord(BaseModel):
    """What the finite elements did; null in a model without any."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    dofs: int | None = Field(description="unknowns of the last mesh")
    newton_steps: int | None = Field(description="Newton steps with a tangent of their own")
    seconds: float | None = Field(description="wall-clock time of all that was solved")
    residual: float | None = Field(description="residual relative to the contact force")


class AnswerRecord(Record):
    """The critical pressure of one case, or why there is none."""

    outcome: str = Field(description="how the question ended (glossary: outcomes)")
    message: str = Field(description="the outcome as a sentence")
    critical_pressure_kPa: float | None = Field(description="critical urine pressure P_ucr")
    critical_pressure_error_kPa: float | None = Field(
        description="estimated discretisation error of it"
    )
    critical_angle_deg: float | None = Field(
        description="contact angle at which the stone starts to move"
    )
    contact_angle_deg: float | None = Field(description="angle at which the contact begins")
    contact_angle_error_deg: float | None = Field(
        description="estimated discretisation error of it"
    )
    equator_contact_pressure_kPa: float | None = Field(description="contact pressure at θ = 90°")
    equator_contact_pressure_error_kPa: float | None = Field(
        description="estimated discretisation error of it"
    )
    peak_contact_pressure_kPa: float | None = Field(description="largest contact pressure")
    downstream_angle_deg: float | None = Field(description="angle at which the contact ends")
    stability_margin: float | None = Field(
        description="stiffness of the weakest shear band of the wall: 1 unloaded, 0 unstable"
    )
    detail: dict[str, float | list[float] | None] = Field(
        description="what only this model knows, by names that carry their unit"
    )
    size_ratio: float | None = Field(description="ξ, stone diameter over inner diameter")
    wall_ratio: float = Field(description="η, outer diameter over inner diameter")
    model: str = Field(description="name of the model")
    material: str = Field(description="name of the material")
    case: dict[str, Any] = Field(
        description="canonical record of the case: all that the answer depends on, in SI units"
    )
    solver: SolverRecord = Field(description="what the finite elements did")
    warnings: list[CautionRecord] = Field(description="where the answer must be read with care")


def answer_record(answer: Answer) -> AnswerRecord:
    """Make the record of an answer."""
    return AnswerRecord(**answer_fields(answer))


def answer_fields(answer: Answer) -> dict[str, Any]:
    """The fields of `AnswerRecord`, for records that have more of them."""
    case, error, contact = answer.case, answer.error, answer.contact
    solved = contact if isinstance(contact, SolvedState) else None
    quantities = () if answer.detail is None else answer.detail.quantities()
    return {
        "outcome": answer.outcome.name,
        "message": answer.message,
        "critical_pressure_kPa": kilo(answer.pressure),
        "critical_pressure_error_kPa": kilo(error.critical_pressure if error else None),
        "critical_angle_deg": degrees(answer.critical_angle),
        "contact_angle_deg": degrees(contact.contact_angle if contact else None),
        "contact_angle_error_deg": degrees(error.contact_angle if error else None),
        "equator_contact_pressure_kPa": kilo(contact.equator_contact_pressure if contact else None),
        "equator_contact_pressure_error_kPa": kilo(
            error.equator_contact_pressure if error else None
        ),
        "peak_contact_pressure_kPa": kilo(contact.peak_contact_pressure if contact else None),
        "downstream_angle_deg": degrees(contact.downstream_angle if contact else None),
        "stability_margin": solved.stability.margin if solved else None,
        "detail": {
            each.name: list(each.value) if isinstance(each.value, tuple) else each.value
            for each in quantities
        },
        "size_ratio": case.size_ratio,
        "wall_ratio": case.wall_ratio,
        "model": answer.model.NAME,
        "material": case.ureter.material.name,
        "case": describe(case, answer.model, answer.numerics),
        "solver": SolverRecord(
            dofs=solved.solver.dofs if solved else None,
            newton_steps=answer.newton_steps or None,
            seconds=answer.seconds or None,
            residual=solved.solver.residual if solved else None,
        ),
        "warnings": [CautionRecord.of(each) for each in answer.warnings],
    }
