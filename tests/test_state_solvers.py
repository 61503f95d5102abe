"""What every state solver promises: the numbers of the plain functions, of the case that asks."""

import dataclasses
import pickle

import pytest
from options import asking
from test_store import assert_same

import stonepass as sp
from stonepass.model.accuracy import LEVELS
from stonepass.model.case_states import push_along
from stonepass.model.seating import Seating
from stonepass.model.states.loaded import find_critical
from stonepass.model.states.loaded_state import NoPush
from stonepass.model.states.state_solver import StateSolver
from stonepass.model.states.uncached import UNCACHED
from stonepass.studies.solution_cache import SolutionCache
from stonepass.units import Pressure

COARSE = LEVELS["fast"].companion
CASE = sp.Case(
    sp.Stone("3 mm", 0.3),
    sp.Ureter("2.5 mm", "3.75 mm", "latex"),
    **asking(accuracy="fast", seating="frictionless", half_length=5.0),
)
DIRECT = dataclasses.replace(CASE, model=sp.PushThrough())
NUMERICS, SEATING = CASE.numerics, Seating("frictionless", 0.0)
PRESSURES = [Pressure(0.0), Pressure(5e3)]
SOLVERS = {
    "uncached": lambda folder: UNCACHED,
    "cache": SolutionCache,
    "cache with walls": lambda folder: SolutionCache(folder, walls=True),
}
QUESTIONS = {
    "seat": lambda solver: solver.seat(CASE, SEATING, NUMERICS, COARSE),
    "push": lambda solver: solver.push(DIRECT, NUMERICS, [COARSE], wetted=False, leak=False),
    "hold": lambda solver: solver.hold(DIRECT, NUMERICS, PRESSURES, COARSE, wetted=False),
}


@pytest.fixture(scope="module")
def plain():
    """What the functions themselves return."""
    return {
        "seat": sp.seat(CASE, COARSE),
        "push": find_critical(DIRECT, NUMERICS, [COARSE], leak=False),
        "hold": push_along(DIRECT, PRESSURES, COARSE),
    }


def numbers(value):
    """Without stress fields, and without the time a solve took."""
    if isinstance(value, list):
        return tuple(map(numbers, value))
    if not dataclasses.is_dataclass(value):
        return value
    fields = {each.name for each in dataclasses.fields(value)} - {"wall", "seconds"}
    return tuple((name, numbers(getattr(value, name))) for name in sorted(fields))


@pytest.mark.parametrize("name", SOLVERS)
def test_every_state_solver_keeps_its_promises(name, plain, tmp_path):
    solver = SOLVERS[name](tmp_path)
    assert isinstance(solver, StateSolver)
    assert type(pickle.loads(pickle.dumps(solver))) is type(solver)
    for what, ask in QUESTIONS.items():
        for _ in range(2 if name.startswith("cache") else 1):
            found = ask(solver)
            assert type(found) is type(plain[what])
            assert_same(numbers(found), numbers(plain[what]))
            first = found[0] if isinstance(found, list) else found
            state = getattr(first, "state", first)
            assert state.case in (CASE, DIRECT)
            if name == "cache with walls":
                assert state.wall is not None


def test_a_state_that_cannot_be_found_is_a_value(tmp_path):
    """An axially compressed wall of fibres kinks all along."""
    question = sp.Case(
        sp.Stone(size_ratio=1.2, friction=0.4), sp.Ureter(wall_ratio=1.3),
        sp.Load(prestretch=0.85), **asking(accuracy="fast", model="direct"),
    )  # fmt: skip
    for make in SOLVERS.values():
        for _ in range(2):
            solver, first = make(tmp_path), PRESSURES[:1]
            (found,) = solver.hold(question, question.numerics, first, COARSE, wetted=False)
            assert isinstance(found, NoPush)
            assert "it buckles axisymmetrically" in found.reason
