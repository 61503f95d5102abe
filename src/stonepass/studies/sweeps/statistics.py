"""Statistics of the results of a sweep: quantiles of P_ucr, ranges of the inputs, warnings."""

from __future__ import annotations

from collections import Counter
from typing import Any

import numpy as np

from stonepass.studies.sweeps.results import SweepResults

__all__ = ["QUANTILES", "input_ranges", "pressure_quantiles", "warning_counts"]

QUANTILES = {"smallest": 0.0, "5 %": 0.05, "median": 0.5, "95 %": 0.95, "largest": 1.0}


def pressure_quantiles(found: SweepResults) -> dict[str, dict[str, float]]:
    """Return quantiles of P_ucr in kPa by model and name (`QUANTILES`).

    They are those of the cases that have a critical pressure; a loose stone has the pressure 0. A
    model without any such case is left out.
    """
    table = found.table(["model", "critical_pressure_kPa"])
    models = np.array(table["model"].to_pylist(), dtype=object)
    pressures = table["critical_pressure_kPa"].to_numpy()
    quantiles = {}
    for label in found.models:
        known = pressures[(models == label) & np.isfinite(pressures)]
        if len(known):
            values = np.quantile(known, list(QUANTILES.values())).tolist()
            quantiles[label] = dict(zip(QUANTILES, values, strict=True))
    return quantiles


def input_ranges(found: SweepResults) -> dict[str, tuple[Any, Any]]:
    """Return the smallest and the largest value of each varied input by column.

    For an input that is no number, both are None. Inputs of cases that are not finished do not
    count.
    """
    ranges: dict[str, tuple[Any, Any]] = {}
    numeric = [name for name in found.inputs if found.columns.get(name) in ("double", "int64")]
    table = found.table(numeric)
    for name in found.inputs:
        known = name in numeric and len(table) > 0
        values = table[name].to_numpy() if known else None
        ranges[name] = (
            (None, None) if values is None else (values.min().item(), values.max().item())
        )
    return ranges


def warning_counts(found: SweepResults) -> dict[str, int]:
    """Return the number of cases with each warning by code, the most frequent first."""
    counts: Counter[str] = Counter()
    for each in found.table(["warnings"])["warnings"].value_counts().to_pylist():
        for code in each["values"].split():
            counts[code] += each["counts"]
    return dict(counts.most_common())
