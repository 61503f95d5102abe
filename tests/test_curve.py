"""Many cases: order, progress, processes, and what cannot travel to another one."""

import pytest
from options import asking

import stonepass as sp
from stonepass.studies.curve import Curve
from stonepass.studies.executor import InProcessExecutor, process_pool
from stonepass.studies.study import run_study

CASE = sp.Case(
    sp.Stone(size_ratio=1.2),
    sp.Ureter(wall_ratio=1.5, material="latex"),
    **asking(seating="frictionless"),
)


def test_processes_give_the_same_answers_in_the_same_order():
    sizes = [1.2, 1.0, 1.1]
    told = []
    here = run_study(Curve(CASE, sizes))
    with process_pool(2) as pool:
        there = run_study(
            Curve(CASE, sizes), pool, progress=lambda done, total: told.append((done, total))
        )
    assert [a.case.size_ratio for a in there] == sizes
    assert [a.pressure for a in there] == [a.pressure for a in here]
    assert told == [(1, 3), (2, 3), (3, 3)]
    assert there[0].contact.wall is None


def test_a_law_that_cannot_travel_is_solved_here(tmp_path):
    (tmp_path / "law.py").write_text(
        "def energy(C, place, xp):\n    return 146.5e3 * (C.I1 - 3.0)\n"
    )
    wall = sp.Ureter(wall_ratio=1.5, material=sp.load_material(f"{tmp_path / 'law.py'}:energy"))
    case = sp.Case(CASE.stone, wall, model=CASE.model, numerics=CASE.numerics)
    with process_pool(2) as pool:
        answers = run_study(Curve(case, [1.1, 1.2]), pool)
    assert answers[1].pressure == pytest.approx(sp.solve(CASE).pressure, rel=1e-9)


def test_an_error_in_a_case_is_raised_to_the_caller():
    future = InProcessExecutor().submit(sp.Stone, size_ratio=40.0)
    with pytest.raises(sp.BadInput, match=r"0\.1 to 3"):
        future.result()
