"""The command line as a user meets it: exit codes, streams, files, sentences."""

import csv
import json
import os
import re
import shlex
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import typer
from typer.main import get_command

import stonepass
from stonepass.cli import run, terminal
from stonepass.cli.app import COMMANDS, PANELS, app
from stonepass.cli.curve import size_range
from stonepass.cli.greeting import BEGINNINGS
from stonepass.inputs.case_file import read_case
from stonepass.paper.inputs import ureter_case
from stonepass.report.table import significant

pytestmark = pytest.mark.usefixtures("shared_solutions")

PRESSURE_KEYS = [
    "outcome", "message", "critical_pressure_kPa", "critical_pressure_error_kPa",
    "critical_angle_deg", "contact_angle_deg", "contact_angle_error_deg",
    "equator_contact_pressure_kPa", "equator_contact_pressure_error_kPa",
    "peak_contact_pressure_kPa", "downstream_angle_deg", "stability_margin", "detail",
    "size_ratio", "wall_ratio", "model", "material", "case", "solver", "warnings",
    "record_version", "version", "disclaimer",
]  # fmt: skip
LATEX = ["--xi", "1.2", "--eta", "1.5", "--material", "latex", "--seating", "frictionless"]
FAST = ["--accuracy", "fast"]  # where a test is about the door, not about the number
SMOOTH = [*FAST, "--seating", "frictionless"]
SHORT = ["--half-length", "4"]  # a short tube, which solves faster still


@pytest.fixture
def cli(capsys):
    """Run the command line in this process: (exit code, stdout, stderr)."""

    def call(*arguments):
        code = run([str(a) for a in arguments])
        out, err = capsys.readouterr()
        return code, out, err

    return call


def test_pressure_json_has_every_key_and_nothing_else_is_on_stdout(cli):
    code, out, err = cli("pressure", *LATEX, "--json")
    record = json.loads(out)
    assert code == 0
    assert err == ""
    assert list(record) == PRESSURE_KEYS
    assert record["outcome"] == "MOVES"
    assert record["critical_pressure_kPa"] == pytest.approx(41.53, abs=0.05)
    assert 0.0 < record["critical_pressure_error_kPa"] < 1e-3 * record["critical_pressure_kPa"]
    assert 0.0 < record["contact_angle_error_deg"] < 0.05
    # Claimed at default settings: no more than the 0.2 % that the verification page holds them to.
    claimed, equator = (record[f"equator_contact_pressure{part}_kPa"] for part in ("_error", ""))
    assert 0.0 < claimed < 2e-3 * equator
    assert record["case"]["ureter"]["material"]["constants"] == {"C10": 146500.0}
    assert set(record["solver"]) == {"dofs", "newton_steps", "seconds", "residual"}
    assert 0.0 <= record["solver"]["residual"] < 1e-8
    assert record["version"] == stonepass.__version__
    assert "Not a medical device" in record["disclaimer"]


def test_lengths_and_ratios_give_the_same_answer(cli):
    by_length = json.loads(
        cli(
            "pressure", "--stone", "4.2mm", "--inner", "3.5mm", "--outer", "4.55mm", *FAST, "--json"
        )[1]
    )
    by_ratio = json.loads(cli("pressure", "--xi", 1.2, "--eta", 1.3, *FAST, "--json")[1])
    assert by_length["critical_pressure_kPa"] == pytest.approx(
        by_ratio["critical_pressure_kPa"], rel=1e-9
    )
    assert by_length["case"]["stone"]["diameter_m"] == 0.0042
    assert by_ratio["case"]["stone"]["diameter_m"] is None


def test_numbers_that_do_not_exist_are_null(cli):
    code, out, _ = cli("pressure", "--xi", 0.9, "--eta", 1.3, "--json")
    record = json.loads(out)
    assert (code, record["outcome"], record["critical_pressure_kPa"]) == (0, "LOOSE", 0.0)
    for key in ("critical_angle_deg", "contact_angle_deg", "stability_margin",
                "critical_pressure_error_kPa", "contact_angle_error_deg"):  # fmt: skip
        assert record[key] is None
    assert record["detail"] == {}
    assert record["solver"] == dict.fromkeys(("dofs", "newton_steps", "seconds", "residual"))


def test_accuracy_is_chosen_kept_and_told(cli, tmp_path):
    path = tmp_path / "case.toml"
    rough = json.loads(cli("pressure", *LATEX, "--accuracy", "fast", "--save", path, "--json")[1])
    usual = json.loads(cli("pressure", *LATEX, "--json")[1])
    assert json.loads(cli("pressure", path, "--json")[1])["case"]["numerics"]["accuracy"] == "fast"
    assert (rough["case"]["numerics"]["accuracy"], usual["case"]["numerics"]["accuracy"]) == (
        "fast",
        "standard",
    )
    assert rough["solver"]["dofs"] < usual["solver"]["dofs"]
    for key in ("critical_pressure_error_kPa", "contact_angle_error_deg"):
        assert rough[key] > usual[key]
    code, _, err = cli("pressure", *LATEX, "--accuracy", "best")
    assert (code, err.count("\n")) == (2, 1)
    assert "fast, standard, reference" in err


def test_a_table_for_people_in_three_units(cli):
    code, out, _ = cli("pressure", *LATEX)
    assert code == 0
    assert re.search(r"critical pressure +41\.5\d .*± 0\.0\d+ %", out)
    assert re.search(r"contact angle +71\.93° +± 0\.0\d+°", out)
    for part in ("kPa", "mmHg", "cmH₂O", "critical pressure", "41.5", "311", "MOVES"):
        assert part in out
    assert max(map(len, out.splitlines())) <= 100


def test_errors_in_tables_are_rounded_up(cli):
    record = json.loads(cli("pressure", *LATEX, "--json")[1])
    table = cli("pressure", *LATEX)[1]
    claims = {
        r"critical pressure .*± ([\d.]+) %": 100.0
        * record["critical_pressure_error_kPa"]
        / record["critical_pressure_kPa"],
        r"contact angle .*± ([\d.]+)°": record["contact_angle_error_deg"],
    }
    for pattern, error in claims.items():
        assert error <= float(re.search(pattern, table)[1]) <= 2.0 * error


def test_no_answer_is_exit_1(cli):
    code, out, _ = cli("pressure", *LATEX, "--friction", 1.5, "--json")
    assert (code, json.loads(out)["outcome"]) == (1, "BEYOND_CLOSURE")
    code, out, _ = cli("pressure", "--xi", 1.2, "--eta", 1.3, "--prestretch", 0.85, *FAST, "--json")
    record = json.loads(out)
    assert (code, record["outcome"]) == (1, "NO_SOLUTION")
    assert "the tube itself is not stable under this load" in record["message"]
    code, out, _ = cli("size", "--eta", 1.3, "--limit", "50kPa", *FAST, "--json")
    assert (code, json.loads(out)["outcome"]) == (1, "BEYOND_RANGE")


@pytest.mark.slow
def test_no_size_below_the_range_is_exit_1(cli):
    code, out, _ = cli("size", "--eta", 1.3, "--limit", "1Pa", "--friction", 1, *FAST, "--json")
    assert (code, json.loads(out)["outcome"]) == (1, "BELOW_RANGE")


def test_warnings_go_to_stderr_and_into_the_record(cli):
    code, out, err = cli("pressure", "--xi", 1.35, "--eta", 1.3, *FAST)
    assert code == 0
    assert "1 to 1.3 only" in err
    assert "1 to 1.3 only" not in out
    record = json.loads(cli("pressure", "--xi", 1.35, "--eta", 1.3, *FAST, "--json")[1])
    assert len(record["warnings"]) == 1


def test_profile_has_both_edges_as_rows(cli, tmp_path):
    path = tmp_path / "p.csv"
    record = json.loads(cli("pressure", *LATEX, "--profile", path, "--json")[1])
    with path.open() as file:
        rows = list(csv.DictReader(file))
    theta = np.array([float(row["theta_deg"]) for row in rows])
    sigma = np.array([float(row["contact_pressure_kPa"]) for row in rows])
    edge = record["contact_angle_deg"]
    assert (theta[0], theta[-1]) == (0.0, 180.0)
    assert np.diff(theta).min() > 0.0
    assert np.diff(theta).max() <= 0.1 + 1e-9
    for angle in (edge, 180.0 - edge):
        assert np.abs(theta - angle).min() < 1e-6
    outside = (theta < edge - 1e-6) | (theta > 180.0 - edge + 1e-6)
    assert np.all(sigma[outside] == 0.0)
    assert np.all(sigma[~outside][1:-1] > 0.0)
    assert sigma.max() == pytest.approx(record["peak_contact_pressure_kPa"], rel=1e-6)


def test_a_profile_says_where_on_the_stone_its_angles_are(cli, tmp_path):
    """The angle of a spheroid is parametric: r = sin θ, z = −aspect × cos θ, over its radius."""
    path = tmp_path / "p.csv"
    for aspect, name in ((1.0, "theta_deg"), (1.5, "parametric_angle_deg")):
        assert cli("pressure", *LATEX, *FAST, "--aspect", aspect, "--profile", path)[0] == 0
        with path.open() as file:
            header, *rows = csv.reader(file)
        assert header == [name, "contact_pressure_kPa", "z_over_radius", "r_over_radius"]
        theta, _, z, r = np.array(rows, dtype=float).T
        np.testing.assert_allclose(z, -aspect * np.cos(np.radians(theta)), atol=1e-9)
        np.testing.assert_allclose(r, np.sin(np.radians(theta)), atol=1e-9)


@pytest.mark.parametrize("ending", ["svg", "png", "pdf"])
def test_figures_are_written(cli, tmp_path, ending):
    path = tmp_path / f"f.{ending}"
    assert cli("pressure", *LATEX, "--figure", path, "--json")[0] == 0
    magic = {"svg": b"<?xml", "png": b"\x89PNG", "pdf": b"%PDF"}[ending]
    assert path.read_bytes().startswith(magic)


def test_without_a_seated_stone_nothing_is_written_and_the_outcome_stays(cli, tmp_path):
    path = tmp_path / "p.csv"
    code, out, err = cli("pressure", "--xi", 0.9, "--eta", 1.3, "--profile", path, "--json")
    assert (code, json.loads(out)["outcome"]) == (0, "LOOSE")
    assert "neither profile nor figure" in err
    assert not path.exists()


def test_pressures_are_shown_in_their_units(cli):
    # 12 kPa = 12000/133.322 = 90.01 mmHg = 12000/98.0665 = 122.4 cmH₂O.
    out = cli("size", "--eta", 1.3, "--limit", "12kPa", *SMOOTH)[1]
    limit = next(line for line in out.splitlines() if "pressure limit" in line)
    assert limit.split()[-3:] == ["12.00", "90.01", "122.4"]


def test_laws_that_print_or_warn_leave_stdout_to_the_answer(cli, tmp_path):
    law = tmp_path / "law.py"
    law.write_text(
        "import warnings\nprint('hello')\n"
        "def energy(C, place, xp):\n"
        "    print('called'); warnings.warn('beware')\n"
        "    return 146.5e3 * (C.I1 - 3.0)\n"
    )
    options = ["--xi", "1.2", "--eta", "1.5", "--seating", "frictionless", "--json"]
    code, out, _ = cli("pressure", *options, "--material", f"{law}:energy")
    assert code == 0
    assert json.loads(out)["critical_pressure_kPa"] == pytest.approx(41.53, abs=0.05)


def test_a_law_with_a_strain_limit_ends_in_an_outcome(cli, tmp_path):
    """U = −log(1 − (I₁ − 3)/0.5): no energy beyond I₁ = 3.5, so the iteration meets NaN."""
    law = tmp_path / "lock.py"
    law.write_text(
        "def energy(C, place, xp):\n"
        "    return -5e4 * xp.log(1.0 - (C.I1 - 3.0) / 0.5)\n"
        "strain_range = (1.0, 1.3)\n"
    )
    command = [sys.executable, "-m", "stonepass", "pressure", "--xi", "1.6", "--eta", "1.3"]
    done = subprocess.run(
        [*command, "--material", f"{law}:energy", *FAST, "--json"], capture_output=True, text=True
    )
    assert done.returncode == 1
    assert json.loads(done.stdout)["outcome"] == "NO_SOLUTION"
    assert "Traceback" not in done.stderr


def test_single_sizes_of_a_case_file_can_be_changed(cli, tmp_path):
    path = tmp_path / "case.toml"
    path.write_text(
        '[stone]\ndiameter = "3.4 mm"\n[ureter]\ninner_diameter = "3.5 mm"\n'
        'outer_diameter = "4.55 mm"\n'
    )
    wider = json.loads(cli("pressure", path, "--outer", "5.25mm", "--json")[1])
    assert (wider["wall_ratio"], wider["outcome"]) == (1.5, "LOOSE")
    by_ratio = json.loads(cli("pressure", path, "--eta", "1.4", "--json")[1])
    assert by_ratio["wall_ratio"] == 1.4
    inner = json.loads(cli("pressure", path, "--inner", "3.45mm", "--json")[1])
    assert inner["size_ratio"] == pytest.approx(3.4 / 3.45)


def test_another_seating_leaves_the_files_friction_behind(cli, tmp_path):
    path = tmp_path / "c.toml"
    small = ["--xi", "0.9", "--eta", "1.5"]
    assert cli("pressure", *small, "--seating-friction", "0.3", "--save", path)[0] == 0
    code, out, _ = cli("pressure", path, "--seating", "frictionless", "--json")
    assert (code, json.loads(out)["case"]["model"]["seating_friction"]) == (0, None)


def test_every_kind_of_warning_of_a_curve_is_told(cli):
    code, out, err = cli(
        "curve", "--eta", 1.3, "--friction", 0.02, "--confining", "4kPa", "--xi", "1.2:1.35:0.15",
        "--seating", "frictionless", *FAST, "--json",
    )  # fmt: skip
    assert code == 0
    kinds = {
        word for row in json.loads(out) for w in row["warnings"] for word in w["sentence"].split()
    }
    assert {"narrowed", "stretches"} <= kinds
    out, err = cli(
        "curve", "--eta", 1.3, "--friction", 0.02, "--confining", "4kPa", "--xi", "1.2:1.35:0.15",
        "--seating", "frictionless", *FAST,
    )[1:]  # fmt: skip
    for part in ("narrowed lumen", "stretches the wall", "narrows the lumen", "not stable"):
        assert part in err


def test_without_arguments_three_commands_are_shown(cli):
    code, out, err = cli()
    assert (code, err) == (0, "")
    assert out.count("    stonepass ") == len(BEGINNINGS) == 3
    for command, question in BEGINNINGS:
        assert question in out
        assert COMMANDS[command.split()[0]]
    for group in ("material", "fit"):
        code, out, err = cli(group)
        assert (code, err) == (0, "")
        assert f"Usage: stonepass {group}" in out


def test_save_and_read_again(cli, tmp_path):
    path = tmp_path / "case.toml"
    arguments = [
        *LATEX,
        "--friction",
        0.3,
        "--seating",
        "growing",
        "--seating-friction",
        0.1,
        "--half-length",
        12,
        "--as-printed",
        *FAST,
    ]
    first = json.loads(cli("pressure", *arguments, "--save", path, "--json")[1])
    again = json.loads(cli("pressure", path, "--json")[1])
    for record in (first, again):
        record["solver"].pop("seconds")
    assert again == first
    assert read_case(path).model.as_printed


def test_options_win_over_the_case_file(cli, tmp_path):
    path = tmp_path / "case.toml"
    cli("pressure", *LATEX, "--friction", 0.3, *FAST, "--save", path, "--json")
    changed = json.loads(
        cli("pressure", path, "--xi", 1.1, "--friction", 0.1, "--half-length", 8, "--json")[1]
    )
    assert changed["size_ratio"] == 1.1
    assert changed["case"]["stone"]["friction"] == 0.1
    assert changed["case"]["numerics"]["half_length"] == 8.0
    assert changed["material"] == "latex"
    size = json.loads(cli("size", path, "--limit", "10kPa", "--json")[1])
    assert (size["wall_ratio"], size["case"]["stone"]["friction"]) == (1.5, 0.3)


def test_the_direct_model_answers_draws_and_writes(cli, tmp_path):
    figure, profile = tmp_path / "push.png", tmp_path / "sigma.csv"
    code, out, _ = cli(
        "pressure", *LATEX[:6], "--friction", 0.475, "--model", "direct", "--accuracy", "fast",
        "--figure", figure, "--profile", profile, "--json",
    )  # fmt: skip
    record = json.loads(out)
    assert code == 0
    assert record["model"] == "direct"
    assert record["critical_pressure_kPa"] == pytest.approx(38.83, abs=0.02)
    assert record["detail"]["leak_pressure_kPa"] == pytest.approx(66.0, rel=0.02)
    assert record["contact_angle_deg"] == record["critical_angle_deg"]
    assert record["contact_angle_deg"] < record["detail"]["seal_angle_deg"]
    assert record["detail"]["seal_angle_deg"] < record["downstream_angle_deg"]
    assert "closure_end_pressure_kPa" not in record["detail"]
    assert figure.stat().st_size > 20_000
    rows = list(csv.reader(profile.read_text().splitlines()))[1:]
    assert float(rows[0][1]) == pytest.approx(record["critical_pressure_kPa"])
    assert float(rows[-1][1]) == 0.0
    code, out, _ = cli("pressure", *LATEX[:6], "--friction", 0.475, "--model", "direct", *FAST)
    assert code == 0
    assert "leak pressure" in out


def test_a_long_stone_needs_more_pressure_and_its_case_file_keeps_the_aspect(cli, tmp_path):
    for model in ("paper", "direct"):
        saved = tmp_path / f"long-{model}.toml"
        common = (*(LATEX if model == "paper" else LATEX[:6]), "--model", model, *FAST)
        sphere = json.loads(cli("pressure", *common, "--json")[1])
        record = json.loads(cli("pressure", *common, "--aspect", 1.4, "--save", saved, "--json")[1])
        assert record["case"]["stone"]["shape"]["aspect"] == 1.4
        assert record["critical_pressure_kPa"] > sphere["critical_pressure_kPa"]
        again = json.loads(cli("pressure", saved, "--json")[1])
        assert again["critical_pressure_kPa"] == record["critical_pressure_kPa"]
    code, _, err = cli("pressure", *LATEX, "--aspect", 3)
    assert code == 2
    assert "--aspect is 3.0, but must be a number from 0.5 to 2" in err


def test_a_stone_by_its_meridian(cli, tmp_path):
    """The example's egg: both models, its pictures, its case file; and what is refused."""
    egg = Path(__file__).parents[1] / "examples" / "egg.csv"
    common = (*LATEX[:6], "--shape", egg, *FAST, *SHORT)
    for model, options in (("paper", LATEX[6:]), ("direct", ())):
        saved, figure = tmp_path / f"{model}.toml", tmp_path / f"{model}.svg"
        code, out, _ = cli(
            "pressure",
            *common,
            *options,
            "--model",
            model,
            "--save",
            saved,
            "--figure",
            figure,
            "--json",
        )
        assert code == 0
        record = json.loads(out)
        assert record["case"]["stone"]["shape"]["aspect"] == pytest.approx(1.3, abs=0.1)
        assert len(record["case"]["stone"]["shape"]["outline"]) > 4
        assert record["case"]["stone"]["shape"]["deviation"] < 1e-3
        assert record["contact_angle_deg"] < 90.0 < record["downstream_angle_deg"]
        assert figure.stat().st_size > 10_000
        again = json.loads(cli("pressure", saved, "--json")[1])
        assert again["critical_pressure_kPa"] == record["critical_pressure_kPa"]
    table = cli("pressure", *common, *LATEX[6:])[1]
    assert "shape egg.csv" in table
    assert "contact ends" in table
    code, _, err = cli("pressure", *common, "--aspect", 1.2)
    assert (code, "--aspect cannot be used with --shape" in err) == (2, True)
    sphere = json.loads(cli("pressure", tmp_path / "paper.toml", "--aspect", 1, "--json")[1])
    assert sphere["case"]["stone"]["shape"]["outline"] == [1.0]
    broken = tmp_path / "broken.csv"
    broken.write_text("z,rho\n0,0\n1,x\n")
    code, _, err = cli("pressure", *LATEX, "--shape", broken)
    assert (code, "broken.csv, row 3, column 'rho' is x, but must be a number" in err) == (2, True)


DIRECT = ("--eta", 1.3, "--model", "direct", *FAST)


@pytest.mark.slow
def test_curve_takes_the_direct_model(cli, tmp_path):
    out = tmp_path / "c.csv"
    assert cli("curve", *DIRECT, "--xi", "1.1:1.2:0.1", "--out", out)[0] == 0
    low, high = (
        float(row["critical_pressure_kPa"]) for row in csv.DictReader(out.read_text().splitlines())
    )
    assert 0.0 < low < 8.0 < high


@pytest.mark.slow
def test_size_takes_the_direct_model(cli):
    size = json.loads(cli("size", *DIRECT, "--limit", "8kPa", "--json")[1])
    assert 1.1 < size["critical_size_ratio"] < 1.2
    assert size["critical_pressure_kPa"] == pytest.approx(8.0, rel=1e-4)


def test_size_json(cli):
    code, out, _ = cli(
        "size", "--inner", "3.5mm", "--outer", "4.55mm", "--limit", "90mmHg", *SMOOTH, "--json"
    )
    record = json.loads(out)
    assert code == 0
    added = {
        "critical_size_ratio", "critical_size_ratio_error", "critical_diameter_mm", "limit_kPa"
    }  # fmt: skip
    assert set(record) == {*PRESSURE_KEYS, *added}
    assert record["critical_diameter_mm"] == pytest.approx(3.5 * record["critical_size_ratio"])
    assert record["critical_pressure_kPa"] == pytest.approx(record["limit_kPa"], rel=1e-4)
    assert 0.0 < record["critical_size_ratio_error"] < 5e-3
    no_lengths = json.loads(cli("size", "--eta", 1.3, "--limit", "90mmHg", *SMOOTH, "--json")[1])
    assert no_lengths["critical_diameter_mm"] is None
    assert no_lengths["critical_size_ratio"] > 1.2


def test_options_of_an_earlier_version_are_taken_by_their_present_names(cli):
    picture = Path(__file__).parents[1] / "examples" / "known_slopes.png"
    now = cli("friction", picture, "--pixel", "0.5um", "--height-range", "24.8um", "--json")
    code, out, err = cli("friction", picture, "--pixel", "0.5um", "--relief=24.8um", "--json")
    assert (code, out) == now[:2]
    assert err.startswith("warning: --relief is now called --height-range\n")


def test_lengths_are_shown_in_millimetres(cli):
    sizes = ["--inner", "3.5mm", "--outer", "4.55mm"]
    table = cli("pressure", "--stone", "4.2mm", *sizes, *SMOOTH)[1]
    assert "stone 4.2 mm, ureter 3.5/4.55 mm (ξ = 1.2, η = 1.3)" in table
    size = cli("size", *sizes, "--limit", "12kPa", *SMOOTH)[1]
    diameter = re.search(r"critical diameter +([\d.]+) mm +± 0\.\d+ mm", size)[1]
    assert f"A stone of {float(diameter):.4g} mm, which is" in size
    curve = cli("curve", *sizes, "--xi", "1.2:1.2:1", *SMOOTH)[1]
    assert "stone" in curve
    assert re.search(r"\n +4\.2 +1\.2 +MOVES", curve)


def test_angles_are_not_in_the_columns_of_pressures(cli):
    pressures, others = cli("pressure", *LATEX, *FAST)[1].split("other quantities")
    assert "°" not in pressures
    assert "mmHg" not in others
    for name in ("contact angle", "critical angle", "stability margin"):
        assert name in others


@pytest.mark.afresh
def test_a_question_asked_again_is_remembered(cli, solved, tmp_path):
    question = ["pressure", *LATEX, *FAST, "--cache", tmp_path]
    first = cli(*question)
    count = len(solved)
    assert count > 0
    assert "remembered" not in first[2]
    code, out, err = cli(*question)
    assert (code, out, len(solved)) == (0, first[1], count)
    assert re.fullmatch(
        r"read from the cache, which saved [\d.]+ s; --no-cache solves it again\n", err
    )
    assert "remembered" not in cli(*question[:-2], "--no-cache")[2]
    assert len(solved) > count


@pytest.mark.afresh
def test_a_solved_wall_is_written_again_without_a_solve(cli, solved, tmp_path):
    question = ["export", *LATEX, *FAST, "--cache", tmp_path, "--out", tmp_path / "wall.vtu"]
    assert cli(*question)[0] == 0
    first, count = (tmp_path / "wall.vtu").read_bytes(), len(solved)
    assert cli(*question)[0] == 0
    assert ((tmp_path / "wall.vtu").read_bytes(), len(solved)) == (first, count)


def test_every_file_that_is_written_is_named(cli, tmp_path):
    files = {"--profile": "p.csv", "--figure": "f.svg", "--save": "c.toml"}
    options = [word for name, file in files.items() for word in (name, tmp_path / file)]
    err = cli("pressure", *LATEX, *FAST, *options, "--json")[2]
    assert sorted(err.splitlines()) == sorted(f"wrote {tmp_path / file}" for file in files.values())


def commands():
    """(Words, command) of every command, those of groups included."""
    group = get_command(app)
    for name in COMMANDS:
        command = group.get_command(typer.Context(group), name)
        inner = getattr(command, "commands", None)
        if inner is None:
            yield [name], command
        else:
            yield from (([name, each], inner[each]) for each in inner)


def test_every_command_has_examples_that_can_be_called_and_exit_codes(cli):
    found = list(commands())
    assert len(found) > 15
    for words, command in found:
        out = cli(*words, "--help")[1]
        assert "Exit codes: 0 " in out, words
        examples = re.findall(r"^ +stonepass (.*)$", out.split("Examples:")[1], re.MULTILINE)
        assert examples, words
        mine = [each for each in examples if shlex.split(each)[: len(words)] == words]
        assert mine, words
        for each in mine:  # the options are known and have values of the right kind
            arguments = shlex.split(each)[len(words) :]
            assert command.make_context(words[-1], arguments).info_name == words[-1]


def test_help_has_panels_and_shows_no_default_twice(cli):
    assert sorted(name for names in PANELS.values() for name in names) == sorted(COMMANDS)
    out = cli("pressure", "--help")[1]
    headings = re.findall(r"^(\S.*):$", out, re.MULTILINE)
    assert headings[:4] == ["Question", "Stone", "Ureter and its load", "Model"]
    assert headings[-3:] == ["Solver", "Output", "Help"]
    for words, _ in commands():
        told = " ".join(cli(*words, "--help")[1].split())
        assert not re.search(r"\[default:[^\[]*\] \[[^\[]*default:", told), words
        assert "<float>" not in told
        assert "<str>" not in told


def test_the_help_fits_a_narrow_terminal(cli, monkeypatch):
    monkeypatch.setenv("COLUMNS", "44")
    out = cli("--help")[1]
    assert max(map(len, out.splitlines())) <= 44
    for _, text in COMMANDS.values():  # never cut
        assert text.split()[-1] in out


def test_a_shell_completes_commands_options_choices_and_materials():
    def completed(line):
        words = f"stonepass {line}"
        environment = os.environ | {
            "_STONEPASS_COMPLETE": "complete_bash",
            "COMP_WORDS": words,
            "COMP_CWORD": str(len(words.split(" ")) - 1),
        }
        command = [sys.executable, "-m", "stonepass"]
        return subprocess.run(
            command, env=environment, capture_output=True, text=True, check=False
        ).stdout.split()

    assert completed("pre") == ["pressure"]
    assert completed("pressure --seating-f") == ["--seating-friction"]
    assert completed("pressure --seating gr") == ["growing"]
    assert completed("size --material lat") == ["latex"]


def test_a_missing_file_is_answered_with_a_similar_one(cli, tmp_path):
    (tmp_path / "patient.toml").write_text("")
    code, _, err = cli("assess", tmp_path / "patent.toml")
    assert (code, "a file that exists; did you mean 'patient.toml'" in err) == (2, True)
    assert "check the path" in cli("pressure", tmp_path / "case.toml")[2]
    assert "check the path" in cli("pressure", tmp_path / "none" / "case.toml")[2]


def test_progress_that_is_no_terminal_is_a_few_lines(capsys, monkeypatch):
    clock = iter(range(0, 10_000, 3))
    monkeypatch.setattr("stonepass.cli.terminal.time.monotonic", lambda: next(clock))
    with terminal.counting("solving") as progress:
        for total in (200, 100):  # two stages
            for done in range(1, total + 1):
                progress(done, total)
    told = ("50 of 200", "100 of 200", "150 of 200", "25 of 100", "50 of 100", "75 of 100")
    assert capsys.readouterr().err.splitlines() == [f"solving: {each}" for each in told]


def test_durations():
    shown = [terminal.duration(each) for each in (0.02, 2.34, 42.4, 240.0, 7300.0)]
    assert shown == ["0.1 s", "2.3 s", "42 s", "4 min", "2 h"]


@pytest.mark.parametrize("columns", [40, 80])
def test_a_narrow_terminal_cuts_no_number(cli, monkeypatch, columns):
    monkeypatch.setenv("COLUMNS", str(columns))
    terminal._console.cache_clear()
    try:
        arguments = ["curve", "--eta", 1.5, "--material", "latex", "--xi", "1.1:1.2:0.1", *SMOOTH]
        shown = cli(*arguments)[1]
        records = json.loads(cli(*arguments, "--json")[1])
        laws = cli("material", "laws")[1]
    finally:
        terminal._console.cache_clear()
    for record in records:
        assert f" {significant(record['critical_pressure_kPa'])}" in shown
        assert f" {significant(record['critical_pressure_kPa'] / 0.1333224)}" in shown
        assert f" {record['contact_angle_deg']:.2f}°" in shown
    assert "…" not in shown + laws
    assert max(map(len, shown.splitlines())) <= columns
    assert "holzapfel-gasser-ogden" in laws
    assert columns < 80 or max(map(len, laws.splitlines())) <= 80


def test_curve_writes_what_it_shows(cli, tmp_path):
    out_csv, figure = tmp_path / "c.csv", tmp_path / "c.svg"
    code, out, _ = cli(
        "curve", "--eta", 1.5, "--material", "latex", "--xi", "1:1.2:0.1",
        "--seating", "frictionless",
        "--out", out_csv, "--figure", figure,
    )  # fmt: skip
    assert code == 0
    with out_csv.open() as file:
        rows = list(csv.DictReader(file))
    assert [row["size_ratio"] for row in rows] == ["1", "1.1", "1.2"]
    assert [row["outcome"] for row in rows] == ["LOOSE", "MOVES", "MOVES"]
    assert rows[0]["contact_angle_deg"] == ""
    assert rows[0]["critical_pressure_error_kPa"] == ""
    assert 0.0 < float(rows[2]["critical_pressure_error_kPa"]) < 0.05
    assert float(rows[2]["critical_pressure_kPa"]) == pytest.approx(41.53, abs=0.05)
    assert "41.5" in out
    assert out.count(" %") == 2  # an error beside each pressure that is not 0
    assert figure.read_text().startswith("<?xml")


@pytest.mark.afresh
def test_curve_files_are_the_same_bytes_every_time(cli, tmp_path):
    for name in ("a", "b"):
        files = ("--out", tmp_path / f"{name}.csv", "--figure", tmp_path / f"{name}.svg")
        cli("curve", "--eta", 1.5, "--material", "latex", "--xi", "1:1.1:0.1", *SMOOTH, *SHORT,
            *files)  # fmt: skip
    for ending in ("csv", "svg"):
        one, two = ((tmp_path / f"{name}.{ending}").read_bytes() for name in "ab")
        assert one == two


def test_curve_with_a_gap_is_exit_1(cli):
    code, out, _ = cli(
        "curve", "--eta", 1.3, "--friction", 1, "--xi", "1.1:1.3:0.2", *SMOOTH, "--json"
    )
    assert code == 1
    assert [row["outcome"] for row in json.loads(out)] == ["MOVES", "BEYOND_CLOSURE"]


def test_size_range():
    assert size_range("1:1.02:0.01") == [1.0, 1.01, 1.02]
    assert size_range("1:1.3:0.01")[-1] == 1.3
    assert size_range("1.2:1.2:1") == [1.2]


def test_materials(cli):
    code, out, _ = cli("material", "list")
    assert code == 0
    for name in ("latex", "ureter", "ureter-printed", "ureter-soft-cross"):
        assert name in out
    code, out, _ = cli("material", "show", "ureter")
    for part in ("0.4056 MPa", "0.8892", "Rassoli", "not reachable"):
        assert part in out
    assert cli("material", "check", "ureter")[0] == 0
    code, out, err = cli("material", "check", "ureter-printed")
    assert (code, out) == (2, "")
    assert "lowers the fibre energy" in err


BAD = [
    (["pressure"], "stone size is missing"),
    (["pressure", "--xi", "1.2"], "ureter size is missing"),
    (["pressure", "--xi", "1.2", "--eta", "0"], "--eta is 0.0"),
    (["pressure", "--xi", "nan", "--eta", "1.3"], "--xi is nan"),
    (["pressure", "--xi", "40", "--eta", "1.3"], "0.1 to 3"),
    (["pressure", "--xi", "1.2", "--eta", "1e9"], "1.02 to 10"),
    (["pressure", "--xi", "-1.2", "--eta", "1.3"], "--xi is -1.2"),
    (["pressure", "--xi", "x", "--eta", "1.3"], "--xi"),
    (["pressure", "--xi", "1.2", "--stone", "4mm", "--eta", "1.3"], "one of the two"),
    (
        ["size", "--outer", "4mm", "--eta", "1.3", "--limit", "9kPa"],
        "--outer cannot be used with --eta",
    ),
    (["pressure", "--xi", "1.2", "--eta", "1.3", "--material", ""], "one of latex"),
    (["headline", "--figure", "/nowhere/h.svg"], "can be written"),
    (["curve", "--eta", "1.3", "--xi", "1:1.1:0.1", "--out", "c.txt"], "ending in .csv"),
    (["pressure", *LATEX, "--seating-friction", "-1"], "--seating-friction is -1.0"),
    (
        ["pressure", *LATEX, "--seating-friction", "0.1"],
        "cannot be used with a frictionless seating",
    ),
    (["pressure", "--stone", "4", "--inner", "3mm", "--outer", "4mm"], "with its unit"),
    (["pressure", "--stone", "4kPa", "--inner", "3mm", "--outer", "4mm"], "must be a length"),
    (["pressure", "--stone", "4mm", "--inner", "4mm", "--outer", "3mm"], "larger than the inner"),
    (["pressure", "--stone", "4mm", "--inner", "3mm"], "--outer is missing"),
    (["pressure", "--stone", "4mm", "--eta", "1.3"], "--inner is missing"),
    (["pressure", "--stone", "0mm", "--inner", "3mm", "--outer", "4mm"], "0.01 mm"),
    (["pressure", *LATEX, "--confining", "3mm"], "must be a pressure"),
    (["pressure", *LATEX, "--confinement", "wet"], "one of dead, hydrostatic"),
    (["pressure", *LATEX, "--seating", "frictionles"], "did you mean 'frictionless'"),
    (["pressure", *LATEX, "--friction", "-1"], "friction is -1.0"),
    (["pressure", *LATEX, "--half-length", "1"], "--half-length is 1.0"),
    (["pressure", *LATEX, "--figure", "x.jpeg"], "ending in .svg"),
    (["pressure", *LATEX, "--profile", "/nowhere/p.csv"], "can be written"),
    (["pressure", "--xi", "1.2", "--eta", "1.3", "--material", "latx"], "did you mean 'latex'"),
    (["pressure", "--xi", "1.2", "--eta", "1.3", "--material", "ureter-printed"], "not stable"),
    (["pressure", "none.toml"], "a file that exists"),
    (["size", "--eta", "1.3"], "--limit"),
    (["size", "--eta", "1.3", "--limit", "12"], "with its unit"),
    (["size", "--eta", "1.3", "--limit", "12 mm"], "must be a pressure"),
    (["size", "--limit", "12kPa"], "ureter size is missing"),
    (["curve", "--eta", "1.3", "--xi", "1:2"], "FROM:TO:STEP"),
    (["curve", "--eta", "1.3", "--xi", "2:1:0.1"], "FROM:TO:STEP"),
    (["curve", "--eta", "1.3", "--xi", "1:nan:0.1"], "FROM:TO:STEP"),
    (["curve", "--eta", "1.3", "--xi", "1:2:1e-9"], "larger step"),
    (["material", "show", "urter"], "did you mean 'ureter'"),
    (["size", "--eta", "1.3", "--limit", "12"], "--limit is 12"),
    (["size", "--eta", "1.3", "--limit", "9GPa"], "--limit is 9GPa"),
    (["presure"], "no command 'presure'; did you mean 'pressure'"),
    (["pressure", "--nonsense"], "no option --nonsense; 'stonepass pressure --help' lists all"),
    (["pressure", "--ston", "4mm"], "did you mean '--stone'"),
    (["pressure", "-xi", "1.2"], "no option -xi; did you mean '--xi'"),
    (["pressure", *LATEX, "--model", "papr"], "did you mean 'paper'"),
    (["export", *LATEX, "--out", "a.inp", "--closure", "series"], "no option --closure"),
]


@pytest.mark.parametrize(
    ("arguments", "words"),
    BAD,
    ids=lambda value: " ".join(value) if isinstance(value, list) else None,
)
def test_bad_requests_are_one_sentence_and_exit_2(cli, arguments, words, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    code, out, err = cli(*arguments)
    assert code == 2
    assert out == ""
    assert words in err
    assert err.startswith("stonepass: ")
    assert len(err.splitlines()) == 1
    assert "Traceback" not in err


def test_a_fault_of_ours_is_a_sentence_and_exit_3(cli, monkeypatch):
    def broken(*_, **__):
        raise RuntimeError("boom")

    monkeypatch.setattr("stonepass.model.critical.solve", broken)
    code, out, err = cli("pressure", *LATEX)
    assert (code, out) == (3, "")
    assert "please report it" in err
    assert "boom" in err


def test_version_and_help(cli):
    assert cli("--version")[1] == f"stonepass {stonepass.__version__}\n"
    for arguments in (["--help"], ["pressure", "-h"], ["material", "--help"]):
        code, out, _ = cli(*arguments)
        assert code == 0
        assert "Usage: stonepass" in out


def test_headline(cli, tmp_path, monkeypatch):
    monkeypatch.setattr("stonepass.paper.headline.SIZE_RATIOS", (1.0, 1.2))
    monkeypatch.setattr(
        "stonepass.paper.headline.ureter_case",
        lambda *given: replace(
            ureter_case(*given),
            model=stonepass.SeatedBalance("frictionless"),
            numerics=stonepass.Numerics("fast", 4.0),
        ),
    )
    figure = tmp_path / "h.svg"
    code, out, err = cli("headline", "--figure", figure, "--workers", 1)
    assert code == 0
    assert f"wrote {figure}" in err
    assert "solving 12 cases on 1 core: about" in err.splitlines()[0]
    for part in ("1.22", "1.11", "published", "η = 1.30", "8 kPa", "change", "Research use only"):
        assert part in out
    assert figure.read_text().startswith("<?xml")


def test_as_a_real_process():
    done = subprocess.run(
        [sys.executable, "-m", "stonepass", "pressure", *LATEX, "--json"],
        capture_output=True,
        text=True,
        check=True,
    )
    assert json.loads(done.stdout)["outcome"] == "MOVES"
    assert done.stderr == ""


def test_every_public_name_is_there():
    for name in stonepass.__all__:
        assert getattr(stonepass, name).__doc__, name
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        stonepass.nothing  # noqa: B018
