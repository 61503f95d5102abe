"""Figures say what they show: cases, units and angles; colours and frames that can be told apart."""

import importlib.util
import json
import re
import sys
from dataclasses import replace
from itertools import combinations
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

import stonepass as sp
from stonepass.model.accuracy import ErrorEstimate
from stonepass.model.states.loaded_state import PushedState, PushReport
from stonepass.paper.page import write_page
from stonepass.paper.section import Asked, Section
from stonepass.report.answer_figure import answer_figure
from stonepass.report.case_line import case_line, length_unit
from stonepass.report.contact_figure import contact_figure
from stonepass.report.curve_figure import curve_figure
from stonepass.report.push_figure import draw_wall
from stonepass.report.rising_report import rising_figure, save_animation
from stonepass.report.stone import polar_angle
from stonepass.report.style import COLOURS, SERIES, in_style, new_figure, series, signed
from stonepass.studies.rising import Rising
from stonepass.units import Pressure

DOCS = Path(__file__).parents[1] / "docs"
BEAM = sp.ElasticFoundation(secant_stretch=1.3)
FAST = sp.Numerics("fast")
# Simulated colour vision in linear RGB (Machado et al. 2009, severity 1).
VISIONS = {
    "normal": np.eye(3),
    "deuteranopia": np.array(
        [
            [0.367322, 0.860646, -0.227968],
            [0.280085, 0.672501, 0.047413],
            [-0.011820, 0.042940, 0.968881],
        ]
    ),
    "protanopia": np.array(
        [
            [0.152286, 1.052583, -0.204868],
            [0.114503, 0.786281, 0.099216],
            [-0.003882, -0.048116, 1.051998],
        ]
    ),
}
DIMENSIONLESS = ("size ratio ξ", "critical size ratio", "wall ratio η", "stretch", "friction μ")


def loaded(name, folder="_ext"):
    """A module of the documentation."""
    path = DOCS / folder / f"{name}.py"
    spec = importlib.util.spec_from_file_location(name, path)
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module
    spec.loader.exec_module(module)
    return module


def linear(colour):
    parts = np.array([int(colour[k : k + 2], 16) for k in (1, 3, 5)]) / 255.0
    return np.where(parts <= 0.04045, parts / 12.92, ((parts + 0.055) / 1.055) ** 2.4)


def lab(rgb):
    """CIE L*a*b* of linear sRGB under D65."""
    to_xyz = np.array(
        [[0.41246, 0.35758, 0.18044], [0.21267, 0.71515, 0.07217], [0.01933, 0.11919, 0.95030]]
    )
    xyz = to_xyz @ np.clip(rgb, 0.0, 1.0) / (0.95047, 1.0, 1.08883)
    f = np.where(xyz > 216 / 24389, np.cbrt(xyz), (24389 / 27 * xyz + 16.0) / 116.0)
    return np.array([116.0 * f[1] - 16.0, 500.0 * (f[0] - f[1]), 200.0 * (f[1] - f[2])])


def distance(one, other, vision):
    """ΔE of two colours, as they are seen."""
    return np.linalg.norm(lab(vision @ linear(one)) - lab(vision @ linear(other)))


def test_the_measure_of_colours_is_right():
    """White is L* = 100, and red and green of equal lightness are near for deuteranopes alone."""
    np.testing.assert_allclose(lab(linear("#ffffff")), (100.0, 0.0, 0.0), atol=0.02)
    near, far = (distance("#B36A00", "#6F8A00", VISIONS[v]) for v in ("deuteranopia", "normal"))
    assert near < 0.5 * far


@pytest.mark.parametrize("vision", VISIONS)
def test_colours_of_data_are_told_apart(vision):
    colours = [COLOURS[name] for name, _, _ in SERIES]
    apart = [distance(*pair, VISIONS[vision]) for pair in combinations(colours, 2)]
    assert len(apart) == 10
    assert min(apart) > 15.0  # 2 are told apart side by side


def test_no_curve_is_told_by_its_colour_alone():
    assert len({str(line) for _, line, _ in SERIES}) == len(SERIES)
    assert len({mark for _, _, mark in SERIES}) == len(SERIES)
    assert series(len(SERIES)) == series(0)


def test_lines_stand_out_from_their_ground():
    """On white and, in the colours of the dark theme, on its ground."""
    dark = loaded("dark_colours")
    assert dark.contrast("#000000", "#ffffff") == pytest.approx(21.0)
    for name in {name for name, _, _ in SERIES} | {"grey"}:
        assert dark.contrast(COLOURS[name], "#ffffff") > 3.0
    for colour in (*(COLOURS[name] for name in COLOURS if name != "stone"), "#440154", "#3b528b"):
        assert dark.contrast(dark.dark_colour(colour.lower()), dark.GROUND) >= 3.0
    assert dark.dark('style="fill: #FFFFFF; stroke: #1f2937"') == (
        f'style="fill: {dark.GROUND}; stroke: #e5e7eb"'
    )


def problem(**stone):
    return sp.Case(sp.Stone(**stone), sp.Ureter(wall_ratio=1.5, material="latex"))


def test_the_line_that_names_a_case():
    assert case_line(problem(size_ratio=1.2, friction=0.3)) == "ξ = 1.2, η = 1.5 · latex · μ = 0.3"
    ureter = sp.Ureter("3.5 mm", "4.55 mm")
    case = sp.Case(sp.Stone("4.2 mm"), ureter, sp.Load("4 kPa", "hydrostatic"))
    line = "stone 4.2 mm, ureter 3.5/4.55 mm (ξ = 1.2, η = 1.3) · ureter · μ = 0.5"
    confined = "confining pressure 4 kPa, hydrostatic"
    assert case_line(case, case.model) == f"{line} · {confined} · model: paper"
    assert case_line(case, with_stone=False).startswith("ureter 3.5/4.55 mm (η = 1.3) · ureter")
    assert case_line(problem(size_ratio=1.2, aspect=1.4)).endswith("· aspect 1.4")
    egg = sp.read_shape(DOCS.parent / "examples" / "egg.csv")
    assert case_line(problem(size_ratio=1.2, shape=egg)).endswith("· shape egg.csv")
    assert length_unit(case) == (1.75, "mm")
    assert length_unit(problem(size_ratio=1.2)) == (1.0, "inner radii")


@pytest.fixture(scope="module")
def seated():
    """Answers of a spheroid by ratios, and of the same one in mm."""
    model = sp.SeatedBalance("frictionless")
    answers = []
    for stone, ureter in (
        (sp.Stone(size_ratio=1.2, aspect=1.5), sp.Ureter(wall_ratio=1.5, material="latex")),
        (sp.Stone("4.2 mm", aspect=1.5), sp.Ureter("3.5 mm", "5.25 mm", material="latex")),
    ):
        case = sp.Case(stone, ureter, model=model, numerics=FAST)
        if answers:  # the state does not know about millimetres, so that one solve serves
            answers.append(
                replace(answers[0], case=case, contact=replace(answers[0].contact, case=case))
            )
        else:
            answers.append(sp.solve(case))
    return answers


def pushed(answer, pressure, peak):
    """A made-up loaded state: the seated wall, with a contact pressure of another height."""
    state = answer.contact
    shape = state.contact_pressure / state.peak_contact_pressure
    return PushedState(
        case=answer.case,
        urine_pressure=pressure,
        net_force=pressure - 20e3,
        friction_work=0.0,
        theta=state.theta,
        contact_pressure=peak * shape,
        upstream_radius=1.0 + pressure / 1e6,
        upstream_stretch=1.0,
        downstream_stretch=1.0,
        wall=replace(state.wall, r=state.wall.r * (1.0 + pressure / 1e6)),
        solver=PushReport(1, 1, 0.0, 0.0, state.solver.volume, 0.0, 0.0),
        stability=state.stability,
        microbuckled=False,
    )


@pytest.fixture(scope="module")
def rising(seated):
    states = [pushed(seated[0], p, peak) for p, peak in ((0.0, 50e3), (8e3, 80e3), (16e3, 90e3))]
    critical = replace(seated[0], pressure=16e3, contact=states[-1])
    return Rising(critical, states, seated[0].contact, np.array([0.1, 0.2, 0.3]), "")


def beam(**given):
    ureter = sp.Ureter(**given or {"wall_ratio": 1.3})
    return [sp.solve(sp.Case(sp.Stone(size_ratio=x), ureter, model=BEAM)) for x in (1.1, 1.15, 1.2)]


@pytest.fixture(scope="module")
def figures(seated, rising):
    """Every figure of a case that needs no more than one quick solve."""
    return {
        "case": answer_figure(seated[0]),
        "millimetres": answer_figure(seated[1]),
        "push": answer_figure(rising.critical),
        "contact": contact_figure(seated[0]),
        "beam": answer_figure(beam()[1]),
        "rising": rising_figure(rising),
        "curve": curve_figure(beam()),
    }


def labels(figure):
    """Labels of every axis that is shown, those of second axes and colour bars included."""
    found = []
    for axes in figure.axes:
        for axis in (axes.xaxis, axes.yaxis):
            ticks = axis.get_ticklabels()
            bar = axes.get_label() == "<colorbar>"
            if axes.axison and ticks and not (bar and not axis.get_label_text()):
                found.append(axis.get_label_text())
        found += [child.yaxis.get_label_text() or child.xaxis.get_label_text()
                  for child in axes.child_axes]  # fmt: skip
    return found


def test_every_axis_has_a_label_with_its_unit(figures):
    found = [label for figure in figures.values() for label in labels(figure)]
    assert len(found) > 30
    plain = [
        label
        for label in found
        if not label.startswith(DIMENSIONLESS) and not label.split(", urine")[0].endswith(")")
    ]
    assert plain == []


def test_every_figure_names_its_case(figures):
    for name, figure in figures.items():
        text = figure.get_suptitle()
        parts = ["η = ", "μ = ", "latex" if name not in ("beam", "curve") else "ureter"]
        assert all(part in text for part in [*parts, "" if name == "curve" else "ξ = "]), name
    assert "stone 4.2 mm, ureter 3.5/5.25 mm" in figures["millimetres"].get_suptitle()


def test_the_angle_has_one_name(figures):
    found = {label for figure in figures.values() for label in labels(figure) if "θ" in label}
    assert found == {
        "angle θ from the upstream axis (°)",  # of the beam's sphere
        "parametric angle θ from the upstream axis (°)",
    }


def test_lengths_are_in_mm_where_mm_were_given(figures):
    ratio, mm = (figures[name].axes[0] for name in ("case", "millimetres"))
    np.testing.assert_allclose(mm.get_xlim(), 1.75 * np.array(ratio.get_xlim()))
    np.testing.assert_allclose(mm.get_ylim(), 1.75 * np.array(ratio.get_ylim()))
    assert mm.get_ylabel() == "radius r (mm)"
    assert ratio.get_ylabel() == "radius r (inner radii)"
    top = curve_figure(beam(inner_diameter="3.5 mm", wall_ratio=1.3)).axes[0].child_axes
    assert "stone diameter (mm)" in {axes.get_xlabel() for axes in top}


def test_the_angle_that_is_drawn_is_the_angle_that_is_told(seated, figures):
    """tan of the polar angle of a spheroid is tan θ over the aspect; the dashed line lies there."""
    case, alpha = seated[0].case, seated[0].contact.contact_angle
    drawn = np.arctan(np.tan(alpha) / 1.5)
    assert polar_angle(case, alpha) == pytest.approx(drawn)
    axes = figures["case"].axes[0]
    dashed = [line for line in axes.lines if line.get_linestyle() == "--"]
    (_, z), (_, r) = dashed[0].get_data()
    assert np.arctan2(r, -z) == pytest.approx(drawn)
    told = " ".join(text.get_text() for text in axes.texts)
    assert f"{np.degrees(drawn):.1f}° as drawn" in told
    assert f"{np.degrees(alpha):.1f}°\n(parametric)" in told
    (arc,) = [patch for patch in axes.patches if hasattr(patch, "theta1")]
    assert arc.theta2 - arc.theta1 == pytest.approx(np.degrees(drawn))


def test_the_wall_has_an_outline(seated, figures):
    """Inner and outer surface, both halves of the tube, above and below the axis."""
    solid = [line for line in figures["case"].axes[0].lines if line.get_linestyle() == "-"]
    wall = seated[0].contact.wall
    lowest = sorted(float(np.min(np.abs(line.get_ydata()))) for line in solid)
    assert len(lowest) == 8
    for radius, found in ((1.0, lowest[:4]), (1.5, lowest[4:])):
        on_it = wall.r[np.isclose(wall.R, radius)]
        np.testing.assert_allclose(found, on_it.min())


def test_the_seal_is_marked_on_the_section_and_the_leak_pressure_is_named(rising, figures):
    section, pressure = figures["push"].axes[0], figures["push"].axes[1]
    (seal,) = [line for line in section.lines if line.get_marker() == "o"]
    np.testing.assert_allclose(np.abs(seal.get_ydata()), 1.2 * np.sin(rising.states[-1].seal_angle))
    assert "seal" in {text.get_text() for text in section.texts}
    assert pressure.get_legend() is None


@in_style
def arrows(state, full):
    axes = new_figure(4.0, 3.0).add_subplot()
    draw_wall(axes, state, 1e5, full)
    return [abs(text.xy[1] - text.xyann[1]) for text in axes.texts if text.arrow_patch is not None]


def test_arrows_grow_with_the_pressure(rising):
    none, half, whole = (arrows(state, 16e3) for state in rising.states)
    assert none == []
    assert len(half) == len(whole) > 4
    assert max(whole) == pytest.approx(2.0 * max(half), rel=1e-2)


def test_all_frames_of_an_animation_have_the_same_axes(rising, tmp_path):
    ends = replace(rising, states=rising.states[::2])
    save_animation(ends, tmp_path / "a.gif")
    frames = []
    with Image.open(tmp_path / "a.gif") as made:
        for k in range(made.n_frames):
            made.seek(k)
            frames.append(np.asarray(made.convert("RGB")))
            assert made.info["duration"] >= 400
    assert len(frames) == 2
    assert tuple(frames[0][-2, 1]) == (255, 255, 255)
    # Tick labels and labels on the left stay where they are; what is inside the axes changes.
    height = len(frames[0])
    for rows in (slice(0, height // 2), slice(int(0.6 * height), height)):
        strips = [frame[rows, :45] for frame in frames]
        assert all(np.array_equal(strips[0], each) for each in strips[1:])
        assert (strips[0] < 128).any()
        assert not np.array_equal(frames[0][rows], frames[-1][rows])


def test_sizes_without_an_answer_are_not_drawn_as_pressures():
    first, second, last = beam()
    error = ErrorEstimate(1e-3, 100.0, 500.0)
    lost = replace(last, pressure=None, outcome=sp.Outcome.BEYOND_CLOSURE)
    axes = curve_figure([replace(first, error=error), second, lost]).axes[0]
    (cross,) = [line for line in axes.lines if line.get_marker() == "x"]
    assert cross.get_label() == "no answer: BEYOND_CLOSURE"
    assert cross.get_transform() == axes.get_xaxis_transform()
    assert list(cross.get_xdata()) == [1.2]
    assert 0.9 < cross.get_ydata()[0] < 1.0
    (bars,) = axes.containers
    (low, high), *_ = bars.lines[2][0].get_segments()
    np.testing.assert_allclose((high - low)[1], 1.0)  # ± 0.5 kPa
    (right,) = [each for each in axes.child_axes if each.get_ylabel()]
    assert right.get_ylabel() == "pressure (mmHg)"


def test_a_minus_is_no_hyphen():
    assert signed(-0.015, 4) == "−0.0150"
    assert signed(0.25, 1) == "+0.2"


def test_a_page_of_some_parts_does_not_claim_to_be_of_all(tmp_path):
    sections, asked = [Section("Fig. 4", "", (), (), ())], Asked(Pressure(12e3))
    path = tmp_path / "index.html"
    write_page(sections, asked, path, ["fig5", "fig6"])
    page = path.read_text(encoding="utf-8")
    assert "Every computed result" not in page
    assert "1 of 3 sections" in page
    assert "Not on this page: fig5, fig6." in page
    write_page(sections, asked, path)
    assert "Every computed result" in path.read_text(encoding="utf-8")


def test_the_figures_of_the_documentation_are_up_to_date():
    """Every figure that the script has drawn; their pages refer to files that are there."""
    maker = loaded("make_figures", ".")
    drawn = json.loads(maker.MANIFEST.read_text(encoding="utf-8"))
    assert len(drawn) >= 12
    outdated = sorted(set(maker.stale()) & set(drawn))
    assert outdated == [], "draw them again: python docs/make_figures.py"
    pages = [*DOCS.glob("*.md"), DOCS.parent / "README.md"]
    shown = [
        page.parent / name
        for page in pages
        for name in re.findall(r"\]\(((?:docs/)?img/[^)]+)\)", page.read_text(encoding="utf-8"))
    ]
    assert len(shown) > 15
    assert [path.name for path in shown if not path.is_file()] == []


def test_a_figure_that_was_drawn_by_other_code_is_found(monkeypatch):
    maker = loaded("make_figures", ".")
    figure = maker.FIGURES["fit"]
    before = maker.digest(figure)
    assert maker.digest(replace(figure, command=(*figure.command, "--relative"))) != before
    assert maker.digest(replace(figure, drawn_by=(signed,))) != before
    monkeypatch.setattr(maker, "NUMBERS", maker.NUMBERS + 1)
    assert maker.digest(figure) != before
