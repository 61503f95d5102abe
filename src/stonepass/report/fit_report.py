"""A fitted law as a table."""

from __future__ import annotations

import math

from rich import box
from rich.table import Table
from rich.text import Text

from stonepass.bench.law_fit import Constant, FittedLaw
from stonepass.materials.constants import Unit
from stonepass.materials.known_laws import name_of_law

__all__ = ["fit_table"]

CLOSE = 0.95  # correlation from which two constants are not determined separately


def fit_table(found: FittedLaw) -> Table:
    """Return a table of the constants with confidence intervals, and of the residuals."""
    title = f"{name_of_law(found.material.law)}, {len(found.predicted)} points"
    table = Table(box=box.SIMPLE_HEAD, title=Text(title), title_justify="left")
    interval = "95 % confidence interval" + ", approximate" * found.approximate
    for name in ("", "value", interval):
        table.add_column(name)
    for each in found.constants:
        ends = "given" if each.given else _interval(each)
        table.add_row(each.name, _shown(each.value, each.unit), ends)
    table.add_row("RMSE", f"{found.rmse / 1e3:.3g} kPa", "")
    table.add_row("R²", f"{found.r_squared:.4f}", "")
    for (one, other), value in found.correlations.items():
        if abs(value) > CLOSE:
            table.add_row(
                f"{one}, {other}", f"{value:+.3f}", "correlation; not determined separately"
            )
    low, high = found.data.strain_range
    table.add_row("stretches", f"{low:.4g} to {high:.4g}", "")
    table.add_row("stable", "no" if found.unstable else "yes", found.unstable)
    if not all(each.given for each in found.constants):
        table.caption = "The intervals assume that the errors of the points are independent."
        table.caption_justify = "left"
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
