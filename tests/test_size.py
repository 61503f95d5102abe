"""The critical size inverts the critical pressure, and every other end is named."""

from dataclasses import replace

import pytest

import stonepass as sp
from stonepass.model.answer import Answer
from stonepass.model.size import _Search, _top, _Unanswered

pytestmark = pytest.mark.usefixtures("shared_solutions")

THIN = sp.Ureter(wall_ratio=1.3)
FAST = sp.Method(accuracy="fast")


def test_size_inverts_pressure():
    found = sp.critical_size(THIN, "12 kPa", method=FAST)
    back = sp.critical_pressure(sp.Stone(size_ratio=found.size_ratio), THIN, method=FAST)
    assert back.pressure == pytest.approx(12e3, rel=1e-4)
    assert found.outcome is sp.Outcome.MOVES
    assert found.diameter is None


def test_size_has_a_diameter_where_the_ureter_has_lengths():
    ureter = sp.Ureter(inner_diameter="3.5 mm", outer_diameter="4.55 mm")
    found = sp.critical_size(ureter, "12 kPa", method=FAST)
    assert found.diameter == pytest.approx(found.size_ratio * 3.5e-3, rel=1e-12)


def test_the_headline_is_near_the_published_sizes():
    # Published 1.22 and 1.11 (paper, Fig. 8a): pressed seating, friction 0.5, one G for both.
    for wall_ratio, published in ((1.3, 1.22), (3.4, 1.11)):
        found = sp.critical_size(sp.Ureter(wall_ratio=wall_ratio), "12 kPa", method=FAST)
        assert found.size_ratio == pytest.approx(published, abs=0.01)


def test_a_limit_beyond_the_strain_range_is_told_with_its_bound():
    found = sp.critical_size(THIN, "50 kPa", method=FAST)
    assert found.outcome is sp.Outcome.BEYOND_RANGE
    assert found.size_ratio is None
    bound = sp.critical_pressure(sp.Stone(size_ratio=1.3), THIN, method=FAST).pressure / 1e3
    assert f"{bound:.4g} kPa" in found.message


def test_a_limit_below_every_stuck_stone_is_told():
    found = sp.critical_size(THIN, "0.001 kPa", friction=1.0, method=FAST)
    assert found.outcome is sp.Outcome.BELOW_RANGE
    assert found.size_ratio is None


def test_beyond_the_closure_is_passed_on():
    found = sp.critical_size(THIN, "50 kPa", friction=1.5, method=FAST)
    assert found.outcome is sp.Outcome.BEYOND_CLOSURE
    assert "at size ratio 1.3" in found.message


def test_an_end_beyond_the_closure_does_not_hide_a_smaller_answer():
    # Friction 0.8: no balance at ξ = 1.3, yet 2 kPa is reached far below.
    found = sp.critical_size(THIN, "2 kPa", friction=0.8, method=FAST)
    assert found.outcome is sp.Outcome.MOVES
    assert found.at_size.pressure == pytest.approx(2e3, rel=1e-4)


@pytest.mark.parametrize("limit", ["-1 kPa", "0 kPa", "1e9 kPa"])
def test_absurd_limits_are_refused(limit):
    with pytest.raises(sp.BadInput, match="limit"):
        sp.critical_size(THIN, limit)


def test_warnings_at_the_critical_size_are_passed_on():
    found = sp.critical_size(THIN, "14 kPa", load=sp.Load("4 kPa"), method=FAST)
    assert found.outcome is sp.Outcome.MOVES
    assert any("shrinks the lumen" in warning for warning in found.warnings)


def test_without_friction_no_size_is_critical():
    found = sp.critical_size(THIN, "12 kPa", friction=0.0, method=FAST)
    assert found.outcome is sp.Outcome.BEYOND_RANGE
    assert "Without friction" in found.message


def test_a_small_limit_is_not_below_the_range():
    # P_ucr(1.0002) of the thin wall with friction 0.5 is a few pascals: 20 Pa is reached above it.
    found = sp.critical_size(THIN, "0.02 kPa", method=FAST)
    assert found.outcome is sp.Outcome.MOVES
    assert 1.0002 < found.size_ratio < 1.005


def test_progress_is_told_every_size():
    tried = []
    sp.critical_size(THIN, "12 kPa", method=FAST, progress=tried.append)
    assert tried[0] == 1.3
    assert 3 < len(tried) < 15


@pytest.mark.parametrize("model", ["paper", pytest.param("direct", marks=pytest.mark.slow)])
def test_a_search_that_begins_on_a_coarser_mesh_ends_where_one_without_does(monkeypatch, model):
    method = replace(FAST, model=model)
    tried = []
    near = sp.critical_size(THIN, "12 kPa", method=method, progress=tried.append)
    assert near.at_size.pressure == pytest.approx(12e3, rel=1e-5)
    assert near.at_size.error.critical_pressure > 0.0
    assert near.size_ratio_error > 0.0
    if model == "direct":  # whose sizes take long: the limit is met, which is the same question
        return
    monkeypatch.setattr(_Search, "near", lambda search, coarse: None)
    alone = sp.critical_size(THIN, "12 kPa", method=method)
    assert near.size_ratio == pytest.approx(alone.size_ratio, abs=2e-6)
    assert near.size_ratio_error == pytest.approx(alone.size_ratio_error, rel=0.05)


def test_a_size_beyond_the_range_of_the_material_is_none():
    """The coarser mesh reaches the limit within the range, the finer one just beyond it."""
    ureter = sp.Ureter(wall_ratio=1.5)
    found = sp.critical_size(ureter, "26.38 kPa", method=FAST)
    assert found.outcome is sp.Outcome.BEYOND_RANGE
    assert found.size_ratio is None


def test_where_the_largest_stone_has_no_answer_a_smaller_one_bounds_the_search():
    """ξ up to 1.3 with answers below 1.2 only; the limit is crossed where the excess changes sign."""
    case = sp.Case(sp.Stone(size_ratio=1.3), THIN)
    none = Answer(case, sp.Outcome.NO_SOLUTION, "No equilibrium was found.")

    def excess(crossing):
        def function(size_ratio):
            if size_ratio > 1.2:
                raise _Unanswered(none)
            return size_ratio - crossing

        return function

    # 1 + 0.75 × 0.3 = 1.225 has none either, 1 + 0.5 × 0.3 = 1.15 has.
    assert _top(1.3, 1.0, excess(1.1)) == pytest.approx((1.15, 0.05))
    # Then halves between 1.15 and 1.225: 1.1875 moves below the limit, 1.2063 has no answer.
    assert _top(1.3, 1.0, excess(1.19)) == pytest.approx((1.196875, 0.006875))
    with pytest.raises(_Unanswered):  # the limit lies where nothing is known
        _top(1.3, 1.0, excess(1.1999))
