"""Remembered finite-element results: the same to the bit, of the right case, and never trusted."""

import dataclasses
import errno
import json
from multiprocessing import get_context
from pathlib import Path

import numpy as np
import pytest
from options import asking

import stonepass as sp
from stonepass.errors import CacheWarning
from stonepass.model.accuracy import LEVELS
from stonepass.model.seating import Seating
from stonepass.model.states.state_solver import StateSolver
from stonepass.model.states.uncached import UNCACHED
from stonepass.studies.serialisation import deserialise, serialise
from stonepass.studies.solution_cache import SolutionCache, default_folder

FAST = asking(accuracy="fast")


def case(xi=1.2, mu=0.4, shape=None, **options):
    stone = sp.Stone(size_ratio=xi, friction=mu, shape=shape)
    return sp.Case(stone, sp.Ureter(wall_ratio=1.5, material="latex"), **(options or FAST))


def files(store):
    return [path for path in store.folder.glob("[0-9a-f][0-9a-f]/*") if path.is_file()]


def set_aside(folder):
    """How many damaged files were set aside."""
    return len(list((folder / "corrupt").glob("*")))


@pytest.fixture(scope="module")
def seated():
    return sp.seat(case())


@pytest.fixture
def canned(monkeypatch, seated):
    """One seated state in place of every solve, and a list of what was solved."""
    found = []

    def seat(case, seating, numerics, resolution):
        found.append("seat")
        coarse = dataclasses.replace(seated.coarse, case=case)
        return dataclasses.replace(seated, case=case, coarse=coarse)

    monkeypatch.setattr(type(UNCACHED), "seat", staticmethod(seat))
    return found


def assert_same(one, other):
    """Equal to the bit, arrays and all."""
    assert type(one) is type(other)
    if isinstance(one, np.ndarray):
        np.testing.assert_array_equal(one, other)
    elif dataclasses.is_dataclass(one):
        for each in dataclasses.fields(one):
            assert_same(getattr(one, each.name), getattr(other, each.name))
    elif isinstance(one, tuple):
        for a, b in zip(one, other, strict=True):
            assert_same(a, b)
    else:
        assert one == other


@pytest.mark.parametrize(
    "method",
    [
        FAST,
        asking(accuracy="fast", model="direct"),
        pytest.param(asking(accuracy="fast", closure="series"), marks=pytest.mark.slow),
    ],
    ids=["paper", "direct", "series"],
)
def test_an_answer_remembered_is_the_answer(tmp_path, solved, method):
    store = SolutionCache(tmp_path, walls=True)
    assert isinstance(store, StateSolver)
    first = sp.solve(case(**method), states=store)
    count = len(solved)
    assert count >= 1
    second = sp.solve(case(**method), states=store)
    assert len(solved) == count
    assert_same(first, second)
    assert first.pressure == sp.solve(case(**method)).pressure
    assert len(files(store)) == count


def test_a_failure_is_remembered_too(tmp_path, solved):
    """An axially compressed wall of fibres kinks all along, which is found before any element."""
    store = SolutionCache(tmp_path)
    kinked = sp.Ureter(wall_ratio=1.3), sp.Load(prestretch=0.85)
    method = asking(accuracy="fast", model="direct")
    question = sp.Case(sp.Stone(size_ratio=1.2, friction=0.4), *kinked, **method)
    first = sp.solve(question, states=store)
    second = sp.solve(question, states=store)
    assert first.outcome is second.outcome is sp.Outcome.NO_SOLUTION
    assert first.message == second.message
    assert "it buckles axisymmetrically" in first.message
    assert solved == ["push"]


def test_what_a_result_depends_on_and_what_not(tmp_path, canned):
    store = SolutionCache(tmp_path)
    sp.solve(case(), states=store)
    same = [
        case(**asking(accuracy="fast", as_printed=True)),
        case(**asking(accuracy="fast", closure_start="lumen")),
        case(mu=0.7, **asking(accuracy="fast", seating_friction=0.4)),
        sp.Case(sp.Stone("3 mm", 0.4), sp.Ureter("2.5 mm", "3.75 mm", "latex"), **FAST),
    ]
    pressures = {sp.solve(each, states=store).pressure for each in same}
    assert canned == ["seat"]
    assert len(pressures) > 1  # of other balances, not of the first one again
    other = [
        case(1.21),
        case(mu=0.41),
        case(**asking()),
        case(**asking(accuracy="fast", seating="growing")),
        case(**asking(accuracy="fast", half_length=11.0)),
        case(shape=sp.Shape(1.1)),
        dataclasses.replace(case(), load=sp.Load("1 kPa")),
        dataclasses.replace(case(), ureter=sp.Ureter(wall_ratio=1.51, material="latex")),
        dataclasses.replace(case(), ureter=sp.Ureter(wall_ratio=1.5)),
    ]
    for count, each in enumerate(other, start=2):
        assert sp.solve(each, states=store).case == each
        assert len(canned) == count


def test_a_case_of_another_size_gets_its_own_lengths(tmp_path):
    store = SolutionCache(tmp_path)
    sp.solve(case(), states=store)
    sized = sp.Case(sp.Stone("3 mm", 0.4), sp.Ureter("2.5 mm", "3.75 mm", "latex"), **FAST)
    found = sp.solve(sized, states=store)
    assert found.case is sized
    assert found.contact.case is sized
    assert found.contact.coarse.case is sized


def test_walls_are_kept_where_they_are_wanted(tmp_path, solved):
    slim, full = SolutionCache(tmp_path), SolutionCache(tmp_path, walls=True)
    asked = case(), Seating("pressed", 0.4), case().numerics
    assert slim.seat(*asked).wall is None
    assert full.seat(*asked).wall is not None
    assert solved == ["seat", "seat"]
    assert slim.seat(*asked).wall is None
    assert full.seat(*asked).wall is not None  # neither takes the other's place
    assert len(solved) == 2


@pytest.mark.parametrize("where", [0, 40, 200, -1])
def test_a_corrupt_file_is_set_aside_and_solved_again(tmp_path, canned, where):
    store = SolutionCache(tmp_path)
    first = sp.solve(case(), states=store)
    (path,) = files(store)
    raw = bytearray(path.read_bytes())
    raw[where] ^= 1
    path.write_bytes(raw)
    assert set_aside(tmp_path) == 0
    with pytest.warns(CacheWarning, match=r"damaged result was moved to .*corrupt"):
        assert_same(first.pressure, sp.solve(case(), states=store).pressure)
    assert set_aside(tmp_path) == 1
    assert len(canned) == 2
    sp.solve(case(), states=store)
    assert len(canned) == 2


@pytest.mark.parametrize("content", [b"", b"short", b"\0" * 5000])
def test_a_file_of_another_kind_is_corrupt(tmp_path, canned, content):
    store = SolutionCache(tmp_path)
    sp.solve(case(), states=store)
    (path,) = files(store)
    path.write_bytes(content)
    with pytest.warns(CacheWarning, match="damaged"):
        assert sp.solve(case(), states=store).pressure > 0.0
    assert set_aside(tmp_path) == 1


def test_another_solver_solves_again(tmp_path, canned, monkeypatch):
    store = SolutionCache(tmp_path)
    sp.solve(case(), states=store)
    monkeypatch.setattr("stonepass.studies.solution_cache.solver_digest", lambda memory: "another")
    sp.solve(case(), states=store)
    assert len(canned) == 2


def test_a_law_that_cannot_be_written_down_is_not_remembered(tmp_path, solved):
    law = Path(__file__).parents[1] / "examples" / "own_law.py"
    question = sp.Case(
        sp.Stone(size_ratio=1.2), sp.Ureter(wall_ratio=1.5, material=sp.load_material(f"{law}:energy")),
        **asking(accuracy="fast", seating="frictionless"),
    )  # fmt: skip
    for _ in range(2):
        sp.solve(question, states=SolutionCache(tmp_path))
    assert len(solved) == 2
    assert files(SolutionCache(tmp_path)) == []


def _solve_in(folder):
    return sp.solve(case(), states=SolutionCache(folder)).pressure


def test_processes_share_a_folder(tmp_path):
    with get_context("spawn").Pool(2) as pool:
        pressures = pool.map(_solve_in, [tmp_path] * 3)
    assert len(set(pressures)) == 1
    assert len(files(SolutionCache(tmp_path))) == 1
    assert set_aside(tmp_path) == 0


def test_a_folder_that_cannot_be_written_costs_no_answer(tmp_path, canned):
    (tmp_path / "file").write_text("in the way")
    with pytest.warns(CacheWarning, match="cache folder '.*file' could not be written"):
        answer = sp.solve(case(), states=SolutionCache(tmp_path / "file"))
    assert answer.pressure > 0.0
    assert (tmp_path / "file").read_text() == "in the way"


def test_a_full_disk_leaves_no_half_written_result(tmp_path, canned, monkeypatch):
    """The disk is full after the first bytes of each file."""

    def full(path, content):
        with path.open("wb") as file:
            file.write(content[:10])
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(Path, "write_bytes", full)
    with pytest.warns(CacheWarning, match="No space left on device"):
        assert sp.solve(case(), states=SolutionCache(tmp_path)).pressure > 0.0
    assert [each for each in tmp_path.rglob("*") if each.is_file()] == []


def test_the_folder_by_its_name(monkeypatch, tmp_path):
    monkeypatch.setenv("STONEPASS_CACHE", str(tmp_path))
    assert default_folder() == tmp_path
    monkeypatch.delenv("STONEPASS_CACHE")
    assert default_folder().name == "stonepass"


def test_nothing_that_is_not_finite_is_written():
    state = sp.seat(case(), LEVELS["fast"].companion)
    document, arrays = serialise(state)
    assert_same(state, deserialise(json.loads(json.dumps(document)), arrays, state.case))
    with pytest.raises(FloatingPointError):
        serialise(dataclasses.replace(state, contact_angle=float("nan")))
