"""The critical size inverts the critical pressure, and every other end is named."""

import pytest
from options import asking

import stonepass as sp
from stonepass.model import size
from stonepass.model.size_search import (
    NoValue,
    Root,
    TooSmall,
    local_slope,
    root_in_range,
    secant_root,
)

pytestmark = pytest.mark.usefixtures("shared_solutions")

THIN = sp.Ureter(wall_ratio=1.3)
FAST = asking(accuracy="fast", seating="frictionless")
PRESSED = asking(accuracy="fast")


def test_size_inverts_pressure():
    found = sp.critical_size(THIN, "12 kPa", **FAST)
    back = sp.critical_pressure(sp.Stone(size_ratio=found.size_ratio), THIN, **FAST)
    assert back.pressure == pytest.approx(12e3, rel=1e-4)
    assert found.outcome is sp.Outcome.SOLVED
    assert found.diameter is None


def test_size_has_a_diameter_where_the_ureter_has_lengths():
    ureter = sp.Ureter(inner_diameter="3.5 mm", outer_diameter="4.55 mm")
    found = sp.critical_size(ureter, "12 kPa", **FAST)
    assert found.diameter == pytest.approx(found.size_ratio * 3.5e-3, rel=1e-12)


def test_the_headline_is_near_the_published_sizes():
    # Published 1.22 and 1.11 (paper, Fig. 8a): pressed seating, friction 0.5, one G for both.
    for wall_ratio, published in ((1.3, 1.22), (3.4, 1.11)):
        ureter = sp.Ureter(wall_ratio=wall_ratio)
        low, high = (
            sp.critical_pressure(sp.Stone(size_ratio=published + change), ureter, **PRESSED)
            for change in (-0.01, 0.01)
        )
        assert low.pressure < 12e3 < high.pressure


def test_a_limit_beyond_the_strain_range_is_told_with_its_bound():
    found = sp.critical_size(THIN, "50 kPa", **FAST)
    assert found.outcome is sp.Outcome.BEYOND_RANGE
    assert found.size_ratio is None
    bound = sp.critical_pressure(sp.Stone(size_ratio=1.3), THIN, **FAST).pressure / 1e3
    assert f"{bound:.4g} kPa" in found.message


def test_a_limit_below_every_stuck_stone_is_told():
    found = sp.critical_size(THIN, "0.001 kPa", friction=1.0, **FAST)
    assert found.outcome is sp.Outcome.BELOW_RANGE
    assert found.size_ratio is None


def test_beyond_the_closure_is_passed_on():
    found = sp.critical_size(THIN, "50 kPa", friction=1.5, **FAST)
    assert found.outcome is sp.Outcome.BEYOND_CLOSURE
    assert "at size ratio 1.3" in found.message


def test_an_end_beyond_the_closure_does_not_hide_a_smaller_answer():
    # Friction 0.8: no balance at ξ = 1.3, yet 2 kPa is reached far below.
    found = sp.critical_size(THIN, "2 kPa", friction=0.8, **FAST)
    assert found.outcome is sp.Outcome.SOLVED
    assert found.at_size.pressure == pytest.approx(2e3, rel=1e-4)


@pytest.mark.parametrize("limit", ["-1 kPa", "0 kPa", "1e9 kPa"])
def test_absurd_limits_are_refused(limit):
    with pytest.raises(sp.BadInput, match="limit"):
        sp.critical_size(THIN, limit)


def test_warnings_at_the_critical_size_are_passed_on():
    found = sp.critical_size(THIN, "14 kPa", load=sp.Load("4 kPa"), **FAST)
    assert found.outcome is sp.Outcome.SOLVED
    assert any("narrows the lumen" in str(warning) for warning in found.warnings)


def test_without_friction_no_size_is_critical():
    found = sp.critical_size(THIN, "12 kPa", friction=0.0, **FAST)
    assert found.outcome is sp.Outcome.BEYOND_RANGE
    assert "Without friction" in found.message


def test_a_small_limit_is_not_below_the_range():
    # P_ucr(1.0002) of the thin wall with friction 0.5 is a few pascals: 20 Pa is reached above it.
    found = sp.critical_size(THIN, "0.02 kPa", **FAST)
    assert found.outcome is sp.Outcome.SOLVED
    assert 1.0002 < found.size_ratio < 1.005


def test_progress_is_told_every_size():
    tried = []
    sp.critical_size(THIN, "12 kPa", **FAST, progress=tried.append)
    assert tried[0] == 1.3
    assert 3 < len(tried) < 15


@pytest.mark.parametrize("model", ["paper", pytest.param("direct", marks=pytest.mark.slow)])
def test_a_search_that_begins_on_a_coarser_mesh_ends_where_one_without_does(monkeypatch, model):
    seating = {"seating": "frictionless"} if model == "paper" else {}
    method = asking(accuracy="fast", model=model, **seating)
    tried = []
    near = sp.critical_size(THIN, "12 kPa", **method, progress=tried.append)
    assert near.at_size.pressure == pytest.approx(12e3, rel=1e-5)
    assert near.at_size.error.critical_pressure > 0.0
    assert near.size_ratio_error > 0.0
    if model == "direct":  # whose sizes take long: the limit is met, which is the same question
        return
    monkeypatch.setattr(size, "secant_root", lambda *arguments: None)
    alone = sp.critical_size(THIN, "12 kPa", **method)
    assert near.size_ratio == pytest.approx(alone.size_ratio, abs=2e-6)
    assert near.size_ratio_error == pytest.approx(alone.size_ratio_error, rel=0.05)


def test_a_size_beyond_the_range_of_the_material_is_none():
    """The coarser mesh reaches the limit within the range, the finer one just beyond it."""
    ureter = sp.Ureter(wall_ratio=1.5)
    found = sp.critical_size(ureter, "26.38 kPa", **FAST)
    assert found.outcome is sp.Outcome.BEYOND_RANGE
    assert found.size_ratio is None


def search(crossing, near_low=1.0002):
    """ξ up to 1.3 with values below 1.2 only; the excess changes sign at `crossing`."""

    def excess(size_ratio):
        return size_ratio - crossing if size_ratio <= 1.2 else None

    return root_in_range(excess, 1.0, 1.3, -0.1, near_low, 1e-9)


def test_where_the_largest_stone_has_no_answer_a_smaller_one_bounds_the_search():
    assert search(1.15) == pytest.approx(1.15, abs=1e-8)
    assert search(1.19) == pytest.approx(1.19, abs=1e-8)
    assert search(1.25) == NoValue(1.3)


def test_a_search_says_how_it_ends():
    def line(x):
        return x - 2.0

    assert root_in_range(line, 1.0, 1.5, -1.0, 1.0, 1e-9) == TooSmall(1.5)
    assert root_in_range(line, 1.0, 3.0, -1.0, 1.0, 1e-9) == pytest.approx(2.0, abs=1e-9)
    assert root_in_range(line, 1.0, 3.0, -1.0, 2.5, 1e-9, may_lie_below=True) is None
    hole = {2.5: None}
    assert root_in_range(lambda x: hole.get(x, line(x)), 1.0, 3.0, -1.0, 2.5, 1e-9,
                         may_lie_below=True) == NoValue(2.5)  # fmt: skip


def test_secants_begin_at_the_root_of_a_coarser_function():
    asked = []

    def value(x, last):
        asked.append((x, last))
        return 100.0 * x + 5.0 * (x - 1.0) ** 2

    root = secant_root(value, 120.0, Root(1.203, 101.0), 1.0, 1.3, 1e-9)
    assert value(root.x, True) == pytest.approx(120.0, rel=1e-9)
    assert asked[-2][1] is True  # the last step is short, so the whole answer is asked for
    assert root.slope == pytest.approx(102.0, rel=0.01)
    assert secant_root(value, 120.0, Root(1.203, None), 1.0, 1.3, 1e-9) is None
    assert secant_root(value, 135.0, Root(1.299, 101.0), 1.0, 1.3, 1e-9) is None  # beyond the range
    assert secant_root(lambda x, last: None, 120.0, Root(1.2, 100.0), 1.0, 1.3, 1e-9) is None


def test_a_slope_is_of_points_that_are_not_too_near():
    assert local_slope({1.0: 0.0, 1.00005: 7.0, 1.1: 1.0}, 1.0) == pytest.approx(10.0)
    assert local_slope({1.0: 0.0, 1.00005: 7.0}, 1.0) is None
    assert local_slope({1.1: 0.0}, 1.0) is None
