"""A measured series and the model as tables."""

from __future__ import annotations

from rich import box
from rich.markup import escape
from rich.table import Table

from stonepass.bench.invitro import FittedParameter, InVitro
from stonepass.report.table import significant

__all__ = ["invitro_table"]

CLOSE = 0.9  # correlation from which two estimates are not determined separately
ROWS = 40  # points that a terminal shows


def invitro_table(found: InVitro) -> list[Table]:
    """Return a table of the points and the model, and one of the fitted numbers."""
    return [_points(found), _fits(found)]


def _points(found: InVitro) -> Table:
    comparison = found.comparison
    title = f"{escape(found.setting.material.name)} · friction {comparison.friction:.3g}"
    table = Table(box=box.SIMPLE_HEAD, title=title, title_justify="left")
    for name in (
        "ξ",
        "η",
        "P_out kPa",
        "measured kPa",
        "model kPa",
        "(model − measured) / measured",
    ):
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
    assumed = "The intervals assume that the errors of the points are independent."
    table = Table(box=box.SIMPLE_HEAD, caption=assumed, caption_justify="left")
    for name in ("", "value", "95 % confidence interval"):
        table.add_column(name)
    here = found.comparison
    share = f"{here.compared} of {len(here.points)} points"
    if here.bias is not None and here.rmse is not None:
        table.add_row("mean residual (model − measured)", f"{here.bias / 1e3:+.3g} kPa", share)
        table.add_row("RMSE", f"{here.rmse / 1e3:.3g} kPa", "")
    if here.r_squared is not None:
        table.add_row("R²", f"{here.r_squared:.4f}", "")
    table.add_row("fitted friction", f"{found.friction.value:.3g}", _interval(found.friction))
    joint = found.joint
    if joint is None:
        return table
    table.add_section()
    table.add_row("friction, fitted with stiffness", f"{joint.friction.value:.3g}",
                  _interval(joint.friction))  # fmt: skip
    table.add_row("stiffness over the material's", f"{joint.stiffness.value:.3g}",
                  _interval(joint.stiffness))  # fmt: skip
    if joint.correlation is not None:
        told = "not determined separately" if abs(joint.correlation) > CLOSE else ""
        table.add_row("correlation of the two", f"{joint.correlation:+.3f}", told)
    return table


def _interval(estimate: FittedParameter) -> str:
    ends = ("open" if end is None else f"{end:.3g}" for end in (estimate.low, estimate.high))
    return " to ".join(ends)
