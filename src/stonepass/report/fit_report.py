"""A fitted law: JSON record and table."""

from __future__ import annotations

import math
from typing import Any

from rich import box
from rich.table import Table
from rich.text import Text

from stonepass.about import DISCLAIMER, VERSION
from stonepass.bench.law_fit import Constant, FittedLaw
from stonepass.materials.constants import Unit
from stonepass.materials.known_laws import name_of_law

__all__ = ["fit_record", "fit_table"]

CLOSE = 0.95  # correlation of two estimates that trade off


def fit_record(found: FittedLaw, inputs: dict[str, Any]) -> dict[str, Any]:
    """All of it as a JSON-ready record, moduli in Pa; `inputs` says what was asked."""
    return {
        "inputs": inputs | {"data": _data(found)},
        "law": name_of_law(found.material.law),
        "constants": [
            {
                "name": each.name,
                "value": each.value,
                "unit": "" if each.unit == "1" else each.unit,
                "low": each.low,
                "high": each.high,
                "given": each.given,
            }
            for each in found.constants
        ],
        "rmse_kPa": found.rmse / 1e3,
        "r_squared": found.r_squared,
        "correlations": {",".join(pair): value for pair, value in found.correlations.items()},
        "points": len(found.predicted),
        "measured": found.data.measured,
        "strain_range": list(found.material.strain_range),
        "stable": not found.unstable,
        "stability": found.unstable,
        "warnings": list(found.warnings),
        "version": VERSION,
        "disclaimer": DISCLAIMER,
    }


def _data(found: FittedLaw) -> list[dict[str, Any]]:
    """The points that were fitted, with what the law says of them."""
    data = found.data
    rows = zip(data.abscissa, data.observed, found.predicted, data.groups, strict=True)
    return [
        {
            "stretch": float(stretch),
            "observed_kPa": float(observed) / 1e3,
            "predicted_kPa": float(predicted) / 1e3,
            "group": group,
        }
        for stretch, observed, predicted, group in rows
    ]


def fit_table(found: FittedLaw) -> Table:
    """Constants with their intervals, and how well they meet the data."""
    title = f"{name_of_law(found.material.law)}, {len(found.predicted)} points"
    table = Table(box=box.SIMPLE_HEAD, title=Text(title), title_justify="left")
    for name in ("", "value", "95 % interval"):
        table.add_column(name)
    for each in found.constants:
        interval = "given" if each.given else _interval(each)
        table.add_row(each.name, _shown(each.value, each.unit), interval)
    table.add_row("RMSE", f"{found.rmse / 1e3:.3g} kPa", "")
    table.add_row("R²", f"{found.r_squared:.4f}", "")
    for (one, other), value in found.correlations.items():
        if abs(value) > CLOSE:
            table.add_row(f"{one}, {other}", f"{value:+.3f}", "correlation: they trade off")
    low, high = found.material.strain_range
    table.add_row("stretches", f"{low:.4g} to {high:.4g}", "")
    table.add_row("stable", "no" if found.unstable else "yes", found.unstable)
    return table


def _interval(constant: Constant) -> str:
    ends = [
        "open" if end is None else _shown(end, constant.unit)
        for end in (constant.low, constant.high)
    ]
    return " to ".join(ends)


def _shown(value: float, unit: Unit) -> str:
    if unit == "1":
        return f"{value:.4g}"
    if unit == "rad":
        return f"{math.degrees(value):.4g}°"
    return f"{value / 1e6:.4g} MPa" if abs(value) >= 1e5 else f"{value / 1e3:.4g} kPa"
