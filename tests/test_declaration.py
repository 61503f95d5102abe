"""Each input is declared once: every door names it, refuses in its own words, and reads it back."""

import json
import math
from dataclasses import dataclass, fields, replace
from pathlib import Path

import numpy as np
import pytest

import stonepass as sp
from stonepass.cli import run
from stonepass.declaration import Kind, inputs_of
from stonepass.errors import BadInput, Misplaced
from stonepass.inputs.build import build_case
from stonepass.inputs.case_record import describe, fingerprint
from stonepass.inputs.catalogue import all_inputs, models_with, option_of, sections
from stonepass.inputs.opening_curve_file import find_opening_curve
from stonepass.inputs.schema import case_schema
from stonepass.materials.composition import Composed
from stonepass.materials.mooney_rivlin import MooneyRivlin
from stonepass.materials.neo_hookean import NeoHookean
from stonepass.model.load import Load
from stonepass.model.models.registry import MODELS
from stonepass.model.numerics import Numerics
from stonepass.model.stone import Stone
from stonepass.model.ureter import Ureter
from stonepass.records.reference import reference

DOCS = Path(__file__).parents[1] / "docs"
LATEX = ("--xi", "1.2", "--eta", "1.5", "--material", "latex")
OWNERS = (Stone, Ureter, Load, Numerics, *MODELS.values())
NUMERIC = (Kind.NUMBER, Kind.WHOLE)


def refusal(capsys, *arguments):
    assert run(["pressure", *map(str, arguments)]) == 2
    return capsys.readouterr().err


def test_all_fields_are_declared():
    """A field without a declaration would be missing at every door; the guard counts them."""
    counted = 0
    for owner in OWNERS:
        names = [each.name for each in fields(owner)]
        assert list(inputs_of(owner)) == names
        counted += len(names)
    assert counted >= 25
    assert len(all_inputs()) >= 25


@pytest.mark.parametrize("key", sorted(all_inputs()))
def test_every_input_is_at_every_door(key):
    each = all_inputs()[key]
    declaration = each.declaration
    assert declaration.option.startswith("--")
    assert declaration.meaning.endswith(".")
    listed = case_schema()["properties"][each.section]["properties"][each.name]
    assert declaration.meaning in listed["description"]
    assert f"`{key}`" in reference()
    if declaration.kind in NUMERIC:
        low, high = declaration.bounds
        assert (listed["minimum"], listed["maximum"]) == (low, high)
        assert low < high


def test_options_are_told_apart():
    options = [option_of(key) for key in all_inputs()]
    assert len(set(options)) == len(options)
    titles = [each.title for each in all_inputs().values()]
    assert len(set(titles)) == len(titles)


@pytest.mark.parametrize(
    "key", [k for k, each in all_inputs().items() if each.declaration.kind in NUMERIC]
)
def test_a_number_out_of_bounds_is_refused_in_the_words_of_the_command_line(key, capsys):
    each = all_inputs()[key]
    low, high = each.declaration.bounds
    option, beyond = option_of(key), math.ceil(high) + 1
    base = {"--xi": "1.2", "--eta": "1.3"}
    owners = models_with(each.name) if each.section == "method" else []
    if owners and "paper" not in owners:
        base["--model"] = owners[0]
    if owners == ["beam"] and each.name != "secant_stretch":
        base["--secant-stretch"] = "1.2"
    base[option] = str(beyond)
    words = refusal(capsys, *[word for pair in base.items() for word in pair])
    assert f"{option} is {beyond}" in words
    assert f"from {low:g} to {high:g}" in words


def test_a_misfit_is_refused_in_the_words_of_the_door(capsys, tmp_path):
    words = refusal(capsys, *LATEX, "--E1", "0.4MPa")
    assert "--E1 cannot be used with the model 'paper': it belongs to 'beam'" in words
    words = refusal(capsys, *LATEX, "--wetted")
    assert "--wetted cannot be used with the model 'paper': it belongs to 'direct'" in words
    words = refusal(capsys, *LATEX, "--model", "direct", "--seating", "growing")
    assert "--seating cannot be used with the model 'direct': it belongs to 'paper'" in words
    path = tmp_path / "case.toml"
    path.write_text(
        "[stone]\nsize_ratio = 1.2\n[ureter]\nwall_ratio = 1.3\n"
        '[method]\ncircumferential_modulus = "0.4 MPa"\n'
    )
    words = refusal(capsys, path)
    assert "in case.toml, 'method.circumferential_modulus' cannot be used with the model" in words
    path.write_text("[stone]\nsize_ratio = 1.2\nfriction = 7\n[ureter]\nwall_ratio = 1.3\n")
    assert "in case.toml, 'stone.friction' is 7" in refusal(capsys, path)
    with pytest.raises(BadInput, match=r"^friction is 7"):
        sp.Stone(size_ratio=1.2, friction=7)


@pytest.mark.parametrize(
    "pair",
    [
        ("--stone", "4mm", "--xi", "1.2"),
        ("--outer", "4mm", "--eta", "1.2"),
        ("--aspect", "1.2", "--shape", "egg.csv"),
    ],
)
def test_two_ways_to_say_one_thing_are_refused(pair, capsys):
    words = refusal(capsys, "--inner", "3mm", *pair)
    assert f"{pair[0]} cannot be used with {pair[2]}" in words


def test_the_default_of_friction_stands_once():
    assert sp.Stone(size_ratio=1.2).friction == inputs_of(Stone)["friction"].default == 0.5
    schema = case_schema()["properties"]["stone"]["properties"]["friction"]
    assert schema["default"] == 0.5
    sources = (Path(sp.__file__).parent).rglob("*.py")
    found = [p.name for p in sources if "friction: float = 0.5" in p.read_text(encoding="utf-8")]
    assert found == []


def test_the_schema_and_the_reference_in_docs_are_in_step():
    schema = json.loads((DOCS / "data" / "case.schema.json").read_text(encoding="utf-8"))
    assert schema == case_schema(), "write it again: python docs/write_reference.py"
    page = (DOCS / "reference.md").read_text(encoding="utf-8")
    assert page == reference(), "write it again: python docs/write_reference.py"


# What is made in Python can be written to a case file and read back.

Z = np.linspace(0.0, 2.2, 25)
RHO = np.sqrt(np.maximum(0.0, 1.0 - (Z / 1.1 - 1.0) ** 2)) * (1.0 + 0.1 * (Z / 1.1 - 1.0))


def made_in_python():
    ureter = Ureter(wall_ratio=1.4, material="latex")
    egg = sp.shape_through(Z, RHO)
    own = sp.Material("mine", MooneyRivlin(4e4, 2e4), "", "", "", (1.0, 1.5))
    fibres = sp.HolzapfelGasserOgden(1e4, 2e4, 3.0, 0.7)
    mixed = sp.Composed(Composed(MooneyRivlin(4e4, 2e4), NeoHookean(1e4)), fibres)
    composed = sp.Material("mixed", mixed, "a source", "", "", (1.0, 1.2))
    curve = sp.OpeningCurve((1.2, 1.3, 1.4), (1.01, 1.05, 1.1))
    series = sp.SeatedBalance(closure="series", series_order=2, opening_curve=curve)
    yield "shape", sp.Case(Stone(size_ratio=1.2, shape=egg), ureter)
    yield "law", sp.Case(Stone("3 mm", 0.2), Ureter("2.5 mm", "4 mm", own), Load("3 kPa"))
    yield "composed law", sp.Case(Stone("3 mm"), Ureter("2.5 mm", "4 mm", composed))
    yield "curve", sp.Case(Stone(size_ratio=1.2), ureter, model=series)
    for name, model in (
        ("direct", sp.PushThrough(wetted=True)),
        ("moduli", sp.ElasticFoundation("0.4 MPa", "20 kPa")),
        ("secant", sp.ElasticFoundation(secant_stretch=1.2)),
        ("paper", sp.SeatedBalance("growing", 0.1, True, "lumen", far_field_ground=True)),
    ):
        numerics = Numerics("fast", 12.0)
        yield name, sp.Case(Stone("4 mm", aspect=1.4), Ureter("3.5 mm", wall_ratio=1.3),
                            Load("2 kPa", "hydrostatic", 1.1), model, numerics)  # fmt: skip


CASES = dict(made_in_python())


@pytest.mark.parametrize("name", CASES)
def test_a_case_made_in_python_is_written_and_read_back(name, tmp_path):
    case = CASES[name]
    sp.write_case(case, tmp_path / "case.toml")
    back = sp.read_case(tmp_path / "case.toml")
    described = [describe(each, each.model, each.numerics) for each in (case, back)]
    first, second = (json.loads(json.dumps(each)) for each in described)
    assert first == second
    assert fingerprint(case, case.model, case.numerics) == fingerprint(
        back, back.model, back.numerics
    )


@pytest.mark.parametrize("seed", range(20))
def test_written_numbers_are_read_back_exactly(seed, tmp_path):
    """Numbers that are not exact in mm, kPa or degrees would give a case another fingerprint."""
    draw = np.random.default_rng(seed).uniform
    law = sp.HolzapfelGasserOgden(1e4 * draw(), 2e4 * draw(), draw(1.0, 5.0), draw(0.1, 1.4))
    wall = sp.Material("mine", law, "", "", "", (1.0, 1.0 + draw()))
    inner = sp.Length(draw(2e-3, 3e-3))
    angles = np.sort(draw(1.0, 1.5, 4))
    curve = sp.OpeningCurve(tuple(angles.tolist()), (1.01, 1.05, 1.1, 1.0 + draw(0.11, 0.3)))
    series = sp.SeatedBalance(closure="series", series_order=2, opening_curve=curve)
    outer = sp.Length(inner * draw(1.2, 2.0))
    stone = Stone(sp.Length(inner * draw(1.05, 1.3)), draw())
    load = Load(sp.Pressure(draw(1.0, 9e3)))
    case = sp.Case(stone, Ureter(inner, outer, wall), load, series)
    sp.write_case(case, tmp_path / "case.toml")
    back = sp.read_case(tmp_path / "case.toml")
    assert describe(back, back.model, back.numerics) == describe(case, case.model, case.numerics)


def test_an_opening_curve_has_angles_in_one_unit():
    radius = [1.01, 1.05, 1.1]
    given = {"alpha_rad": [1.2, 1.3, 1.4], "radius_ratio": radius}
    assert find_opening_curve(given) == sp.OpeningCurve((1.2, 1.3, 1.4), tuple(radius))
    with pytest.raises(BadInput, match="must be one of alpha_deg and alpha_rad"):
        find_opening_curve(given | {"alpha_deg": [70.0, 75.0, 80.0]})


def test_a_fingerprint_tells_cases_apart_and_is_plain():
    case = CASES["paper"]
    mark = fingerprint(case, case.model, case.numerics)
    assert len(mark) == 64
    assert mark != fingerprint(case, sp.PushThrough(), case.numerics)
    assert mark != fingerprint(case.with_friction(0.1), case.model, case.numerics)
    assert mark != fingerprint(case, case.model, replace(case.numerics, half_length=13.0))


def test_a_users_function_cannot_be_written(tmp_path):
    from stonepass.materials.user_law import UserLaw

    wall = sp.Material("mine", UserLaw(lambda *a: 0.0, "energy"), "", "", "", (1.0, 1.5))
    case = sp.Case(Stone(size_ratio=1.2), Ureter(wall_ratio=1.3, material=wall))
    with pytest.raises(BadInput, match=r"must be one of neo-hookean.* to be written"):
        sp.write_case(case, tmp_path / "case.toml")


def test_the_constructor_of_a_value_reads_no_file(tmp_path):
    law = tmp_path / "law.py"
    law.write_text("raise SystemExit('executed')\n")
    with pytest.raises(BadInput, match="load_material"):
        Ureter(wall_ratio=1.3, material=f"{law}:energy")
    with pytest.raises(BadInput, match="load_material"):
        Ureter(wall_ratio=1.3, material="law.toml")
    with pytest.raises(BadInput, match="a Python file that runs"):
        sp.load_material(f"{law}:energy")


def test_models_refuse_what_does_not_go_together():
    with pytest.raises(Misplaced, match="secant_stretch cannot be used with a modulus"):
        sp.ElasticFoundation("0.4 MPa", "20 kPa", 1.2)
    with pytest.raises(BadInput, match="longitudinal_modulus is missing"):
        sp.ElasticFoundation("0.4 MPa")
    with pytest.raises(Misplaced, match="opening_curve cannot be used with the closure 'linear'"):
        sp.SeatedBalance(opening_curve=sp.OpeningCurve((1.2, 1.3, 1.4), (1.0, 1.1, 1.2)))
    with pytest.raises(BadInput, match=r"model is .*PushThrough"):
        sp.Case(Stone(size_ratio=1.2), Ureter(wall_ratio=1.3), model=sp.PushThrough)
    assert NeoHookean(1.0).C10 == 1.0
    assert set(sections()) == {"stone", "ureter", "load", "method"}


BASE = {
    "stone.size_ratio": 1.2, "stone.friction": 0.3, "ureter.wall_ratio": 1.5,
    "ureter.material": "latex", "load.confining_pressure": "2 kPa",
}  # fmt: skip
# One changed value of every declared input, and further values that this needs.
CHANGED = {
    "stone.diameter": {"stone.diameter": "4 mm", "stone.size_ratio": None,
                       "ureter.inner_diameter": "3.5 mm"},
    "stone.friction": {"stone.friction": 0.4},
    "stone.size_ratio": {"stone.size_ratio": 1.3},
    "stone.aspect": {"stone.aspect": 1.2},
    "stone.shape": {"stone.shape": {"aspect": 1.3}},
    "ureter.inner_diameter": {"ureter.inner_diameter": "3.5 mm"},
    "ureter.outer_diameter": {"ureter.inner_diameter": "3.5 mm", "ureter.outer_diameter": "6 mm",
                              "ureter.wall_ratio": None},
    "ureter.material": {"ureter.material": "ureter"},
    "ureter.wall_ratio": {"ureter.wall_ratio": 1.6},
    "ureter.wall_thickness": {"ureter.inner_diameter": "3.5 mm", "ureter.wall_ratio": None,
                              "ureter.wall_thickness": "0.5 mm"},
    "load.confining_pressure": {"load.confining_pressure": "3 kPa"},
    "load.confinement": {"load.confinement": "hydrostatic"},
    "load.prestretch": {"load.prestretch": 1.1},
    "method.model": {"method.model": "direct"},
    "method.seating": {"method.seating": "growing"},
    "method.seating_friction": {"method.seating_friction": 0.1},
    "method.as_printed": {"method.as_printed": True},
    "method.closure_start": {"method.closure_start": "lumen"},
    "method.closure": {"method.closure": "series"},
    "method.series_order": {"method.closure": "series", "method.series_order": 4},
    "method.opening_curve": {"method.closure": "series", "method.series_order": 1,
                             "method.opening_curve": {"alpha_deg": [80.0, 90.0],
                                                      "radius_ratio": [1.0, 1.2]}},
    "method.far_field_ground": {"method.far_field_ground": True},
    "method.wetted": {"method.model": "direct", "method.wetted": True},
    "method.circumferential_modulus": {"method.model": "beam",
                                       "method.circumferential_modulus": "0.4 MPa",
                                       "method.longitudinal_modulus": "0.02 MPa"},
    "method.longitudinal_modulus": {"method.model": "beam",
                                    "method.circumferential_modulus": "0.4 MPa",
                                    "method.longitudinal_modulus": "0.03 MPa"},
    "method.secant_stretch": {"method.model": "beam", "method.secant_stretch": 1.2},
    "method.accuracy": {"method.accuracy": "fast"},
    "method.half_length": {"method.half_length": 12.0},
}  # fmt: skip


def test_every_declared_input_is_in_the_canonical_record():
    """An input that is added and not in the record would make two cases equal."""
    assert set(CHANGED) == set(all_inputs())
    prints = {}
    for key, changed in ({"": {}} | CHANGED).items():
        values = {name: value for name, value in (BASE | changed).items() if value is not None}
        case = build_case(values)
        prints[key] = fingerprint(case, case.model, case.numerics)
    assert len(set(prints.values())) == len(prints), prints


def test_laws_inside_a_law_are_told_apart_by_the_record():
    """Two laws with the same constants and different names, each beside the same fibres."""

    @dataclass(frozen=True)
    class Other(NeoHookean):
        pass

    prints = set()
    for matrix in (NeoHookean(5e3), Other(5e3), NeoHookean(6e3)):
        wall = sp.Material("m", Composed(NeoHookean(1e5), matrix), "", "", "", (1.0, 1.5))
        case = sp.Case(Stone(size_ratio=1.2), Ureter(wall_ratio=1.5, material=wall))
        prints.add(fingerprint(case, case.model, case.numerics))
    assert len(prints) == 3
