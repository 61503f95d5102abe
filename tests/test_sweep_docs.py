"""The how-to of sweeps is true: its Python code and its commands run, and its study is the example."""

import re
import shlex
import tomllib
from pathlib import Path

import stonepass as sp
from stonepass.cli import run
from stonepass.studies.sweeps.case_rows import OUTCOMES

ROOT = Path(__file__).parents[1]
PAGE = (ROOT / "docs" / "howto" / "sweep.md").read_text(encoding="utf-8")


def blocks(language):
    return re.findall(rf"^```{language}\n(.*?)^```", PAGE, re.MULTILINE | re.DOTALL)


def test_the_page_runs(tmp_path, monkeypatch, capsys):
    """In the order of the page; the commands for a cluster are those of test_sweep_cluster.py."""
    (tmp_path / "examples").symlink_to(ROOT / "examples")
    monkeypatch.chdir(tmp_path)
    names, ran = {}, []
    for language, block in re.findall(
        r"^```(python|sh)\n(.*?)^```", PAGE, re.MULTILINE | re.DOTALL
    ):
        if language == "python":
            exec(block, names)
            ran.append(language)
            continue
        for line in block.splitlines():
            program, *arguments = shlex.split(line)
            if program == "stonepass" and "--scheduler" not in arguments:
                ran.append(arguments[0])
                alone = ["--workers", "1"] if arguments[0] == "sweep" else []
                assert run([*arguments, *alone]) == 0
    assert ran == ["python", "python", "sweep", "results", "sweep", "python"]
    assert len(names["points"]) == 3
    assert dict(names["grid"].sizes) == {"sample": 16, "size_ratio": 6}
    assert (tmp_path / "study.png").stat().st_size > 10_000
    assert (tmp_path / "study.nc").exists()
    assert capsys.readouterr().out


def test_the_study_of_the_page_is_the_example():
    (shown,) = blocks("toml")
    example = (ROOT / "examples" / "sweep.toml").read_text(encoding="utf-8")
    assert tomllib.loads(shown) == tomllib.loads(example)
    assert sp.read_sweep(ROOT / "examples" / "sweep.toml").cases == 6 * 16


def test_the_page_names_the_outcomes_of_rows():
    assert all(f"`{name}`" in PAGE for name in OUTCOMES)


def test_the_plan_follows_from_the_measured_costs():
    """Core-days are 10⁸ times the seconds of the table above them."""
    costs = {
        row[0].strip("` "): [float(cell) for cell in row[1:]]
        for row in (line.strip("|").split("|") for line in PAGE.splitlines())
        if len(row) == 5 and row[1].strip().replace(".", "").isdigit()
    }
    plan = {
        row[0].strip(): float(row[1])
        for row in (line.strip("|").split("|") for line in PAGE.splitlines())
        if len(row) == 4 and row[1].strip().replace(".", "").isdigit()
    }
    assert (len(costs), len(plan)) == (4, 5)
    for name, days in plan.items():
        model, *others = name.replace("`", "").split(", ")
        row = next(key for key in costs if key.replace("`", "").startswith(model) and (
            "frictionless" in key) == ("frictionless" in others))  # fmt: skip
        seconds = costs[row][1 if "standard" in others else 0]
        assert abs(days / (1e8 * seconds / 86_400.0) - 1.0) < 0.02, name
