"""The record of a comparison with the contact that CalculiX computed."""

from __future__ import annotations

import math

from pydantic import Field

from stonepass.export.comparison import DeckComparison
from stonepass.records.answer import AnswerRecord, answer_fields
from stonepass.records.base import PartRecord, kilo

__all__ = ["CalculixRecord", "CompareRecord", "compare_record"]


class CalculixRecord(PartRecord):
    """The contact that CalculiX computed, and the critical pressure that follows from it."""

    contact_angle_deg: float = Field(description="angle at which the contact begins")
    equator_contact_pressure_kPa: float = Field(description="contact pressure at θ = 90°")
    peak_contact_pressure_kPa: float = Field(description="largest contact pressure")
    critical_pressure_kPa: float | None = Field(
        description=(
            "P_ucr by the force balance and closure of the answer; null if the forces do not "
            "balance"
        )
    )


class CompareRecord(AnswerRecord):
    """The answer of stonepass, and the results of CalculiX for the same case."""

    calculix: CalculixRecord = Field(description="results from the contact of CalculiX")


def compare_record(found: DeckComparison) -> CompareRecord:
    """Make the record of a comparison."""
    theirs = found.contact
    return CompareRecord(
        **answer_fields(found.answer),
        calculix=CalculixRecord(
            contact_angle_deg=math.degrees(theirs.contact_angle),
            equator_contact_pressure_kPa=theirs.equator_contact_pressure / 1e3,
            peak_contact_pressure_kPa=theirs.peak_contact_pressure / 1e3,
            critical_pressure_kPa=kilo(found.pressure),
        ),
    )
