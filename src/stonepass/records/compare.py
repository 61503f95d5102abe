"""Our answer beside the contact of CalculiX as a record."""

from __future__ import annotations

import math

from pydantic import Field

from stonepass.export.comparison import Comparison
from stonepass.records.answer import AnswerRecord, answer_fields
from stonepass.records.base import PartRecord, kilo

__all__ = ["CalculixRecord", "CompareRecord", "compare_record"]


class CalculixRecord(PartRecord):
    """The numbers that the force balance gives with the contact that CalculiX found."""

    contact_angle_deg: float = Field(description="angle at which the contact begins")
    equator_contact_pressure_kPa: float = Field(description="contact pressure at θ = 90°")
    peak_contact_pressure_kPa: float = Field(description="largest contact pressure")
    critical_pressure_kPa: float | None = Field(
        description="P_ucr by the same balance and closure; null where the forces do not balance"
    )


class CompareRecord(AnswerRecord):
    """Our answer, and what follows from the contact that CalculiX found for the same case."""

    calculix: CalculixRecord = Field(description="what follows from CalculiX's contact")


def compare_record(found: Comparison) -> CompareRecord:
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
