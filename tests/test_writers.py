"""The writer contract, over every registered export format and the one of the examples."""

import runpy
import subprocess
import sys
from dataclasses import replace
from itertools import product
from pathlib import Path

import pytest
import typer
from options import asking
from typer.testing import CliRunner

import stonepass as sp
from stonepass import export
from stonepass.cli import run
from stonepass.cli.export import make_command
from stonepass.errors import BadInput
from stonepass.export.checks import names_of
from stonepass.export.contract import KINDS
from stonepass.export.input_options import FROM_CONTACT
from stonepass.export.registry import WRITERS
from stonepass.export.words import as_flag
from stonepass.inputs.catalogue import all_inputs, option_of
from stonepass.materials.demiray import Demiray
from stonepass.materials.fung import Fung
from stonepass.materials.holzapfel import HolzapfelGasserOgden
from stonepass.materials.known_laws import KNOWN_LAWS
from stonepass.materials.mooney_rivlin import MooneyRivlin
from stonepass.materials.neo_hookean import NeoHookean
from stonepass.materials.ogden import Ogden
from stonepass.materials.protocol import Material
from stonepass.materials.user_law import UserLaw
from stonepass.materials.yeoh import Yeoh

EXAMPLES = Path(__file__).parents[1] / "examples"
TOY = runpy.run_path(str(EXAMPLES / "toy_writer.py"))["CONTACT"]
ALL = (*WRITERS, TOY)
LAWS = {
    "neo-hookean": NeoHookean(1e5),
    "mooney-rivlin": MooneyRivlin(1e5, 4e4),
    "yeoh": Yeoh(1e5, 1e4, 5e3),
    "fung": Fung(4e5, 0.7, 0.9, 0.2, 1.2e4),
    "demiray": Demiray(1e5, 2.0),
    "ogden": Ogden(1e5, 2.0),
    "holzapfel-gasser-ogden": HolzapfelGasserOgden(5e4, 5e4, 1.0, 0.7),
}
OWN = UserLaw(lambda C, place, xp: 1e5 * (C.rr + C.tt + C.zz), "own")
EGG = sp.read_shape(EXAMPLES / "egg.csv")

every_writer = pytest.mark.parametrize("writer", ALL, ids=lambda writer: writer.name)


def case(law="neo-hookean", load=None, xi=1.2, shape=None, **method):
    law = LAWS[law] if isinstance(law, str) else law
    material = Material("named", law, "a test", "none", "no", (1.0, 1.5))
    stone = sp.Stone(size_ratio=xi, friction=0.3, shape=shape)
    ureter = sp.Ureter(wall_ratio=1.5, material=material)
    return sp.Case(stone, ureter, load or sp.Load(), **asking(accuracy="fast", **method))


CASES = {
    "plain": case(),
    "frictionless": case(seating="frictionless"),
    "growing": case(seating="growing"),
    "dead": case(load=sp.Load("2 kPa")),
    "hydrostatic": case(load=sp.Load("2 kPa", "hydrostatic", 1.1)),
    "spheroid": case(shape=sp.Shape(1.4)),
    "outline": case(shape=EGG),
}


@pytest.fixture(scope="module")
def answer():
    """One solved answer for all formats that show results: what they do with it is tested."""
    return sp.solve(CASES["frictionless"])


def refused(*arguments, **keywords):
    """The one sentence of a refusal."""
    with pytest.raises(BadInput) as found:
        export.write(*arguments, writers=ALL, **keywords)
    sentence = str(found.value)
    assert "\n" not in sentence
    assert sentence.endswith(".")
    return sentence


# --- declarations


def test_the_registry_holds_the_formats_and_names_and_endings_are_unique():
    assert export.formats() == WRITERS
    assert len(WRITERS) >= 3  # the other tests inspect something
    for attribute in ("name", "ending", "description"):
        assert len({getattr(writer, attribute) for writer in ALL}) == len(ALL)
    for writer in ALL:
        assert writer.ending.startswith(".")
        assert writer.ending == writer.ending.lower()
        assert set(writer.limits) <= set(KINDS)


def test_options_are_declared_in_full_and_one_name_means_one_thing():
    seen = {}
    for option in (option for writer in ALL for option in writer.options):
        assert seen.setdefault(option.name, option) == option, option.name
        assert option.name.isalpha()
        assert option.meaning
        if option.kind is str:
            assert option.default in option.choices
        else:
            assert option.bounds is not None
            assert option.default is not None or option.default_text
    assert len(seen) >= 3


def test_limits_name_only_options_and_choices_that_exist():
    checked = 0
    for writer in ALL:
        choices = {option.name: option.choices for option in writer.options}
        assert set(writer.limits) <= set(KINDS)
        for limit in writer.limits.values():
            allowed = limit.allowed
            assert allowed
            for name, value in (each for needs in allowed.values() for each in needs.items()):
                assert value in choices[name]
                checked += 1
    assert checked > 0


def test_declaring_formats_and_the_command_loads_no_numerical_library():
    code = (
        "import sys, stonepass.export\n"
        "assert not {'numpy', 'scipy', 'ngsolve', 'meshio', 'matplotlib'} & set(sys.modules)\n"
        "import stonepass.cli.export\n"  # its options are those that the models declare
        "assert not {'ngsolve', 'meshio', 'matplotlib'} & set(sys.modules)\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_the_documentation_has_every_format_with_its_options_models_and_laws():
    text = (EXAMPLES.parent / "docs" / "export.md").read_text(encoding="utf-8")
    for writer in WRITERS:
        flags = ", ".join(f"`--{option.name}`" for option in writer.options)
        models = ", ".join(f"`{name}`" for name in writer.limits["model"].names)
        cells = (f"`{writer.name}`", writer.description, flags, models)
        assert f"| {' | '.join(cells)} |".replace("|  |", "| |") in text
        for law in writer.limits["law"].names if "law" in writer.limits else ():
            assert f"`{law}`" in text


# --- refusals


@every_writer
@pytest.mark.parametrize("words", [None, as_flag])
def test_an_unknown_option_is_refused_in_the_words_of_the_door(writer, words, tmp_path):
    door = {} if words is None else {"words": words}
    told = refused(CASES["plain"], tmp_path / f"x{writer.ending}", colour="red", **door)
    assert "colour" in told
    expected = f"format='{writer.name}'" if words is None else f"--format {writer.name}"
    assert expected in told


@every_writer
def test_options_of_other_formats_are_refused(writer, tmp_path):
    own = {option.name for option in writer.options}
    others = {option.name: option for each in ALL for option in each.options}
    assert set(others) - own
    for name in set(others) - own:
        value = others[name].default or 0.1
        told = refused(CASES["plain"], tmp_path / f"x{writer.ending}", **{name: value})
        assert told.startswith(f"{name} is")
        assert f"left out with format='{writer.name}'" in told


@every_writer
def test_values_that_no_option_has_are_refused(writer, tmp_path):
    for option in writer.options:
        wrong = ["nonsense", "", True] if option.kind is str else [-1.0, float("nan"), True, "0.1"]
        for value in wrong:
            path = tmp_path / f"x{writer.ending}"
            told = refused(CASES["plain"], path, words=as_flag, **{option.name: value})
            assert told.startswith(f"--{option.name} is")


@every_writer
def test_a_law_of_ones_own_is_refused_where_laws_are_limited(writer, tmp_path):
    if "law" not in writer.limits:  # a format that shows what was solved, whatever the law
        assert sum("law" in each.limits for each in ALL) >= 3
        return
    told = refused(case(law=OWN), tmp_path / f"x{writer.ending}")
    assert told.startswith("law is a user-defined law, but must be")
    assert "yeoh" in told


@every_writer
def test_a_model_beyond_the_limit_is_refused_with_the_reason(writer, tmp_path):
    limit = writer.limits["model"]
    others = {"paper": {}, "direct": {}, "beam": {"secant_stretch": 1.1}}
    counted = 0
    for model, method in others.items():
        if model not in limit.names:
            other = case(model=model, **method)
            told = refused(other, tmp_path / f"x{writer.ending}", words=as_flag)
            assert told.startswith(f"--model is {model}, but must be")
            assert limit.reason in told
            counted += 1
    assert counted > 0


def test_a_law_that_another_option_or_format_can_express_is_refused_with_both(tmp_path):
    path = tmp_path / "x.inp"
    with pytest.raises(BadInput, match=r"use flavour='abaqus' or format='feb'\.$"):
        export.write(case("fung"), path)
    with pytest.raises(BadInput, match=r"use --flavour abaqus or --format feb\.$"):
        export.write(case("fung"), path, words=as_flag)


@pytest.mark.parametrize(
    ("name", "format", "words"),
    [
        ("x.step", None, "ending of path is x.step"),
        ("x", None, "format"),
        ("x.inp", "stl", "format is stl"),
        ("x.inp", "feb", ".feb"),
        ("nowhere/x.inp", None, "nowhere"),
    ],
)
def test_files_that_no_format_has_are_refused(name, format, words, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)  # a long path would be shown shortened
    assert words in refused(CASES["plain"], Path(name), format)


@pytest.mark.parametrize("file", ["x.inp", "x.feb"])
@pytest.mark.parametrize("option", [["--accuracy", "fast"], ["--wetted"]])
def test_a_flag_without_influence_is_refused_at_the_command_line(file, option, tmp_path, capsys):
    given = ["--xi", "1.2", "--eta", "1.5", "--material", "latex", "--out", str(tmp_path / file)]
    assert run(["export", *given, *option]) == 2
    told = capsys.readouterr().err
    assert f"{option[0]} cannot be used with --format" in told
    assert not list(tmp_path.iterdir())


def test_an_input_that_every_format_ignores_has_no_flag(capsys):
    ignored = set.intersection(*(set(writer.ignores) for writer in WRITERS))
    assert ignored == {"as_printed", "closure_start", "closure", "series_order", "opening_curve",
                       "far_field_ground"}  # fmt: skip
    assert run(["export", "--help"]) == 0
    told = " ".join(capsys.readouterr().out.split())
    for name in ignored:
        assert f"{option_of(f'method.{name}')} " not in told
    assert "--model paper|direct paper:" in told
    assert "--wetted / --dry" in told
    assert "Only for the format vtu." in told


def test_what_a_format_ignores_is_an_input_of_the_method_and_changes_nothing(tmp_path):
    """Cases that differ in such fields alone give the same file."""
    different = {"accuracy": "reference", "as_printed": True, "closure_start": "lumen",
                 "closure": "series", "series_order": 4, "far_field_ground": True}  # fmt: skip
    ignoring = [writer for writer in ALL if writer.ignores]
    assert len(ignoring) >= 2
    for writer in ignoring:
        assert {f"method.{name}" for name in writer.ignores} <= set(all_inputs())
        # A curve has the closure 'series' with it, and 'wetted' belongs to a model without a deck.
        assert set(writer.ignores) <= {*different, "opening_curve", "wetted"}
        if "accuracy" not in writer.ignores:  # a solved wall, whose solve takes none of them
            assert writer.ignores == FROM_CONTACT
            continue
        both = [
            export.write(each, tmp_path / f"x{writer.ending}").content
            for each in (CASES["dead"], replace(CASES["dead"], **asking(**different)))
        ]
        assert both[0] == both[1]


# --- files


@every_writer
@pytest.mark.parametrize("name", CASES)
def test_a_writer_writes_the_cases_that_it_claims_and_twice_the_same(
    writer, name, answer, tmp_path
):
    for kind, names in names_of(CASES[name]).items():
        limit = writer.limits.get(kind)
        if limit is not None and not set(names) <= set(limit.names):
            assert refused(CASES[name], tmp_path / f"x{writer.ending}").startswith(kind)
            return
    written = []
    for file in ("one", "two"):
        path = tmp_path / f"{file}{writer.ending}"
        made = export.write(CASES[name], path, solved=lambda: answer, writers=ALL)
        assert made.path == path
        assert made.summary
        content = made.content
        assert path.read_bytes() == (content.encode() if isinstance(content, str) else content)
        written.append(path.read_bytes())
    assert written[0] == written[1]
    assert len(written[0]) > 100


def test_the_cases_cover_every_name_that_a_limit_has():
    covered = {kind: set() for kind in KINDS}
    for each in CASES.values():
        for kind, names in names_of(each).items():
            covered[kind] |= set(names)
    for writer in ALL:
        for kind in ("seating", "load", "shape"):
            if kind in writer.limits:
                assert set(writer.limits[kind].names) <= covered[kind], (writer.name, kind)


def test_every_known_law_has_an_instance_here():
    assert set(LAWS) == set(KNOWN_LAWS)


@every_writer
@pytest.mark.parametrize("law", LAWS)
def test_a_law_is_written_if_and_only_if_it_is_declared(writer, law, answer, tmp_path):
    """For all choices of the options; where the declaration refuses, the function does so too."""
    choices = [[(o.name, c) for c in o.choices] for o in writer.options if o.choices]
    counted = 0
    for chosen in map(dict, product(*choices)):
        limit = writer.limits.get("law", export.Limit(tuple(LAWS)))
        needs = limit.allowed.get(law)
        declared = needs is not None and all(chosen[key] == each for key, each in needs.items())
        arguments = (case(law), tmp_path / f"x{writer.ending}")
        if declared:
            made = export.write(*arguments, solved=lambda: answer, writers=ALL, **chosen)
            assert made.path is not None
        else:
            assert refused(*arguments, **chosen).startswith(f"law is {law}")
            kept = {kind: each for kind, each in writer.limits.items() if kind != "law"}
            with pytest.raises(BadInput):
                export.write(*arguments, writers=(replace(writer, limits=kept),), **chosen)
        counted += 1
    assert counted >= 1


@every_writer
def test_a_stone_that_is_not_held_has_no_file(writer, tmp_path):
    path = tmp_path / f"x{writer.ending}"
    try:
        made = export.write(case(xi=0.9), path, writers=ALL)
    except BadInput as problem:  # an input file of a seated state that does not exist
        assert "lumen" in str(problem)
    else:
        assert made.path is None
        assert made.summary.startswith("LOOSE")
    assert not path.exists()


def test_the_next_step_has_the_name_of_the_file_quoted(tmp_path):
    path = tmp_path / "my stone.INP"
    made = export.write(CASES["plain"], path, flavour="abaqus", fine=0.1, element=None)
    assert made.next_step == "run it with: abaqus job='my stone' input='my stone.INP'"


def test_a_format_of_one_file_has_its_place_at_the_command_line(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    app = typer.Typer(rich_markup_mode=None)
    app.command()(make_command(ALL))
    told = " ".join(CliRunner().invoke(app, ["--help"]).output.split())
    assert "contact: table of the contact pressure" in told
    assert (
        "--unit kPa|mmHg Only for the format contact: unit of the pressure. [default: kPa]" in told
    )
    given = ["--xi", "1.2", "--eta", "1.5", "--material", "latex", "--accuracy", "fast"]
    given += ["--seating", "frictionless", "--out", "contact.csv", "--unit", "mmHg"]
    assert CliRunner().invoke(app, given).exit_code == 0
    head, *rows = Path("contact.csv").read_text(encoding="utf-8").splitlines()
    assert head == "theta_rad,contact_pressure_mmHg"
    assert len(rows) > 10
