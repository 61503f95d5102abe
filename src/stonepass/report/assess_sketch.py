"""The sketch of an assessment: stone and ureter to scale at the measured values."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from stonepass.array_types import Float
from stonepass.clinic.assessment import Assessment
from stonepass.report.style import COLOURS, in_style, new_figure

__all__ = ["sketch_figure"]

WIDTH = 5.0  # inches
POINTS = 801
SMOOTHING = 0.35  # length of the transitions, in inner diameters
WALL = "#E8B9A0"
URINE = "#F6E9B2"


@in_style
def sketch_figure(found: Assessment) -> Figure:
    """Draw a longitudinal section in mm: the dilated segment, the stone, and the ureter below it.

    The diameters of stone and ureter are to scale. The transition between the segments is
    schematic; the wall keeps its cross-section.
    """
    sizes = {name: 1e3 * each.value for name, each in found.patient.measured.items()}
    stone, inner = sizes["stone_diameter"] / 2.0, sizes["inner_diameter"] / 2.0
    upstream = sizes.get("dilated_inner_diameter", 2.0 * inner) / 2.0
    aspect = found.patient.shape.aspect
    reach = aspect * stone + 2.5 * inner
    z = np.linspace(-1.6 * reach, 1.6 * reach, POINTS)
    radius = _lumen(z, stone, aspect, inner, upstream)
    outer = np.sqrt(radius**2 + found.patient.case().ureter.wall_ratio ** 2 * inner**2 - inner**2)
    half = 1.45 * float(outer.max())
    figure = new_figure(WIDTH, WIDTH * (2.0 * half + 0.9 * inner) / (3.2 * reach) + 0.1)
    axes = figure.add_subplot()
    _draw(axes, z, radius, outer)
    angle = np.linspace(0.0, 2.0 * np.pi, 200)
    axes.fill(aspect * stone * np.cos(angle), stone * np.sin(angle), facecolor=COLOURS["stone"],
              edgecolor=COLOURS["ink"], linewidth=1.0, zorder=3)  # fmt: skip
    _label(axes, found, z, outer)
    axes.set(xlim=(z[0], z[-1]), ylim=(-half, half), aspect="equal")
    axes.axis("off")
    return figure


def _lumen(
    z: Float[np.ndarray, " n"], stone: float, aspect: float, inner: float, upstream: float
) -> Float[np.ndarray, " n"]:
    """Return the inner radius of the wall, smooth between the segments and around the stone."""
    base = np.where(z < 0.0, upstream, inner)
    outline = stone * np.sqrt(np.clip(1.0 - (z / (aspect * stone)) ** 2, 0.0, None))
    step, width = z[1] - z[0], 2.0 * SMOOTHING * inner
    reach = np.arange(-3.0 * width, 3.0 * width + step, step)
    kernel = np.exp(-0.5 * (reach / width) ** 2)
    padded = np.pad(np.maximum(base, outline), len(reach) // 2, mode="edge")
    smooth = np.convolve(padded, kernel / kernel.sum(), mode="same")
    first = len(reach) // 2
    return np.maximum(smooth[first : first + len(z)], outline)


def _draw(
    axes: Axes,
    z: Float[np.ndarray, " n"],
    radius: Float[np.ndarray, " n"],
    outer: Float[np.ndarray, " n"],
) -> None:
    axes.fill_between(z, -radius, radius, color=URINE, linewidth=0)
    for side in (1.0, -1.0):
        axes.fill_between(z, side * radius, side * outer, facecolor=WALL, linewidth=0)
        for line in (radius, outer):
            axes.plot(z, side * line, color=COLOURS["ink"], linewidth=0.7)


def _label(
    axes: Axes,
    found: Assessment,
    z: Float[np.ndarray, " n"],
    outer: Float[np.ndarray, " n"],
) -> None:
    """Write the measured sizes, the direction of the urine and a scale bar."""
    measured = found.patient.measured
    told = {name: each.describe(1e-3, "mm") for name, each in measured.items()}
    left, right = 0.62 * z[0], 0.62 * z[-1]
    top = 1.08 * float(outer.max())
    small: dict[str, Any] = {"fontsize": 8, "ha": "center"}
    axes.text(0.0, 0.0, f"stone\n{told['stone_diameter']}", va="center", zorder=4, **small)
    if "dilated_inner_diameter" in told:
        axes.text(left, top, f"dilated, inside\n{told['dilated_inner_diameter']}", va="bottom",
                  **small)  # fmt: skip
    wall = told.get("wall_thickness")
    wall = f"outside {told['outer_diameter']}" if wall is None else f"wall {wall}"
    axes.text(right, top, f"ureter, inside\n{told['inner_diameter']}\n{wall}", va="bottom", **small)
    axes.annotate("", (0.55 * z[0], 0.0), (0.9 * z[0], 0.0),
                  arrowprops={"arrowstyle": "-|>", "color": COLOURS["ink"]})  # fmt: skip
    axes.text(0.72 * z[0], 0.12 * float(outer.max()), "urine", fontsize=8, ha="center")
    bar = -1.22 * float(outer.max())
    axes.plot([z[-1] - 5.0 - 0.05 * z[-1], 0.95 * z[-1]], [bar, bar], color=COLOURS["ink"], lw=1.4)
    axes.text(0.95 * z[-1] - 2.5, 1.04 * bar, "5 mm", fontsize=8, ha="center", va="top")
