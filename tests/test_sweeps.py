"""Sweeps: what is varied, the cases by index, and one row for every case whatever happens in it."""

import hashlib
import json
import pickle
import tomllib
from concurrent.futures import Future, ProcessPoolExecutor, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from dataclasses import replace
from itertools import product

import numpy as np
import pyarrow as pa
import pyarrow.parquet
import pytest
from scipy.stats import qmc
from toy_laws import hazardous

import stonepass as sp
from stonepass.inputs.build import build_case
from stonepass.inputs.case_record import describe
from stonepass.inputs.catalogue import all_inputs
from stonepass.materials.constants import constants_of
from stonepass.materials.known_laws import KNOWN_LAWS
from stonepass.model.models.registry import MODELS
from stonepass.studies.source_digest import NUMBERS
from stonepass.studies.sweeps import advice, case_rows, dispatch
from stonepass.studies.sweeps.blocks import this_solver
from stonepass.studies.sweeps.case_rows import build
from stonepass.studies.sweeps.dispatch import least_block
from stonepass.studies.sweeps.run import run_sweep
from stonepass.studies.sweeps.varied_input import varied_input

BEAM = {"model": "beam", "secant_stretch": 1.2}
GRID = {
    "ureter": {"wall_ratio": 1.3, "material": "latex"},
    "method": BEAM,
    "vary": {"stone.size_ratio": [1.05, 1.1, 1.2], "stone.friction": [0.1, 0.3]},
}


def rows(found):
    return found.table().to_pylist()


def plan_of(**parts):
    return sp.read_sweep(GRID | parts)


# --- the plan


def test_the_cases_are_all_combinations_in_a_stated_order():
    plan = plan_of(
        method={}, models={"beam": {"secant_stretch": 1.2}, "paper": {}, "loaded": {"model": "direct"}}
    )  # fmt: skip
    assert plan.cases == 18
    found = [
        (each.cells["size_ratio"], each.cells["friction"], each.label) for each in plan.block(0, 18)
    ]
    assert found == list(product([1.05, 1.1, 1.2], [0.1, 0.3], ["beam", "paper", "loaded"]))
    assert [plan.case(k).cells for k in range(18)] == [each.cells for each in plan.block(0, 18)]
    assert build(plan.case(2).values).model.NAME == "direct"


def test_a_plan_of_a_thousand_million_cases_is_not_listed():
    steps = {"from": 0.1, "to": 0.5, "count": 1000}
    plan = plan_of(vary={"stone.friction": steps, "stone.size_ratio": {"low": 1.05, "high": 1.3}},
                   samples={"count": 2**20})  # fmt: skip
    assert plan.cases == 1000 * 2**20
    last = plan.case(plan.cases - 1)
    assert last.cells["friction"] == 0.5
    assert len(pickle.dumps(plan)) < 100_000


@pytest.mark.parametrize("method", ["sobol", "latin-hypercube"])
def test_a_sample_depends_on_its_index_alone(method):
    vary = {"stone.size_ratio": {"low": 1.05, "high": 1.3},
            "ureter.material.C10": {"low": "50 kPa", "high": "200 kPa", "scale": "log"},
            "stone.friction": [0.1, 0.2]}  # fmt: skip
    plan = plan_of(vary=vary, samples={"method": method, "count": 64, "seed": 7})
    unit = (
        qmc.Sobol(2, seed=7).random_base2(6)
        if method == "sobol"
        else qmc.LatinHypercube(2, seed=7).random(64)
    )
    cells = [each.cells for each in plan.block(0, plan.cases)]
    assert np.allclose([each["size_ratio"] for each in cells[::2]], 1.05 + 0.25 * unit[:, 0], 1e-14)
    assert np.allclose([each["C10_Pa"] for each in cells[::2]], 5e4 * 4.0 ** unit[:, 1], 1e-13)
    for start, stop in ((0, 1), (5, 9), (31, 100), (127, 128)):
        assert [each.cells for each in plan.block(start, stop)] == cells[start:stop]
    other = plan_of(vary=vary, samples={"method": method, "count": 64, "seed": 8})
    assert other.case(0).cells != cells[0]
    assert other.digest != plan.digest


def test_every_declared_input_and_every_constant_can_be_varied():
    """One value of each input is read, and stands in a column whose name has its unit."""
    given = {
        "length": ["4 mm"], "pressure": ["2 kPa"], "number": [1.5], "whole number": [3],
        "flag": [True], "material": ["latex"], "shape": [{"aspect": 1.1}],
        "opening curve": [{"alpha_deg": [70.0, 80.0], "radius_ratio": [1.0, 1.1]}],
    }  # fmt: skip
    columns = set()
    for key, each in all_inputs().items():
        if key == "method.model":
            continue
        declaration = each.declaration
        values = list(declaration.choices) or given[declaration.kind.value]
        if declaration.bounds is not None and declaration.kind.value == "number":
            values = [declaration.bounds[0]]
        found = varied_input(key, [])
        assert found.read(values[0]) is not None
        columns.add(found.column)
    assert len(columns) == len(all_inputs()) - 1
    assert {"stone_diameter_m", "confining_pressure_Pa", "size_ratio"} <= columns
    for name, law in KNOWN_LAWS.items():
        table = {"law": name, "source": "test", "strain_range": [1.0, 1.5]}
        for each in constants_of(law):
            middle = {"Pa": "100 kPa", "rad": "40 deg", "1": 0.5}[each.unit]
            table[each.name] = middle
        material = sp.Material("m", law(**{each.name: _middle(each) for each in constants_of(law)}),
                               "s", "t", "v", (1.0, 1.5))  # fmt: skip
        for each in constants_of(law):
            found = varied_input(f"ureter.material.{each.name}", [material])
            assert found.column.endswith({"Pa": "_Pa", "rad": "_rad", "1": each.name}[each.unit])
            assert found.from_number(_middle(each)) == _middle(each)


def _middle(constant):
    if constant.default is not None:
        return constant.default
    return {"Pa": 1e5, "rad": 0.7}.get(constant.unit, max(constant.low + 0.4, 0.5))


def test_a_constant_of_the_law_reaches_the_case():
    plan = plan_of(vary={"ureter.material.C10": ["100 kPa", "120 kPa"]}, stone={"size_ratio": 1.1})
    laws = [build(each.values).ureter.material.law for each in plan.block(0, 2)]
    assert [law.C10 for law in laws] == [100e3, 120e3]


def test_a_study_file_reads_as_its_dictionary(tmp_path):
    path = tmp_path / "study.toml"
    path.write_text(
        """
[ureter]
wall_ratio = 1.3
material = "wall.toml"
[vary]
"stone.size_ratio" = {from = 1.05, to = 1.2, count = 4}
stone.friction = [0.1, 0.3]
load.confining_pressure = ["0 kPa", "1 kPa"]
[models.paper]
seating = "frictionless"
[models.direct]
"""
    )
    (tmp_path / "wall.toml").write_text(
        'law = "neo-hookean"\nC10 = "150 kPa"\nsource = "test"\nstrain_range = [1.0, 1.5]\n'
    )
    plan = sp.read_sweep(path)
    assert plan.cases == 4 * 2 * 2 * 2
    assert [each.column for each in plan.inputs] == [
        "size_ratio",
        "friction",
        "confining_pressure_Pa",
    ]
    same = sp.read_sweep(
        {
            "ureter": {
                "wall_ratio": 1.3,
                "material": sp.load_material(str(tmp_path / "wall.toml")),
            },
            "vary": {
                "stone.size_ratio": np.array([1.05, 1.1, 1.15, 1.2]),
                "stone": {"friction": [0.1, 0.3]},
                "load.confining_pressure": [sp.Pressure(0.0), "1 kPa"],
            },
            "models": {"paper": {"seating": "frictionless"}, "direct": {}},
        }
    )
    assert [each.cells for each in same.block(0, 32)] == [each.cells for each in plan.block(0, 32)]
    assert same.digest == plan.digest
    quick = plan.with_accuracy("fast")
    assert build(quick.case(31).values).numerics.accuracy == "fast"
    assert quick.digest != plan.digest


@pytest.mark.parametrize(
    ("parts", "words"),
    [
        ({"vary": {"stone.sizeratio": [1.1]}}, "did you mean 'stone.size_ratio'"),
        ({"vary": {"ureter.material.C1": [1.1]}}, "did you mean 'ureter.material.C10'"),
        ({"vari": {}}, "did you mean 'vary'"),
        ({"vary": {}}, "at least one input"),
        ({"vary": {"stone.size_ratio": 1.1}}, "a list, {from"),
        ({"vary": {"stone.size_ratio": []}}, "1 to 1000000 values"),
        ({"vary": {"stone.size_ratio": [1.1, 40.0]}}, "0.1 to 3"),
        ({"vary": {"stone.size_ratio": [1.1], "stone.diameter": ["3"]}}, "unit"),
        ({"vary": {"stone.size_ratio": {"from": 1.2, "to": 1.1, "count": 3}}}, "rising"),
        ({"vary": {"stone.size_ratio": {"from": 1.2, "to": 1.3}}}, "a whole number from 2"),
        ({"vary": {"stone.size_ratio": {"from": 1.2, "too": 1.3}}}, "did you mean 'to'"),
        ({"vary": {"stone.size_ratio": {"low": 1.1, "high": 1.2}}}, "'samples.count' is missing"),
        ({"vary": {"load.confinement": {"low": 1, "high": 2}}}, "no real numbers"),
        ({"samples": {"count": 8}}, "left out, because no input has a range"),
        (
            {"vary": {"stone.size_ratio": {"low": 1.1, "high": 1.2}}, "samples": {"cout": 8}},
            "did you mean 'count'",
        ),
        ({"stone": {"friction": 0.1}}, "'stone.friction' is fixed and varied"),
        ({"models": {"direct": {}}}, "because the models are listed"),
        ({"method": {}, "models": {"paper": {}, "bea": {}}}, "did you mean 'beam'"),
        ({"method": {"wetted": True}}, "belongs to 'direct'"),
        ({"ureter": {"wall_ratio": 1.3, "thickness": 1}}, "did you mean 'wall_thickness'"),
        ({"vary": {"stone.friction": [0.1]}}, "size of the stone is missing"),
        (
            {"vary": {"stone.size_ratio": [1.1], "stone": {"size_ratio": [1.2]}}},
            "'stone.size_ratio' is given twice",
        ),
        (
            {
                "vary": {"method.accuracy": ["fast", "standard"], "stone.size_ratio": [1.1]},
                "models": {"paper": {"accuracy": "fast"}},
                "method": {},
            },
            "'method.accuracy' is fixed and varied",
        ),
    ],
)
def test_a_study_with_a_mistake_is_refused_in_one_sentence(parts, words):
    with pytest.raises(sp.BadInput) as refused:
        plan_of(**parts)
    assert words in str(refused.value)
    assert str(refused.value).startswith("in study")


@pytest.mark.parametrize("count", [2**30 + 1, 0, 1.5, True])
def test_the_number_of_samples_is_bounded(count):
    with pytest.raises(sp.BadInput, match="a whole number from 1"):
        plan_of(vary={"stone.size_ratio": {"low": 1.1, "high": 1.2}}, samples={"count": count})


def test_explicit_points_by_array_and_by_file(tmp_path):
    points = np.array([[1.1, 150.0], [1.2, 180.0], [1.15, 100.0]])
    table = pa.table({"stone.size_ratio": points[:, 0], "ureter.material.C10_kPa": points[:, 1]})
    pyarrow.parquet.write_table(table, tmp_path / "design.parquet")
    (tmp_path / "design.csv").write_text(
        "stone.size_ratio,ureter.material.C10_kPa\n1.1,150\n1.2,180\n1.15,100\n"
    )
    vary = {"stone.friction": [0.1, 0.3]}
    arrays = {name: table[name].to_numpy() for name in table.column_names}
    plan = plan_of(vary=vary, points=arrays)
    cells = [each.cells for each in plan.block(0, plan.cases)]
    assert plan.cases == 6
    assert [each["C10_Pa"] for each in cells] == pytest.approx(
        [150e3, 150e3, 180e3, 180e3, 1e5, 1e5]
    )
    assert [each["friction"] for each in cells] == [0.1, 0.3] * 3
    assert [each.cells for each in plan.part(3, 6).block(3, 6)] == cells[3:]
    for name in ("design.csv", "design.parquet"):
        assert plan_of(vary=vary, points={"file": str(tmp_path / name)}) == plan
    for wrong, words in (
        ({"ureter.material.C10": [1e5]}, "'ureter.material.C10_Pa'"),
        ({"stone.size_ratio": [1.1, np.nan]}, "point 2, column 'stone.size_ratio' is nan"),
        ({"stone.size_ratio": [1.1, 70.0]}, "0.1 to 3"),
        (
            {"stone.size_ratio": [1.1], "stone.friction": [0.1, 0.2]},
            "numbers of values of the columns is 1, 2",
        ),
        ({"stone.size_ratio": ["a"]}, "a column of numbers"),
        ({"stone.size_ratio": ["1_2"]}, "a column of numbers"),
        ({"stone.size_ratio_mm": [1.1]}, "'stone.size_ratio', whose values have no unit"),
        ({"stone.size_ratio": [True, False]}, "a column of numbers"),
        ({"stone.size_ratio": []}, "number of points is 0"),
        ({"file": "none.csv"}, "none.csv"),
    ):
        with pytest.raises(sp.BadInput) as refused:
            plan_of(vary={}, points=wrong)
        assert words in str(refused.value)


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (b"stone.size_ratio,stone.size_ratio\n1.1,1.2\n", "given once"),
        ("stone.size_ratio,Größe\n1.1,1\n".encode("latin-1"), "in p.csv, key is Größe"),
        (b"stone.size_ratio\n", "at least one row"),
        (b"stone.size_ratio,stone.friction\n1.1,0.2\n1.2,\n", "row 3, column 'stone.friction'"),
        (b"stone.size_ratio,stone.friction\n1.1,0.2\n70,0.2\n", "row 3, column 'stone.size_ratio'"),
        (b"stone.size_ratio,stone.friction\n1.1,0.2\n1,2,0,3\n", "by semicolons"),
        (b"stone.size_ratio,lenght\n1.1,2\n", "in p.csv, key is lenght"),
        (b"stone.size_ratio\n2024-01-01\n", "row 2, column 'stone.size_ratio' is 2024-01-01"),
        (b"stone.size_ratio\n1_2\n", "row 2, column 'stone.size_ratio' is 1_2"),
        # A point or a comma may separate thousands here.
        (b"stone.size_ratio;ureter.material.C10_Pa\n1,1;120.000\n1,2;150.000\n", "thousands"),
        (b"stone.size_ratio;ureter.material.C10_Pa\n1.1;120,000\n1.2;150,000\n", "thousands"),
        (b"stone.size_ratio\tureter.material.C10_Pa\n2\t120,000\n2\t150,000\n", "thousands"),
        (b"stone.size_ratio,ureter.material.C10_kPa\n-,Pa\n1.1,120\n", "convert the values to kPa"),
    ],
)
def test_a_points_file_with_a_mistake_is_refused_in_one_sentence(tmp_path, content, words):
    (tmp_path / "p.csv").write_bytes(content)
    with pytest.raises(sp.BadInput) as refused:
        plan_of(vary={}, points={"file": str(tmp_path / "p.csv")})
    assert words in str(refused.value)


@pytest.mark.parametrize(
    "text",
    [
        "stone.size_ratio;stone.friction\n1.1;0.3\n1.2;0.5\n",
        "stone.size_ratio;stone.friction\n1,1;0,3\n1,2;0,5\n",
        "stone.size_ratio\tstone.friction\n1.1\t0.3\n1.2\t0.5\n",
        "# design of May\n\n# two coefficients\nstone.size_ratio,stone.friction\n1.1,0.3\n1.2,0.5\n",
        "\ufeffstone.size_ratio,stone.friction\r\n1.1,0.3\r\n1.2,0.5\r\n",
        "stone.size_ratio,stone.friction,\n1.1,0.3,\n# the second\n1.2,0.5,\n,,\n",
        "# stone.size_ratio,stone.friction\n1.1,0.3\n1.2,0.5\n",
        "# Pr\u00fcfung\nstone.size_ratio,stone.friction\n1.1,0.3\n1.2,0.5\n",
    ],
)
@pytest.mark.parametrize("encoding", ["utf-8", "utf-16", "cp1252"])
def test_points_files_of_spreadsheets_are_read(tmp_path, text, encoding):
    raw = text if encoding == "utf-8" else text.removeprefix("\ufeff")
    (tmp_path / "p.csv").write_text(raw, encoding=encoding, newline="")
    plan = plan_of(vary={}, points={"file": str(tmp_path / "p.csv")})
    found = [(each["size_ratio"], each["friction"]) for each in (c.cells for c in plan.block(0, 2))]
    assert found == [(1.1, 0.3), (1.2, 0.5)]


def test_keys_with_dots_need_no_quotes_in_toml():
    table = tomllib.loads("stone.size_ratio = [1.1, 1.2]\nureter.material.C10_kPa = [100, 120]")
    plan = plan_of(vary={}, points=table)
    assert [each.cells["C10_Pa"] for each in plan.block(0, 2)] == pytest.approx([1e5, 1.2e5])


def test_blanks_round_the_names_of_a_points_file_do_not_matter(tmp_path):
    (tmp_path / "p.csv").write_text(" stone.size_ratio , stone.friction\n1.1,0.2\n")
    plan = plan_of(vary={}, points={"file": str(tmp_path / "p.csv")})
    assert plan.case(0).cells == {"size_ratio": 1.1, "friction": 0.2}


def test_another_accuracy_holds_for_every_model_or_is_refused():
    models = {"paper": {"accuracy": "reference"}, "direct": {}}
    quick = plan_of(method={}, models=models).with_accuracy("fast")
    for k in range(quick.cases):
        assert build(quick.case(k).values).numerics.accuracy == "fast"
    varied = plan_of(vary=GRID["vary"] | {"method.accuracy": ["fast", "standard"]}, method={})
    with pytest.raises(sp.BadInput, match="varied and given"):
        varied.with_accuracy("fast")


# --- the rows


def test_every_case_has_a_row_with_its_answer(tmp_path):
    found = sp.sweep(GRID, tmp_path / "s")
    assert len(found) == 6
    for row, (xi, mu) in zip(rows(found), product([1.05, 1.1, 1.2], [0.1, 0.3]), strict=True):
        case = build_case({"stone.size_ratio": xi, "stone.friction": mu, "ureter.wall_ratio": 1.3,
                           "ureter.material": "latex", "method.model": "beam",
                           "method.secant_stretch": 1.2})  # fmt: skip
        answer = sp.solve(case)
        assert (row["size_ratio"], row["friction"], row["outcome"]) == (xi, mu, "MOVES")
        assert row["critical_pressure_kPa"] == answer.pressure / 1e3
        assert row["contact_angle_deg"] == np.degrees(answer.contact.contact_angle)
        assert row["foundation_Pa"] == answer.detail.state.foundation
        assert row["warnings"].split() == [each.code for each in answer.warnings]
        record = json.dumps([NUMBERS, describe(case, case.model, case.numerics)], sort_keys=True)
        assert row["fingerprint"] == hashlib.sha256(record.encode()).hexdigest()[:32]
        assert row["critical_pressure_error_kPa"] is None
    assert found.counts == {"beam": {"MOVES": 6}}


@pytest.mark.parametrize("make", [lambda: None, lambda: ThreadPoolExecutor(3)])
def test_whatever_goes_wrong_in_one_case_is_a_row(tmp_path, make, capfd):
    study = {
        "ureter": {"inner_diameter": "3 mm", "material": hazardous()},
        "method": BEAM,
        "vary": {
            "stone.diameter": ["2 mm", "3.3 mm"],
            "ureter.outer_diameter": ["2.5 mm", "3.9 mm"],
            "ureter.material.hazard": [0.0, 1.0],
        },
    }
    found = sp.sweep(study, tmp_path / "s", executor=make())
    outcomes = [each["outcome"] for each in rows(found)]
    assert outcomes == ["BAD_INPUT", "BAD_INPUT", "LOOSE", "PROGRAM_ERROR"] + [
        "BAD_INPUT", "BAD_INPUT", "MOVES", "PROGRAM_ERROR"]  # fmt: skip
    first, failed = rows(found)[0], rows(found)[3]
    assert first["reason"] == (
        "'ureter.outer_diameter' is 2.5 mm, but must be larger than the inner diameter, 3 mm."
    )
    assert first["size_ratio"] is None
    assert "the law failed" in failed["reason"]
    assert failed["critical_pressure_kPa"] is None
    assert len({each["fingerprint"] for each in rows(found)}) == 8
    assert capfd.readouterr() == ("", "")


def test_no_number_that_is_not_finite_reaches_a_row(tmp_path, monkeypatch):
    solve = case_rows.PressureJob.run
    monkeypatch.setattr(
        case_rows.PressureJob, "run", lambda *a: replace(solve(*a), pressure=float("nan"))
    )
    found = sp.sweep(GRID, tmp_path / "s")
    assert found.counts == {"beam": {"PROGRAM_ERROR": 6}}
    assert rows(found)[0]["reason"] == "ValueError: a result is nan"


def test_results_are_equal_wherever_they_are_solved(tmp_path):
    one = sp.sweep(GRID, tmp_path / "one", block_cases=4)
    with ThreadPoolExecutor(2) as threads, ProcessPoolExecutor(1) as processes:
        others = [
            sp.sweep(GRID, tmp_path / "threads", executor=threads),
            sp.sweep(GRID, tmp_path / "processes", executor=processes, block_cases=4),
        ]
    for other in others:
        assert other.table().equals(one.table())
    assert [e.digest for e in others[1].ledger.entries] == [e.digest for e in one.ledger.entries]


class Breaking:
    """Workers whose process ends in some cases; the executor is then broken until it is renewed."""

    count, connected = 2, True

    def __init__(self, *deadly):
        self.deadly, self.broken, self.renewed, self.alone = deadly, False, 0, []

    @property
    def executor(self):
        return self

    def submit(self, function, task):
        future = Future()
        if any(task.start <= each < task.stop for each in self.deadly):
            self.broken = True
            self.alone.append(task.stop - task.start)
        if self.broken:
            future.set_exception(BrokenProcessPool())
        else:
            future.set_result(function(task))
        return future

    def renew(self):
        self.broken, self.renewed = False, self.renewed + 1


def test_the_case_that_ends_its_process_is_found_and_the_others_are_solved():
    plan, workers = plan_of(), Breaking(3)
    blocks = list(dispatch.solved_blocks(plan, [(0, 6)], workers, this_solver(), block_cases=6))
    assert sorted(k for each in blocks for k in range(each.start, each.stop)) == list(range(6))
    counts = {each.start: each.counts for each in blocks}
    assert counts[3] == (("beam", "WORKER_LOST", 1),)
    assert sum(n for each in blocks for _, o, n in each.counts if o == "MOVES") == 5
    assert workers.alone == [6, 6, 3, 2, 1, 1] or workers.alone == [6, 6, 3, 1, 1]
    assert workers.renewed == len(workers.alone)


@pytest.mark.slow
def test_a_case_that_ends_its_process_twice_is_a_row(tmp_path):
    """The other cases of its block are solved; a pool is begun again after each end."""
    deaths = tmp_path / "deaths"
    study = {
        "ureter": {"wall_ratio": 1.3, "material": hazardous(deaths)},
        "method": BEAM,
        "vary": {"ureter.material.hazard": [0.0, 0.0, 2.0, 0.0], "stone.size_ratio": [1.1]},
    }
    found = sp.sweep(study, tmp_path / "s", workers=2, block_cases=2)
    outcomes = [each["outcome"] for each in rows(found)]
    assert outcomes == ["MOVES", "MOVES", "WORKER_LOST", "MOVES"]
    assert 3 <= len(deaths.read_text()) <= 5


@pytest.mark.slow
def test_a_broken_executor_of_the_caller_keeps_what_is_finished(tmp_path):
    study = {
        "ureter": {"wall_ratio": 1.3, "material": hazardous(tmp_path / "deaths")},
        "method": BEAM,
        "vary": {"ureter.material.hazard": [0.0, 2.0], "stone.size_ratio": [1.1]},
    }
    with ProcessPoolExecutor(1) as pool, pytest.raises(sp.StonepassError, match="resume=True"):
        sp.sweep(study, tmp_path / "s", executor=pool, block_cases=1)
    found = sp.sweep(study, tmp_path / "s", workers=2, block_cases=1, resume=True)
    assert [each["outcome"] for each in rows(found)] == ["MOVES", "WORKER_LOST"]


# --- blocks and duration


def test_a_million_cases_have_five_hundred_blocks_at_most():
    assert [least_block(n) for n in (1, 999, 10_000, 10**6, 10**9)] == [1, 1, 20, 2000, 2000]


def test_a_long_block_returns_early_and_nothing_is_lost(tmp_path, monkeypatch):
    monkeypatch.setattr(dispatch, "BLOCK_SECONDS", 0.0)
    monkeypatch.setattr(dispatch, "_next_size", lambda *a: 4)
    found = sp.sweep(GRID, tmp_path / "s")
    assert [each.stop - each.start for each in found.ledger.entries] == [1] * 6
    assert found.table()["index"].to_pylist() == list(range(6))


def test_a_sweep_that_would_take_too_long_is_refused_with_its_arithmetic(tmp_path, monkeypatch):
    steps = {"from": 0.1, "to": 0.5, "count": 1000}
    study = GRID | {
        "vary": {"stone.friction": steps, "stone.size_ratio": {"low": 1.05, "high": 1.3}},
        "samples": {"count": 2**20},
    }
    monkeypatch.setattr(advice, "case_seconds", lambda *a: [0.5, 0.7])
    with pytest.raises(sp.StonepassError) as refused:
        sp.sweep(study, tmp_path / "s")
    assert "1 048 576 000 cases × 0.6 s a case / 1 worker = 7.3e+03 days" in str(refused.value)
    assert "max_days = 8739" in str(refused.value)
    assert not (tmp_path / "s" / "ledger.sqlite").exists()


def test_cases_are_measured_before_a_long_sweep():
    seconds = advice.case_seconds(plan_of(), [0, 3, 5], 20.0)
    assert len(seconds) == 3
    assert all(each > 0.0 for each in seconds)
    assert len(advice.case_seconds(plan_of(), [0, 3, 5], 0.0)) == 1


def test_the_standing_is_told(tmp_path):
    told = []
    study = GRID | {"vary": {"stone.size_ratio": [0.9, 1.1, 1.2], "ureter.wall_ratio": [1.3, 1.8]}}
    study["ureter"] = {"material": "latex"}
    run_sweep(sp.read_sweep(study), tmp_path / "s", tell=told.append, block_cases=2)
    assert [(each.finished, each.unanswered, each.faults) for each in told] == [
        (0, 0, 0), (2, 0, 0), (4, 1, 0), (6, 2, 0)]  # fmt: skip


def test_every_model_of_the_registry_can_stand_beside_the_others():
    plan = sp.read_sweep(
        {"stone": {"size_ratio": 1.1}, "ureter": {"wall_ratio": 1.3},
         "models": {name: {"secant_stretch": 1.2} if name == "beam" else {} for name in MODELS}}
    )  # fmt: skip
    assert [each.label for each in plan.block(0, plan.cases)] == list(MODELS)
