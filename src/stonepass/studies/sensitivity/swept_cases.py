"""The results of a sweep as solved cases of a sensitivity study."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from stonepass.array_types import Float
from stonepass.errors import BadInput, Outcome
from stonepass.studies.sensitivity.evaluator import BAD_INPUT, OUTCOMES, Evaluations
from stonepass.studies.sensitivity.interpolated_cases import InterpolatedCases, require_same_inputs
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
        The results. If the sweep has several models, those of the model with the options of the
        case are used.

    Raises
    ------
    BadInput
        An input of the sweep is no number, or the uncertain or the fixed inputs, model and options
        included, are not those of the sweep (see `InterpolatedCases`).

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
    points = {key: _numbers(table[column]) for key, column in inputs.items()}
    require_same_inputs(uncertain, points, name)
    rows = _matching(uncertain, points, table, name)
    points = {key: values[rows] for key, values in points.items()}
    return InterpolatedCases(uncertain, points, _evaluations(table, bounds, rows), name)


def _matching(uncertain: UncertainCase, points: Inputs, table: Any, name: str) -> Any:
    """Return which rows are cases of the study: those of the one model that has its fixed inputs.

    The first solved case of each model of the sweep is compared with the study. Rows of cases in
    which the program failed do not belong to them.
    """
    outcome, model = (_words(table[column]) for column in ("outcome", "model"))
    fingerprints = _words(table["fingerprint"])
    for label in dict.fromkeys(model.tolist()):
        of_model = model == label
        solved = np.flatnonzero(of_model & np.isin(outcome, [*Outcome.__members__]))
        if len(solved) == 0:
            continue
        row = int(solved[0])
        case = uncertain.case({key: float(values[row]) for key, values in points.items()})
        if fingerprint_of(CaseInputs(row, case.model.NAME, {}, {}), case) == fingerprints[row]:
            return of_model & np.isin(outcome, [*Outcome.__members__, "BAD_INPUT"])
    raise BadInput("fixed inputs of the study", "others than those of the " + name,
                   "the same, including model, material and accuracy")  # fmt: skip


def _evaluations(table: Any, bounds: Mapping[Outcome, str], rows: Any) -> Evaluations:
    codes = {each.name: code for code, each in enumerate(OUTCOMES)} | {"BAD_INPUT": BAD_INPUT}
    words = _words(table["outcome"])[rows]
    bound = np.full(len(words), np.nan)
    for outcome, column in bounds.items():
        bound = np.where(words == outcome.name, _numbers(table[column])[rows], bound)
    return Evaluations(
        np.array([codes[each] for each in words], dtype=int),
        np.ma.masked_invalid(1e3 * _numbers(table[PRESSURE])[rows]),
        np.ma.masked_invalid(1e3 * bound),
        "the inputs of the sweep contradict each other" if "BAD_INPUT" in words else "",
    )


def _words(column: Any) -> Any:
    """Return a column of texts as an array."""
    return np.array(column.to_pylist(), dtype=object)


def _numbers(column: Any) -> Float[np.ndarray, " n"]:
    """Return a column as an array in which a missing number is NaN."""
    return np.asarray(column.to_numpy(), dtype=float)
