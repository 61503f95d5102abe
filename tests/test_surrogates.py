"""Surrogates: polynomials, their fit, the balance that they share with the model, files, doors."""

import json
import shlex
from dataclasses import replace

import numpy as np
import pytest
from scipy.stats import qmc

import stonepass as sp
from stonepass.cli import main as command_line
from stonepass.errors import BadInput, Outcome
from stonepass.inputs.command_options import command_options
from stonepass.inputs.material_file import find_material
from stonepass.model.states.stability import axisymmetric_buckling
from stonepass.studies.conditions import Conditions, case_at, lumen_ratios
from stonepass.studies.surrogates import buckling_limit, build
from stonepass.studies.surrogates.box import HELD_OUT, Box, fit_lumen
from stonepass.studies.surrogates.buckling_limit import MARGIN, stable_loads
from stonepass.studies.surrogates.build import build_surrogate
from stonepass.studies.surrogates.check import MOST, check_surrogate
from stonepass.studies.surrogates.crossing import first_crossing, refined_guess
from stonepass.studies.surrogates.domain import Domain
from stonepass.studies.surrogates.polynomial import SparsePolynomial, chebyshev_products
from stonepass.studies.surrogates.refinement import least_certain
from stonepass.studies.surrogates.regression import fit_polynomial, joined
from stonepass.studies.surrogates.seated_contact import SeatedContact
from stonepass.studies.surrogates.solved import LOOSE
from stonepass.studies.surrogates.stable_loads import StableLoads
from stonepass.studies.surrogates.store import load_surrogate, save_surrogate, shipped_surrogates


def points(count, dimensions, seed=1):
    return qmc.Sobol(dimensions, seed=seed).random(count)


def test_products_are_those_of_cosines():
    u = points(16, 2)
    degrees = np.array([[0, 0], [3, 1], [0, 5]])
    angle = np.arccos(2.0 * u - 1.0)
    expected = [np.cos(i * angle[:, 0]) * np.cos(j * angle[:, 1]) for i, j in degrees]
    assert np.allclose(chebyshev_products(u, degrees), expected, atol=1e-13)


@pytest.mark.parametrize("terms", [1, 3, 40, 200])
@pytest.mark.parametrize("functions", [1, 4, 14])
def test_the_planned_sum_is_that_of_all_terms(terms, functions):
    rng = np.random.default_rng(terms)
    # Few terms have a high degree, so that all matrices differ; some degrees do not occur.
    degrees = np.unique(rng.integers(0, [12, 9, 3, 7]) * rng.integers(0, 2, (terms, 4)), axis=0)
    degrees = np.unique(np.floor(degrees * rng.random(degrees.shape)).astype(int), axis=0)
    coefficients = rng.normal(size=(len(degrees), functions))
    coefficients[rng.random(coefficients.shape) < 0.3] = 0.0
    u = rng.random((7, 4))
    expected = chebyshev_products(u, degrees).T @ coefficients
    assert np.allclose(SparsePolynomial(degrees, coefficients)(u), expected, rtol=0, atol=1e-11)
    assert not SparsePolynomial(degrees, 0.0 * coefficients)(u).any()


def test_a_polynomial_is_recovered_with_its_terms():
    u = points(64, 3)
    degrees = np.array([[0, 0, 0], [2, 0, 1], [0, 3, 0]])
    true = SparsePolynomial(degrees, np.array([[1.0], [0.5], [-2.0]]))
    found = fit_polynomial(u, true(u)[:, 0], (4, 4, 4), 6)
    other = points(32, 3, seed=2)
    assert np.abs(found.polynomial(other) - true(other)).max() < 1e-10
    assert {tuple(each) for each in degrees} <= {tuple(k) for k in found.polynomial.degrees}


def test_leave_one_out_errors_are_those_of_fits_without_the_point():
    u = points(32, 2)
    y = np.exp(u[:, 0]) * np.sqrt(1.0 + u[:, 1])
    found = fit_polynomial(u, y, (3, 3), 3)
    matrix = chebyshev_products(u, found.polynomial.degrees).T
    for k in (0, 7, 31):
        others = np.arange(32) != k
        refit = np.linalg.lstsq(matrix[others], y[others], rcond=None)[0]
        assert found.left_out[k] == pytest.approx(matrix[k] @ refit - y[k], abs=1e-10)


def test_twice_the_points_leave_less_than_half_the_error():
    def function(u):
        return np.exp(u[:, 0] - 0.5 * u[:, 1]) / (1.0 + u[:, 2] * u[:, 0])

    other = points(256, 3, seed=5)
    worst = []
    for count in (32, 64, 128):
        u = points(count, 3)
        found = fit_polynomial(u, function(u), (8, 8, 8), 8)
        worst.append(np.abs(found.polynomial(other)[:, 0] - function(other)).max())
    assert worst[1] < 0.4 * worst[0]
    assert worst[2] < 0.4 * worst[1]


def test_joined_polynomials_keep_their_values():
    one = SparsePolynomial(np.array([[0], [2]]), np.array([[1.0], [3.0]]))
    other = SparsePolynomial(np.array([[2], [1]]), np.array([[4.0], [5.0]]))
    u = points(8, 1)
    both = joined([one, other])
    assert len(both.degrees) == 3
    assert np.allclose(both(u), np.hstack([one(u), other(u)]))


def test_a_fixed_coordinate_has_no_influence():
    degrees = np.array([[0, 0], [1, 2], [1, 1], [3, 0]])
    whole = SparsePolynomial(degrees, np.arange(8.0).reshape(4, 2))
    fixed = whole.fixed(1, 0.3)
    u = points(8, 2)
    there = np.stack([u[:, 0], np.full(8, 0.3)], axis=1)
    assert np.allclose(fixed(u), whole(there), atol=1e-12)
    assert len(fixed.degrees) == 3


def test_the_first_of_several_crossings_is_found():
    # x = 1 comes first: the roots of these functions are 0.7 and 0.2; 0.35; none; 1.
    def excess(x, rows):
        values = np.array([(x - 0.7) * (x - 0.2), x - 0.35, 1.0 + x, x - 2.0])
        return values[rows, np.arange(len(x))]

    x, found = first_crossing(excess, 4)
    assert x == pytest.approx([0.7, 0.35, 0.0, 1.0], abs=1e-9)
    assert found.tolist() == [True, True, False, True]


def test_a_guess_is_refined_or_given_up():
    def excess(x, rows):
        return np.tanh(3.0 * (x - np.array([0.4, 0.9, 0.5]))) + np.array([0.0, 0.0, 2.0])

    x, sure = refined_guess(excess, np.array([0.43, 0.88, 0.5]))
    assert sure.tolist() == [True, True, False]
    assert x[:2] == pytest.approx([0.4, 0.9], abs=1e-5)


@pytest.fixture
def few_walls(monkeypatch):
    """Compute the largest loads of five walls only, which is faster."""
    monkeypatch.setattr(buckling_limit, "WALLS", 5)


def test_the_box_is_sampled_inside_and_the_same_every_time(few_walls):
    case = sp.Case(sp.Stone(size_ratio=1.2), sp.Ureter(wall_ratio=1.5), sp.Load("4 kPa"))
    box = Box(friction=(0.1, 0.8))
    stable = stable_loads(case, box.wall_ratio)
    whole = box.sample(case, stable, 64)
    assert box.contains(whole).all()
    assert (whole.load_factor <= stable(whole.wall_ratio)).all()
    later = box.sample(case, stable, 16, first=48)
    assert np.array_equal(later.size_ratio, whole.size_ratio[48:])
    assert 0.1 < np.mean(whole.load_factor == 0.0) < 0.4
    lumen = lumen_ratios(case, whole.wall_ratio, whole.load_factor)
    assert (whole.size_ratio > lumen).all()
    assert lumen.min() >= stable.narrowest
    at = box.setting(case, whole, lumen, stable.narrowest)
    assert at.unit.min() >= 0.0
    assert at.unit.max() <= 1.0


def test_the_lumen_is_that_of_the_far_field():
    case = sp.Case(sp.Stone(size_ratio=1.2), sp.Ureter(wall_ratio=1.5, material="latex"),
                   sp.Load("8 kPa"))  # fmt: skip
    box = Box()
    asked = box.sample(case, any_load(), 64)
    polynomial = fit_lumen(case, box)
    u = np.stack([box.wall_coordinate(asked), asked.load_factor], axis=1)
    lumen = lumen_ratios(case, asked.wall_ratio, asked.load_factor)
    assert np.abs(polynomial(u)[:, 0] - lumen).max() < 1e-9


def test_the_largest_load_is_a_fraction_of_that_at_which_the_tube_buckles(few_walls):
    """The thin wall is limited by buckling, the thick one by the load of the case."""
    case = sp.Case(sp.Stone(size_ratio=1.2), sp.Ureter(wall_ratio=1.5), sp.Load("10 kPa"))
    found = stable_loads(case, (1.2, 2.0))
    assert (np.diff(found.factor) >= 0.0).all()
    assert found.factor[-1] == 1.0
    edge = float(found(np.array([1.2]))[0]) / MARGIN

    def buckles(factor):
        at = Conditions(np.ones(1), np.array([1.2]), np.zeros(1), np.array([factor]))
        return axisymmetric_buckling(case_at(case, at, 0), case.numerics.half_length)

    assert not buckles(0.99 * edge)
    assert "half-waves" in buckles(1.01 * edge)
    unloaded = stable_loads(replace(case, load=sp.Load()), (1.2, 2.0))
    assert (unloaded.factor == 1.0).all()
    assert unloaded.narrowest == 1.0


def test_a_load_that_closes_the_lumen_is_refused():
    soft = sp.Material("soft", sp.NeoHookean(1.0), "", "", "", (1.0, 1.5))
    wall = sp.Ureter(wall_ratio=1.5, material=soft)
    case = sp.Case(sp.Stone(size_ratio=1.2), wall, sp.Load("90 kPa"))
    with pytest.raises(BadInput, match="keeps a lumen"):
        stable_loads(case, (1.1, 2.0))


@pytest.mark.parametrize("load", ["0 kPa", "3 kPa"])
def test_the_learnt_contact_gives_the_pressure_of_the_model(shared_solutions, load):
    """The balance of the surrogate is that of the model, if what is learnt is exact."""
    case = sp.Case(
        sp.Stone(size_ratio=1.15, friction=0.4),
        sp.Ureter(wall_ratio=1.4),
        sp.Load(load),
        sp.SeatedBalance(seating="frictionless"),
        sp.Numerics("fast"),
    )
    box = Box()
    frictions = (0.02, 0.3, 0.9)
    asked = Conditions(
        np.full(3, 1.15),
        np.full(3, 1.4),
        np.array(frictions),
        np.full(3, 1.0 if load[0] != "0" else 0.0),
    )
    answers = [sp.solve(case_at(case, asked, k), case.numerics.resolution) for k in range(3)]
    lumen = lumen_ratios(case, asked.wall_ratio, asked.load_factor)
    at = box.setting(case, asked, lumen, float(lumen[0]))
    physics = SeatedContact.fitted_to(answers)
    solved = physics.solve(case, at, physics.learnt(case, at, answers))
    assert solved.pressure == pytest.approx([each.pressure for each in answers], rel=3e-4)
    angles = [each.contact.contact_angle for each in answers]
    assert solved.quantities["contact_angle"] == pytest.approx(angles, abs=1e-12)


def any_load(narrowest=1.0):
    """Return loads up to that of the case for all walls of a box."""
    return StableLoads(np.array([1.1, 4.0]), np.ones(2), narrowest)


def main(arguments):
    """Return the exit code of a command."""
    with pytest.raises(SystemExit) as ended:
        command_line(arguments)
    return ended.value.code


@pytest.fixture(scope="module")
def shipped():
    return load_surrogate("ureter")


def test_every_shipped_surrogate_is_checked_and_holds_its_errors():
    # Not all reach the 0.5 % that are aimed at, see docs/surrogates.md, "Limits".
    largest = {("ureter", "paper"): 0.005, ("ureter", "direct"): 0.009,
               ("latex", "paper"): 0.005, ("latex", "direct"): 0.0075}  # fmt: skip
    assert set(shipped_surrogates()) == set(largest)
    for material, model in shipped_surrogates():
        measured = load_surrogate(material, model).about["check"]
        assert measured["compared"] >= 200
        assert measured["same_outcome"] >= 0.99 * measured["cases"] >= 0.99 * 300
        assert measured["largest"] <= largest[material, model]
        assert measured["within"] >= 0.98


def test_a_shipped_surrogate_agrees_with_a_solved_case(shipped, shared_solutions):
    answer = sp.critical_pressure(sp.Stone(size_ratio=1.15), sp.Ureter(wall_ratio=1.3))
    found = shipped.evaluate(size_ratio=1.15, wall_ratio=1.3, friction=0.5)
    assert found.pressure[0] == pytest.approx(answer.pressure, rel=2e-3)


def test_special_conditions_have_their_outcome(shipped):
    found = shipped.evaluate(
        size_ratio=[0.99, 1.0, 1.2, 1.2, 1.7, 1.2, 1.3, 1.2],
        wall_ratio=[1.3, 1.3, 1.3, 1.3, 1.3, 1.05, 1.3, 1.3],
        friction=[0.5, 0.5, 0.0, 0.5, 0.5, 0.5, 1.0, 0.5],
        confining_pressure=[0, 0, 0, 0, 0, 0, 0, 8e3],
    )
    names = [each.name for each in found.outcomes]
    assert names[:6] == ["LOOSE", "LOOSE", "MOVES", "MOVES", "NO_SOLUTION", "NO_SOLUTION"]
    assert names[6] == "BEYOND_CLOSURE"
    assert found.outside.tolist() == [False] * 4 + [True, True, False, True]
    assert found.pressure[:3].tolist() == [0.0, 0.0, 0.0]
    assert found.pressure.mask.tolist() == [False] * 4 + [True] * 4
    assert found.lower_bound[6] > 0.0
    assert found.answered.tolist() == [True] * 4 + [False] * 4


@pytest.mark.parametrize(("material", "model"), shipped_surrogates())
def test_conditions_outside_the_box_alone_have_no_number(material, model):
    """An evaluation in which no condition is covered has the same outcome as any other."""
    surrogate = load_surrogate(material, model)
    inside = {"size_ratio": 1.2, "wall_ratio": 1.3, "friction": 0.3, "confining_pressure": 0.0}
    assert not surrogate.evaluate(**inside).outside[0]
    for name, value in (("size_ratio", 1.7), ("wall_ratio", 1.05), ("wall_ratio", 4.1),
                        ("friction", 1.2), ("confining_pressure", 30e3)):  # fmt: skip
        found = surrogate.evaluate(**inside | {name: value})
        assert found.outcomes == [Outcome.NO_SOLUTION]
        assert found.outside.tolist() == [True]
        assert found.pressure.mask.tolist() == [True]


def test_pressure_scales_with_the_stiffness_and_grows_with_the_stone(shipped):
    at = {"wall_ratio": 1.5, "friction": 0.4}
    sizes = np.linspace(1.001, 1.5, 400)
    soft = shipped.evaluate(size_ratio=sizes, **at)
    stiff = shipped.evaluate(size_ratio=sizes, stiffness=2.5, **at)
    assert np.allclose(stiff.pressure, 2.5 * soft.pressure, rtol=1e-12)
    assert (np.diff(soft.pressure.compressed()) > 0.0).all()


def test_pressures_may_have_a_unit_and_few_conditions_are_no_special_case(shipped):
    at = {"wall_ratio": 1.3, "friction": 0.5}
    loaded = shipped.evaluate(size_ratio=1.2, confining_pressure="2 kPa", **at)
    assert loaded.inputs["confining_pressure"].tolist() == [2000.0]
    assert repr(loaded) == "<SurrogateAnswers: 1 condition; MOVES 1>"
    none = shipped.evaluate(size_ratio=[], **at)
    assert (len(none), none.to_rows()) == (0, [])
    loose = shipped.evaluate(size_ratio=[0.8, 0.9], **at)
    assert (loose.pressure == 0.0).all()


@pytest.mark.parametrize("given", [{"size_ratio": np.nan}, {"friction": -0.1}, {"wall_ratio": "x"},
                                   {"stiffness": 1e308}, {"friction": 0.1 + 0.1j},
                                   {"friction": np.ma.masked_equal([0.1, 0.2], 0.2)},
                                   {"friction": [0.1, 0.2], "size_ratio": [1.1, 1.2, 1.3]}])  # fmt: skip
def test_impossible_inputs_are_refused(shipped, given):
    with pytest.raises(BadInput):
        shipped.evaluate(**{"size_ratio": 1.2, "wall_ratio": 1.3, "friction": 0.5} | given)


def test_many_conditions_are_evaluated_as_one_by_one(shipped):
    rng = np.random.default_rng(3)
    size, wall, friction = rng.uniform([0.98, 1.1, 0.0], [1.6, 4.0, 1.0], (20_000, 3)).T
    many = shipped.evaluate(size_ratio=size, wall_ratio=wall, friction=friction)
    for k in range(0, 20_000, 997):
        one = shipped.evaluate(size_ratio=size[k], wall_ratio=wall[k], friction=friction[k])
        assert one.outcome[0] == many.outcome[k]
        assert np.ma.allclose(one.pressure[:1], many.pressure[k : k + 1], rtol=1e-9)


def test_the_fast_search_finds_the_first_balance(shipped, monkeypatch):
    """The refined guess and the full search give the same pressures and outcomes."""
    from stonepass.studies.surrogates import seated_contact

    rng = np.random.default_rng(4)
    size, wall, friction = rng.uniform([1.001, 1.1, 0.0], [1.6, 4.0, 1.0], (5000, 3)).T
    at = {"size_ratio": size, "wall_ratio": wall, "friction": friction}
    quick = shipped.evaluate(**at)
    monkeypatch.setattr(
        seated_contact,
        "refined_guess",
        lambda excess, guess, step=0.0: (guess, np.zeros(len(guess), bool)),
    )
    full = shipped.evaluate(**at)
    assert (quick.outcome == full.outcome).all()
    # Both searches stop at a difference that matters only where the pressure is below 1 kPa.
    assert np.ma.allclose(quick.pressure, full.pressure, rtol=1e-4, atol=1.0)


def test_files_hold_the_whole_surrogate(shipped, tmp_path):
    path = tmp_path / "own.json"
    save_surrogate(shipped, path)
    assert load_surrogate(path) == shipped
    assert b"pickle" not in path.with_suffix(".npz").read_bytes()


def test_damaged_files_and_changed_materials_are_refused(shipped, tmp_path):
    path = tmp_path / "own.json"
    save_surrogate(shipped, path)
    document = json.loads(path.read_text())
    packed = path.with_suffix(".npz").read_bytes()
    path.with_suffix(".npz").write_bytes(packed[:-1])
    with pytest.raises(BadInput, match="build it again"):
        load_surrogate(path)
    path.with_suffix(".npz").write_bytes(packed)
    for change in ({"format": 99}, {"material_digest": "0"}):
        path.write_text(json.dumps(document | change))
        with pytest.raises(BadInput, match="build it again"):
            load_surrogate(path)
    for key in ("box", "case", "floor_Pa", "narrowest_lumen", "about"):
        for wrong in ({}, {key: "x"}, {key: None}, {key: 3 if key != "floor_Pa" else -1.0}):
            kept = {name: value for name, value in document.items() if name != key}
            path.write_text(json.dumps(kept | wrong))
            if key == "narrowest_lumen" and wrong == {key: 3}:
                continue  # a possible number
            with pytest.raises(BadInput):
                load_surrogate(path)
    path.write_text("{")
    with pytest.raises(BadInput, match="build it again"):
        load_surrogate(path)
    with pytest.raises(BadInput, match="one of 'latex'"):
        load_surrogate("steel")


@pytest.mark.slow
@pytest.mark.longest
def test_a_surrogate_of_your_own_is_built_and_checked(tmp_path):
    """A small box of a soft rubber; the measured error is within the claim."""
    case = sp.Case(
        sp.Stone(size_ratio=1.2),
        sp.Ureter(wall_ratio=1.5, material="latex"),
        model=sp.SeatedBalance(seating="frictionless"),
        numerics=sp.Numerics("fast"),
    )
    box = Box(size_ratio=1.3, wall_ratio=(1.4, 2.0), friction=(0.2, 0.6))
    built = build_surrogate(case, box, sp.JobSolver(), effort=0.06)
    found = check_surrogate(built, sp.JobSolver(), 24)
    assert found.same_outcome == 24
    assert found.largest < 0.005
    assert found.within > 0.9


@pytest.mark.slow
def test_a_pre_stretch_without_a_confining_pressure_narrows_the_lumen():
    case = sp.Case(
        sp.Stone(size_ratio=1.2),
        sp.Ureter(wall_ratio=1.5, material="latex"),
        sp.Load(prestretch=1.1),
        sp.SeatedBalance(seating="frictionless"),
        sp.Numerics("fast"),
    )
    built = build_surrogate(case, Box(1.3, (1.4, 1.8), (0.1, 0.6)), sp.JobSolver(), 0.03)
    at = Conditions(*(np.array([each]) for each in (1.15, 1.6, 0.4, 1.0)))
    answer = sp.critical_pressure(case_at(built.case, at, 0))
    assert built.solve(at).pressure[0] == pytest.approx(answer.pressure, rel=0.01)
    narrow = Conditions(*(np.array([each]) for each in (0.97, 1.6, 0.4, 1.0)))
    assert built.solve(narrow).outcome[0] != LOOSE  # the lumen is 0.953


def test_an_empty_table_of_answers_has_its_whole_header(shipped, tmp_path):
    for count in (0, 1):
        found = shipped.evaluate(size_ratio=np.full(count, 1.2), wall_ratio=1.3, friction=0.5)
        found.save(tmp_path / f"{count}.csv")
    empty, one = ((tmp_path / f"{count}.csv").read_text().splitlines() for count in (0, 1))
    assert empty == one[:1]


def test_models_and_options_without_a_surrogate_are_refused():
    case = sp.Case(sp.Stone(size_ratio=1.2), sp.Ureter(wall_ratio=1.5))
    for model in (
        sp.ElasticFoundation(secant_stretch=1.2),
        sp.SeatedBalance(closure="series"),
    ):
        with pytest.raises(BadInput):
            build_surrogate(replace(case, model=model))


@pytest.mark.parametrize(
    ("options", "reason"),
    [
        (["--eta", "5"], "The wall ratio is 5, but from 1.1 to 4."),
        (["--eta", "1.3", "--friction", "1.5"], "The friction coefficient is 1.5, but from 0 to 1."),
        (["--eta", "1.3", "--confining", "9kPa"],
         "The confining pressure is 9 kPa, but at most 6.73"),
    ],
)  # fmt: skip
def test_the_input_that_is_outside_is_named(capsys, options, reason):
    assert main(["surrogate", "evaluate", "ureter", "--xi", "1.2", *options]) == 1
    assert reason in " ".join(capsys.readouterr().out.split())


def test_the_command_line_lists_shows_and_evaluates(capsys, tmp_path):
    assert main(["surrogate", "list"]) == 0
    assert "latex" in capsys.readouterr().out
    assert main(["surrogate", "show", "ureter"]) == 0
    assert "1.1 to 4" in capsys.readouterr().out
    assert main(["surrogate", "evaluate", "ureter", "--xi", "1.2", "--eta", "1.3", "--json"]) == 0
    (row,) = json.loads(capsys.readouterr().out)
    assert row["outcome"] == "MOVES"
    assert row["critical_pressure_error_kPa"] < 0.01 * row["critical_pressure_kPa"]
    table = tmp_path / "points.csv"
    table.write_text("size_ratio,wall_ratio,friction\n1.1,1.3,0.5\n1.7,1.3,0.5\n")
    out = tmp_path / "answers.csv"
    command = ["surrogate", "evaluate", "latex", "--points", str(table), "--out", str(out)]
    assert main(command) == 1
    lines = out.read_text().splitlines()
    assert lines[0].startswith("size_ratio,wall_ratio,friction,confining_pressure_kPa,stiffness")
    assert "NO_SOLUTION" in lines[2]
    told = " ".join(capsys.readouterr().out.split())
    assert "0.5 OUTSIDE" in told
    assert "OUTSIDE: the surrogate does not cover these inputs" in told
    assert "Row 2: the size ratio is 1.7, but at most 1.6." in told
    before = table.read_text()
    assert main([*command[:-1], str(table)]) == 2
    assert "--out is" in capsys.readouterr().err
    assert table.read_text() == before
    for option, value in (("--confining", "3kPa"), ("--friction", "0.1"), ("--xi", "1.2")):
        assert main([*command, option, value]) == 2
        assert f"{option} is" in capsys.readouterr().err
    for option in ("--xi", "--eta", "--friction", "--stiffness"):
        both = {"--xi": "1.2", "--eta": "1.3"} | {option: "-1"}
        asked = [word for pair in both.items() for word in pair]
        assert main(["surrogate", "evaluate", "ureter", *asked]) == 2
        assert f"{option} is -1" in capsys.readouterr().err
    table.write_text("size_ratio,wall_ratio,friction\n1.1,1.3,0.5\n1.2,-1.3,0.5\n")
    assert main(command) == 2
    assert "points.csv" in (told := capsys.readouterr().err)
    assert "3" in told.split("wall_ratio")[0]  # the line of the file
    assert main(["surrogate", "evaluate", "ureter", "--eta", "1.3"]) == 2
    assert "--xi" in capsys.readouterr().err


@pytest.mark.parametrize(("material", "model"), shipped_surrogates())
def test_the_shown_command_builds_this_surrogate(material, model, monkeypatch, capsys, tmp_path):
    """The command asks for the case and the box of the surrogate."""
    assert main(["surrogate", "show", material, "--model", model]) == 0
    words = shlex.split(capsys.readouterr().out.splitlines()[-1])
    assert words[0] == "stonepass"
    asked, surrogate = [], load_surrogate(material, model)

    def built(case, box, solver, effort):
        asked.append((case, box))
        return surrogate

    monkeypatch.setattr(build, "build_surrogate", built)
    out = tmp_path / "again.json"
    assert main([*words[1:-1], str(out), "--workers", "1", "--no-cache"]) == 0
    assert asked == [(surrogate.case, surrogate.box)]
    assert load_surrogate(out) == surrogate


def test_a_case_with_a_table_of_constants_has_no_options():
    """A table cannot be written on a command line."""
    table = {"law": "neo-hookean", "C10": "70 kPa", "strain_range": [0.5, 1.5], "source": "mine"}
    wall = sp.Ureter(wall_ratio=1.3, material=find_material(table))
    with pytest.raises(BadInput, match="use a case file"):
        command_options(sp.Case(sp.Stone(size_ratio=1.2), wall))


def test_further_cases_are_where_two_fits_differ_and_apart_from_each_other():
    u = points(256, 2)
    true = 1e4 * (1.0 + u[:, 0])
    wrong = true * (1.0 + 0.3 * np.exp(-((u - 0.8) ** 2).sum(axis=1) / 0.02))
    wrong[u[:, 0] < 0.1] = np.nan
    chosen = least_certain(lambda part: true if part.start == 0 else wrong, u, 6)
    assert len(chosen) == 6
    assert np.linalg.norm(u[chosen] - 0.8, axis=1).max() < 0.4
    apart = np.linalg.norm(u[chosen][:, None] - u[chosen], axis=2)[~np.eye(6, dtype=bool)]
    assert apart.min() > 0.08
    assert len(least_certain(lambda part: true, u, 6)) == 0


def test_cases_of_a_check_are_never_used_to_build():
    """However many cases a level has, those of the check and of the refinement are left out."""
    case = sp.Case(sp.Stone(size_ratio=1.2), sp.Ureter(wall_ratio=1.5))
    domain = Domain(Box(), any_load())
    used = domain.training(case, 3000)
    assert len(used.size_ratio) == 3000
    reserved = domain.box.sample(case, domain.stable, 4096 - 1024, first=1024)
    assert not set(used.size_ratio) & set(reserved.size_ratio)
    assert set(domain.candidates(case, 2048).size_ratio) <= set(reserved.size_ratio[1024:])
    checked = domain.box.sample(case, domain.stable, MOST, HELD_OUT)
    assert not set(domain.candidates(case, 2048).size_ratio) & set(checked.size_ratio)
