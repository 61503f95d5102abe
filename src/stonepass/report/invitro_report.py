"""A measured series beside the model: JSON record, table, CSV."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from rich import box
from rich.markup import escape
from rich.table import Table

from stonepass.about import DISCLAIMER, VERSION
from stonepass.bench.comparison import Comparison
from stonepass.bench.invitro import Estimate, InVitro
from stonepass.bench.least_squares import LEVEL
from stonepass.io.csv_file import write_csv
from stonepass.report.table import significant

__all__ = ["invitro_record", "invitro_table", "write_invitro"]

CLOSE = 0.9  # correlation of two estimates that trade off
ROWS = 40  # of points in a terminal
_COLUMNS = ("size_ratio", "wall_ratio", "confining_kPa", "measured_kPa", "sd_kPa", "outcome",
            "critical_pressure_kPa", "critical_pressure_error_kPa")  # fmt: skip


def invitro_record(found: InVitro, file: str) -> dict[str, Any]:
    """All of it as a JSON-ready record; `file` is where the points stand."""
    joint = found.joint
    return {
        "friction": found.comparison.friction,
        **_agreement(found.comparison),
        "fitted_friction": _estimate(found.friction),
        "fitted_agreement": _agreement(found.fitted),
        "joint": None
        if joint is None
        else {
            "friction": _estimate(joint.friction),
            "stiffness": _estimate(joint.stiffness),
            "correlation": joint.correlation,
        },
        "weighted": found.weighted,
        "level": LEVEL,
        "points": [dict(zip(_COLUMNS, row, strict=True)) for row in _rows(found.comparison)],
        "inputs": {
            "file": file,
            "material": found.setting.material.name,
            "confinement": found.setting.confinement,
            "model": found.setting.model.NAME,
            "seating": getattr(found.setting.model, "seating", None),
            "accuracy": found.setting.numerics.accuracy,
        },
        "warnings": [*found.warnings, *answers_warnings(found.comparison)],
        "version": VERSION,
        "disclaimer": DISCLAIMER,
    }


def write_invitro(found: InVitro, path: Path) -> None:
    """Write the points with the model's answers as CSV."""
    write_csv(path, _COLUMNS, _rows(found.comparison))


def invitro_table(found: InVitro) -> list[Table]:
    """The points beside the model, and what the series says of friction and stiffness."""
    return [_points(found), _fits(found)]


def answers_warnings(comparison: Comparison) -> list[str]:
    """What the answers warn of, each sentence once."""
    return list(dict.fromkeys(str(w) for answer in comparison.answers for w in answer.warnings))


def _points(found: InVitro) -> Table:
    comparison = found.comparison
    title = f"{escape(found.setting.material.name)} · friction {comparison.friction:.3g}"
    table = Table(box=box.SIMPLE_HEAD, title=title, title_justify="left")
    for name in ("ξ", "η", "P_out kPa", "measured kPa", "model kPa", "model/measured − 1"):
        table.add_column(name, justify="right")
    pairs = list(zip(comparison.points, comparison.answers, strict=True))
    for point, answer in pairs[:ROWS]:
        known = answer.pressure
        table.add_row(
            f"{point.size_ratio:.4g}",
            f"{point.wall_ratio:.4g}",
            f"{point.confining_pressure / 1e3:.4g}",
            significant(point.pressure / 1e3)
            + ("" if point.sd is None else f" ± {point.sd / 1e3:.2g}"),
            answer.outcome.name if known is None else significant(known / 1e3),
            "" if known is None or not point.pressure else f"{known / point.pressure - 1.0:+.1%}",
        )
    if len(pairs) > ROWS:
        table.add_row("…", "", "", f"{len(pairs) - ROWS} more", "", "")
    return table


def _fits(found: InVitro) -> Table:
    table = Table(box=box.SIMPLE_HEAD)
    for name in ("", "value", "95 % interval"):
        table.add_column(name)
    here = found.comparison
    share = f"{here.compared} of {len(here.points)} points"
    if here.bias is not None and here.rmse is not None:
        table.add_row("bias, model less measured", f"{here.bias / 1e3:+.3g} kPa", share)
        table.add_row("RMSE", f"{here.rmse / 1e3:.3g} kPa", "")
    if here.r_squared is not None:
        table.add_row("R²", f"{here.r_squared:.4f}", "")
    table.add_row("friction that fits", f"{found.friction.value:.3g}", _interval(found.friction))
    joint = found.joint
    if joint is None:
        return table
    table.add_section()
    table.add_row("with stiffness unknown: friction", f"{joint.friction.value:.3g}",
                  _interval(joint.friction))  # fmt: skip
    table.add_row("stiffness, times the material's", f"{joint.stiffness.value:.3g}",
                  _interval(joint.stiffness))  # fmt: skip
    if joint.correlation is not None:
        told = "they trade off" if abs(joint.correlation) > CLOSE else ""
        table.add_row("correlation of the two", f"{joint.correlation:+.3f}", told)
    return table


def _interval(estimate: Estimate) -> str:
    ends = ("open" if end is None else f"{end:.3g}" for end in (estimate.low, estimate.high))
    return " to ".join(ends)


def _estimate(estimate: Estimate) -> dict[str, float | None]:
    return {"value": estimate.value, "low": estimate.low, "high": estimate.high}


def _agreement(comparison: Comparison) -> dict[str, Any]:
    bias, rmse = comparison.bias, comparison.rmse
    return {
        "bias_kPa": None if bias is None else bias / 1e3,
        "rmse_kPa": None if rmse is None else rmse / 1e3,
        "r_squared": comparison.r_squared,
        "compared": comparison.compared,
        "not_compared": comparison.not_compared,
    }


def _rows(comparison: Comparison) -> list[list[Any]]:
    rows = []
    for point, answer in zip(comparison.points, comparison.answers, strict=True):
        error = None if answer.error is None else answer.error.critical_pressure
        rows.append([
            point.size_ratio,
            point.wall_ratio,
            point.confining_pressure / 1e3,
            point.pressure / 1e3,
            None if point.sd is None else point.sd / 1e3,
            answer.outcome.name,
            None if answer.pressure is None else answer.pressure / 1e3,
            None if error is None else error / 1e3,
        ])  # fmt: skip
    return rows
