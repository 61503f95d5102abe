"""Answers as flat records with the names of the glossary: JSON and CSV."""

from __future__ import annotations

import csv
import math
from collections.abc import Iterable
from dataclasses import asdict, is_dataclass
from pathlib import Path
from typing import Any

import numpy as np

from stonepass.about import DISCLAIMER, VERSION
from stonepass.errors import BadInput
from stonepass.model.answer import Answer, ContactState
from stonepass.model.case import Case
from stonepass.model.size import SizeAnswer

__all__ = [
    "curve_rows",
    "record",
    "size_record",
    "write_csv",
    "write_curve",
    "write_profile",
]

PROFILE_STEP = 0.1  # degrees
LEFT_OUT = ("model", "pairs")  # of the method: one stands elsewhere, the other as a file
_CURVE_COLUMNS = (
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


def record(answer: Answer) -> dict[str, Any]:
    """One answer as a JSON-ready record; a number that does not exist is None."""
    state, case, error = answer.state, answer.case, answer.error
    pushed, touch, beam = answer.pushed, answer.touch, answer.beam
    return {
        "outcome": answer.outcome.name,
        "message": answer.message,
        "critical_pressure_kPa": _kilo(answer.pressure),
        "critical_pressure_error_kPa": _kilo(error.critical_pressure if error else None),
        "critical_angle_deg": _degrees(answer.critical_angle),
        "contact_angle_deg": _degrees(touch.contact_angle if touch else None),
        "contact_angle_error_deg": _degrees(error.contact_angle if error else None),
        "equator_contact_pressure_kPa": _kilo(touch.equator_contact_pressure if touch else None),
        "equator_contact_pressure_error_kPa": _kilo(
            error.equator_contact_pressure if error else None
        ),
        "peak_contact_pressure_kPa": _kilo(touch.peak_contact_pressure if touch else None),
        "closure_end_pressure_kPa": _kilo(answer.closure_end_pressure),
        **_series(answer),
        "leak_pressure_kPa": _kilo(answer.leak_pressure),
        "seal_angle_deg": _degrees(pushed.seal_angle if pushed else None),
        "downstream_angle_deg": _degrees(touch.downstream_angle if touch else None),
        "stability_margin": state.stability.margin if state else None,
        "size_ratio": case.size_ratio,
        "wall_ratio": case.wall_ratio,
        "model": case.method.model,
        "material": case.ureter.material.name,
        "inputs": _inputs(case),
        "beam": None
        if beam is None
        else {
            "circumferential_modulus_Pa": beam.circumferential_modulus,
            "longitudinal_modulus_Pa": beam.longitudinal_modulus,
            "foundation_Pa": beam.foundation,
            "decay": beam.decay,
            "half_contact_length": beam.half_length,
        },
        "solver": {
            "dofs": state.solver.dofs if state else None,
            "newton_steps": answer.newton_steps or None,
            "seconds": answer.seconds or None,
            "residual": state.solver.residual if state else None,
        },
        "warnings": list(answer.warnings),
        "version": VERSION,
        "disclaimer": DISCLAIMER,
    }


def _series(answer: Answer) -> dict[str, Any]:
    """Coefficients of the fitted closure: in t, and those of Eq. 14 in ρ_α/R_s, in inner radii."""
    series, touch = answer.series, answer.touch
    if series is None or touch is None:
        return {"series_coefficients": None, "printed_series_coefficients": None}
    case = answer.case
    first = float(case.stone.shape.width(np.array(touch.contact_angle)))
    return {
        "series_coefficients": list(series.coefficients),
        "printed_series_coefficients": list(series.printed(first, case.size_ratio)),
    }


def size_record(answer: SizeAnswer) -> dict[str, Any]:
    """One critical size as a JSON-ready record.

    The keys of `record` describe the state at the critical size; without one they are None.
    """
    found = answer.size_ratio is not None
    assert not found or answer.at_size is not None
    base = (
        answer.at_size
        if found and answer.at_size
        else Answer(answer.case, answer.outcome, answer.message)
    )
    row = record(base)
    if not found:
        row["size_ratio"] = None
        row["inputs"]["size_ratio"] = None
    return {
        **row,
        "outcome": answer.outcome.name,
        "message": answer.message,
        "critical_size_ratio": answer.size_ratio,
        "critical_size_ratio_error": answer.size_ratio_error,
        "critical_diameter_mm": None if answer.diameter is None else answer.diameter * 1e3,
        "limit_kPa": _kilo(answer.limit),
        "warnings": list(answer.warnings),
    }


def curve_rows(answers: Iterable[Answer]) -> list[dict[str, Any]]:
    """The rows of a curve: the numbers of `record` that vary with the stone."""
    return [{key: row[key] for key in _CURVE_COLUMNS} for row in map(record, answers)]


def write_curve(answers: Iterable[Answer], path: Path) -> None:
    """Write a curve as CSV; a number that does not exist is an empty cell."""
    rows = [[row[key] for key in _CURVE_COLUMNS] for row in curve_rows(answers)]
    write_csv(path, _CURVE_COLUMNS, rows)


def write_profile(state: ContactState, path: Path) -> None:
    """Write the pressure on the stone as CSV, θ from 0 to 180° in steps of 0.1°.

    The edges of the contact are rows too. Seated, it is the contact pressure; loaded, the urine
    pressure stands before the contact.
    """
    first = math.degrees(state.contact_angle)
    last = math.degrees(state.downstream_angle)
    grid = np.linspace(0.0, 180.0, round(180.0 / PROFILE_STEP) + 1)
    theta = np.unique(np.concatenate([grid, [first, last]]))
    pressure = state.pressure_at(np.radians(theta)) / 1e3
    rows = zip(theta.tolist(), pressure.tolist(), strict=True)
    write_csv(path, ("theta_deg", "contact_pressure_kPa"), rows)


def _inputs(case: Case) -> dict[str, Any]:
    """What the answer was computed from, in SI."""
    ureter, law = case.ureter, case.ureter.material.law
    constants: dict[str, Any] = asdict(law) if is_dataclass(law) else {}
    constants.pop("function", None)
    return {
        "stone_diameter_m": case.stone_diameter,
        "size_ratio": case.size_ratio,
        "friction": case.stone.friction,
        "aspect": case.stone.aspect,
        "outline": list(case.stone.shape.outline),
        "shape_deviation": case.stone.shape.deviation,
        "inner_diameter_m": ureter.inner_diameter,
        "outer_diameter_m": ureter.outer_diameter,
        "wall_ratio": ureter.wall_ratio,
        "law": type(law).__name__,
        "law_constants": constants,
        "confining_pressure_Pa": float(case.load.confining_pressure),
        "confinement": case.load.confinement,
        "prestretch": case.load.prestretch,
        **{name: value for name, value in asdict(case.method).items() if name not in LEFT_OUT},
        "pairs": None if case.method.pairs is None else case.method.pairs.reference,
        "seating_friction": case.seating_friction,
    }


def _kilo(value: float | None) -> float | None:
    return None if value is None else value / 1e3


def _degrees(value: float | None) -> float | None:
    return None if value is None else math.degrees(value)


def _cell(value: Any) -> str:
    if value is None:
        return ""
    if isinstance(value, list):
        return "; ".join(value)
    return f"{value:.10g}" if isinstance(value, float) else str(value)


def write_csv(path: Path, header: Iterable[str], rows: Iterable[Iterable[Any]]) -> None:
    """Write rows as CSV; a number that does not exist is an empty cell."""
    try:
        with path.open("w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(header)
            writer.writerows([_cell(value) for value in row] for row in rows)
    except OSError as problem:
        raise BadInput("output file", str(path), f"writable ({problem.strerror})") from problem
