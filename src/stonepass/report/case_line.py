"""The case that a figure shows, in one line, and the unit of its lengths."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from stonepass.model.problem import Problem

__all__ = ["case_line", "length_unit"]


def length_unit(case: Problem) -> tuple[float, str]:
    """Return the length of one inner radius on the axes of a figure, and the unit of the axes.

    The unit is mm if the ureter has an inner diameter, otherwise the inner radius itself.
    """
    inner = case.ureter.inner_diameter
    return (1.0, "inner radii") if inner is None else (0.5e3 * inner, "mm")


def case_line(case: Problem, model: Any = None, *, with_stone: bool = True) -> str:
    """Return stone, ureter, wall, friction and load, and the model if one is given.

    Parameters
    ----------
    case : Problem
    model : Model, optional
        The line ends with its name.
    with_stone : bool
        False if the figure varies the size of the stone, so that the line leaves it out.
    """
    stone, ureter = case.stone, case.ureter
    parts = [_sizes(case, with_stone=with_stone), ureter.material.name, f"μ = {stone.friction:g}"]
    if not stone.shape.spheroidal:
        parts.append(f"shape {Path(stone.shape.reference).name or 'as given'}")
    elif stone.aspect != 1.0:
        parts.append(f"aspect {stone.aspect:g}")
    if case.load.confining_pressure > 0.0:
        pressure = f"{case.load.confining_pressure / 1e3:g} kPa"
        parts.append(f"confining pressure {pressure}, {case.load.confinement}")
    if case.load.prestretch != 1.0:
        parts.append(f"pre-stretch {case.load.prestretch:g}")
    if model is not None:
        parts.append(f"model: {model.NAME}")
    return " · ".join(parts)


def _sizes(case: Problem, *, with_stone: bool) -> str:
    inner, diameter = case.ureter.inner_diameter, case.stone_diameter
    ratios = [f"ξ = {case.size_ratio:.4g}"] if with_stone else []
    ratios.append(f"η = {case.wall_ratio:.4g}")
    if inner is None or diameter is None:
        return ", ".join(ratios)
    lengths = [f"stone {diameter * 1e3:.4g} mm"] if with_stone else []
    lengths.append(f"ureter {inner * 1e3:.4g}/{inner * case.wall_ratio * 1e3:.4g} mm")
    return f"{', '.join(lengths)} ({', '.join(ratios)})"
