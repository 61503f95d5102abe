"""The row of one case of a sweep: its inputs, and its answer or the reason why it has none."""

from __future__ import annotations

import hashlib
import json
import math
from typing import Any

from stonepass.errors import BadInput, Outcome
from stonepass.inputs.build import build_case, in_words
from stonepass.inputs.case_file import WORDS
from stonepass.inputs.case_record import describe
from stonepass.inputs.material_file import find_material
from stonepass.model.answer import Answer
from stonepass.model.case import Case
from stonepass.model.contact_state import SolvedState
from stonepass.studies.jobs import PressureJob
from stonepass.studies.source_digest import NUMBERS
from stonepass.studies.sweeps.plan import CaseInputs
from stonepass.studies.sweeps.varied_input import MATERIAL, described, with_constants

__all__ = [
    "COLUMNS",
    "FAULTS",
    "OUTCOMES",
    "Row",
    "answered",
    "build",
    "fingerprint_of",
    "lost_row",
    "solved_row",
]

Row = dict[str, Any]

# Outcomes of a row in addition to those of `Outcome`, with the sentence that explains each.
OUTCOMES = {
    "BAD_INPUT": "The inputs of the case contradict each other, or one of them is out of bounds",
    "PROGRAM_ERROR": "The program failed in this case",
    "WORKER_LOST": "The process that solved this case ended twice before it had a result",
}
FAULTS = ("PROGRAM_ERROR", "WORKER_LOST")  # outcomes of which the physics is not the reason

# Columns that every case has, with their types; those of the varied inputs and of the model's own
# quantities come after the index and the fingerprint, and at the end.
COLUMNS = {
    "model": "string",
    "outcome": "string",
    "reason": "string",
    "size_ratio": "double",
    "wall_ratio": "double",
    "critical_pressure_kPa": "double",
    "critical_pressure_error_kPa": "double",
    "critical_angle_deg": "double",
    "contact_angle_deg": "double",
    "contact_angle_error_deg": "double",
    "equator_contact_pressure_kPa": "double",
    "equator_contact_pressure_error_kPa": "double",
    "peak_contact_pressure_kPa": "double",
    "stability_margin": "double",
    "warnings": "string",
}


def build(values: dict[str, Any]) -> Case:
    """Make the case of raw values, some of which may be constants of the law.

    Parameters
    ----------
    values : dict
        Raw values by key (see `inputs.build.build_case`), and ``ureter.material.NAME`` for a
        constant of the law in SI units.

    Raises
    ------
    BadInput
        A value is out of bounds, or two values contradict each other.
    """
    prefix = f"{MATERIAL}."
    constants = {
        key.removeprefix(prefix): value for key, value in values.items() if key.startswith(prefix)
    }
    kept = {key: value for key, value in values.items() if not key.startswith(prefix)}
    if constants:
        kept[MATERIAL] = with_constants(find_material(kept.get(MATERIAL, "ureter")), constants)
    return build_case(kept)


def solved_row(inputs: CaseInputs) -> Row:
    """Solve a case and return its row; whatever goes wrong in one case is a row too."""
    case = None
    try:
        case = build(inputs.values)
        answer = PressureJob(case).run(None)
        return _begun(inputs, case) | _answered(answer)
    except BadInput as problem:
        return _failed(inputs, case, "BAD_INPUT", str(in_words(problem, WORDS)))
    except Exception as problem:  # a fault in one case must not end the study
        return _failed(inputs, case, "PROGRAM_ERROR", f"{type(problem).__name__}: {problem}")


def lost_row(inputs: CaseInputs) -> Row:
    """Return the row of a case that ended the process which solved it."""
    try:
        case = build(inputs.values)
    except BadInput:
        case = None
    return _failed(inputs, case, "WORKER_LOST", OUTCOMES["WORKER_LOST"])


def fingerprint_of(inputs: CaseInputs, case: Case | None) -> str:
    """Return the first 128 bits of a digest of the case and of the version of the numbers.

    Parameters
    ----------
    inputs : CaseInputs
        The raw inputs, which are described if the case cannot be made.
    case : Case or None
        The case.
    """
    record = (
        {key: described(value) for key, value in inputs.values.items()}
        if case is None
        else describe(case, case.model, case.numerics)
    )
    text = json.dumps([NUMBERS, record], sort_keys=True, allow_nan=False)
    return hashlib.sha256(text.encode()).hexdigest()[:32]


def _begun(inputs: CaseInputs, case: Case | None) -> Row:
    """Return the first columns of a row; the columns of the answer are still empty."""
    row: Row = {"index": inputs.index, "fingerprint": fingerprint_of(inputs, case)}
    row |= dict.fromkeys(COLUMNS) | {"model": inputs.label, "warnings": ""}
    if case is not None:
        row |= {"size_ratio": float(case.size_ratio), "wall_ratio": float(case.wall_ratio)}
    return row | inputs.cells


def _failed(inputs: CaseInputs, case: Case | None, outcome: str, reason: str) -> Row:
    return _begun(inputs, case) | {"outcome": outcome, "reason": reason}


def _answered(answer: Answer) -> Row:
    error, contact = answer.error, answer.contact
    solved = contact if isinstance(contact, SolvedState) else None
    row: Row = {
        "outcome": answer.outcome.name,
        "reason": answer.reason or (None if answer.outcome.answered else answer.outcome.value),
        "critical_pressure_kPa": _kilo(answer.pressure),
        "critical_pressure_error_kPa": _kilo(error.critical_pressure if error else None),
        "critical_angle_deg": _degrees(answer.critical_angle),
        "contact_angle_deg": _degrees(contact.contact_angle if contact else None),
        "contact_angle_error_deg": _degrees(error.contact_angle if error else None),
        "equator_contact_pressure_kPa": _kilo(
            contact.equator_contact_pressure if contact else None
        ),
        "equator_contact_pressure_error_kPa": _kilo(
            error.equator_contact_pressure if error else None
        ),
        "peak_contact_pressure_kPa": _kilo(contact.peak_contact_pressure if contact else None),
        "stability_margin": _finite(solved.stability.margin if solved else None),
        "warnings": " ".join(each.code for each in answer.warnings),
    }
    quantities = () if answer.detail is None else answer.detail.quantities()
    return row | {each.name: _finite_values(each.value) for each in quantities}


def _kilo(value: float | None) -> float | None:
    return None if value is None else _finite(value / 1e3)


def _degrees(value: float | None) -> float | None:
    return None if value is None else _finite(math.degrees(value))


def _finite_values(value: Any) -> Any:
    if isinstance(value, tuple | list):
        return [_finite(each) for each in value]
    return _finite(value)


def _finite(value: float | None) -> float | None:
    """Return a number as the built-in float; a number that is not finite is an error."""
    if value is None:
        return None
    if not math.isfinite(value):
        raise ValueError(f"a result is {value}")
    return float(value)


def answered(outcome: str) -> bool:
    """Return True if an outcome of a row is one that has an answer."""
    return outcome in Outcome.__members__ and Outcome[outcome].answered
