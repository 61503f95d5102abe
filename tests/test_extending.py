"""The recipes of the developer guide: one file and one registration make a model, a law, …."""

import importlib.util
import json
import sys
from pathlib import Path

import numpy as np
import pytest

import stonepass as sp
from stonepass.cli import run
from stonepass.inputs.catalogue import all_inputs
from stonepass.inputs.schema import case_schema
from stonepass.model.answer import Detail, Model
from stonepass.model.contact_state import ContactState
from stonepass.model.far_field import urine_pressure
from stonepass.model.models.registry import MODELS

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
