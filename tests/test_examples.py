"""Every example runs; every docstring example is true; the glossary's words are the code's words."""

import doctest
import importlib
import pkgutil
import re
import runpy
from pathlib import Path

import pytest

import stonepass
from stonepass.cli import run

pytestmark = pytest.mark.usefixtures("shared_solutions")

ROOT = Path(__file__).parents[1]
# Dozens of solves each, whose commands and functions other tests run with less; and the maker of
# micrographs, whose files test_micrograph makes too.
LONG = (
    "latex_series.csv", "make_bench.py", "make_micrographs.py", "one_stone.py", "patient.toml"
)  # fmt: skip
EXAMPLES = [
    pytest.param(path, id=path.name, marks=[pytest.mark.slow] if path.name in LONG else [])
    for path in sorted((ROOT / "examples").iterdir())
    if path.is_file()  # those in "extend" are run by test_extending.py
]
FAST = ["--accuracy", "fast"]


# How the examples that are data are used.
COMMANDS = {
    "known_slopes.png": ["friction", "{}", "--pixel", "0.5um", "--height-range", "24.8um"],
    "crystals.tif": ["friction", "{}", "--crystal", "20um"],
    "crystals.x3p": ["friction", "{}"],
    "uncertain_stone.toml": ["sensitivity", "{}", "--workers", "1", "--samples", "64"],
    "egg.csv": ["pressure", "--xi", "1.2", "--eta", "1.3", "--shape", "{}", *FAST],
    "latex_tensile.csv": [
        "fit", "tensile", "{}", "--law", "neo-hookean", "--width", "10mm", "--thickness", "1.2mm"
    ],
    "latex_series.csv": [
        "invitro", "{}", "--material", "latex", "--seating", "frictionless", "--workers", "1"
    ],
    "ureter_tensile.csv": [
        "fit", "tensile", "{}", "--law", "fung", "--fix", "G=12kPa", "--fix", "a1122=0.1856"
    ],
    "ureter_inflation.csv": [
        "fit", "inflation", "{}", "--law", "fung", "--inner", "3.5mm", "--outer", "4.55mm",
        "--fix", "G=12kPa", "--fix", "a2222=0.8892", "--fix", "a1122=0.1856",
    ],
}  # fmt: skip


def test_there_are_examples():
    paths = [path for example in EXAMPLES for path in example.values]
    assert len([path for path in paths if path.suffix in (".py", ".toml", ".csv")]) >= 5


@pytest.mark.parametrize("path", EXAMPLES)
def test_example_runs(path, capsys, tmp_path, monkeypatch):
    monkeypatch.setenv("STONEPASS_CACHE", str(tmp_path))
    if path.name in COMMANDS:
        assert run([part.format(path) for part in COMMANDS[path.name]]) == 0
    elif path.suffix == ".toml" and "[vary]" in path.read_text():
        assert run(["sweep", str(path), "--out", str(tmp_path / "s"), "--workers", "1"]) == 0
    elif path.suffix == ".toml" and "[stone]" in path.read_text():
        command = "assess" if "[assessment]" in path.read_text() else "pressure"
        assert run([command, str(path), *(FAST if command == "pressure" else [])]) == 0
    elif path.suffix == ".toml" or "def energy" in path.read_text():
        law = str(path) if path.suffix == ".toml" else f"{path}:energy"
        assert run(["material", "check", law]) == 0
        assert run(["pressure", "--xi", "1.2", "--eta", "1.3", "--material", law, *FAST]) == 0
    else:
        monkeypatch.setattr("sys.argv", [str(path), str(tmp_path)])  # a folder for what it writes
        runpy.run_path(str(path), run_name="__main__")
    assert capsys.readouterr().out


def test_docstring_examples():
    names = [m.name for m in pkgutil.walk_packages(stonepass.__path__, "stonepass.")]
    modules = [importlib.import_module(n) for n in names if not n.endswith("__main__")]
    results = [doctest.testmod(module) for module in modules]
    assert sum(result.failed for result in results) == 0
    assert sum(result.attempted for result in results) >= 3  # the guard inspected something


def test_outcomes_are_in_the_glossary():
    glossary = (ROOT / "docs" / "glossary.md").read_text(encoding="utf-8")
    assert len(stonepass.Outcome) > 5
    for outcome in stonepass.Outcome:
        assert f"`{outcome.name}`" in glossary


def test_readme_commands_are_real():
    """Every `stonepass …` line of the README and the docs parses: --help of it exists."""
    text = "".join(
        path.read_text(encoding="utf-8")
        for path in [ROOT / "README.md", *ROOT.glob("docs/*.md"), *ROOT.glob("docs/[ht]*/*.md")]
    )
    blocks = "".join(re.findall(r"^ *```sh$(.*?)^ *```$", text, flags=re.MULTILINE | re.DOTALL))
    commands = set(re.findall(r"^\s*stonepass (\w+)", blocks, flags=re.MULTILINE))
    commands |= set(re.findall(r"`stonepass ([a-z]+)[^`]*`", text))
    assert {"pressure", "size", "curve", "headline", "material"} <= commands
    for command in commands:
        assert run([command, "--help"]) == 0
