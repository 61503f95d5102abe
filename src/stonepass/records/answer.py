"""The record of the answer to one case."""

from __future__ import annotations

from typing import Any

from pydantic import Field

from stonepass.model.answer import Answer
from stonepass.model.contact_state import SolvedState
from stonepass.records.base import CautionRecord, PartRecord, Record, degrees, kilo, warning_records
from stonepass.records.case import CaseRecord, case_record

__all__ = ["AnswerRecord", "SolverRecord", "answer_record"]


class SolverRecord(PartRecord):
    """Effort and residuals of the finite-element solve; null in a model without finite elements."""

    dofs: int | None = Field(description="number of unknowns of the last mesh")
    newton_steps: int | None = Field(
        description=(
            "number of Newton steps for which a new tangent was factorised, including those of "
            "failed attempts and of the coarser solve"
        )
    )
    seconds: float | None = Field(description="wall-clock time of all solves in s")
    residual: float | None = Field(
        description="residual of the last solve, relative to the contact force"
    )


class AnswerRecord(Record):
    """The critical pressure of one case, or the reason why it does not exist."""

    outcome: str = Field(description="outcome of the calculation (glossary: outcomes)")
    message: str = Field(description="the outcome as a sentence")
    critical_pressure_kPa: float | None = Field(description="critical urine pressure P_ucr")
    critical_pressure_error_kPa: float | None = Field(
        description="estimated discretisation error (±) of `critical_pressure_kPa`"
    )
    critical_angle_deg: float | None = Field(
        description="α_cr, the angle up to which the wall has opened when the stone starts to move"
    )
    contact_angle_deg: float | None = Field(
        description=(
            "angle at which the contact begins: α₀ of the seated state, or α of the loaded state "
            "in the direct model"
        )
    )
    contact_angle_error_deg: float | None = Field(
        description="estimated discretisation error (±) of `contact_angle_deg`"
    )
    equator_contact_pressure_kPa: float | None = Field(description="contact pressure at θ = 90°")
    equator_contact_pressure_error_kPa: float | None = Field(
        description="estimated discretisation error (±) of `equator_contact_pressure_kPa`"
    )
    peak_contact_pressure_kPa: float | None = Field(description="largest contact pressure")
    downstream_angle_deg: float | None = Field(
        description=(
            "angle at which the contact ends: 180° − α₀ in the seated state of a stone whose "
            "halves are mirror images"
        )
    )
    stability_margin: float | None = Field(
        description=(
            "stiffness of the weakest shear band in the solved wall, divided by the shear modulus "
            "at rest (G for a Fung wall): 1 in an unloaded wall, 0 if strong ellipticity is lost"
        )
    )
    detail: dict[str, float | list[float] | None] = Field(
        description=(
            "additional results, which depend on the model. The model `paper` has "
            "`closure_end_pressure_kPa` (P_u at the end of the closure, r_a = R_s, which is no "
            "physical bound), and for a fitted series `series_coefficients` (c₁, c₂, … in powers "
            "of t = (ρ_α − ρ₀)/(R_s − ρ₀)) and `printed_series_coefficients` (a₀, a₁, … of Eq. 14 "
            "in inner radii). The model `direct` has `leak_pressure_kPa` (P_u at which urine "
            "passes the held stone, from the coarser solve) and `seal_angle_deg` (angle of the "
            "largest contact pressure in the loaded state). The model `beam` has "
            "`closure_end_pressure_kPa`, `circumferential_modulus_Pa` (E₁), "
            "`longitudinal_modulus_Pa` (E₂), `foundation_Pa` (k R_a), `decay` (β R_a) and "
            "`half_contact_length` (a/R_a)"
        )
    )
    size_ratio: float | None = Field(
        description="ξ, stone diameter divided by inner diameter of the ureter"
    )
    wall_ratio: float = Field(description="η, outer diameter divided by inner diameter")
    model: str = Field(
        description="name of the model: `paper`, `direct`, `beam`, or a model of your own"
    )
    material: str = Field(description="name of the material")
    case: CaseRecord = Field(description="complete description of the case, in SI units")
    solver: SolverRecord = Field(description="effort and residual of the finite-element solves")
    warnings: list[CautionRecord] = Field(description="warnings about the answer")


def answer_record(answer: Answer) -> AnswerRecord:
    """Make the record of an answer."""
    return AnswerRecord(**answer_fields(answer))


def answer_fields(answer: Answer) -> dict[str, Any]:
    """Return the fields of `AnswerRecord`, for records that extend it."""
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
        "case": case_record(case, answer.model, answer.numerics),
        "solver": SolverRecord(
            dofs=solved.solver.dofs if solved else None,
            newton_steps=answer.newton_steps or None,
            seconds=answer.seconds or None,
            residual=solved.solver.residual if solved else None,
        ),
        "warnings": warning_records(answer.warnings),
    }
