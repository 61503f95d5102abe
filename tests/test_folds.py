"""A wall that passes through itself is found, and named."""

from dataclasses import replace
from functools import partial

import ngsolve as ng
import numpy as np
import pytest
from options import asking

import stonepass as sp
from stonepass.fe.axisymmetric.profile import Profile
from stonepass.fe.axisymmetric.seating import seat_on_stone
from stonepass.fe.axisymmetric.self_intersection import crossing, self_contact
from stonepass.materials.catalogue import CATALOGUE
from stonepass.materials.derivatives import hoop_modulus
from stonepass.model.states.first_guess import wrap_round_arc
from stonepass.model.states.nondimensional import tube_of


def test_a_polyline_that_crosses_itself_by_hand():
    # (0,0)–(2,0) is cut by (2,2)–(1,−1) at z = 0.
    assert crossing(np.array([0.0, 2.0, 2.0, 1.0]), np.array([0.0, 0.0, 2.0, -1.0])) == 0
    # A hook that does not reach back to its stem.
    assert crossing(np.array([0.0, 2.0, 2.0, 1.0]), np.array([0.0, 0.0, 2.0, 1.0])) is None
    # A curve that only ever goes on cannot cross itself, however far it swings.
    assert crossing(np.array([1.0, -5.0, 7.0, 1.0]), np.array([0.0, 1.0, 2.0, 3.0])) is None


def test_a_fold_that_bends_back_without_touching_is_none():
    t = np.linspace(0.0, 1.0, 200)
    z = t + 0.2 * np.sin(4.0 * np.pi * t)  # not monotonic
    assert np.any(np.diff(z) < 0.0)
    assert crossing(1.0 + 0.5 * t, z) is None
    turn = np.linspace(0.1, 5.0 * np.pi, 400)
    assert crossing(turn * np.cos(turn), turn * np.sin(turn)) is None  # a spiral
    eight = np.linspace(0.1, 2.0 * np.pi + 0.5, 200)
    assert crossing(np.sin(eight), np.sin(2.0 * eight)) is not None


def test_a_state_that_touches_itself_is_no_answer(monkeypatch):
    import stonepass.fe.axisymmetric.seating as module

    monkeypatch.setattr(module, "self_contact", lambda solved: 1.5)
    tube = sp.Ureter(wall_ratio=1.5, material="latex")
    answer = sp.critical_pressure(
        sp.Stone(size_ratio=1.2), tube, **asking(accuracy="fast", seating="frictionless")
    )
    assert answer.outcome is sp.Outcome.NO_SOLUTION
    assert "folded onto itself near Z = 1.5" in answer.message


@pytest.mark.parametrize("wall_ratio", [1.2, 3.4])
def test_a_stone_that_is_far_too_large_is_named(wall_ratio):
    case = sp.Case(sp.Stone(size_ratio=3.0), sp.Ureter(wall_ratio=wall_ratio))
    answer = sp.solve(replace(case, numerics=sp.Numerics("fast")))
    assert answer.outcome is sp.Outcome.NO_SOLUTION
    assert "stretches the wall to 3 times its circumference" in answer.message
    assert "'ureter' were used up to 1.3 only" in answer.message


@pytest.fixture(scope="module")
def solved():
    law = CATALOGUE["latex"].law
    case = sp.Case(sp.Stone(size_ratio=1.2), sp.Ureter(wall_ratio=1.5, material="latex"))
    tube = tube_of(law, 1.5, case.load, 10.0)
    wrap_at = partial(wrap_round_arc, case, 10.0, 1.0, hoop_modulus(law))
    return seat_on_stone(tube, Profile(1.2), wrap_at)[0]


@pytest.mark.parametrize(
    ("component", "change", "where"),
    [
        # Material drawn back by more than it is apart passes through the middle, or a fold.
        (1, lambda: -3.0 * ng.exp(-4.0 * (ng.y - 2.0) ** 2), (1.5, 2.5)),
        # A lumen that closes meets the axis.
        (0, lambda: -2.5 * ng.exp(-4.0 * (ng.y - 4.0) ** 2), (3.8, 4.2)),
    ],
    ids=["through the middle", "through the axis"],
)
def test_a_real_wall_that_meets_itself_is_found(solved, component, change, where):
    assert self_contact(solved) is None
    displacement = solved.discretisation.fields[component]
    kept = displacement.vec.CreateVector()
    kept.data = displacement.vec
    displacement.Set(displacement + change())
    try:
        found = self_contact(solved)
    finally:
        displacement.vec.data = kept
    assert where[0] < found < where[1]


def test_a_real_wall_that_folds_over_is_found(solved):
    """An S: the wall comes back over itself with the radius changed on the way."""
    u, w, *_ = solved.discretisation.fields
    kept = solved.discretisation.state.vec.CreateVector()
    kept.data = solved.discretisation.state.vec
    turn = ng.IfPos(ng.y - 4.0, ng.IfPos(7.0 - ng.y, ng.y - 4.0, 3.0), 0.0) * 2.0 * np.pi / 3.0
    w.Set(w - 1.5 * ng.sin(turn))
    u.Set(u + 0.5 * (1.0 - ng.cos(turn)) + 0.3 * ng.sin(2.0 * turn))
    try:
        assert self_contact(solved) is not None
    finally:
        solved.discretisation.state.vec.data = kept
    assert self_contact(solved) is None
