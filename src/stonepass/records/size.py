"""The record of the critical size at a pressure limit."""

from __future__ import annotations

from pydantic import Field

from stonepass.model.answer import Answer
from stonepass.model.size import SizeAnswer
from stonepass.records.answer import AnswerRecord, answer_fields
from stonepass.records.base import kilo, warning_records

__all__ = ["SizeRecord", "size_record"]


class SizeRecord(AnswerRecord):
    """The critical size, and the answer for a stone of this size.

    If there is no critical size, the keys of the answer are null.
    """

    critical_size_ratio: float | None = Field(description="size ratio ξ of the critical size")
    critical_size_ratio_error: float | None = Field(
        description=(
            "estimated error (±) of `critical_size_ratio`: the discretisation error of P_ucr "
            "divided by dP_ucr/dξ, plus the tolerance of the search, 1e-6"
        )
    )
    critical_diameter_mm: float | None = Field(
        description="critical stone diameter; null if the ureter is given by ratios only"
    )
    limit_kPa: float = Field(description="pressure limit")


def size_record(answer: SizeAnswer) -> SizeRecord:
    """Make the record of a critical size."""
    case = answer.case
    found = answer.size_ratio is not None and answer.at_size is not None
    state = Answer(case, case.model, case.numerics, answer.outcome)
    if found and answer.at_size is not None:
        state = answer.at_size
    fields = answer_fields(state)
    if not found:
        stone = fields["case"].stone.model_copy(update={"size_ratio": None, "diameter_m": None})
        described = fields["case"].model_copy(update={"stone": stone})
        fields |= {"size_ratio": None, "case": described}
    diameter = answer.diameter
    limit = kilo(answer.limit)
    assert limit is not None
    return SizeRecord(
        **{
            **fields,
            "outcome": answer.outcome.name,
            "message": answer.message,
            "critical_size_ratio": answer.size_ratio,
            "critical_size_ratio_error": answer.size_ratio_error,
            "critical_diameter_mm": None if diameter is None else diameter * 1e3,
            "limit_kPa": limit,
            "warnings": warning_records(answer.warnings),
        }
    )
