"""The results of a sweep as solved cases of a sensitivity study."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from stonepass.array_types import Float
from stonepass.errors import BadInput, Outcome
from stonepass.studies.sensitivity.evaluator import BAD_INPUT, OUTCOMES, Evaluations
from stonepass.studies.sensitivity.interpolated_cases import InterpolatedCases
from stonepass.studies.sensitivity.uncertain_case import Inputs, UncertainCase
from stonepass.studies.sweeps.case_rows import fingerprint_of
from stonepass.studies.sweeps.plan import CaseInputs
from stonepass.studies.sweeps.results import SweepResults

__all__ = ["swept_cases"]

# The column of the lower bound in kPa, by the outcome without a critical pressure.
BOUNDS = {
    Outcome.BEYOND_CLOSURE: "closure_end_pressure_kPa",
    Outcome.LEAKS: "leak_pressure_kPa",
}
PRESSURE = "critical_pressure_kPa"


def swept_cases(uncertain: UncertainCase, results: SweepResults) -> InterpolatedCases:
    """Make an evaluator that interpolates the results of a sweep.

    Rows of cases in which the program failed are left out.

    Parameters
    ----------
    uncertain : UncertainCase
        The case with its uncertain inputs, which must be the varied inputs of the sweep.
    results : SweepResults
        The results. If the sweep has several models, those of the model of the case are used.

    Raises
    ------
    BadInput
        The model of the case is not in the sweep, an input of the sweep is no number, or the
        uncertain or the fixed inputs are not those of the sweep (see `InterpolatedCases`).

    References
    ----------
    docs/howto/sensitivity.md, "Results of a sweep".
    """
    plan, name = results.ledger.plan, f"sweep '{results.folder.name}'"
    inputs = {each["key"]: each["column"] for each in plan["inputs"]}
    for each in plan["inputs"]:
        if each["type"] != "double":
            raise BadInput(f"'{each['key']}'", f"varied in the {name}", "a real number")
    bounds = {outcome: column for outcome, column in BOUNDS.items() if column in results.columns}
    asked = ["model", "outcome", "fingerprint", PRESSURE, *inputs.values(), *bounds.values()]
    table = results.table([each for each in dict.fromkeys(asked) if each in results.columns])
    words = np.array(table["outcome"].to_pylist(), dtype=object)
    rows = np.isin(words, [*Outcome.__members__, "BAD_INPUT"]) & _of_model(uncertain, plan, table)
    points = {key: _numbers(table[column])[rows] for key, column in inputs.items()}
    solved = _evaluations(
        words[rows], {key: table[key] for key in table.column_names}, bounds, rows
    )
    found = InterpolatedCases(uncertain, points, solved, name)
    _check_fixed(uncertain, points, np.array(table["fingerprint"].to_pylist())[rows], solved, name)
    return found


def _check_fixed(
    uncertain: UncertainCase, points: Inputs, fingerprints: Any, solved: Evaluations, name: str
) -> None:
    """Refuse a sweep whose fixed inputs are not those of the study, by the first solved case."""
    row = int(np.flatnonzero(solved.outcome != BAD_INPUT)[0])
    case = uncertain.case({key: float(values[row]) for key, values in points.items()})
    inputs = CaseInputs(row, case.model.NAME, {}, {})
    if fingerprint_of(inputs, case) != fingerprints[row]:
        raise BadInput("fixed inputs of the study", "others than those of the " + name,
                       "the same, including model, material and accuracy")  # fmt: skip


def _of_model(uncertain: UncertainCase, plan: Mapping[str, Any], table: Any) -> Any:
    """Return which rows belong to the model of the case."""
    labels = [each["label"] for each in plan["models"]]
    if len(labels) == 1:
        return np.ones(table.num_rows, dtype=bool)
    mine = uncertain.median_case.model.NAME
    if mine not in labels:
        raise BadInput("model", mine, "one of the models of the sweep, " + ", ".join(labels))
    return np.array(table["model"].to_pylist(), dtype=object) == mine


def _evaluations(words: Any, table: Any, bounds: Mapping[Outcome, str], rows: Any) -> Evaluations:
    codes = {each.name: code for code, each in enumerate(OUTCOMES)} | {"BAD_INPUT": BAD_INPUT}
    bound = np.full(len(words), np.nan)
    for outcome, column in bounds.items():
        bound = np.where(words == outcome.name, _numbers(table[column])[rows], bound)
    return Evaluations(
        np.array([codes[each] for each in words], dtype=int),
        np.ma.masked_invalid(1e3 * _numbers(table[PRESSURE])[rows]),
        np.ma.masked_invalid(1e3 * bound),
        "the inputs of the sweep contradict each other" if "BAD_INPUT" in words else "",
    )


def _numbers(column: Any) -> Float[np.ndarray, " n"]:
    """Return a column as an array in which a missing number is NaN."""
    return np.asarray(column.to_numpy(), dtype=float)
