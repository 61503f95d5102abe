"""A wall that passes through itself is found, and named."""

import numpy as np
import pytest

import stonepass as sp
from stonepass.fe.folds import crossing


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
    import stonepass.fe.tube as module

    monkeypatch.setattr(module, "self_contact", lambda solved: 1.5)
    case = sp.Case(sp.Stone(size_ratio=1.2), sp.Ureter(wall_ratio=1.5, material="latex"))
    answer = sp.solve(case)
    assert answer.outcome is sp.Outcome.NO_SOLUTION
    assert "folded onto itself near Z = 1.5" in answer.message


@pytest.mark.parametrize("wall_ratio", [1.2, 3.4])
def test_a_stone_that_is_far_too_large_is_named(wall_ratio):
    answer = sp.solve(sp.Case(sp.Stone(size_ratio=3.0), sp.Ureter(wall_ratio=wall_ratio)))
    assert answer.outcome is sp.Outcome.NO_SOLUTION
    assert "stretches the wall to 3 times its circumference" in answer.message
    assert "'ureter' were used to 1.3" in answer.message
