"""Seating with friction: Coulomb's law, both limits, energy, balance, independence of increments."""

from dataclasses import replace

import numpy as np
import pytest

import stonepass as sp
from stonepass.fe.axisymmetric.problem import Resolution
from stonepass.model.case_states import seat
from stonepass.model.seating import Seating
from stonepass.model.states.seated_state import SeatedState

FAST = sp.Numerics("fast")
STANDARD = sp.Numerics()
LATEX = sp.Case(
    sp.Stone(size_ratio=1.2, friction=0.475),
    sp.Ureter(wall_ratio=1.5, material="latex"),
    numerics=FAST,
)
THIN = sp.Case(sp.Stone(size_ratio=1.2), sp.Ureter(wall_ratio=1.3), numerics=FAST)


@pytest.fixture(scope="module")
def latex():
    return seat(LATEX)


def with_method(case, **changes):
    return replace(case, model=replace(case.model, **changes))


def test_pressed_is_the_default(latex):
    assert LATEX.model.seating == "pressed"
    assert LATEX.model.seating_of(LATEX) == Seating("pressed", 0.475)
    assert isinstance(latex, SeatedState)


def test_friction_stays_inside_its_cone(latex):
    # At the nodes, where Coulomb's law is solved; the profile between them is clipped to it.
    assert latex.solver.cone_excess <= 1e-9
    assert np.abs(latex.friction_traction).max() > 0.1 * latex.peak_contact_pressure


def test_friction_takes_energy_and_gives_none(latex):
    assert latex.solver.dissipated > 0.0
    assert seat(with_method(LATEX, seating="growing")).solver.dissipated > 0.0
    assert seat(with_method(LATEX, seating="frictionless")).solver.dissipated == 0.0


def test_the_dissipated_energy_converges_with_the_increments():
    """Points in contact must keep where they stuck: else energy drifts with the increments."""
    case, found = with_method(LATEX, seating_friction=0.1), []
    for increments in (6, 12, 24):
        found.append(seat(case, Resolution(increments=increments)).solver.dissipated)
    assert abs(found[2] - found[1]) < abs(found[1] - found[0])
    assert found[1] == pytest.approx(found[2], rel=0.1)


@pytest.mark.parametrize("case", [LATEX, THIN], ids=["latex", "ureter"])
def test_each_half_is_in_axial_balance(case):
    # Stress at both sections, contact forces and the bath; no equation of the solver says so.
    bath = replace(case, load=sp.Load("3 kPa", "hydrostatic"))
    for seating, bound in (("frictionless", 1e-4), ("pressed", 2e-3)):
        for loaded in (case, bath):
            state = seat(with_method(loaded, seating=seating), STANDARD.resolution)
            assert state.solver.axial_balance < bound


def test_no_friction_is_the_frictionless_state():
    smooth = seat(with_method(LATEX, seating="frictionless"))
    states = [seat(with_method(LATEX, seating_friction=mu)) for mu in (0.1, 0.01, 0.001)]
    hardly = states[2]  # along the whole path
    assert hardly.contact_angle == pytest.approx(smooth.contact_angle, abs=1e-4)
    assert hardly.equator_contact_pressure == pytest.approx(
        smooth.equator_contact_pressure, rel=3e-3
    )
    changes = [abs(state.contact_angle - smooth.contact_angle) for state in states]
    assert changes[0] > 2.0 * changes[1] > 4.0 * changes[2]
    assert changes[2] < 2e-4


STICKING = [with_method(LATEX, seating_friction=mu) for mu in (1.0, 2.0)]


def test_much_friction_is_full_stick(latex):
    """Beyond some friction nothing slips but the very edge, and more friction changes nothing."""
    one, two = (seat(case) for case in STICKING)
    assert abs(one.contact_angle - two.contact_angle) < one.error.contact_angle
    middle = np.abs(one.theta - np.pi / 2) < np.pi / 2 - one.contact_angle - 0.05
    slipping = np.abs(two.friction_traction) >= 1.999 * two.contact_pressure
    assert not slipping[middle].any()
    assert two.solver.dissipated < 1e-3 * latex.equator_contact_pressure


def test_pressed_and_growing_differ_but_little_in_the_critical_pressure():
    # Friction has a path: the pressures near the equator differ, P_ucr by about 1 %.
    quick = replace(LATEX, numerics=sp.Numerics("fast"))
    pressures = [sp.solve(with_method(quick, seating=s)).pressure for s in ("pressed", "growing")]
    assert pressures[0] == pytest.approx(pressures[1], rel=0.02)
    assert pressures[0] != pytest.approx(pressures[1], rel=1e-4)


@pytest.mark.slow
def test_much_friction_with_many_increments_does_not_slip_at_all():
    """The slip of the last increment, next to the edge, is what is left: none of it at 32."""
    finely = [seat(case, Resolution(increments=32)).contact_angle for case in STICKING]
    assert finely[0] == pytest.approx(finely[1], abs=3e-6)


@pytest.mark.parametrize("case", [LATEX, THIN], ids=["latex", "ureter"])
def test_the_result_does_not_depend_on_the_increments(case):
    found = [sp.solve(case, Resolution(increments=n)).pressure for n in (8, 20)]
    assert found[0] == pytest.approx(found[1], rel=3e-3)
    assert found[0] != found[1]  # the increments were really changed


def test_an_increment_that_fails_is_halved(monkeypatch, latex):
    """Make the first attempt of the second increment fail and see the path end all the same."""
    import stonepass.fe.axisymmetric.loading_path as module

    calls = {"count": 0}
    original = module.newton_or_homotopy

    def flaky(system, stiffen, tolerance):
        calls["count"] += 1
        report = original(system, stiffen, tolerance)
        return replace(report, reason="made to fail") if calls["count"] == 2 else report

    monkeypatch.setattr(module, "newton_or_homotopy", flaky)
    state = seat(LATEX, STANDARD.resolution)
    assert isinstance(state, SeatedState)
    assert calls["count"] >= 10  # eight increments, one halved, one tried twice
    assert state.contact_angle == pytest.approx(latex.contact_angle, abs=1e-3)


def test_a_path_that_cannot_go_on_is_named(monkeypatch):
    import stonepass.fe.axisymmetric.loading_path as module
    from stonepass.fe.core.newton import Report

    monkeypatch.setattr(module, "newton_or_homotopy", lambda *_: Report(1, 1.0, "made to fail"))
    answer = sp.solve(LATEX)
    assert answer.outcome is sp.Outcome.NO_SOLUTION
    assert "at 0% of the path, made to fail" in answer.message


def test_where_no_smooth_edge_is_found_the_state_says_so(monkeypatch):
    """The fallback on an ordinary case: same answer, with the uncertainty of its edge stated."""
    import stonepass.fe.axisymmetric.seating as module
    from stonepass.fe.axisymmetric.problem import Failure

    case = replace(LATEX, numerics=STANDARD)
    good = sp.solve(case)
    monkeypatch.setattr(module, "solve_fitted_contact", lambda *_: Failure("made to fail", 1))
    answer = sp.solve(case)
    assert answer.outcome is sp.Outcome.MOVES
    assert any("contact angle has an uncertainty of" in str(warning) for warning in answer.warnings)
    uncertainty = answer.contact.contact_angle_uncertainty
    assert 0.0 < uncertainty < 0.02
    expected = pytest.approx(good.contact.contact_angle, abs=uncertainty)
    assert answer.contact.contact_angle == expected
    assert answer.pressure == pytest.approx(good.pressure, rel=3e-3)
