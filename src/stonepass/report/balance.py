"""The panel of the force balance: resistance and drive over the angle at which contact begins."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from stonepass.array_types import Float
from stonepass.model.answer import Answer
from stonepass.report.style import COLOURS, angle_label, series, tidy
from stonepass.units import Values

__all__ = ["draw_balance", "draw_critical_angle"]


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
    axes.plot(degrees, resistance / 1e3, **series(0, marker=False), label="resistance")
    if friction is not None:
        axes.plot(degrees, friction / 1e3, ":", color=COLOURS["blue"], linewidth=1.0,
                  label="of which friction")  # fmt: skip
    axes.plot(degrees, drive / 1e3, **series(2, marker=False), label="drive")
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
        xlabel=angle_label(sphere=answer.case.stone.shape.spherical, name="α"),
        ylabel=r"force / ($\pi R_s^2$)  (kPa)",
    )
    axes.set_title("Forces when the wall is open up to α")
    axes.legend(loc="best")
    tidy(axes)


def draw_critical_angle(axes: Axes, answer: Answer, peak: float) -> None:
    """Draw up to `peak`, in the axes' unit, the angle to which the wall opens before P_ucr."""
    if answer.critical_angle is not None:
        degrees = np.degrees(answer.critical_angle)
        axes.plot([degrees, degrees], [0.0, peak], color=COLOURS["orange"], linestyle="--",
                  linewidth=1.2,
                  label=f"the wall opens up to {degrees:.1f}° at $P_{{ucr}}$")  # fmt: skip
