"""Closures side by side, the fitted series, and pressure rising on a held stone."""

import csv
import json
from pathlib import Path

import numpy as np
import pytest
from options import asking
from shown import check_shown

import stonepass as sp
from stonepass.cli import run
from stonepass.errors import BadInput, Outcome
from stonepass.inputs.build import build_method
from stonepass.inputs.case_file import read_case, values_of, write_case
from stonepass.inputs.opening_curve_file import find_opening_curve, read_opening_curve
from stonepass.inputs.overlay import overlay
from stonepass.model.closure import Series, fit_series, linear_closure
from stonepass.model.energy_balance import opening_pressure
from stonepass.model.far_field import urine_pressure
from stonepass.model.opening_curve import OpeningCurve
from stonepass.studies.closures import CLOSURES, closures
from stonepass.studies.rising import contact_deviation, raise_pressure

pytestmark = pytest.mark.usefixtures("shared_solutions")

EDGE, XI = 0.94, 1.2  # ρ₀ over R_s
FAST = asking(accuracy="fast")


def case(mu=0.475, **options):
    stone = sp.Stone(size_ratio=1.2, friction=mu)
    return sp.Case(stone, sp.Ureter(wall_ratio=1.5, material="latex"), **(options or FAST))


def test_the_series_of_first_order_is_the_linear_closure():
    width = np.linspace(EDGE, 1.0, 7)
    series = Series((1.0,))(width, EDGE, XI)
    np.testing.assert_allclose(series, linear_closure(width, EDGE, XI), rtol=1e-14)


def test_the_series_begins_at_the_lumen_whatever_its_coefficients():
    assert Series((3.0, -7.0, 1.0))(np.array(EDGE), EDGE, XI) == 1.0
    assert Series((3.0, -7.0, 1.0), 0.9)(np.array(EDGE), EDGE, XI) == 0.9


def test_the_printed_coefficients_are_those_of_eq_14():
    """r_a = R_s sin α − Σ aᵢ sinⁱ α (Eqs 13, 14); and at α₀ Σ aᵢ sinⁱ α₀ = R_s sin α₀ − R_a."""
    series = Series((0.7, -0.4, 0.6))
    a = series.printed(EDGE, XI)
    assert len(a) == 4
    width = np.linspace(EDGE, 1.0, 7)
    delta = np.polynomial.polynomial.polyval(width, a)
    np.testing.assert_allclose(XI * width - delta, series(width, EDGE, XI), rtol=1e-9)
    assert delta[0] == pytest.approx(XI * EDGE - 1.0, rel=1e-9)


def test_a_series_is_recovered_from_its_own_pairs():
    width = np.linspace(EDGE, 1.0, 12)
    wanted = Series((0.7, -0.4, 0.6))
    radius = wanted(width, EDGE, XI)
    found = fit_series(width, radius, EDGE, XI, 3)
    np.testing.assert_allclose(found.coefficients, wanted.coefficients, atol=1e-10)
    with pytest.raises(BadInput, match="order is 0, but must be 1 to 8"):
        fit_series(width, radius, EDGE, XI, 0)
    with pytest.raises(BadInput, match="number of opened states is 4, but must be at least 5"):
        fit_series(width[:4], radius[:4], EDGE, XI, 5)


def test_the_pressure_that_opens_the_tube_to_the_stone_by_the_far_field():
    question = case()
    expected = float(urine_pressure(np.array(1.2), 1.5, question.ureter.material.law, sp.Load()))
    assert opening_pressure(question) == pytest.approx(expected, rel=1e-12)


@pytest.fixture(scope="module")
def compared(with_shared_solutions):
    with with_shared_solutions():
        return closures(case())


def test_pairs_begin_at_the_seated_state_and_lie_below_the_linear_closure(compared):
    alpha, radius = compared.opening_curve.arrays
    assert radius[0] == pytest.approx(1.0, abs=1e-9)
    seated = sp.seat(case(**asking(seating="frictionless", accuracy="fast")))
    assert alpha[0] == pytest.approx(seated.contact_angle, abs=1e-4)
    assert np.all(np.diff(alpha) > 0.0)
    first = np.sin(alpha[0])
    assert np.all(radius[1:] < linear_closure(np.sin(alpha[1:]), first, 1.2))
    # The theory page: at α = 77.8° r_a is 1.065, and Eq. 15 gives 1.108.
    assert np.interp(np.radians(77.8), alpha, radius) == pytest.approx(1.065, abs=1e-3)
    width = np.sin(np.radians(77.8))
    assert linear_closure(width, first, 1.2) == pytest.approx(1.108, abs=1e-3)


def test_energy_and_direct_agree_and_the_paper_lies_around_them(compared):
    assert set(compared.pressures) == set(CLOSURES)
    assert abs(compared.error("energy")) < 2e-3
    assert abs(compared.error("series")) < 0.03
    assert compared.error("printed") < 0.0 < compared.error("derived")
    assert compared.outcome is Outcome.MOVES
    alone = sp.solve(case(**asking(model="direct", accuracy="fast")))
    assert compared.pressures["direct"] == pytest.approx(alone.pressure, rel=1e-7)
    printed = sp.solve(case(**asking(as_printed=True, accuracy="fast")))
    assert compared.pressures["printed"] == printed.pressure
    check_shown(compared, "closure", "critical_pressure_kPa", "relative_to_direct")


def test_rising_pressure_ends_where_the_stone_moves_and_the_seat_is_measured_against():
    rising = raise_pressure(case(), steps=4)
    forces = [state.net_force for state in rising.states]
    assert len(forces) == 4
    assert np.all(np.diff(forces) > 0.0)
    assert forces[-1] == pytest.approx(0.0, abs=1e-3 * abs(forces[0]))
    assert np.all((rising.deviation > 0.01) & (rising.deviation < 0.3))
    check_shown(rising, "urine_pressure_kPa", "net_force_kPa")
    # Without friction and pressure it is the seated state itself.
    bare = raise_pressure(case(0.0, **asking(seating="frictionless", accuracy="fast")), steps=2)
    assert bare.states[0].urine_pressure == 0.0
    assert contact_deviation(bare.states[0], bare.seated) < 1e-3


def test_closures_and_push_at_the_door(tmp_path, capsys):
    stone = ["--xi", "1.2", "--eta", "1.5", "--material", "latex", "--friction", "0.475",
             "--accuracy", "fast"]  # fmt: skip
    assert run(["closures", *stone, "--figure", str(tmp_path / "c.svg"), "--json"]) == 0
    record = json.loads(capsys.readouterr().out)
    assert set(record) >= {"direct_pressure_kPa", "energy_error", "series_coefficients"}
    assert (tmp_path / "c.svg").read_text(encoding="utf-8").startswith("<?xml")
    rows, gif, csv_file = tmp_path / "m.csv", tmp_path / "p.gif", tmp_path / "p.csv"
    assert run(["closures", "--map", "1.1:1.1:0.1", "--map-eta", "1.5,2", "--map-friction", "0.3",
                "--material", "latex", "--accuracy", "fast", "--half-length", "4",
                "--seating", "frictionless", "--out", str(rows),
                "--figure", str(tmp_path / "m.png")]) == 0  # fmt: skip
    assert "energy: I(P) = D: " in capsys.readouterr().out
    with rows.open(encoding="utf-8") as file:
        errors = [float(row["energy_error"]) for row in csv.DictReader(file)]
    assert len(errors) == 2
    assert max(map(abs, errors)) < 5e-3
    assert run(["push", *stone, "--steps", "2", "--to", "10kPa", "--animation", str(gif),
                "--out", str(csv_file)]) == 0  # fmt: skip
    assert gif.read_bytes()[:3] == b"GIF"
    with csv_file.open(encoding="utf-8") as file:
        last = list(csv.DictReader(file))[-1]
    assert float(last["urine_pressure_kPa"]) == pytest.approx(10.0)
    bare = ["closures", "--map", "1.1:1.2:0.1"]
    assert run([*bare, "--map-eta", "1.5;2"]) == 2
    assert "numbers separated by commas" in capsys.readouterr().err
    assert run([*bare, "--xi", "1.2"]) == 2
    assert "--xi cannot be used with --map" in capsys.readouterr().err
    assert run(["closures", *stone, "--series-order", "9"]) == 2
    assert "order is 9, but must be a whole number from 1 to 8" in capsys.readouterr().err
    assert run(["push", *stone, "--steps", "1"]) == 2
    assert "steps is 1, but must be a whole number from 2 to 200" in capsys.readouterr().err
    assert run(["push", *stone, "--to", "0kPa"]) == 2
    assert "highest pressure is 0 Pa, but must be above zero" in capsys.readouterr().err


def test_a_loose_stone_is_answered_by_push_and_closures_too(capsys):
    loose = ["--xi", "0.9", "--eta", "1.5"]
    assert run(["push", *loose, "--json"]) == 0
    record = json.loads(capsys.readouterr().out)
    assert (record["outcome"], record["states"]) == ("LOOSE", [])
    assert run(["closures", *loose, "--json"]) == 0
    record = json.loads(capsys.readouterr().out)
    assert (record["outcome"], record["derived_pressure_kPa"]) == ("LOOSE", 0.0)
    assert record["series_pressure_kPa"] is None


def test_a_map_takes_the_material_of_a_case_file(tmp_path, capsys):
    file = tmp_path / "tube.toml"
    file.write_text(
        "[stone]\nsize_ratio = 1.2\n[ureter]\nwall_ratio = 1.5\nmaterial = 'latex'\n",
        encoding="utf-8",
    )
    assert run(["closures", str(file), "--map", "0.9:0.9:0.1", "--map-eta", "1.5",
                "--map-friction", "0.3", "--json"]) == 0  # fmt: skip
    (record,) = json.loads(capsys.readouterr().out)
    assert record["material"] == "latex"


@pytest.mark.slow
def test_under_a_load_the_comparison_carries_the_warnings_of_its_models():
    stone = sp.Stone(size_ratio=1.2, friction=0.3)
    found = closures(sp.Case(stone, sp.Ureter(wall_ratio=1.3), sp.Load("4 kPa"), **FAST))
    assert any("the tube would collapse" in str(each) for each in found.warnings)
    assert any("hoop compression" in str(each) for each in found.warnings)
    assert not any("error is not estimated" in str(each) for each in found.warnings)
    # Opened from the narrowed lumen, each pair gives its own pressure back.
    assert found.opening_curve.radius[0] < 0.95
    assert abs(found.error("energy")) < 5e-3


def test_a_series_as_the_closure_of_an_answer(compared, tmp_path):
    """Fitted to direct states, from a file of them, of first order; and Eq. 15 as a series."""
    series = sp.solve(case(**asking(closure="series", accuracy="fast")))
    assert series.pressure == pytest.approx(compared.pressures["series"], rel=1e-6)
    assert series.detail.closure.series == compared.series
    assert series.error.critical_pressure < 0.01 * series.pressure
    alpha, radius = compared.opening_curve.arrays
    rows = [f"{r:.15g},{a:.15g}" for a, r in zip(np.degrees(alpha), radius, strict=True)]
    (tmp_path / "pairs.csv").write_text("\n".join(["radius_ratio,alpha_deg", *rows]))
    pairs = read_opening_curve(tmp_path / "pairs.csv")
    np.testing.assert_allclose(pairs.arrays, (alpha, radius), rtol=1e-12)
    method = asking(closure="series", opening_curve=pairs, far_field_ground=True, accuracy="fast")
    by_file = sp.solve(case(**method))
    # From a file the series begins where the pressed stone touches, not the direct one.
    assert by_file.pressure == pytest.approx(series.pressure, rel=3e-3)
    straight = np.linspace(alpha[0], np.pi / 2, 9)
    sine = np.sin(straight)
    line = 1.0 + 0.2 * (sine - sine[0]) / (1.0 - sine[0])
    eq15 = OpeningCurve(tuple(straight), tuple(line))
    linear = sp.solve(case(**asking(accuracy="fast")))
    method = asking(closure="series", opening_curve=eq15, series_order=1, accuracy="fast")
    assert sp.solve(case(**method)).pressure == pytest.approx(linear.pressure, rel=2e-3)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        (
            "alpha_deg,radius_ratio\n70,1\n95,1.1\n",
            "row 3, column 'alpha_deg' is 95, but must be a number from",
        ),
        (
            "alpha_deg,radius_ratio\n70,1\n80,0\n",
            "row 3, column 'radius_ratio' is 0, but must be a number",
        ),
        ("alpha,radius_ratio\n70,1\n", "column is alpha, but must be one of alpha_deg"),
        ("alpha_deg,radius_ratio\n70,one\n", "row 2, column 'radius_ratio' is one"),
    ],
)
def test_pairs_that_are_none_are_refused_with_their_place(tmp_path, text, sentence):
    (tmp_path / "pairs.csv").write_text(text)
    with pytest.raises(BadInput) as refused:
        read_opening_curve(tmp_path / "pairs.csv")
    assert "pairs.csv" in str(refused.value)
    assert sentence in str(refused.value)


@pytest.mark.parametrize(
    ("method", "sentence"),
    [
        ({"closure": "cubic"}, "closure is cubic, but must be one of linear, series"),
        ({"series_order": 9}, "series_order is 9, but must be a whole number from 1 to 8"),
        ({"series_order": 2.0}, "series_order is 2.0, but must be a whole number"),
        (
            {"opening_curve": OpeningCurve((1.3,), (1.0,))},
            "opening_curve cannot be used with the closure 'linear'",
        ),
        (
            {"closure": "series", "opening_curve": OpeningCurve((1.3,), (1.0,))},
            "opening_curve is 1 points, but must be at least as many points as coefficients, 3",
        ),
        ({"closure": "series", "opening_curve": "pairs.csv"}, "as read_opening_curve returns it"),
    ],
)
def test_a_method_asks_for_a_series_that_can_be(method, sentence):
    with pytest.raises(BadInput) as refused:
        asking(**method)
    assert sentence in str(refused.value)


def test_a_closure_belongs_to_the_model_of_the_paper():
    sentence = "closure cannot be used with the model 'direct': it belongs to 'paper'"
    with pytest.raises(BadInput, match=sentence):
        build_method({"method.closure": "series", "method.model": "direct"})


def test_a_case_file_keeps_its_pairs(tmp_path):
    table = "alpha_deg,radius_ratio\n75,1.02\n80,1.08\n85,1.13\n"
    (tmp_path / "pairs.csv").write_text(table)
    pairs = read_opening_curve(tmp_path / "pairs.csv")
    question = case(**asking(closure="series", series_order=2, opening_curve=pairs))
    write_case(question, tmp_path / "case.toml")
    assert 'opening_curve = "pairs.csv"' in (tmp_path / "case.toml").read_text()
    assert read_case(tmp_path / "case.toml") == question
    made = case(
        **asking(closure="series", series_order=1, opening_curve=OpeningCurve((1.4,), (1.1,)))
    )
    write_case(made, tmp_path / "other.toml")  # the points themselves, since no file has them
    assert read_case(tmp_path / "other.toml") == made


def test_pairs_are_of_one_stone_and_of_a_series_that_stays_near_it():
    wild = OpeningCurve(tuple(np.radians([75.0, 80.0, 85.0, 89.0])), (1.02, 3.0, 5.0, 9.0))
    with pytest.raises(BadInput, match="opening_curve is such that its series reaches r_a"):
        sp.solve(case(**asking(closure="series", opening_curve=wild, accuracy="fast")))
    method = asking(closure="series", series_order=1, opening_curve=OpeningCurve((1.4,), (1.1,)))
    with pytest.raises(BadInput, match="opening_curve cannot be used with sizes that vary"):
        sp.critical_size(sp.Ureter(wall_ratio=1.5, material="latex"), "20 kPa", **method)
    with pytest.raises(BadInput, match="opening_curve cannot be used with sizes that vary"):
        case(**method).with_size_ratio(1.1)


def test_a_beam_question_is_raised_by_the_direct_model(tmp_path, capsys):
    beam = case(**asking(model="beam", secant_stretch=1.2, accuracy="fast"))
    with pytest.raises(BadInput, match="model is beam, but must be 'paper'"):
        raise_pressure(beam, steps=2)
    write_case(beam, tmp_path / "case.toml")
    assert run(["push", str(tmp_path / "case.toml"), "--steps", "2", "--json"]) == 0
    record = json.loads(capsys.readouterr().out)
    direct = sp.solve(case(**asking(model="direct", accuracy="fast")))
    assert record["critical_pressure_kPa"] == pytest.approx(direct.pressure / 1e3)


def by(model, options):
    """Model and numerics of a case file once another model is chosen beside it."""
    question = case(**options)
    return build_method(overlay(values_of(question, Path.cwd()), {"method.model": model}))


def test_another_model_leaves_the_closure_behind(compared):
    series = asking(closure="series", opening_curve=compared.opening_curve)
    assert by("direct", series) == tuple(asking(model="direct").values())
    assert by("paper", series)[0].closure == "series"
    beam = asking(model="beam", secant_stretch=1.2)
    assert by("beam", beam) == tuple(beam.values())
    assert by("direct", beam) == tuple(asking(model="direct").values())


@pytest.mark.parametrize(
    ("table", "sentence"),
    [
        ({"alpha_deg": [70.0, 95.0], "radius_ratio": [1.0, 1.1]}, "alpha of pair 2 is 95°"),
        ({"alpha_deg": [70.0, 80.0], "radius_ratio": [1.0]}, "is 2 angles and 1 radii, but must"),
        ({"alpha_deg": [70.0]}, "must be a table of two lists of numbers"),
        ({"alpha_deg": "70", "radius_ratio": [1.0]}, "must be a table of two lists of numbers"),
    ],
)
def test_a_table_that_is_no_opening_curve_is_refused_for_what_is_wrong(table, sentence):
    with pytest.raises(BadInput) as refused:
        find_opening_curve(table)
    assert sentence in str(refused.value)
