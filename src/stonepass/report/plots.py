"""The main graph of each result, drawn on axes that the caller chooses."""

from __future__ import annotations

import numpy as np
from matplotlib.axes import Axes

from stonepass.bench.invitro import InVitro
from stonepass.bench.law_fit import FittedLaw
from stonepass.clinic.assessment import Assessment
from stonepass.errors import BadInput
from stonepass.model.answer import Answer
from stonepass.model.size import SizeAnswer
from stonepass.report.case_line import case_line
from stonepass.report.contact_figure import draw_contact
from stonepass.report.curve_figure import draw_curve, frame_curve
from stonepass.report.fit_figure import draw_fit
from stonepass.report.friction_figure import draw_baseline
from stonepass.report.sensitivity_figure import draw_tornado, explain_tornado
from stonepass.report.style import COLOURS, tidy
from stonepass.studies.closures import CLOSURES, EXACT, ClosureComparison
from stonepass.studies.curve import CriticalCurve
from stonepass.studies.rising import Rising
from stonepass.studies.sensitivity.sensitivity import Sensitivity
from stonepass.surface.friction_result import SurfaceFriction

__all__ = [
    "plot_answer",
    "plot_assessment",
    "plot_closures",
    "plot_curve",
    "plot_fit",
    "plot_friction",
    "plot_rising",
    "plot_sensitivity",
    "plot_series",
    "plot_size",
]

POINTS = 400  # points of a drawn line


def plot_answer(answer: Answer, axes: Axes) -> None:
    """Draw the contact pressure over the angle on the stone, and the critical angle."""
    if answer.contact is None:
        raise BadInput("plot", answer.outcome.name, "asked for where there is a contact to draw")
    draw_contact(axes, answer)
    if answer.critical_angle is not None:
        axes.axvline(
            np.degrees(answer.critical_angle),
            color=COLOURS["orange"],
            linestyle="--",
            label=f"the wall opens to {np.degrees(answer.critical_angle):.1f}°",
        )
    axes.set_title(case_line(answer.case), loc="left", fontsize="medium")
    axes.legend()


def plot_size(answer: SizeAnswer, axes: Axes) -> None:
    """Draw the contact pressure on a stone of the critical size."""
    if answer.at_size is None or answer.size_ratio is None:
        raise BadInput("plot", answer.outcome.name, "asked for where a critical size was found")
    plot_answer(answer.at_size, axes)


def plot_curve(curve: CriticalCurve, axes: Axes) -> None:
    """Draw the critical pressure over the size ratio; crosses mark sizes without an answer."""
    draw_curve(axes, curve, 0, f"model {curve[0].model.NAME}")
    frame_curve(axes)
    axes.set_title(case_line(curve[0].case, with_stone=False), loc="left", fontsize="medium")
    axes.legend()


def plot_closures(found: ClosureComparison, axes: Axes) -> None:
    """Draw the critical pressure by each closure, with the direct model as a line."""
    names = [name for name in CLOSURES if found.pressures[name] is not None]
    if not names:
        raise BadInput("plot", found.outcome.name, "asked for where a closure has a pressure")
    pressures = [(found.pressures[name] or 0.0) / 1e3 for name in names]
    axes.barh(names, pressures, color=COLOURS["blue"], height=0.6)
    direct = found.pressures[EXACT]
    if direct is not None:
        axes.axvline(direct / 1e3, color=COLOURS["orange"], linestyle="--", label="direct model")
        axes.legend()
    axes.invert_yaxis()
    axes.set(xlabel="critical pressure (kPa)", ylabel="closure")
    axes.set_title(case_line(found.case), loc="left", fontsize="medium")
    tidy(axes)


def plot_rising(rising: Rising, axes: Axes) -> None:
    """Draw the axial force on the held stone over the urine pressure."""
    if not rising.states:
        raise BadInput("plot", rising.critical.outcome.name, "asked for where a state was found")
    axes.axhline(0.0, color=COLOURS["grey"], linewidth=0.8)
    axes.plot(
        [state.urine_pressure / 1e3 for state in rising.states],
        [state.net_force / 1e3 for state in rising.states],
        marker="o",
        markersize=3,
        color=COLOURS["blue"],
        label="net force over the cross-section of the stone",
    )
    if rising.critical.pressure:
        axes.axvline(rising.critical.pressure / 1e3, color=COLOURS["orange"], linestyle="--",
                     label="critical pressure")  # fmt: skip
    axes.set(xlabel="urine pressure (kPa)", ylabel="net force / area (kPa)")
    axes.set_title(case_line(rising.critical.case), loc="left", fontsize="medium")
    axes.legend()
    tidy(axes)


def plot_fit(found: FittedLaw, axes: Axes) -> None:
    """Draw the measured points and the fitted law with its 95 % confidence band."""
    draw_fit(axes, found)
    axes.set_title(found.summary().partition(";")[0], loc="left", fontsize="medium")


def plot_series(found: InVitro, axes: Axes) -> None:
    """Draw the model's critical pressure over the measured one, with the line of equality."""
    shown = found.comparison
    measured, predicted = shown.measured / 1e3, shown.predicted / 1e3
    if not shown.compared:
        raise BadInput("plot", "a series without answers", "asked for where a point has an answer")
    top = 1.05 * float(max(measured.max(), predicted.max()))
    axes.plot([0.0, top], [0.0, top], color=COLOURS["grey"], linewidth=0.8, label="equality")
    axes.plot(measured, predicted, "o", color=COLOURS["blue"],
              label=f"model at friction {shown.friction:.3g}")  # fmt: skip
    axes.set(xlabel="measured critical pressure (kPa)", ylabel="critical pressure, model (kPa)")
    axes.set_title(found.summary().partition(",")[0], loc="left", fontsize="medium")
    axes.legend()
    tidy(axes)


def plot_friction(found: SurfaceFriction, axes: Axes) -> None:
    """Draw the mean profile of the surface with its baseline and the steepest tangent."""
    draw_baseline(axes, found, 0)
    axes.set_title(found.summary().partition(",")[0], loc="left", fontsize="medium")
    axes.legend()
    tidy(axes)


def plot_assessment(found: Assessment, axes: Axes) -> None:
    """Draw the fraction of samples whose critical pressure is below a pressure."""
    samples, limit = found.samples, float(found.patient.limit)
    if samples is None:
        raise BadInput("plot", found.outcome.name, "asked for where there are samples to draw")
    grid = np.linspace(0.0, 2.0 * limit, POINTS)[1:]
    fractions = [samples.below(float(pressure)) for pressure in grid]
    low = np.array([each.low for each in fractions])
    high = np.array([each.high for each in fractions])
    axes.fill_between(grid / 1e3, 100 * low, 100 * high, color=COLOURS["blue"], alpha=0.2,
                      linewidth=0)  # fmt: skip
    axes.plot(grid / 1e3, 100 * low, color=COLOURS["blue"], label="critical pressure is below")
    axes.axvline(limit / 1e3, color=COLOURS["orange"], linestyle="--", label="pressure limit")
    axes.set(xlabel="pressure (kPa)", ylabel="fraction of samples (%)", ylim=(0.0, 100.0))
    axes.set_title(found.summary(), loc="left", fontsize="medium")
    axes.legend()
    tidy(axes)


def plot_sensitivity(found: Sensitivity, axes: Axes) -> None:
    """Draw the tornado of the critical pressure."""
    draw_tornado(axes, found, found.pressures)
    explain_tornado(axes)
