"""The picture of a fit: what was measured with the law through it, and what is left."""

from __future__ import annotations

import numpy as np
from matplotlib.figure import Figure

from stonepass.bench.law_fit import FittedLaw
from stonepass.materials.known_laws import name_of_law
from stonepass.report.style import COLOURS, in_style, new_figure, tidy

__all__ = ["fit_figure"]

SHADES = ("blue", "orange", "green", "pink", "grey")


@in_style
def fit_figure(found: FittedLaw) -> Figure:
    """Draw data and law on the left, residuals on the right, one colour for each curve."""
    figure = new_figure(9.2, 3.8)
    left, right = figure.add_subplot(1, 2, 1), figure.add_subplot(1, 2, 2)
    data, groups = found.data, np.array(found.data.groups)
    for k, group in enumerate(dict.fromkeys(found.data.groups)):
        chosen = groups == group
        order = np.argsort(data.abscissa[chosen])
        x = data.abscissa[chosen][order]
        colour = COLOURS[SHADES[k % len(SHADES)]]
        left.plot(x, data.observed[chosen][order] / 1e3, "o", markersize=4, color=colour)
        left.plot(x, found.predicted[chosen][order] / 1e3, color=colour, label=group)
        right.plot(x, found.residuals[chosen][order] / 1e3, "o", markersize=4, color=colour)
    right.axhline(0.0, color=COLOURS["grey"], linewidth=0.9)
    label = "stretch" if data.measured == "nominal stress" else "inner radius over that at rest"
    left.set(xlabel=label, ylabel=f"{data.measured} (kPa)")
    left.set_title(f"{name_of_law(found.material.law)}: R² = {found.r_squared:.4f}")
    left.legend(fontsize=8)
    right.set(xlabel=label, ylabel="law less measured (kPa)")
    right.set_title(f"Residuals, RMSE {found.rmse / 1e3:.3g} kPa")
    for axes in (left, right):
        tidy(axes)
    return figure
