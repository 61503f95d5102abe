"""The stone in a meridian section, and the angles at which the wall touches it."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Arc, Polygon

from stonepass.model.problem import Problem
from stonepass.report.case_line import length_unit
from stonepass.report.style import COLOURS

__all__ = ["draw_radii", "draw_stone", "frame_section", "mark_angle", "polar_angle"]

ARC = 0.42  # radius of the arc of an angle over the stone's radius or half its length


def draw_stone(axes: Axes, case: Problem) -> None:
    """Fill the stone's section, in the unit of `length_unit`."""
    radius = case.size_ratio * length_unit(case)[0]
    rho, along = case.stone.shape.meridian(np.linspace(0.0, np.pi, 361))
    axes.add_patch(
        Polygon(
            radius * np.r_[np.c_[along, rho], np.c_[along, -rho][::-1]],
            facecolor=COLOURS["stone"],
            edgecolor=COLOURS["ink"],
            lw=0.8,
            zorder=1.5,  # above the colour of the urine, below lines
        )
    )


def draw_radii(axes: Axes, case: Problem, angles: Sequence[float]) -> None:
    """Draw dashed lines from the stone's centre to the ends of the contact, angles θ in rad."""
    radius = case.size_ratio * length_unit(case)[0]
    rho, along = case.stone.shape.meridian(np.array(angles))
    for r, z in zip(radius * rho, radius * along, strict=True):
        for half in (1.0, -1.0):
            axes.plot(
                [0.0, z], [0.0, half * r], color=COLOURS["grey"], linewidth=0.8, linestyle="--"
            )


def polar_angle(case: Problem, theta: float) -> float:
    """Return the angle in rad, seen from the stone's centre, between the upstream axis and θ.

    It is θ itself for a sphere; for other stones θ is a parameter (see `Shape`).
    """
    rho, along = case.stone.shape.meridian(np.array(theta))
    return float(np.arctan2(rho, -along))


def mark_angle(axes: Axes, case: Problem, theta: float, name: str) -> None:
    """Draw the arc from the upstream axis to θ in rad, and write the angle."""
    shape, radius = case.stone.shape, case.size_ratio * length_unit(case)[0]
    pole = -float(shape.meridian(np.array(0.0))[1])
    size = ARC * radius * min(1.0, pole)
    drawn = np.degrees(polar_angle(case, theta))
    look: dict[str, Any] = {"color": COLOURS["ink"], "linewidth": 0.8}
    axes.plot([-pole * radius, 0.0], [0.0, 0.0], linestyle="-.", **look)
    axes.add_patch(Arc((0.0, 0.0), 2 * size, 2 * size, theta1=180.0 - drawn, theta2=180.0,
                       zorder=2.0, **look))  # fmt: skip
    text = f"{name} = {np.degrees(theta):.1f}°"
    if not shape.spherical:
        text = f"{drawn:.1f}° as drawn,\n{text}\n(parametric)"
    axes.annotate(text, (-0.55 * pole * radius, -0.06 * radius), ha="center", va="top", fontsize=8)


def frame_section(axes: Axes, case: Problem, extent: float, height: float) -> None:
    """Set the limits of a section's axes, given as half ranges in their unit, and label them."""
    unit = length_unit(case)[1]
    axes.set(xlim=(-extent, extent), ylim=(-height, height), aspect="equal")
    axes.set(xlabel=f"axial position z ({unit}), urine from the left", ylabel=f"radius r ({unit})")
    axes.yaxis.set_major_formatter(lambda value, _: f"{abs(value):g}")
    axes.spines[["top", "right"]].set_visible(False)
