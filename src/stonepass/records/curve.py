"""A curve of critical pressure over size as records and as CSV."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path
from typing import Any

from stonepass.io.csv_file import write_csv
from stonepass.model.answer import Answer
from stonepass.records.answer import answer_record

__all__ = ["COLUMNS", "curve_rows", "write_curve"]

# Keys of `AnswerRecord`, or of its detail, that vary with the stone.
COLUMNS = (
    "size_ratio",
    "outcome",
    "critical_pressure_kPa",
    "critical_pressure_error_kPa",
    "critical_angle_deg",
    "contact_angle_deg",
    "contact_angle_error_deg",
    "equator_contact_pressure_kPa",
    "equator_contact_pressure_error_kPa",
    "peak_contact_pressure_kPa",
    "closure_end_pressure_kPa",
    "leak_pressure_kPa",
    "stability_margin",
    "wall_ratio",
    "model",
    "material",
    "warnings",
)


def curve_rows(answers: Iterable[Answer]) -> list[dict[str, Any]]:
    """The rows of a curve: the numbers of an answer's record that vary with the stone.

    A number that this model does not have is None; `warnings` has the sentences.
    """
    rows = []
    for record in map(answer_record, answers):
        known = record.to_dict() | record.detail
        known["warnings"] = [each.sentence for each in record.warnings]
        rows.append({key: known.get(key) for key in COLUMNS})
    return rows


def write_curve(answers: Iterable[Answer], path: Path) -> None:
    """Write a curve as CSV; a number that does not exist is an empty cell."""
    write_csv(path, COLUMNS, [[row[key] for key in COLUMNS] for row in curve_rows(answers)])
