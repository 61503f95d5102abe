"""The picture of a sweep: histograms, pairs of inputs, critical pressure over each input."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import Normalize
from matplotlib.figure import Figure

from stonepass.array_dataclass import array_dataclass
from stonepass.array_types import Bool, Float
from stonepass.errors import BadInput
from stonepass.io.column_names import unit_of
from stonepass.report.style import (
    COLOURS,
    SERIES,
    add_heading,
    in_style,
    new_figure,
    tidy,
)
from stonepass.studies.sweeps.results import SweepResults

__all__ = ["plot_sweep", "sweep_figure"]

MOST_INPUTS = 5  # of which the picture has panels
MOST_POINTS = 4000  # drawn in one panel
FEW = 12  # values of an input up to which each value has a bin of its own
SCATTERED = 400  # points up to which a pair of sampled inputs is drawn point by point
BINS = (5, 14)  # smallest and largest number of bins of an input with many values
PER_BIN = 24  # rows in each bin of a pair on average, within these numbers
ENOUGH = 8  # points of a bin for which a band is drawn
PANEL = 1.75  # size of a panel in inches
PRESSURE = "critical pressure (kPa)"
# Units of axes for the SI units of the columns, and the factors of the values.
SHOWN_UNITS = {"Pa": ("kPa", 1e-3), "m": ("mm", 1e3), "rad": ("°", 180.0 / np.pi)}


@array_dataclass
@dataclass(frozen=True)
class _Input:
    """The values of an input in all rows; names of categories have their indices as values."""

    label: str
    values: Float[np.ndarray, " n"]
    categories: tuple[str, ...] = ()

    @property
    def few(self) -> Float[np.ndarray, " k"] | None:
        """The different values if they are few, else None."""
        different = np.unique(self.values)
        return different if len(different) <= FEW else None

    @property
    def edges(self) -> Float[np.ndarray, " k"]:
        """Edges of the bins: around each of few values, or equal ones."""
        few = self.few
        if few is None:
            bins = int(np.clip(np.sqrt(len(self.values) / PER_BIN), *BINS))
            return np.linspace(self.values.min(), self.values.max(), bins + 1)
        if len(few) == 1:
            return few[0] + np.array([-0.5, 0.5]) * max(abs(few[0]), 1.0) * 0.1
        inner = (few[1:] + few[:-1]) / 2.0
        return np.array([2.0 * few[0] - inner[0], *inner, 2.0 * few[-1] - inner[-1]])


@in_style
def sweep_figure(found: SweepResults) -> Figure:
    """Draw histograms on the diagonal, pairs of inputs below it, and P_ucr over each input.

    A panel of a pair shows the mean critical pressure of the first model in each bin. The last row
    shows the critical pressure of every model; a line joins the medians, and a band contains 90 %
    of the cases.

    Raises
    ------
    BadInput
        No case is finished, or none has a critical pressure.
    """
    inputs, pressure, models = _data(found)
    shown = inputs[:MOST_INPUTS]
    count = len(shown) + 1
    size = max(PANEL * count + 1.2, 4.6)
    figure = new_figure(size, size - 0.4)
    add_heading(figure, _heading(found, len(inputs) - len(shown)))
    axes = figure.subplots(count, count, squeeze=False)
    first = models == found.models[0]
    scale, pairs = Normalize(), []
    for i in range(count):
        for j in range(count):
            panel = axes[i, j]
            if j > i:
                panel.set_axis_off()
            elif i == count - 1 and j == i:
                _histogram_of_pressure(panel, pressure, models, found.models)
            elif i == count - 1:
                _pressure_over(panel, shown[j], pressure, models, found.models)
            elif i == j:
                _histogram(panel, shown[i], np.isfinite(pressure))
            else:
                pairs.append(_pair(panel, shown[j], shown[i], pressure, first, scale))
            if j <= i:
                _frame(panel, i, j, count, shown)
    if pairs:
        means = [np.ma.compressed(each.get_array()) for each in pairs]
        scale.autoscale(np.concatenate(means))
        bar = figure.colorbar(pairs[0], ax=axes[: count - 1, -1], fraction=0.3, shrink=0.7)
        bar.set_label(f"mean {PRESSURE}")
        bar.outline.set_visible(False)
    _legend(figure, axes, found, np.isfinite(pressure))
    return figure


@in_style
def plot_sweep(found: SweepResults, axes: Axes) -> None:
    """Draw the histogram of the critical pressure of each model."""
    _, pressure, models = _data(found)
    _histogram_of_pressure(axes, pressure, models, found.models)
    axes.set(xlabel=PRESSURE, ylabel="cases")
    axes.set_title(f"{len(found)} of {found.cases} cases", loc="left", fontsize="medium")
    tidy(axes)
    if len(found.models) > 1:
        axes.legend()


def _data(
    found: SweepResults,
) -> tuple[list[_Input], Float[np.ndarray, " n"], Any]:
    """Return the inputs, P_ucr in kPa (NaN where there is none), and the models of all rows."""
    table = found.table([*found.inputs, "model", "critical_pressure_kPa"])
    pressure = table["critical_pressure_kPa"].to_numpy().astype(float)
    if not np.isfinite(pressure).any():
        raise BadInput("figure", f"of {len(found)} cases", "asked for where there is a critical "
                       "pressure")  # fmt: skip
    models = np.array(table["model"].to_pylist(), dtype=object)
    return [_input(found, table, name) for name in found.inputs], pressure, models


def _input(found: SweepResults, table: Any, name: str) -> _Input:
    if found.columns[name] in ("double", "int64"):
        label, factor = _label(name)
        return _Input(label, table[name].to_numpy().astype(float) * factor)
    texts = [str(each) for each in table[name].to_pylist()]
    words = tuple(dict.fromkeys(texts))
    return _Input(_label(name)[0], np.array([float(words.index(each)) for each in texts]), words)


def _label(column: str) -> tuple[str, float]:
    """Return the label of an axis, e.g. ``C10 (kPa)``, and the factor of the values of a column."""
    unit = unit_of(column)
    if not unit:
        return column.replace("_", " "), 1.0
    shown, factor = SHOWN_UNITS.get(unit, (unit, 1.0))
    return f"{column.removesuffix(f'_{unit}').replace('_', ' ')} ({shown})", factor


def _heading(found: SweepResults, left_out: int) -> str:
    finished = f"{len(found)} of {found.cases} cases"
    more = f" · {left_out} more inputs are not drawn" if left_out else ""
    return f"{finished} · model {', '.join(found.models)}{more}"


def _histogram(panel: Axes, given: _Input, answered: Bool[np.ndarray, " n"]) -> None:
    parts = [given.values[answered], given.values[~answered]]
    panel.hist(parts, given.edges.tolist(), stacked=True, rwidth=0.9,
               color=[COLOURS["stone"], COLOURS["grey"]])  # fmt: skip


def _histogram_of_pressure(
    panel: Axes,
    pressure: Float[np.ndarray, " n"],
    models: Any,
    labels: tuple[str, ...],
) -> None:
    known = pressure[np.isfinite(pressure)]
    top = max(known.max(), known.min() + 1e-9)
    edges = np.linspace(known.min(), top, 2 * BINS[1] + 1).tolist()
    for k, label in enumerate(labels):
        colour, line, _ = SERIES[k % len(SERIES)]
        values = pressure[(models == label) & np.isfinite(pressure)]
        panel.hist(values, edges, histtype="stepfilled", color=COLOURS[colour], alpha=0.25)
        panel.hist(values, edges, histtype="step", color=COLOURS[colour], linestyle=line,
                   linewidth=1.2, label=label)  # fmt: skip


def _pair(
    panel: Axes,
    across: _Input,
    up: _Input,
    pressure: Float[np.ndarray, " n"],
    first: Bool[np.ndarray, " n"],
    scale: Normalize,
) -> Any:
    """Draw the mean critical pressure over two inputs, and crosses where there is none."""
    known = first & np.isfinite(pressure)
    lost = first & ~np.isfinite(pressure)
    look: dict[str, Any] = {"cmap": "viridis", "norm": scale}
    scattered = across.few is None and up.few is None and known.sum() <= SCATTERED
    if scattered:
        drawn: Any = panel.scatter(across.values[known], up.values[known], c=pressure[known], s=9,
                                   linewidths=0, **look)  # fmt: skip
    else:
        edges = (across.edges, up.edges)
        where = (across.values[known], up.values[known])
        total, *_ = np.histogram2d(*where, bins=edges, weights=pressure[known])
        count, *_ = np.histogram2d(*where, bins=edges)
        mean = np.ma.masked_where(count == 0, total / np.maximum(count, 1))
        drawn = panel.pcolormesh(*edges, mean.T, edgecolors="white", linewidth=0.4, **look)
    if lost.any() and scattered:
        panel.plot(across.values[lost], up.values[lost], "x", color=COLOURS["grey"], markersize=3)
    return drawn


def _pressure_over(
    panel: Axes,
    given: _Input,
    pressure: Float[np.ndarray, " n"],
    models: Any,
    labels: tuple[str, ...],
) -> None:
    """Draw P_ucr of each model over one input: points, medians, and bands of 90 %."""
    for k, label in enumerate(labels):
        colour, line, mark = SERIES[k % len(SERIES)]
        own = (models == label) & np.isfinite(pressure)
        x, y = given.values[own], pressure[own]
        some = np.random.default_rng(0).permutation(len(x))[:MOST_POINTS]
        panel.plot(x[some], y[some], mark, color=COLOURS[colour], markersize=1.6, alpha=0.25,
                   markeredgewidth=0, zorder=1, rasterized=len(some) > 1000)  # fmt: skip
        middle, low, median, high = _bands(given, x, y)
        if len(middle):
            _band(panel, given, middle, low, high, COLOURS[colour])
            joined = "none" if given.categories else line
            panel.plot(middle, median, color=COLOURS[colour], linestyle=joined, linewidth=1.4,
                       marker=mark, markersize=2.5)  # fmt: skip
    lost = np.unique(given.values[~np.isfinite(pressure)])[:MOST_POINTS]
    if len(lost):  # the layout fails with a line that has no points
        panel.plot(lost, np.full(len(lost), 1.0), "|", color=COLOURS["grey"], markersize=5,
                   clip_on=False, transform=panel.get_xaxis_transform())  # fmt: skip
    panel.set_ylim(bottom=0.0)


def _band(panel: Axes, given: _Input, middle: Any, low: Any, high: Any, colour: str) -> None:
    """Draw a band between quantiles, or bars for an input whose values are names."""
    if given.categories:
        panel.vlines(middle, low, high, color=colour, alpha=0.25, linewidth=7)
    else:
        panel.fill_between(middle, low, high, color=colour, alpha=0.15, linewidth=0)


def _bands(
    given: _Input, x: Float[np.ndarray, " n"], y: Float[np.ndarray, " n"]
) -> tuple[list[float], list[float], list[float], list[float]]:
    """Return centres of bins with enough points, and the 5 %, 50 % and 95 % quantiles in them."""
    edges, few = given.edges, given.few
    centres = (edges[1:] + edges[:-1]) / 2.0 if few is None else few
    where = np.clip(np.searchsorted(edges, x, side="right") - 1, 0, len(centres) - 1)
    found: list[tuple[float, ...]] = []
    for k, centre in enumerate(centres):
        inside = y[where == k]
        if len(inside) >= ENOUGH:
            found.append((float(centre), *np.quantile(inside, [0.05, 0.5, 0.95]).tolist()))
    middle, low, median, high = ([row[c] for row in found] for c in range(4))
    return middle, low, median, high


def _frame(panel: Axes, i: int, j: int, count: int, shown: list[_Input]) -> None:
    """Label the outer axes of the triangle only."""
    tidy(panel)
    panel.grid(visible=False)
    panel.tick_params(labelsize=7.0)
    panel.locator_params(nbins=4)
    last = i == count - 1
    if not (last and j == i):
        _scale(panel, shown[j], "x")
    if j < i and not last:
        _scale(panel, shown[i], "y")
    if last:
        panel.set_xlabel(PRESSURE if j == i else shown[j].label)
    else:
        panel.tick_params(labelbottom=False)
    if j == i:
        panel.set_yticks([])
        panel.spines["left"].set_visible(False)
    elif j == 0:
        panel.set_ylabel(PRESSURE if last else shown[i].label)
    else:
        panel.tick_params(labelleft=False)


def _scale(panel: Axes, given: _Input, direction: str) -> None:
    """Let all panels of an input show the same range, and its names where it has names."""
    ends = (float(given.edges[0]), float(given.edges[-1]))
    if direction == "x":
        panel.set_xlim(*ends)
    else:
        panel.set_ylim(*ends)
    if given.categories:
        ticks = panel.set_xticks if direction == "x" else panel.set_yticks
        ticks(range(len(given.categories)), given.categories)


def _legend(
    figure: Figure, axes: Any, found: SweepResults, answered: Bool[np.ndarray, " n"]
) -> None:
    """Explain the colours beside the diagonal, where the triangle leaves room."""
    handles, labels = axes[-1, -1].get_legend_handles_labels()
    if not answered.all():
        handles.append(axes[0, 0].containers[-1][0])
        labels.append("without a critical pressure")
    if len(found.models) > 1 or not answered.all():
        axes[0, -1].legend(handles, labels, loc="upper right")
