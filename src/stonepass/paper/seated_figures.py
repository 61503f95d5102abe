"""Figs 4, 5 and 7: the wall stretched over the stone, its stress, and the contact pressure."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Arc as Curve

from stonepass.export.vtu import write_vtu
from stonepass.fe.axisymmetric.wall_values import Field
from stonepass.model.case import Case
from stonepass.model.states.seated_state import SeatedState
from stonepass.paper.inputs import FRICTION, LATEX_WALLS, PUBLISHED, latex_case, ureter_case
from stonepass.paper.section import Asked, Claim, Illustration, Section, Table
from stonepass.report.revolve import revolved_figure
from stonepass.report.section import add_colour_bar, draw_section, element_rim, section_height
from stonepass.report.stone import draw_radii, frame_section, mark_angle
from stonepass.report.style import (
    COLOURS,
    SERIES,
    add_heading,
    angle_label,
    in_style,
    new_figure,
    ordered_colours,
    tidy,
)
from stonepass.studies.jobs import Job, PressureJob, Results

__all__ = ["Fig4", "Fig5", "Fig7"]

LATEX_SIZE = 1.2
SIZES = (1.1, 1.15, 1.2, 1.25, 1.3)  # size ratios of the additional profiles of Fig. 7
STEP = 0.25  # step of the data of the profiles in degrees
ASIDE = 0.05  # largest distance of the peak from the equator over half the contact
RIPPLE = 0.02  # largest oscillation due to the increments, as a fraction of the peak
EXTENT = 3.6  # half-length of the meshes that is drawn, in inner radii
SECTION_WIDTH = 4.4  # width of the sections of Figs 4 and 7 in inches


class Fig4:
    """Latex tubes: section and contact pressure of three walls."""

    def jobs(self, asked: Asked) -> list[Job[Any]]:
        """Return a job for each tube; its state keeps the stress field."""
        return [PressureJob(case, wall=True) for case in _latex()]

    def write(self, found: Results, asked: Asked, folder: Path) -> Section:
        """Draw the sections, write the profiles, and draw the middle tube in three dimensions."""
        states = [_state(found, case) for case in _latex()]
        return _sections(
            "Fig. 4: latex tubes over steel spheres",
            "fig4",
            states,
            "Latex tubes, ξ = 1.2, friction 0.475, pressed seating: radial compression in the "
            "wall with the mesh, and the contact pressure σ(θ).",
            folder,
        )


class Fig5:
    """The two ureters without the stone and with the stone in its place."""

    def jobs(self, asked: Asked) -> list[Job[Any]]:
        """Return a job for each ureter; its state keeps the stress field."""
        return [PressureJob(case, wall=True) for case in _ureters()]

    @in_style
    def write(self, found: Results, asked: Asked, folder: Path) -> Section:
        """Draw the meshes."""
        states = [_state(found, case) for case in _ureters()]
        figure = new_figure(8.4, 9.0)
        add_heading(figure, f"Human ureter · μ = {FRICTION:g} · model: paper")
        grid = figure.add_gridspec(2, 1, height_ratios=_heights(states))
        for k, state in enumerate(states):
            _meshes(figure.add_subplot(grid[k]), state, "ab"[k])
        caption = (
            "The finite-element mesh with the stone pressed in (blue, above the axis) and without "
            "the stone (grey, below the axis, with the outline of the stone where it first touches "
            "the lumen), at the published critical sizes. The elements have order 4 and become "
            "smaller towards the edge of the contact, which is a grid line."
        )
        rows = [
            [
                state.case.wall_ratio,
                state.case.size_ratio,
                state.solver.dofs,
                np.degrees(state.contact_angle),
                state.equator_contact_pressure / 1e3,
            ]
            for state in states
        ]
        header = ("wall_ratio", "size_ratio", "dofs", "contact_angle_deg",
                  "equator_contact_pressure_kPa")  # fmt: skip
        return Section.written(
            "Fig. 5: finite elements of the human ureter",
            "",
            folder,
            [Illustration("fig5", figure, caption)],
            [Table("fig5", header, rows)],
        )


class Fig7:
    """The two ureters: section and contact pressure, and its profile over the size of the stone."""

    def jobs(self, asked: Asked) -> list[Job[Any]]:
        """Return jobs for the two walls, with stress fields, and for stones of other sizes."""
        return [
            *(PressureJob(case, wall=True) for case in _ureters()),
            *(PressureJob(ureter_case(eta, xi)) for eta in PUBLISHED for xi in SIZES),
        ]

    @in_style
    def write(self, found: Results, asked: Asked, folder: Path) -> Section:
        """Draw the sections, write the profiles, and judge their form."""
        states = [_state(found, case) for case in _ureters()]
        section = _sections(
            "Fig. 7: contact pressure in the human ureter",
            "fig7",
            states,
            "The two walls at their published critical sizes, friction 0.5: radial compression in "
            "the wall, and the contact pressure σ(θ).",
            folder,
        )
        others = {
            eta: [_state(found, ureter_case(eta, xi), wall=False) for xi in SIZES]
            for eta in PUBLISHED
        }
        figure = _by_size(others)
        extra = Section.written(
            "",
            "",
            folder,
            [Illustration("fig7_sizes", figure, "Contact pressure for several sizes.")],
            [_profiles("fig7_sizes", [state for row in others.values() for state in row])],
        )
        return Section(
            section.title,
            section.text,
            section.pictures + extra.pictures,
            section.files + extra.files,
            (_single_peak([*states, *(state for row in others.values() for state in row)]),),
        )


@in_style
def _by_size(rows: dict[float, list[SeatedState]]) -> Figure:
    """Draw the contact pressure of stones of several sizes, a panel for each wall."""
    figure = new_figure(8.4, 4.2)
    add_heading(figure, f"Human ureter · μ = {FRICTION:g} · model: paper")
    panels = figure.subplots(1, len(rows), sharey=True)
    for k, (axes, (eta, row)) in enumerate(zip(panels, rows.items(), strict=True)):
        for n, (state, colour) in enumerate(zip(row, ordered_colours(len(row)), strict=True)):
            axes.plot(
                np.degrees(state.theta),
                state.contact_pressure / 1e3,
                color=colour,
                linestyle=SERIES[n % len(SERIES)][1],
                label=f"ξ = {state.case.size_ratio:g}",
            )
        axes.set(xlabel=angle_label(sphere=True))
        axes.set_title(f"{'ab'[k]}  η = {eta:.2f}")
        tidy(axes)
    panels[0].set(ylabel="contact pressure (kPa)", ylim=(0, None))
    panels[0].legend(loc="upper center")  # the thin wall presses less, so that there is room
    return figure


def _latex() -> list[Case]:
    return [latex_case(eta, LATEX_SIZE) for eta in LATEX_WALLS]


def _ureters() -> list[Case]:
    return [ureter_case(eta, xi) for eta, xi in PUBLISHED.items()]


def _state(found: Results, case: Case, *, wall: bool = True) -> SeatedState:
    state = found.answer(case, wall=wall).contact
    assert isinstance(state, SeatedState), "a sphere a little above the lumen is seated"
    return state


def _single_peak(states: Sequence[SeatedState]) -> Claim:
    """Return the claim that every profile has a single maximum near the equator."""
    humps, aside = [], []
    for state in states:
        theta, top = state.theta, state.peak_contact_pressure
        sigma = np.interp(np.linspace(theta[0], theta[-1], 25), theta, state.contact_pressure) / top
        steps, peak = np.diff(sigma), int(np.argmax(sigma))
        humps.append(bool((steps[:peak] > -RIPPLE).all() and (steps[peak:] < RIPPLE).all()))
        highest = theta[np.argmax(state.contact_pressure)]
        aside.append(abs(highest - np.pi / 2) / (np.pi / 2 - state.contact_angle))
    return Claim(
        "shape of the contact pressure over θ (Fig. 7)",
        "one maximum near the equator",
        f"one maximum in {sum(humps)} of {len(humps)} states, at most {max(aside):.1%} of half the "
        "contact away from the equator",
        all(humps) and max(aside) < ASIDE,
        "the values of the figure are not published; near means within 5 % of half the contact, "
        "and oscillations below 2 % of the peak, which come from the increments, do not count",
    )


@in_style
def _sections(
    title: str, name: str, states: Sequence[SeatedState], caption: str, folder: Path
) -> Section:
    heights = _heights(states)
    figure = new_figure(9.2, SECTION_WIDTH * sum(heights) + 0.75 * len(states))
    first = states[0].case
    add_heading(
        figure, f"{first.ureter.material.name} · μ = {first.stone.friction:g} · model: paper"
    )
    grid = figure.add_gridspec(len(states), 2, width_ratios=(1.7, 1.0), height_ratios=heights)
    sections = [figure.add_subplot(grid[k, 0]) for k in range(len(states))]
    top = max(state.peak_contact_pressure for state in states)
    extent = min(_extent(state) for state in states)
    profiles: list[Axes] = []
    for k, (axes, state) in enumerate(zip(sections, states, strict=True)):
        assert state.wall is not None
        image = draw_section(axes, state.wall, state.case, top, (-1.0, 1.0))
        axes.set_xlim(-extent, extent)
        draw_radii(axes, state.case, (state.contact_angle, state.downstream_angle))
        mark_angle(axes, state.case, state.contact_angle, r"$\alpha_0$")
        axes.set_title(
            f"{'abcdef'[k]}  η = {state.case.wall_ratio:g}, ξ = {state.case.size_ratio:g}"
        )
        shared = profiles[0] if profiles else None
        profiles.append(figure.add_subplot(grid[k, 1], sharex=shared, sharey=shared))
        _profile(profiles[-1], state)
    profiles[0].set_ylim(0.0, 1.05 * top / 1e3)
    add_colour_bar(sections, image, shrink=0.5)
    middle = states[len(states) // 2]
    assert middle.wall is not None
    solid = revolved_figure(middle.wall, middle.case, middle.peak_contact_pressure)
    write_vtu(folder / f"{name}.vtu", middle.wall, mirrored=True)
    revolved = (
        f"The section revolved about its axis, with a quarter cut away (η = "
        f"{middle.case.wall_ratio:g}); the file {name}.vtu has the whole tube with its stresses."
    )
    return Section.written(
        title,
        "",
        folder,
        [Illustration(name, figure, caption), Illustration(f"{name}_3d", solid, revolved)],
        [_profiles(name, states)],
        files=(f"{name}.vtu",),
    )


def _profile(axes: Axes, state: SeatedState) -> None:
    degrees, pressure = np.degrees(state.theta), state.contact_pressure / 1e3
    axes.fill_between(degrees, pressure, color=COLOURS["blue"], alpha=0.15, linewidth=0)
    axes.plot(degrees, pressure, color=COLOURS["blue"])
    axes.set(xlabel=angle_label(sphere=True), ylabel="contact pressure (kPa)")
    tidy(axes)


def _extent(state: SeatedState) -> float:
    """Return half the length that `draw_section` shows."""
    return 2.2 * state.case.size_ratio * state.case.stone.shape.reach + 0.6


def _heights(states: Sequence[SeatedState]) -> list[float]:
    """Return heights of panels over their common width, so that all have the same scale."""
    half = min(_extent(state) for state in states)
    return [section_height([state.wall]) / half for state in states if state.wall is not None]


def _profiles(name: str, states: Sequence[SeatedState]) -> Table:
    theta = np.arange(0.0, 180.0 + STEP / 2, STEP)
    header = ["theta_deg"]
    columns = [theta]
    for state in states:
        header.append(f"pressure_kPa_eta_{state.case.wall_ratio:g}_xi_{state.case.size_ratio:g}")
        columns.append(state.pressure_at(np.radians(theta)) / 1e3)
    return Table(name, header, np.column_stack(columns).tolist())


def _meshes(axes: Axes, state: SeatedState, panel: str) -> None:
    """Draw the deformed mesh above the axis in blue, and the undeformed one below it in grey."""
    wall, xi = state.wall, state.case.size_ratio
    assert wall is not None
    for half in (1.0, -1.0):
        for side in (1.0, -1.0):
            if half < 0.0:
                _lines(axes, wall, wall.R, wall.Z, side, half, COLOURS["grey"])
            else:
                _lines(axes, wall, wall.r, wall.z, side, half, COLOURS["blue"])
    axes.add_patch(
        Curve(
            (0.0, xi - 1.0), 2 * xi, 2 * xi, theta1=180, theta2=360, color=COLOURS["ink"], ls="--"
        )
    )
    axes.add_patch(Curve((0.0, 0.0), 2 * xi, 2 * xi, theta1=0, theta2=180, color=COLOURS["ink"]))
    axes.axhline(0.0, color=COLOURS["grey"], linewidth=0.7, linestyle="-.")
    eta = state.case.wall_ratio
    top = 1.08 * max(eta, float(wall.r.max()))
    frame_section(axes, state.case, EXTENT, top)
    for height, text, colour in (
        (0.5, "stone pressed in", COLOURS["blue"]),
        (-0.5, "before", COLOURS["grey"]),
    ):
        axes.annotate(text, (-0.97 * EXTENT, height), va="center", color=colour)
    axes.set_title(f"{panel}  η = {eta:.2f}, ξ = {xi:.2f}")


def _lines(
    axes: Axes,
    wall: Field,
    r: np.ndarray,
    z: np.ndarray,
    side: float,
    half: float,
    colour: str,
) -> None:
    """Draw the outlines of the elements."""
    path = element_rim(wall.r.shape[1])
    gap = np.full((len(r), 1), np.nan)
    x, y = (np.concatenate([values[:, path], gap], axis=1).ravel() for values in (z, r))
    axes.plot(side * x, half * y, color=colour, linewidth=0.5)
