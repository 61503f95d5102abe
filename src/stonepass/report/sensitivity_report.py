"""A sensitivity study as tables of a terminal: inputs with their indices, and the tornado."""

from __future__ import annotations

from rich import box
from rich.table import Table

from stonepass.report.printing import Part
from stonepass.studies.sensitivity.conclusions import conclusions
from stonepass.studies.sensitivity.estimate import Effects, IndexEstimate, Indices
from stonepass.studies.sensitivity.sensitivity import Sensitivity
from stonepass.studies.sensitivity.tornado import Bar, Tornado

__all__ = ["sensitivity_parts"]

BAR = 10  # characters of the longest bar


def sensitivity_parts(found: Sensitivity) -> list[Part]:
    """Return the table of the indices, those of the tornado, and the conclusions."""
    parts: list[Part] = []
    if found.main.inputs:
        parts.append(_indices(found))
    parts.append(_tornado(found, found.pressures))
    if found.sizes is not None:
        parts.append(_tornado(found, found.sizes))
    return [*parts, *conclusions(found)]


def _indices(found: Sensitivity) -> Table:
    main, sobol = found.main, found.study.method == "sobol"
    table = Table(
        box=box.SIMPLE_HEAD,
        title=f"Sensitivity of {main.response.title} · {found.source}",
        title_justify="left",
    )
    columns = ("total index", "first order") if sobol else ("mean |effect|", "standard deviation")
    for name in ("input", "uncertain", *columns, ""):
        table.add_column(name, justify="right" if name in columns else "left")
    largest = max(each.importance.value for each in main.inputs)
    for each in main.inputs:
        bar = "█" * round(BAR * max(each.importance.value, 0.0) / largest)
        uncertain = found.study.uncertain[each.key].describe()
        table.add_row(found.title(each.key), uncertain, *_cells(each, main.response.unit), bar)
    return table


def _cells(each: Indices | Effects, unit: str) -> tuple[str, str]:
    if isinstance(each, Indices):
        return _shown(each.total), _shown(each.first)
    return f"{_shown(each.mean_absolute)} {unit}".rstrip(), f"{each.spread:.2g} {unit}".rstrip()


def _shown(estimate: IndexEstimate) -> str:
    return f"{estimate.value:.2f} ± {estimate.half_width:.2f}"


def _tornado(found: Sensitivity, tornado: Tornado) -> Table:
    limit = "" if tornado.limit is None else f" at {tornado.limit / 1e3:.4g} kPa"
    centre = tornado.centre.describe(tornado.unit)
    table = Table(
        box=box.SIMPLE_HEAD,
        title=f"{tornado.quantity.capitalize()}{limit}, one input at a time · medians: {centre}",
        title_justify="left",
    )
    for name in ("input", "5 % quantile", tornado.unit, "95 % quantile", f"{tornado.unit} "):
        table.add_column(name, justify="left" if name == "input" else "right")
    for bar in tornado.bars:
        table.add_row(found.title(bar.key), *_ends(found, bar))
    return table


def _ends(found: Sensitivity, bar: Bar) -> list[str]:
    cells = []
    for end in (bar.low, bar.high):
        assert end.input is not None
        cells += [found.study.uncertain[bar.key].show(end.input), end.describe()]
    return cells
