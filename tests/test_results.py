"""Results of the public interface: how they print, what they become, how mistakes are answered."""

from __future__ import annotations

import dataclasses
import json
import math
import sys
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure
from shown import check_shown

import stonepass as sp
from stonepass.report.presentation import SHOWN
from stonepass.result import Result
from stonepass.studies.progress import reported

BEAM = sp.ElasticFoundation("0.4 MPa", "0.02 MPa")
URETER = sp.Ureter("3.5 mm", "4.54 mm")
CASE = sp.Case(sp.Stone("4.2 mm"), URETER, model=BEAM)


@pytest.fixture(scope="module")
def fitted() -> sp.FittedLaw:
    stretch = np.linspace(1.05, 1.5, 10)
    stress = 2.0 * 0.15e6 * (stretch - stretch**-2)
    return sp.fit_law(sp.Tension(stretch, stress, ("axial",) * len(stretch)), "neo-hookean")


@pytest.fixture(scope="module")
def results(fitted: sp.FittedLaw) -> dict[type, Result]:
    """One result of each kind that needs no finite elements."""
    return {
        sp.Answer: sp.critical_pressure(CASE),
        sp.SizeAnswer: sp.critical_size(CASE, "6 kPa"),
        sp.CriticalCurve: sp.critical_curve(CASE, [1.0, 1.1, 1.2]),
        sp.FittedLaw: fitted,
    }


def test_every_kind_of_result_is_registered() -> None:
    known = {each for each in vars(sp)["_HOME"] if isinstance(getattr(sp, each), type)}
    kinds = {getattr(sp, each) for each in known if issubclass(getattr(sp, each), Result)}
    assert kinds - {Result} == set(SHOWN)
    assert len(SHOWN) >= 9


def test_results_are_shown(results: dict[type, Result]) -> None:
    """The other kinds are checked where they are solved, by `check_shown` too."""
    for result in results.values():
        check_shown(result)


def test_an_answer_says_outcome_pressure_and_case() -> None:
    answer = sp.critical_pressure(CASE)
    assert repr(answer) == (
        f"<Answer: MOVES, P_ucr {answer.pressure / 1e3:.4g} kPa; "
        "ξ 1.2, η 1.297, ureter, friction 0.5, model beam>"
    )
    failed = dataclasses.replace(answer, outcome=sp.Outcome.NO_SOLUTION, pressure=None)
    assert repr(failed).startswith("<Answer: NO_SOLUTION; ξ 1.2")


def test_printing_shows_the_table_and_the_warnings() -> None:
    answer = sp.critical_pressure(CASE)
    printed = str(answer)
    assert "critical pressure" in printed
    assert f"{answer.pressure_mmHg:.2f}" in printed
    assert all(f"warning: {each}" in printed for each in answer.warnings)
    assert answer.warnings


def test_html_has_the_same_numbers_and_no_markup() -> None:
    answer = sp.critical_pressure(CASE)
    html = answer._repr_html_()
    assert html.count("<tr>") >= 8
    assert f"{answer.pressure_kPa:.2f}" in html
    assert "[bold]" not in html
    odd = dataclasses.replace(CASE, ureter=dataclasses.replace(URETER, material=_named("a<b>")))
    assert "a&lt;b&gt;" in sp.critical_pressure(odd)._repr_html_()


def _named(name: str) -> sp.Material:
    return dataclasses.replace(URETER.material, name=name, reference="")


def test_dictionaries_are_those_of_json(results: dict[type, Result]) -> None:
    for result in results.values():
        json.dumps(result.to_dict(), allow_nan=False)
    answer = results[sp.Answer]
    assert isinstance(answer, sp.Answer)
    assert answer.to_dict() == sp.answer_record(answer).to_dict()


def test_series_and_frames(results: dict[type, Result]) -> None:
    pandas = pytest.importorskip("pandas")
    answer, curve = results[sp.Answer], results[sp.CriticalCurve]
    series = answer.to_series()
    assert isinstance(series, pandas.Series)
    assert series["friction"] == 0.5
    assert math.isnan(series["stability_margin"])  # the beam has no wall of finite elements
    assert "disclaimer" not in series
    frame = curve.to_frame()
    assert list(frame["size_ratio"]) == [1.0, 1.1, 1.2]
    assert frame["critical_pressure_kPa"].dtype == float
    assert frame["outcome"][0] == "LOOSE"
    with pytest.raises(sp.BadInput, match=r"table of 3 rows, but must be one row; use to_frame"):
        curve.to_series()
    assert list(results[sp.FittedLaw].to_frame()["name"]) == ["C10"]


def test_without_pandas_the_remedy_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(sp.StonepassError, match="pip install pandas"):
        sp.critical_pressure(CASE).to_frame()


def test_a_plot_of_nothing_is_refused() -> None:
    loose = sp.critical_pressure(sp.Stone("3 mm"), URETER)
    with pytest.raises(sp.BadInput, match="LOOSE, but must be asked for where there is a contact"):
        loose.plot(Figure().add_subplot())
    with pytest.raises(sp.BadInput, match="LOOSE"):
        loose.figure()


def test_a_notebook_displays_a_figure_without_pyplot(results: dict[type, Result]) -> None:
    png, size = results[sp.CriticalCurve].figure()._repr_png_()
    assert png.startswith(b"\x89PNG")
    pixels = tuple(int.from_bytes(png[at : at + 4], "big") for at in (16, 20))
    assert pixels == (2 * size["width"], 2 * size["height"])


def test_saving(results: dict[type, Result], tmp_path: Path) -> None:
    answer, curve = results[sp.Answer], results[sp.CriticalCurve]
    answer.save(tmp_path / "answer.json")
    assert json.loads((tmp_path / "answer.json").read_text("utf-8")) == answer.to_dict()
    answer.save(tmp_path / "answer.png")
    assert (tmp_path / "answer.png").read_bytes().startswith(b"\x89PNG")
    curve.save(str(tmp_path / "curve.csv"))
    header, *lines = (tmp_path / "curve.csv").read_text("utf-8").splitlines()
    assert header.startswith("size_ratio,outcome,critical_pressure_kPa")
    assert len(lines) == 3
    with pytest.raises(sp.BadInput, match=r"\.json, \.csv|\.csv"):
        answer.save(tmp_path / "answer.docx")


def test_pressures_in_other_units() -> None:
    answer = sp.critical_pressure(CASE)
    assert answer.pressure is not None
    assert answer.pressure_kPa == answer.pressure / 1e3
    assert answer.pressure_mmHg == pytest.approx(answer.pressure / 133.322387415, rel=1e-15)
    assert answer.pressure_cmH2O == pytest.approx(answer.pressure / 98.0665, rel=1e-15)
    none = dataclasses.replace(answer, pressure=None)
    assert none.pressure_kPa is none.pressure_mmHg is none.pressure_cmH2O is None


def test_answers_compare_by_value_and_do_not_hash() -> None:
    one, other = sp.critical_pressure(CASE), sp.critical_pressure(CASE)
    assert one == other
    assert one == dataclasses.replace(other, seconds=9.0)
    assert one != dataclasses.replace(other, pressure=1.0)
    with pytest.raises(TypeError, match="unhashable"):
        hash(one)


def test_a_case_stands_for_its_parts() -> None:
    assert sp.critical_pressure(CASE) == sp.critical_pressure(CASE.stone, URETER, model=BEAM)
    by_parts = sp.critical_size(URETER, "6 kPa", model=BEAM)
    assert sp.critical_size(CASE, "6 kPa") == by_parts
    assert by_parts.diameter_mm == pytest.approx(3.5 * by_parts.size_ratio, rel=1e-12)
    with pytest.raises(sp.BadInput, match="model cannot be used with a Case: it is part of"):
        sp.critical_size(CASE, "6 kPa", model=BEAM)
    with pytest.raises(sp.BadInput, match="load cannot be used with a Case"):
        sp.critical_pressure(CASE, load=sp.Load("1 kPa"))


def test_a_curve_is_a_sequence() -> None:
    seen: list[tuple[int, int]] = []
    curve = sp.critical_curve(CASE, np.array([1.1, 1.2]), progress=lambda *n: seen.append(n))
    assert seen == [(1, 2), (2, 2)]
    assert len(curve) == 2
    assert curve[1] == list(curve)[1]
    assert curve[1].pressure == pytest.approx(sp.critical_pressure(CASE).pressure, rel=1e-12)
    assert curve[:1] == curve.answers[:1]
    assert curve.size_ratios == pytest.approx((1.1, 1.2))
    assert curve.pressures[1] == curve[1].pressure
    with pytest.raises(sp.BadInput, match="size_ratios is empty"):
        sp.critical_curve(CASE, [])


@pytest.mark.parametrize(
    ("mistake", "sentence"),
    [
        (lambda: sp.critical_pressure(URETER, CASE.stone),
         'stone is a Ureter, but must be a Stone; write it like Stone(diameter="4.2 mm").'),
        (lambda: sp.critical_pressure(CASE.stone),
         "ureter is missing, but must be given in addition to the stone; write critical_pressure(stone, "
         "ureter), or critical_pressure(case)."),
        (lambda: sp.critical_pressure(CASE.stone, URETER, model="direct"),
         "model is direct, but must be a Model; write it like PushThrough()."),
        (lambda: sp.critical_pressure(CASE.stone, URETER, model="beam"),
         "model is beam, but must be a Model; write it like ElasticFoundation()."),
        (lambda: sp.critical_pressure(CASE.stone, URETER, model=sp.PushThrough),
         "model is the class PushThrough, but must be a Model; write it like PushThrough()."),
        (lambda: sp.critical_pressure(CASE.stone, URETER, numerics="fast"),
         'numerics is fast, but must be a Numerics; write it like Numerics("fast").'),
        (lambda: sp.critical_pressure(CASE.stone, URETER, load="2 kPa"),
         'load is 2 kPa, but must be a Load; write it like Load(confining_pressure="2 kPa").'),
        (lambda: sp.critical_size("6 kPa", URETER),
         "ureter is 6 kPa, but must be a Ureter; write it like "
         'Ureter(inner_diameter="3.5 mm", outer_diameter="4.54 mm").'),
        (lambda: sp.solve(CASE.stone),
         "case is a Stone, but must be a Case; write it like Case(stone, ureter)."),
        (lambda: sp.critical_curve(URETER, [1.1]),
         "case is a Ureter, but must be a Case; write it like Case(stone, ureter)."),
    ],
)  # fmt: skip
def test_natural_mistakes_are_answered_with_the_remedy(mistake, sentence: str) -> None:  # type: ignore[no-untyped-def]
    with pytest.raises(sp.BadInput) as refused:
        mistake()
    assert str(refused.value) == sentence


@pytest.mark.parametrize(
    ("name", "meant"),
    [("curve", "critical_curve"), ("critical_presure", "critical_pressure"), ("Uretr", "Ureter"),
     ("direct", "PushThrough"), ("load_case", "read_case")],
)  # fmt: skip
def test_unknown_names_name_the_nearest(name: str, meant: str) -> None:
    with pytest.raises(AttributeError, match=f"did you mean stonepass.{meant}?"):
        getattr(sp, name)


def test_other_names_lead_to_public_ones() -> None:
    assert set(vars(sp)["_OTHER_NAMES"].values()) <= set(sp.__all__)
    assert not set(vars(sp)["_OTHER_NAMES"]) & set(sp.__all__)


def test_a_wall_thickness_stands_for_the_outer_diameter(tmp_path: Path) -> None:
    thick = sp.Ureter("3.5 mm", wall_thickness="0.52 mm")
    assert thick == URETER
    assert hash(thick) == hash(URETER)
    assert thick.wall_ratio == pytest.approx(4.54 / 3.5, rel=1e-14)
    assert dataclasses.replace(thick, material=_named("mine")).outer_diameter == 0.00454
    case = dataclasses.replace(CASE, ureter=thick)
    sp.write_case(case, tmp_path / "case.toml")
    assert "wall_thickness" not in (tmp_path / "case.toml").read_text("utf-8")
    assert sp.read_case(tmp_path / "case.toml") == case
    (tmp_path / "thick.toml").write_text(
        '[stone]\ndiameter = "4.2 mm"\n[ureter]\ninner_diameter = "3.5 mm"\n'
        'wall_thickness = "0.52 mm"\n', "utf-8")  # fmt: skip
    assert sp.read_case(tmp_path / "thick.toml").ureter == URETER


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"wall_thickness": "0.5 mm"}, "inner diameter is missing"),
        ({"inner_diameter": "3.5 mm", "outer_diameter": "5 mm", "wall_thickness": "0.5 mm"},
         "wall thickness cannot be used with both diameters; the diameters give 0.75 mm"),
        ({"inner_diameter": "3.5 mm", "wall_thickness": "0.5 mm", "wall_ratio": 2.0},
         "wall_ratio cannot be used with both diameters"),
        ({"inner_diameter": "3.5 mm", "wall_thickness": "0.01 mm"}, "wall_ratio is 1.0057"),
        ({"inner_diameter": "3.5 mm", "wall_thickness": "-1 mm"}, "wall thickness is -1 mm"),
    ],
)  # fmt: skip
def test_contradicting_walls_are_refused(given: dict[str, object], words: str) -> None:
    with pytest.raises(sp.BadInput, match=words):
        sp.Ureter(**given)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (sp.Stone("4.2 mm"), "Stone(diameter='4.2 mm')"),
        (sp.Stone(size_ratio=1.2, aspect=1.4, friction=0.3),
         "Stone(friction=0.3, size_ratio=1.2, aspect=1.4)"),
        (sp.Ureter("3.5 mm", wall_thickness="0.52 mm"),
         "Ureter(inner_diameter='3.5 mm', outer_diameter='4.54 mm', material='ureter')"),
        (sp.Ureter(wall_ratio=1.5, material="latex"), "Ureter(material='latex', wall_ratio=1.5)"),
        (sp.Load("2 kPa", "hydrostatic"),
         "Load(confining_pressure='2 kPa', confinement='hydrostatic')"),
        (sp.SeatedBalance("frictionless"), "SeatedBalance(seating='frictionless')"),
        (sp.PushThrough(), "PushThrough()"),
        (BEAM, "ElasticFoundation(circumferential_modulus='400 kPa', "
               "longitudinal_modulus='20 kPa')"),
        (sp.Numerics("fast"), "Numerics(accuracy='fast')"),
        (sp.Shape(1.4), "Shape(1.4)"),
    ],
)  # fmt: skip
def test_inputs_print_as_they_are_written(value: object, text: str) -> None:
    assert repr(value) == text
    assert eval(text, vars(sp) | {name: getattr(sp, name) for name in sp.__all__}) == value


def test_a_case_prints_its_parts() -> None:
    assert repr(sp.Case(sp.Stone(size_ratio=1.2), sp.Ureter(wall_ratio=1.5))) == (
        "Case(Stone(size_ratio=1.2), Ureter(material='ureter', wall_ratio=1.5), Load(), "
        "SeatedBalance(), Numerics())"
    )
    law = "Fung(C=405600.0, a1111=0.7091, a2222=0.8892, a1122=0.1856, G=12000.0)"
    assert repr(sp.material("ureter")) == f"Material('ureter', {law})"
    egg = sp.read_shape(Path(__file__).parents[1] / "examples" / "egg.csv")
    assert repr(egg).endswith("egg.csv: length over diameter 1.332>")


def test_states_and_data_print_short() -> None:
    stretch = np.linspace(1.0, 1.5, 40)
    assert repr(sp.Tension(stretch, stretch, ("axial",) * 40)).startswith(
        "Tension(stretch=<array of shape (40,)>"
    )
    beam = sp.critical_pressure(CASE).contact
    assert len(repr(beam)) < 2000


def test_progress_of_a_terminal_and_of_none(capsys: pytest.CaptureFixture[str]) -> None:
    with reported(False, "cases") as nothing:
        assert nothing is None
    with reported(True, "cases") as told:  # the tests have no terminal
        assert told is None
    assert capsys.readouterr().err == ""


def test_progress_in_a_notebook(monkeypatch: pytest.MonkeyPatch) -> None:
    shown: list[str] = []

    class Handle:
        def update(self, line: object) -> None:
            shown.append(repr(line))

    class Kernel:
        kernel = object()

    class Module:
        get_ipython = staticmethod(Kernel)

    class Display:
        @staticmethod
        def display(line: object, display_id: bool) -> Handle:
            shown.append(line._repr_html_())  # type: ignore[attr-defined]
            return Handle()

    monkeypatch.setitem(sys.modules, "IPython", Module)
    monkeypatch.setitem(sys.modules, "IPython.display", Display)
    monkeypatch.setattr("stonepass.studies.progress.DELAY", -1.0)
    sp.critical_curve(CASE, [1.1, 1.2])
    assert shown == ['<progress value="1" max="2"></progress> jobs: 1 of 2',
                     "jobs: 2 of 2"]  # fmt: skip


def test_sizes_of_a_strip_are_text_or_quantities() -> None:
    pint = pytest.importorskip("pint")
    data = Path(__file__).parents[1] / "examples" / "latex_tensile.csv"
    read = sp.read_tension(data, "10 mm", "1.2 mm")
    assert read == sp.read_tension(data, sp.length("10 mm"), sp.length("1.2 mm"))
    by_area = sp.read_tension(data, section=12 * pint.UnitRegistry().mm ** 2)
    np.testing.assert_allclose(by_area.stress, read.stress, rtol=1e-14)
    with pytest.raises(sp.BadInput, match="width is 10, but must be a length with its unit"):
        sp.read_tension(data, 10, "1.2 mm")  # type: ignore[arg-type]
