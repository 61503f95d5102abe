"""The recipes of the developer guide: one file and one registration make a model, a law, a study.

An export format by the same recipe is tested in `test_writers`.
"""

import importlib
import importlib.util
import json
import sys
from pathlib import Path

import numpy as np
import pytest

import stonepass as sp
import stonepass.cli
from stonepass.cli import run
from stonepass.export import inp_material
from stonepass.inputs import material_file
from stonepass.inputs.catalogue import all_inputs
from stonepass.inputs.schema import case_schema
from stonepass.materials.known_laws import KNOWN_LAWS
from stonepass.model.answer import Detail, Model
from stonepass.model.contact_state import ContactState
from stonepass.model.far_field import urine_pressure
from stonepass.model.models.registry import MODELS
from stonepass.studies.study import Study, run_study

EXTEND = Path(__file__).parents[1] / "examples" / "extend"


def load(name):
    spec = importlib.util.spec_from_file_location(name, EXTEND / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    sys.modules[name] = module  # dataclasses look their module up
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def plug(monkeypatch):
    module = load("plug_model")
    # The options of a command are made when its file is loaded: load it anew, and restore it after.
    before = importlib.import_module("stonepass.cli.pressure")
    monkeypatch.setattr(stonepass.cli, "pressure", before)
    monkeypatch.delitem(sys.modules, "stonepass.cli.pressure")
    monkeypatch.setitem(MODELS, "plug", module.Plug)
    all_inputs.cache_clear()
    yield module
    monkeypatch.undo()
    all_inputs.cache_clear()


def test_a_model_answers_through_every_door(plug, tmp_path, capsys):
    case = sp.Case(
        sp.Stone(size_ratio=1.2, friction=0.4),
        sp.Ureter(wall_ratio=1.5, material="latex"),
        model=plug.Plug(length=1.5),
    )
    answer = sp.solve(case)
    assert isinstance(case.model, Model)
    assert isinstance(answer.contact, ContactState)
    assert isinstance(answer.detail, Detail)
    law = case.ureter.material.law
    opening = float(urine_pressure(np.array(1.2), 1.5, law, sp.Load()))
    assert answer.pressure == pytest.approx(2.0 * 0.4 * opening * 1.5, rel=1e-12)
    # The command line offers the model and its option, and shows the number that only it knows.
    arguments = ["--xi", "1.2", "--eta", "1.5", "--material", "latex", "--friction", "0.4"]
    arguments += ["--model", "plug", "--plug-length", "1.5"]
    assert run(["pressure", *arguments, "--json", "--figure", str(tmp_path / "plug.svg")]) == 0
    record = json.loads(capsys.readouterr().out)
    assert record["critical_pressure_kPa"] == pytest.approx(answer.pressure / 1e3, rel=1e-12)
    assert record["detail"] == {"opening_pressure_kPa": pytest.approx(opening / 1e3)}
    assert record["case"]["model"] == {"name": "plug", "length": 1.5, "far_field_ground": False}
    assert (tmp_path / "plug.svg").stat().st_size > 1000
    assert run(["pressure", *arguments]) == 0
    assert "opening pressure" in capsys.readouterr().out
    # So do case files and their schema.
    sp.write_case(case, tmp_path / "case.toml")
    assert sp.read_case(tmp_path / "case.toml") == case
    assert "length" in case_schema()["properties"]["method"]["properties"]
    # Its size is found without a mesh, and another model has none of its options.
    size = sp.critical_size(case.ureter, "20 kPa", 0.4, model=case.model)
    assert size.outcome.name == "SOLVED"
    assert sp.solve(case.with_size_ratio(size.size_ratio)).pressure == pytest.approx(20e3, rel=1e-5)
    assert run(["pressure", "--xi", "1.2", "--eta", "1.5", "--plug-length", "1"]) == 2
    assert "--plug-length cannot be used with the model 'paper'" in capsys.readouterr().err


@pytest.fixture
def gent(monkeypatch):
    module = load("gent_law")
    monkeypatch.setitem(KNOWN_LAWS, "gent", module.Gent)
    return module


def test_a_law_is_read_checked_and_solved(gent, tmp_path, capsys):
    path = tmp_path / "gent.toml"
    path.write_text(
        'law = "gent"\nmu = "293 kPa"\nJm = 9e3\nsource = "made up"\nstrain_range = [1.0, 1.5]\n'
    )
    wall = material_file.load_material(str(path))
    assert wall.law == gent.Gent(293e3, 9e3)
    # With chains of nearly unlimited length it is the neo-Hookean law of half its modulus.
    latex = sp.Ureter(wall_ratio=1.5, material="latex")
    pressures = [
        sp.critical_pressure(
            sp.Stone(size_ratio=1.2),
            ureter,
            model=sp.SeatedBalance("frictionless"),
            numerics=sp.Numerics("fast"),
        ).pressure
        for ureter in (latex, sp.Ureter(wall_ratio=1.5, material=wall))
    ]
    assert pressures[1] == pytest.approx(pressures[0], rel=1e-3)
    assert run(["material", "show", str(path)]) == 0
    shown = capsys.readouterr().out
    assert "0.293 MPa" in shown
    assert "Jm" in shown
    path.write_text(path.read_text().replace("9e3", "0.01"))
    with pytest.raises(sp.BadInput, match=r"Jm is 0\.01, but must be"):
        material_file.load_material(str(path))


def test_a_law_is_exported_by_one_entry_in_the_table_of_a_program(gent, monkeypatch, tmp_path):
    wall = sp.Material("rubber", gent.Gent(293e3, 9e3), "", "", "", (1.0, 1.5))
    case = sp.Case(sp.Stone(size_ratio=1.2), sp.Ureter(wall_ratio=1.5, material=wall))
    path = tmp_path / "stone.inp"
    with pytest.raises(sp.BadInput, match=r"law is gent, but must be .*neo-hookean"):
        sp.export.write(case, path)
    monkeypatch.setitem(inp_material.ABAQUS, gent.Gent, lambda law, D1: [f"** Gent {law.mu:g}"])
    with pytest.raises(sp.BadInput, match="use flavour='abaqus'"):
        sp.export.write(case, path)
    found = sp.export.write(case, path, flavour="abaqus")
    assert "** Gent 293000" in found.content


def test_a_study_runs_its_jobs_anywhere():
    module = load("friction_study")
    case = sp.Case(
        sp.Stone(size_ratio=1.1),
        sp.Ureter(wall_ratio=1.3),
        model=sp.ElasticFoundation(secant_stretch=1.2),
    )
    study = module.FrictionRange(case)
    assert isinstance(study, Study)
    seen = []
    found = run_study(study, progress=lambda done, count: seen.append((done, count)))
    assert [friction for friction, _, _ in found] == [0.1, 0.3, 0.5]
    assert found[1][1] == sp.solve(case.with_friction(0.3)).pressure
    assert seen[-1] == (3, 3)


def test_the_guide_shows_the_code_that_is_tested():
    guide = (Path(__file__).parents[1] / "docs" / "developing.md").read_text(encoding="utf-8")
    shown = [block.split("```")[0] for block in guide.split("```python\n")[1:]]
    assert len(shown) >= 4
    sources = "\n".join(
        path.read_text(encoding="utf-8")
        for path in [*EXTEND.glob("*.py"), EXTEND.parent / "toy_writer.py"]
    )
    for block in shown:
        assert block.strip() in sources, block
