"""What the API answers at once: information, instant answers, and how they can be repeated."""

import copy
import itertools
import json
import shlex
import tomllib

import numpy as np
import pytest
from web_server import CASE, THIN, client

import stonepass as sp
from stonepass.cli import run
from stonepass.inputs.catalogue import all_inputs
from stonepass.model.far_field import lumen_ratio
from stonepass.studies.sensitivity.evaluator import OUTCOMES, Evaluations
from stonepass.studies.sensitivity.size_search import search_sizes
from stonepass.web.documented import InstantDocument
from stonepass.web.instant.answer import CAUSES
from stonepass.web.instant.question import largest_load, named_surrogate
from stonepass.web.instant.words import digits
from stonepass.web.section.build import case_of_section, section_of
from stonepass.web.section.grid import SectionGrid, digest, grid_of

ALL = {"include": ["curve", "map", "section"], "limit": "6 kPa"}


@pytest.fixture(scope="module")
def asking():
    with client() as found:
        yield found


def instant(asking, case=CASE, **more):
    found = asking.post("/api/v1/instant", json={"case": case} | more)
    assert found.status_code == 200, found.text
    InstantDocument.model_validate(found.json())  # as the description of the API says
    return found.json()


# --- information


def test_the_api_lists_its_addresses(asking):
    about = asking.get("/api/v1").json()
    assert about["name"] == "stonepass"
    assert about["notice"] == "Research use only. Not a medical device."
    described = asking.get("/api/v1/openapi.json").json()["paths"]
    for name, address in about["links"].items():
        if name not in ("page", "openapi"):
            assert address in described, name


def test_inputs_are_those_of_the_one_declaration(asking):
    found = {each["key"]: each for each in asking.get("/api/v1/inputs").json()}
    assert set(found) == set(all_inputs()) | {"stiffness"}
    friction = found["stone.friction"]
    assert (friction["bounds"], friction["default"], friction["unit"]) == ([0.0, 2.0], 0.5, None)
    assert found["ureter.inner_diameter"]["unit"] == "m"
    assert found["load.confinement"]["choices"] == ["dead", "hydrostatic"]
    described = asking.get("/api/v1/openapi.json").json()["components"]["schemas"]
    for section, name in (("StoneSection", "friction"), ("LoadSection", "prestretch")):
        schema = described[section]["properties"][name]
        low, high = found[f"{section.removesuffix('Section').lower()}.{name}"]["bounds"]
        assert (schema["minimum"], schema["maximum"]) == (low, high)
        assert schema["description"]


def test_materials_limits_and_words(asking):
    materials = {each["name"]: each for each in asking.get("/api/v1/materials").json()}
    assert materials["ureter"]["instant"] is True
    assert materials["ureter-printed"]["stable"] is False
    assert materials["latex"]["constants"] == {"C10": 146500.0}
    limits = asking.get("/api/v1/pressure-limits").json()
    assert [each["pressure_kPa"] for each in limits] == [2.0, 4.0, 6.0, 8.0, 12.0]
    assert all(each["source"] for each in limits)
    words = asking.get("/api/v1/glossary").json()
    assert words["size ratio"] == "R_s / R_a"
    assert len(words) > 50
    assert not any("](" in meaning or "`" in meaning for meaning in words.values())


# --- instant answers


def test_the_answer_is_that_of_the_surrogate(asking):
    found = instant(asking, **ALL)
    case = sp.Case(sp.Stone("4.2 mm"), sp.Ureter("3.5 mm", "4.54 mm"))
    known = sp.load_surrogate("ureter").evaluate(
        size_ratio=case.size_ratio, wall_ratio=case.wall_ratio, friction=0.5
    )
    answer = found["answer"]
    assert answer["critical_pressure_kPa"] == pytest.approx(
        float(known.pressure[0]) / 1e3, rel=1e-12
    )
    assert answer["critical_pressure_error_kPa"] == pytest.approx(float(known.error[0]) / 1e3)
    assert answer["outcome"] == "MOVES"
    assert "kPa" in answer["sentence"]
    assert "mmHg" in answer["sentence"]
    assert "cmH₂O" in answer["sentence"]


@pytest.mark.slow
def test_the_answer_is_near_that_of_the_finite_elements(asking):
    solved = sp.solve(sp.Case(sp.Stone("4.2 mm"), sp.Ureter("3.5 mm", "4.54 mm")))
    answer = instant(asking)["answer"]
    assert abs(solved.pressure_kPa - answer["critical_pressure_kPa"]) < 0.1


def test_curve_and_map_are_evaluations_of_the_surrogate(asking):
    found = instant(asking, stiffness=1.7, **ALL)
    surrogate = named_surrogate("ureter", "paper")
    curve, grid = found["curve"], found["map"]
    at = surrogate.evaluate(size_ratio=curve["size_ratio"], friction=0.5, stiffness=1.7,
                            wall_ratio=4.54 / 3.5)  # fmt: skip
    here = [np.nan if each is None else each for each in curve["critical_pressure_kPa"]]
    assert np.allclose(here, at.pressure.filled(np.nan) / 1e3, rtol=1e-4, atol=1e-5, equal_nan=True)
    assert curve["diameter_mm"][-1] == pytest.approx(1.6 * 3.5)
    assert curve["outcome"][0] == "LOOSE"
    row, column = 3, -1
    one = surrogate.evaluate(
        size_ratio=grid["size_ratio"][column], wall_ratio=grid["wall_ratio"][row], friction=0.5,
        stiffness=1.7,
    )  # fmt: skip
    assert grid["outcome"][row][column] == one.outcomes[0].name
    shape = (len(grid["wall_ratio"]), len(grid["size_ratio"]))
    assert np.array(grid["outcome"]).shape == shape
    assert (grid["wall_ratio"][0], grid["wall_ratio"][-1]) == (1.1, 4.0)


@pytest.mark.parametrize("material", ["ureter", "latex"])
@pytest.mark.parametrize("friction", [0.05, 0.9])
@pytest.mark.parametrize("limit", [0.5, 12.0])
def test_the_largest_stone_is_that_of_a_finer_search(asking, material, friction, limit):
    """The search of the sensitivity study halves the interval 24 times."""
    case = {
        "stone": {"size_ratio": 1.1, "friction": friction},
        "ureter": {"wall_ratio": 1.45, "material": material},
    }
    found = instant(asking, case, include=["map"], limit=f"{limit} kPa")
    surrogate = named_surrogate(material, "paper")
    walls = np.array([1.45, *found["map"]["wall_ratio"]])

    def pressures(sizes, cases):
        known = surrogate.evaluate(size_ratio=sizes, wall_ratio=walls[cases], friction=friction)
        codes = np.array([OUTCOMES.index(each) for each in known.OUTCOMES])[known.outcome]
        bound = np.ma.masked_array(known.lower_bound, ~np.ma.getmaskarray(known.pressure))
        return Evaluations(codes, known.pressure, bound)

    fine = search_sizes(pressures, len(walls), 1e3 * limit, (0.95, 1.6))
    size = found["size"]
    ours = [size["critical_size_ratio"], *found["map"]["critical_size_ratio"]]
    outcomes = [size["outcome"], *found["map"]["critical_size_outcome"]]
    assert len(ours) == 22
    for k, (value, outcome) in enumerate(zip(ours, outcomes, strict=True)):
        assert outcome == OUTCOMES[fine.outcome[k]].name
        if outcome == "SOLVED":
            assert value == pytest.approx(float(fine.value[k]), abs=3e-5 if k else 1e-6)
        else:
            assert value is None


def test_a_loose_stone_and_one_beyond_the_closure_have_a_sentence(asking):
    loose = instant(asking, CASE | {"stone": {"diameter": "3 mm"}}, **ALL)
    assert loose["answer"]["outcome"] == "LOOSE"
    assert loose["answer"]["critical_pressure_kPa"] == 0.0
    assert set(loose["section"]["inner"]["r"]) == {1.0}
    stuck = {"diameter": "4.6 mm", "friction": 1.0}
    beyond = instant(asking, CASE | {"stone": stuck}, **ALL)["answer"]
    assert beyond["outcome"] == "BEYOND_CLOSURE"
    assert beyond["critical_pressure_kPa"] is None
    assert f"more than {beyond['lower_bound_kPa']:.3g} kPa" in beyond["sentence"]


@pytest.mark.parametrize(
    ("changed", "key"),
    [
        ({"stone": {"diameter": "6 mm"}}, "stone.diameter"),
        ({"stone": {"diameter": "4 mm", "friction": 1.4}}, "stone.friction"),
        (
            {"ureter": {"inner_diameter": "3.5 mm", "outer_diameter": "3.7 mm"}},
            "ureter.outer_diameter",
        ),
        ({"load": {"confining_pressure": "8 kPa"}}, "load.confining_pressure"),
        ({"load": {"confining_pressure": "90 kPa"}}, "load.confining_pressure"),
    ],
)
@pytest.mark.parametrize("model", ["paper", "direct"])
def test_outside_the_range_of_the_surrogate_there_is_no_number_but_a_reason(
    asking, changed, key, model
):
    found = instant(asking, CASE | changed | {"method": {"model": model}}, **ALL)
    assert found["answer"]["outside"] is True
    assert found["answer"]["critical_pressure_kPa"] is None
    assert "finite elements" in found["answer"]["sentence"]
    outside = {name for name, each in found["validity"].items() if not each["inside"]}
    assert key in outside
    sentence = found["validity"][key]["sentence"]
    assert "outside the range" in sentence
    assert found["repeat"]["command"] is None
    assert found["repeat"]["solve_command"].startswith("stonepass pressure")


def test_the_ranges_hold_for_the_surrogate_itself(asking):
    """Just inside there is an answer, just outside there is none."""
    found = instant(asking, {"stone": {"size_ratio": 1.2}, "ureter": {"wall_ratio": 1.5}})
    places = {"stone.size_ratio": ("stone", "size_ratio"), "stone.friction": ("stone", "friction"),
              "ureter.wall_ratio": ("ureter", "wall_ratio")}  # fmt: skip
    count = 0
    for key, (section, name) in places.items():
        for end, beyond in (("low", -1e-3), ("high", 1e-3)):
            edge = found["validity"][key][end]
            if edge in (0.0, 0.1):  # the smallest friction and the smallest stone of an input
                continue
            for step, outside in ((0.0, False), (beyond, True)):
                case = {"stone": {"size_ratio": 1.2}, "ureter": {"wall_ratio": 1.5}}
                case[section][name] = edge + step
                asked = instant(asking, case)
                assert asked["answer"]["outside"] is outside, (key, edge + step)
                assert asked["validity"][key]["inside"] is not outside
                count += 1
    assert count == 8


@pytest.mark.parametrize(
    ("inner", "outer", "stone"),
    [("3 mm", "3.3 mm", "3.5 mm"), ("3.7 mm", "5 mm", "5.92 mm"), ("3.5 mm", "14 mm", "4 mm")],
)
def test_the_edge_of_the_range_is_inside_although_quotients_are_rounded(
    asking, inner, outer, stone
):
    ureter = {"inner_diameter": inner, "outer_diameter": outer}
    found = instant(asking, {"stone": {"diameter": stone, "friction": 0.1}, "ureter": ureter})
    assert all(each["inside"] for each in found["validity"].values())
    assert found["answer"]["critical_pressure_kPa"] > 0.0


def test_the_direct_model_is_not_told_by_the_words_of_the_other(asking):
    case = {
        "stone": {"size_ratio": 1.2, "friction": 0.8},
        "ureter": {"wall_ratio": 1.3, "material": "latex"},
        "method": {"model": "direct"},
    }
    found = instant(asking, case, limit="90 kPa", include=["curve"])
    assert "closure" not in found["size"]["sentence"] + found["answer"]["sentence"]
    assert "paper" not in found["size"]["sentence"] + found["answer"]["sentence"]
    assert found["answer"]["lower_bound_kPa"] > 0.0
    assert "more than" in found["answer"]["sentence"]


def test_numbers_in_sentences_have_no_exponent():
    told = [digits(each) for each in (1234.5, 12.345, 0.012345, 0.0, 8.73e3)]
    assert told == ["1234", "12.3", "0.0123", "0", "8730"]
    assert digits(12.0, 1) == "12"


@pytest.mark.parametrize(
    ("case", "key"),
    [
        (CASE | {"method": {"model": "beam", "secant_stretch": 1.2}}, "method.model"),
        (CASE | {"method": {"as_printed": True}}, "method.model"),
        (CASE | {"stone": {"diameter": "4 mm", "aspect": 1.3}}, "stone.aspect"),
        (CASE | {"load": {"prestretch": 1.1}}, "load.prestretch"),
        (CASE | {"ureter": THIN | {"material": "ureter-soft-cross"}}, "ureter.material"),
        (CASE | {"method": {"half_length": 20.0}}, "method.half_length"),
    ],
)
def test_a_case_that_no_surrogate_describes_says_why(asking, case, key):
    found = instant(asking, case, **ALL)
    assert found["answer"] is None
    assert found["size"] is None
    told = [each for each in found["warnings"] if each["code"] == "no_surrogate"]
    assert [each["input"] for each in told] == [key]
    assert told[0]["sentence"].endswith("solve by finite elements instead.")


def test_warnings_stand_beside_the_input_that_causes_them(asking):
    found = instant(asking, CASE | {"stone": {"diameter": "5 mm"}})
    assert [(each["code"], each["input"]) for each in found["warnings"]] == [
        ("wall_beyond_range", "stone.size_ratio")
    ]
    keys = {each["key"] for each in asking.get("/api/v1/inputs").json()}
    assert set(CAUSES.values()) <= keys


# --- sections


@pytest.mark.parametrize("material", ["ureter", "latex"])
def test_the_stored_sections_are_those_of_the_present_constants(material):
    grid = grid_of(material)
    assert grid is not None
    assert len(digest(material)) == 64
    axes = (len(grid.fraction), len(grid.wall_ratio), len(grid.part))
    assert grid.values["inner_r"].shape[:3] == axes
    assert all(np.isfinite(each).all() for each in grid.values.values())


@pytest.mark.parametrize("material", ["ureter", "latex"])
def test_sections_cover_the_confining_pressures_of_the_instant_answer(material):
    grid, surrogate = grid_of(material), sp.load_surrogate(material, "paper")
    for wall in np.linspace(1.1, 4.0, 20):
        most = largest_load(surrogate, float(wall))
        assert grid.largest_load(float(wall)) == pytest.approx(most, rel=1e-12)


@pytest.mark.parametrize("confining", [0.0, 2800.0])
def test_an_interpolated_section_is_near_the_solved_one(confining):
    fraction, wall = 0.37, 1.32  # between the solved ones
    case, tube = case_of_section("ureter", fraction, wall, confining)
    solved = section_of(sp.PressureJob(case, wall=True).run(None))
    drawn = grid_of("ureter").section(case.size_ratio, wall, confining, tube)
    for name in ("inner_z", "inner_r", "outer_z", "outer_r"):
        assert np.abs(getattr(solved, name) - getattr(drawn, name)).max() < 0.01, name
    assert drawn.contact_angle == pytest.approx(solved.contact_angle, abs=np.radians(1.0))
    assert np.abs(drawn.pressure - solved.pressure).max() < 0.05 * solved.pressure.max()


def test_a_section_is_exact_at_a_solved_place_and_never_inside_the_stone():
    grid = grid_of("latex")
    i, j, k = 5, 4, 2
    wall = float(grid.wall_ratio[j])
    confining = float(grid.part[k]) * grid.largest_load(wall)
    case, tube = case_of_section("latex", float(grid.fraction[i]), wall, confining)
    section = grid.section(case.size_ratio, wall, confining, tube)
    stored = tube.inner + (case.size_ratio - tube.inner) * grid.values["inner_r"][i, j, k]
    inside = np.hypot(section.inner_z, section.inner_r) > case.size_ratio * (1.0 + 1e-9)
    assert np.allclose(section.inner_r[inside], stored[inside], atol=1e-12)
    for fraction in np.linspace(0.001, 1.0, 30):
        for eta, load in itertools.product((1.1, 1.37, 4.0), (0.0, 0.4, 1.0)):
            confining = load * grid.largest_load(eta)
            case, tube = case_of_section("latex", float(fraction), eta, confining)
            found = grid.section(case.size_ratio, eta, confining, tube)
            assert np.hypot(found.inner_z, found.inner_r).min() > case.size_ratio - 1e-9
            assert (found.outer_r > found.inner_r).all()


def test_a_section_under_a_load_scales_with_the_stiffness(asking):
    soft = CASE | {"load": {"confining_pressure": "2 kPa"}}
    stiff = CASE | {"load": {"confining_pressure": "4 kPa"}}
    one = instant(asking, soft, include=["section"])["section"]
    two = instant(asking, stiff, include=["section"], stiffness=2.0)["section"]
    assert one["inner"] == two["inner"]
    doubled = 2.0 * np.array(one["contact"]["pressure_kPa"])
    assert two["contact"]["pressure_kPa"] == pytest.approx(doubled, abs=3e-4)


def test_a_loose_stone_under_a_load_lies_in_the_narrowed_tube(asking):
    case = CASE | {"stone": {"diameter": "3 mm"}, "load": {"confining_pressure": "2 kPa"}}
    found = instant(asking, case, include=["section"])
    assert found["answer"]["outcome"] == "LOOSE"
    (radius,) = set(found["section"]["inner"]["r"])
    wall = sp.Ureter("3.5 mm", "4.54 mm")
    lumen = lumen_ratio(wall.wall_ratio, wall.material.law, sp.Load("2 kPa"))
    assert radius == pytest.approx(lumen, abs=1e-4)
    assert radius < 0.99


def test_a_stored_section_of_other_constants_is_not_used(monkeypatch):
    monkeypatch.setattr("stonepass.web.section.grid.digest", lambda material: "another")
    grid_of.cache_clear()
    assert grid_of("ureter") is None
    monkeypatch.undo()
    grid_of.cache_clear()
    assert isinstance(grid_of("ureter"), SectionGrid)


# --- repeating an answer


def printed(capsys, arguments):
    capsys.readouterr()
    code = run(shlex.split(arguments)[1:])
    return code, capsys.readouterr().out


@pytest.mark.parametrize("stiffness", [1.0, 0.6])
def test_the_command_and_the_python_code_repeat_the_answer(asking, capsys, stiffness):
    found = instant(asking, stiffness=stiffness)
    answer = found["answer"]
    code, out = printed(capsys, found["repeat"]["command"] + " --json")
    assert code == 0
    again = json.loads(out)[0]
    assert again.pop("outcome") == answer["outcome"]
    known = {key: each for key, each in again.items() if answer[key] is not None}
    assert known == {key: pytest.approx(answer[key], rel=1e-9) for key in known}
    assert all(again[key] is None for key in again.keys() - known.keys())
    exec(found["repeat"]["python"], {})
    again = eval(capsys.readouterr().out, {})
    assert again["critical_pressure_kPa"] == pytest.approx(
        answer["critical_pressure_kPa"], rel=1e-9
    )


def test_the_curl_command_repeats_the_request(asking):
    words = shlex.split(instant(asking, limit="6 kPa")["repeat"]["curl"])
    assert words[:2] == ["curl", "--json"]
    assert json.loads(words[2]) == {"case": CASE, "limit": "6 kPa"}
    assert words[3] == "http://127.0.0.1:8765/api/v1/instant"


QUICK = {
    "stone": {"diameter": "4.2 mm", "friction": 0.3},
    "ureter": THIN,
    "load": {"confinement": "hydrostatic"},
    "method": {"accuracy": "fast", "seating": "frictionless", "far_field_ground": True},
}


@pytest.mark.parametrize("stiffness", [1.0, 1.5])
def test_the_finite_elements_can_be_asked_by_command_python_and_file(
    asking, capsys, tmp_path, monkeypatch, stiffness
):
    repeat = instant(asking, QUICK, stiffness=stiffness)["repeat"]
    monkeypatch.chdir(tmp_path)
    (tmp_path / "case.toml").write_text(repeat["case_file"], encoding="utf-8")
    case = sp.read_case("case.toml")
    assert ("case.toml" in repeat["solve_command"]) is (stiffness != 1.0)
    alone = sp.solve(case).pressure_kPa
    code, out = printed(capsys, repeat["solve_command"] + " --json --no-cache")
    assert code == 0
    assert json.loads(out)["critical_pressure_kPa"] == pytest.approx(alone, rel=1e-12)
    exec(repeat["solve_python"], {})
    assert f"{alone:.4g} kPa"[:4] in capsys.readouterr().out


def test_texts_of_a_request_are_quoted_in_the_commands(asking):
    table = {
        "law": "neo-hookean",
        "C10": "0.1 MPa",
        "source": "$(touch x); '\"",
        "strain_range": [1.0, 1.5],
    }
    case = {"stone": {"size_ratio": 1.2}, "ureter": {"wall_ratio": 1.3, "material": table}}
    repeat = instant(asking, case)["repeat"]
    assert len(shlex.split(repeat["curl"])) == 4
    assert repeat["solve_command"] == "stonepass pressure case.toml"
    assert tomllib.loads(repeat["case_file"])["ureter"]["material"]["source"] == table["source"]


# --- problems


HUGE = 10**400  # a whole number that is no number of the machine


@pytest.mark.parametrize(
    ("changed", "field", "words"),
    [
        ({"stone": {"size_ratio": 1.2, "shape": {"aspect": HUGE}}}, "stone.shape", "'aspect' is 1"),
        ({"stone": {"size_ratio": 1.2, "shape": {"outline": 1}}}, "stone.shape", "'outline' is 1"),
        ({"stone": {"size_ratio": 1.2, "shape": {"z": [0, 1, HUGE], "rho": [0, 1, 0]}}}, "stone.shape", "'z' is"),
        ({"stone": {"size_ratio": 1.2, "shape": {"z": [0, 1, 2]}}}, "stone.shape", "both 'z' and 'rho'"),
        ({"stone": {"size_ratio": 1.2, "shape": {"radius": 1}}}, "stone.shape", "key is radius"),
        ({"method": {"closure": "series", "opening_curve": {"angle": [1]}}}, "method.opening_curve", "key is angle"),
        ({"method": {"closure": "series", "opening_curve": {"alpha_deg": [0], "radius_ratio": [1]}}},
         "method.opening_curve", "alpha of pair 1"),
        ({"method": {"closure": "series", "opening_curve": {"alpha_deg": [HUGE], "radius_ratio": [1]}}},
         "method.opening_curve", "two lists of numbers"),
    ],
)  # fmt: skip
def test_tables_of_an_input_are_refused_with_their_part(asking, changed, field, words):
    content = json.dumps({"case": CASE | changed})
    found = asking.post(
        "/api/v1/instant", content=content, headers={"content-type": "application/json"}
    )
    assert (found.status_code, found.json()["field"]) == (422, field)
    assert words in found.json()["detail"]


@pytest.mark.parametrize(
    ("load", "inside"), [("9.9 kPa", True), ("10 kPa", True), ("11 kPa", False)]
)
def test_the_range_of_the_wall_holds_at_the_largest_load(asking, load, inside):
    case = {
        "stone": {"size_ratio": 1.2},
        "ureter": {"wall_ratio": 2.0},
        "load": {"confining_pressure": load},
    }
    found = instant(asking, case)
    assert found["validity"]["ureter.wall_ratio"]["inside"]
    assert found["validity"]["ureter.wall_ratio"]["high"] == 4.0
    assert found["validity"]["load.confining_pressure"]["inside"] is inside
    assert (found["answer"]["outcome"] == "MOVES") is inside


def test_no_range_is_wider_than_what_an_input_may_be(asking):
    found = instant(asking, CASE, stiffness=20.0)
    assert found["validity"]["load.confining_pressure"]["high"] == 100e3
    assert found["validity"]["stone.size_ratio"]["low"] == 0.1


@pytest.mark.parametrize(
    ("body", "field", "words"),
    [
        ({"case": CASE, "limit": "6"}, "limit", "unit"),
        ({"case": CASE, "include": ["everything"]}, "include.0", "one of"),
        ({"case": CASE, "other": 1}, "other", "no such key"),
        ({"case": CASE | {"stone": {"frictoin": 0.5}}}, "stone.frictoin", "did you mean 'friction'"),
        ({"case": CASE | {"ston": {}}}, "ston", "did you mean 'stone'"),
        ({"case": CASE | {"stone": {"diameter": 4.2}}}, "stone.diameter", "text"),
        ({"case": CASE | {"stone": {"diameter": "4.2"}}}, "stone.diameter", "unit"),
        ({"case": CASE | {"stone": {"diameter": "4.2 mm", "size_ratio": 1.2}}}, "stone.diameter", "one of the two"),
        ({"case": CASE | {"load": {"confinement": "dea"}}}, "load.confinement", "did you mean 'dead'"),
        ({"case": CASE | {"ureter": THIN | {"material": "uretr"}}}, "ureter.material", "did you mean 'ureter'"),
    ],
)  # fmt: skip
def test_problems_name_the_field_and_say_what_is_allowed(asking, body, field, words):
    found = asking.post("/api/v1/instant", json=body)
    assert found.status_code == 422
    problem = found.json()
    assert problem["field"] == field
    assert words in problem["detail"]
    assert set(problem) <= {"type", "title", "status", "detail", "field", "value"}


COMPOSED = {
    "law": "composed",
    "source": "two parts",
    "strain_range": [1.0, 1.3],
    "fibres": {"law": "fung", "C": "0.4 MPa", "a1111": 0.7, "a2222": 0.9, "a1122": 0.2},
    "matrix": {"law": "neo-hookean", "C10": "6 kPa"},
}


@pytest.mark.parametrize(
    ("part", "key", "value", "field", "message"),
    [
        ("fibres", "a1111", "x", "fibres.a1111", "is x, but must be a number"),
        ("matrix", "C10", "6", "matrix.C10", "is 6, but must be a pressure with its unit"),
        ("matrix", "source", "x", "matrix.source", "is x, but must be left out, because there is"),
        (None, "matrix", 3, "matrix", "is 3, but must be a table"),
        (None, "law", "compsed", "law", "did you mean 'composed'"),
    ],
)
def test_the_parts_of_a_composed_law_are_named_by_their_keys(part, key, value, field, message):
    given = copy.deepcopy(COMPOSED)
    (given[part] if part else given)[key] = value
    case = {"stone": {"diameter": "4.2 mm"},
            "ureter": {"inner_diameter": "3.5 mm", "wall_thickness": "0.52 mm", "material": given}}  # fmt: skip
    with client() as asking:
        told = asking.post("/api/v1/instant", json={"case": case})
    assert told.status_code == 422
    assert told.json()["field"] == f"ureter.material.{field}"
    assert message in told.json()["detail"]
