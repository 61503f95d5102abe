"""Marks of published and computed critical sizes in figures."""

from __future__ import annotations

from typing import Any

from matplotlib.axes import Axes

from stonepass.report.style import COLOURS

__all__ = ["PUBLISHED_MARK", "draw_critical_size"]

# A large hollow star, so that the mark of the computed size is visible inside it.
PUBLISHED_MARK: dict[str, Any] = {
    "marker": "*",
    "markersize": 14,
    "linestyle": "none",
    "markerfacecolor": "none",
    "markeredgecolor": COLOURS["ink"],
}


def draw_critical_size(
    axes: Axes, size: float | None, published: float, limit: float, colour: str
) -> None:
    """Mark a computed size, with its number, and the published one at the limit in kPa."""
    if size is not None:
        axes.plot(size, limit, "o", color=colour, markersize=5, zorder=6)
        axes.annotate(f"{size:.3f}", (size, limit), xytext=(8, -14), textcoords="offset points",
                      color=colour, fontweight="bold")  # fmt: skip
    axes.plot(published, limit, **PUBLISHED_MARK, zorder=5)
