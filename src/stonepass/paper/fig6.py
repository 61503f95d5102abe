"""Fig. 6: critical pressure of spheres in latex tubes, in air and under water."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes

from stonepass.inputs.measured_pressures import Point
from stonepass.model.answer import Answer
from stonepass.model.case import Case
from stonepass.model.load import Load
from stonepass.paper.inputs import LATEX_FRICTION, LATEX_WALLS, WATER, latex_case
from stonepass.paper.section import Asked, Claim, Illustration, Section, answers_table
from stonepass.report.style import (
    COLOURS,
    SERIES,
    add_heading,
    add_mmhg_axis,
    in_style,
    mark_unanswered,
    new_figure,
    tidy,
)
from stonepass.studies.jobs import Job, PressureJob, Results

__all__ = ["Fig6"]

SIZES = tuple(float(x) for x in np.round(np.linspace(1.0, 1.5, 11), 10))
LOADS = (Load(), Load(WATER, "hydrostatic"), Load(WATER, "dead"))
SHADES = {eta: SERIES[k][0] for k, eta in enumerate(LATEX_WALLS)}
MARKS = {eta: SERIES[k][2] for k, eta in enumerate(LATEX_WALLS)}
LINES = ("-", "-", "--")
NO_ANSWER = "no answer: drive stays below resistance"


class Fig6:
    """Three tubes, in air and under 540 mm of water, with measured points if they are given."""

    def jobs(self, asked: Asked) -> list[Job[Any]]:
        """Return the cases of the curves and of the points."""
        curves = [
            PressureJob(latex_case(eta, xi, load))
            for load in LOADS
            for eta in LATEX_WALLS
            for xi in SIZES
        ]
        return [*curves, *(PressureJob(_case(point)) for point in asked.points)]

    @in_style
    def write(self, found: Results, asked: Asked, folder: Path) -> Section:
        """Draw both panels, write the curves, and compare them with the points."""
        figure = new_figure(9.2, 4.6)
        add_heading(figure, f"Steel spheres in latex tubes · μ = {LATEX_FRICTION:g} · model: paper")
        air, water = (figure.add_subplot(1, 2, k) for k in (1, 2))
        answers = []
        for load, line in zip(LOADS, LINES, strict=True):
            axes = water if load.confining_pressure > 0.0 else air
            for eta in LATEX_WALLS:
                curve = [found.answer(latex_case(eta, xi, load)) for xi in SIZES]
                label = f"η = {eta:g}" if line == "-" else None
                _draw(axes, curve, eta, line, label)
                answers += curve
        if asked.points:
            _draw_points(air, water, asked.points)
        water.plot([], [], color=COLOURS["ink"], linestyle="--", label="dead load (Eq. 10)")
        highest = max(air.get_ylim()[1], water.get_ylim()[1])
        for axes, title in ((air, "a  In air"), (water, f"b  Under {WATER / 1e3:g} kPa of water")):
            axes.set(xlabel="size ratio ξ", ylabel="critical pressure (kPa)", ylim=(0, highest))
            axes.set_title(title)
            axes.legend(loc="upper left", fontsize=8)
            tidy(axes)
            add_mmhg_axis(axes)
        caption = (
            "Critical pressure of steel spheres in latex tubes, friction 0.475. Under water the "
            "pressure on the outer wall is hydrostatic (solid); Eq. 10 keeps its resultant instead "
            "(dashed). Crosses at the top: no critical pressure, since drive and resistance do not "
            "balance before the closure ends (BEYOND_CLOSURE)."
        )
        header = ("wall_ratio", "confining_kPa", "confinement", "size_ratio", "outcome",
                  "critical_pressure_kPa", "critical_pressure_error_kPa")  # fmt: skip
        return Section.written(
            "Fig. 6: the in-vitro series",
            "",
            folder,
            [Illustration("fig6", figure, caption)],
            [answers_table("fig6", header, answers)],
            [_grows(found), _agreement(found, asked.points)],
        )


def _case(point: Point) -> Case:
    load = Load(point.confining_pressure, "hydrostatic" if point.confining_pressure else "dead")
    return latex_case(point.wall_ratio, point.size_ratio, load)


def _draw(axes: Axes, curve: Sequence[Answer], eta: float, line: str, label: str | None) -> None:
    axes.plot(
        [answer.case.size_ratio for answer in curve],
        [np.nan if answer.pressure is None else answer.pressure / 1e3 for answer in curve],
        color=COLOURS[SHADES[eta]],
        linestyle=line,
        marker=MARKS[eta],
        markersize=3,
        label=label,
    )
    lost = [answer.case.size_ratio for answer in curve if answer.pressure is None]
    told = NO_ANSWER in axes.get_legend_handles_labels()[1]
    mark_unanswered(axes, lost, "_" if told else NO_ANSWER, COLOURS[SHADES[eta]])


def _draw_points(air: Axes, water: Axes, points: Sequence[Point]) -> None:
    walls = sorted({point.wall_ratio for point in points})
    for axes, wet in ((air, False), (water, True)):
        for eta in walls:
            some = [p for p in points if p.wall_ratio == eta and (p.confining_pressure > 0) is wet]
            if some:
                axes.errorbar(
                    [point.size_ratio for point in some],
                    [point.pressure / 1e3 for point in some],
                    yerr=[0.0 if point.sd is None else point.sd / 1e3 for point in some],
                    fmt=MARKS.get(eta, "o"),
                    markersize=6,
                    markerfacecolor="white",
                    capsize=2,
                    color=COLOURS[SHADES.get(eta, "grey")],
                    label=f"measured, η = {eta:g}",
                )


def _grows(found: Results) -> Claim:
    steps = []
    for load in LOADS:
        for eta in LATEX_WALLS:
            curve = [found.answer(latex_case(eta, xi, load)).pressure for xi in SIZES]
            known = [pressure for pressure in curve if pressure is not None]
            steps += [after > before for before, after in pairwise(known)]
    return Claim(
        "in-vitro tubes: P_ucr grows with ξ (Fig. 6)",
        "yes",
        f"in {sum(steps)} of {len(steps)} steps",
        all(steps) and len(steps) > 50,
        "the curves themselves are not published",
    )


def _agreement(found: Results, points: Sequence[Point]) -> Claim:
    what = "in-vitro tubes: theory agrees with experiment (Fig. 6)"
    if not points:
        reason = "the measured points are not published; give yours as --points FILE.csv"
        return Claim(what, "agrees well", "not judged", None, reason)
    errors = []
    for point in points:
        pressure = found.answer(_case(point)).pressure
        if pressure is not None and point.pressure > 0.0:
            errors.append(pressure / point.pressure - 1.0)
    if not errors:
        return Claim(
            what, "agrees well", "no point has an answer", False, "no point can be compared"
        )
    rms, bias = float(np.sqrt(np.mean(np.square(errors)))), float(np.mean(errors))
    return Claim(
        what,
        "agrees well",
        f"bias {bias:+.1%}, root mean square {rms:.1%} over {len(errors)} points",
        rms <= 0.2,
        "agreement means a root mean square of at most 20 %, since no constant is fitted",
    )
