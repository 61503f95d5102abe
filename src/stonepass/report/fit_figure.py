"""The picture of a fit: what was measured with the law through it, and the residuals."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stonepass.bench.law_fit import FittedLaw
from stonepass.materials.constants import shown_constant
from stonepass.materials.known_laws import constants_by_name, name_of_law
from stonepass.report.style import COLOURS, add_heading, in_style, new_figure, series, tidy

__all__ = ["fit_figure"]


@in_style
def fit_figure(found: FittedLaw) -> Figure:
    """Draw data and law with its 95 % band on the left, residuals on the right."""
    figure = new_figure(9.2, 4.2)
    name = name_of_law(found.material.law)
    known = constants_by_name(name)
    constants = (f"{c.name} = {shown_constant(c.value, known[c.name])}" for c in found.constants)
    add_heading(figure, f"{name} law: {', '.join(constants)}")
    left, right = figure.add_subplot(1, 2, 1), figure.add_subplot(1, 2, 2)
    data = found.data
    for k, group in enumerate(dict.fromkeys(data.groups)):
        _draw_group(left, right, found, group, k)
    right.axhline(0.0, color=COLOURS["grey"], linewidth=0.9)
    strip = data.measured == "nominal stress"
    label = "stretch" if strip else "inner radius / inner radius at rest"
    left.set(xlabel=label, ylabel=f"{data.measured} (kPa)")
    left.set_title(f"Measured and fitted: R² = {found.r_squared:.4f}")
    right.set(xlabel=label, ylabel="residual: law − measured (kPa)")
    right.set_title(f"Residuals: root mean square {found.rmse / 1e3:.3g} kPa")
    for axes in (left, right):
        axes.legend()
        tidy(axes)
    return figure


def _draw_group(left: Axes, right: Axes, found: FittedLaw, group: str, k: int) -> None:
    """One curve of the data: marks for what was measured, a line and a band for the law."""
    data = found.data
    chosen = np.array(data.groups) == group
    order = np.argsort(data.abscissa[chosen])

    def sorted_kpa(values: np.ndarray) -> np.ndarray:
        kilopascals: np.ndarray = values[chosen][order] / 1e3
        return kilopascals

    x, look = data.abscissa[chosen][order], series(k)
    points = {"color": look["color"], "marker": look["marker"], "linestyle": "none"}
    predicted, band = sorted_kpa(found.predicted), sorted_kpa(found.band)
    left.plot(x, sorted_kpa(data.observed), **points, markersize=4, markerfacecolor="white",
              label=f"{group}, measured")  # fmt: skip
    left.fill_between(x, predicted - band, predicted + band, color=look["color"], alpha=0.2, lw=0,
                      label=None if k else "95 % confidence band of the law")  # fmt: skip
    left.plot(x, predicted, **series(k, marker=False), label=f"{group}, law")
    right.plot(x, sorted_kpa(found.residuals), **points, markersize=4, label=group)
