"""The stone in a meridian section, and the angles at which the wall touches it."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Polygon

from stonepass.model.problem import Problem
from stonepass.report.style import COLOURS

__all__ = ["draw_radii", "draw_stone"]


def draw_stone(axes: Axes, case: Problem) -> None:
    """Fill the stone's section, lengths in inner radii."""
    rho, along = case.stone.shape.meridian(np.linspace(0.0, np.pi, 361))
    axes.add_patch(
        Polygon(
            case.size_ratio * np.r_[np.c_[along, rho], np.c_[along, -rho][::-1]],
            facecolor=COLOURS["stone"],
            edgecolor=COLOURS["ink"],
            lw=0.8,
            zorder=1.5,  # above what fills the lumen, below lines
        )
    )


def draw_radii(axes: Axes, case: Problem, angles: Sequence[float]) -> None:
    """Dashed lines from the stone's centre to where the contact begins and ends, θ in rad."""
    rho, along = case.stone.shape.meridian(np.array(angles))
    for r, z in zip(case.size_ratio * rho, case.size_ratio * along, strict=True):
        for half in (1.0, -1.0):
            axes.plot(
                [0.0, z], [0.0, half * r], color=COLOURS["grey"], linewidth=0.8, linestyle="--"
            )
