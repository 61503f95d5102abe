"""Records of a curve of critical pressure over size, and their table as CSV."""

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
    """One point of a curve: the quantities of an answer that vary with the size of the stone."""

    size_ratio: float = Field(
        description="ξ, stone diameter divided by inner diameter of the ureter"
    )
    outcome: str = Field(description="outcome of the calculation (glossary: outcomes)")
    critical_pressure_kPa: float | None = Field(description="critical urine pressure P_ucr")
    critical_pressure_error_kPa: float | None = Field(
        description="estimated discretisation error (±) of `critical_pressure_kPa`"
    )
    critical_angle_deg: float | None = Field(
        description="α_cr, the angle up to which the wall has opened when the stone starts to move"
    )
    contact_angle_deg: float | None = Field(description="angle at which the contact begins")
    contact_angle_error_deg: float | None = Field(
        description="estimated discretisation error (±) of `contact_angle_deg`"
    )
    equator_contact_pressure_kPa: float | None = Field(description="contact pressure at θ = 90°")
    equator_contact_pressure_error_kPa: float | None = Field(
        description="estimated discretisation error (±) of `equator_contact_pressure_kPa`"
    )
    peak_contact_pressure_kPa: float | None = Field(description="largest contact pressure")
    closure_end_pressure_kPa: float | None = Field(
        description=(
            "P_u at the end of the closure (r_a = R_s), which is no physical bound; null for a "
            "model without a closure"
        )
    )
    leak_pressure_kPa: float | None = Field(
        description="P_u at which urine passes the held stone; null for a model without a leak"
    )
    stability_margin: float | None = Field(
        description=(
            "stiffness of the weakest shear band in the solved wall, divided by the shear modulus "
            "at rest: 1 in an unloaded wall, 0 if strong ellipticity is lost"
        )
    )
    wall_ratio: float = Field(description="η, outer diameter divided by inner diameter")
    model: str = Field(description="name of the model")
    material: str = Field(description="name of the material")
    warnings: list[CautionRecord] = Field(description="warnings about the answer")


def curve_records(answers: Iterable[Answer]) -> list[CurvePointRecord]:
    """Make the records of a curve; quantities that the model does not have are None."""
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
    """Write a curve as CSV, with empty cells for missing numbers and warnings as sentences.

    Parameters
    ----------
    answers : iterable of Answer
        The answers of the curve; pressures are written in kPa and angles in degrees.
    path : Path
        File to write.

    Raises
    ------
    BadInput
        The file cannot be written.
    """
    columns = tuple(CurvePointRecord.model_fields)
    rows = []
    for point in curve_records(answers):
        cells = dict(point) | {"warnings": [each.sentence for each in point.warnings]}
        rows.append([cells[name] for name in columns])
    write_csv(path, columns, rows)
