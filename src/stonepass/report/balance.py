"""The panel of the force balance: resistance and drive over the angle the wall is open to."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from stonepass.array_types import Float
from stonepass.model.answer import Answer
from stonepass.report.style import COLOURS, tidy
from stonepass.units import Values

__all__ = ["draw_balance"]


def draw_balance(
    axes: Axes,
    answer: Answer,
    alpha: Float[np.ndarray, " n"],
    resistance: Values,
    drive: Values,
    friction: Values | None = None,
) -> None:
    """Draw forces over π R_s² in Pa at angles α, and where they cross; `friction` resists too."""
    degrees = np.degrees(alpha)
    axes.plot(degrees, resistance / 1e3, color=COLOURS["blue"], label="resistance")
    if friction is not None:
        axes.plot(degrees, friction / 1e3, ":", color=COLOURS["blue"], linewidth=0.9,
                  label="part due to friction")  # fmt: skip
    axes.plot(degrees, drive / 1e3, color=COLOURS["green"], label="drive")
    if answer.pressure is not None and answer.critical_angle is not None:
        height = np.interp(answer.critical_angle, alpha, np.asarray(resistance)) / 1e3
        axes.plot(
            np.degrees(answer.critical_angle),
            height,
            marker="o",
            color=COLOURS["orange"],
            linestyle="none",
            label=rf"$P_{{ucr}}$ = {answer.pressure / 1e3:.4g} kPa",
        )
    axes.set(
        xlabel="angle α up to which the wall is open (°)", ylabel=r"force / ($\pi R_s^2$)  (kPa)"
    )
    axes.set_title("Resistance and drive")
    axes.legend(fontsize=8)
    tidy(axes)
