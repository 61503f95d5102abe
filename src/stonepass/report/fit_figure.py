"""The picture of a fit: measured points, fitted law and residuals."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stonepass.array_types import Int
from stonepass.bench.law_fit import FittedLaw
from stonepass.materials.constants import shown_constant
from stonepass.materials.known_laws import constants_by_name, name_of_law
from stonepass.report.style import COLOURS, add_heading, in_style, new_figure, series, tidy

__all__ = ["draw_fit", "fit_figure"]


@in_style
def fit_figure(found: FittedLaw) -> Figure:
    """Draw data and law with its 95 % band on the left, residuals on the right."""
    figure = new_figure(9.2, 4.2)
    name = name_of_law(found.material.law)
    known = constants_by_name(name)
    constants = (f"{c.name} = {shown_constant(c.value, known[c.name])}" for c in found.constants)
    add_heading(figure, f"{name} law: {', '.join(constants)}")
    left, right = figure.add_subplot(1, 2, 1), figure.add_subplot(1, 2, 2)
    draw_fit(left, found)
    left.set_title(f"Measured and fitted: R² = {found.r_squared:.4f}")
    _draw_residuals(right, found)
    right.set_title(f"Residuals: root mean square {found.rmse / 1e3:.3g} kPa")
    return figure


def draw_fit(axes: Axes, found: FittedLaw) -> None:
    """Draw each curve of the data: marks for the data, a line and a 95 % band for the law."""
    for k, (group, order) in enumerate(_groups(found)):
        x, look = found.data.abscissa[order], series(k)
        predicted, band = found.predicted[order] / 1e3, found.band[order] / 1e3
        axes.plot(x, found.data.observed[order] / 1e3, **_marks(k), markersize=4,
                  markerfacecolor="white", label=f"{group}, measured")  # fmt: skip
        axes.fill_between(x, predicted - band, predicted + band, color=look["color"], alpha=0.2,
                          lw=0, label=None if k else "95 % confidence band of the law")  # fmt: skip
        axes.plot(x, predicted, **series(k, marker=False), label=f"{group}, law")
    axes.set(xlabel=_abscissa(found), ylabel=f"{found.data.measured} (kPa)")
    axes.legend()
    tidy(axes)


def _draw_residuals(axes: Axes, found: FittedLaw) -> None:
    for k, (group, order) in enumerate(_groups(found)):
        x = found.data.abscissa[order]
        axes.plot(x, found.residuals[order] / 1e3, **_marks(k), markersize=4, label=group)
    axes.axhline(0.0, color=COLOURS["grey"], linewidth=0.9)
    axes.set(xlabel=_abscissa(found), ylabel="residual: law − measured (kPa)")
    axes.legend()
    tidy(axes)


def _groups(found: FittedLaw) -> Iterator[tuple[str, Int[np.ndarray, " points"]]]:
    """Yield the name of each curve and the indices of its points, by rising abscissa."""
    names = np.array(found.data.groups)
    for name in dict.fromkeys(found.data.groups):
        chosen = np.flatnonzero(names == name)
        yield name, chosen[np.argsort(found.data.abscissa[chosen])]


def _marks(k: int) -> dict[str, Any]:
    look = series(k)
    return {"color": look["color"], "marker": look["marker"], "linestyle": "none"}


def _abscissa(found: FittedLaw) -> str:
    strip = found.data.measured == "nominal stress"
    return "stretch" if strip else "inner radius / inner radius at rest"
