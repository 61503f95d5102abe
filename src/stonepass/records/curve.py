"""A curve of critical pressure over size as records and as CSV."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from pydantic import Field

from stonepass.io.csv_file import write_csv
from stonepass.model.answer import Answer
from stonepass.records.answer import answer_record
from stonepass.records.base import CautionRecord, PartRecord

__all__ = ["CurvePointRecord", "curve_records", "write_curve"]


class CurvePointRecord(PartRecord):
    """One point of a curve: the numbers of an answer that vary with the stone."""

    size_ratio: float = Field(description="ξ, stone diameter over inner diameter")
    outcome: str = Field(description="how the question ended (glossary: outcomes)")
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
    closure_end_pressure_kPa: float | None = Field(
        description=(
            "P_u at which the closure ends (r_a = R_s), no physical bound; null in a model "
            "without a closure"
        )
    )
    leak_pressure_kPa: float | None = Field(
        description="P_u at which urine passes the held stone; null in a model without a leak"
    )
    stability_margin: float | None = Field(
        description="stiffness of the weakest shear band of the wall: 1 unloaded, 0 unstable"
    )
    wall_ratio: float = Field(description="η, outer diameter over inner diameter")
    model: str = Field(description="name of the model")
    material: str = Field(description="name of the material")
    warnings: list[CautionRecord] = Field(description="where the answer must be read with care")


def curve_records(answers: Iterable[Answer]) -> list[CurvePointRecord]:
    """Make the records of a curve; a number that its model does not have is None."""
    points = []
    for record in map(answer_record, answers):
        known = dict(record) | record.detail
        points.append(
            CurvePointRecord.model_validate(
                {name: known.get(name) for name in CurvePointRecord.model_fields}
            )
        )
    return points


def write_curve(answers: Iterable[Answer], path: Path) -> None:
    """Write a curve as CSV.

    A number that does not exist is an empty cell; warnings stand there as sentences.
    """
    columns = tuple(CurvePointRecord.model_fields)
    rows = []
    for point in curve_records(answers):
        cells = dict(point) | {"warnings": [each.sentence for each in point.warnings]}
        rows.append([cells[name] for name in columns])
    write_csv(path, columns, rows)
