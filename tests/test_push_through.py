"""The loaded push-through: exact identities first, then what must hold of every answer."""

from dataclasses import replace
from unittest.mock import Mock

import numpy as np
import pytest
from options import asking

import stonepass as sp
from stonepass.errors import Outcome
from stonepass.fe.axisymmetric.loaded_wall import loaded_wall
from stonepass.fe.axisymmetric.problem import Failure, Resolution
from stonepass.fe.axisymmetric.sliding_contact import solve_at_pressure
from stonepass.fe.axisymmetric.sliding_state import Configuration, SlidingState
from stonepass.materials.catalogue import CATALOGUE
from stonepass.materials.derivatives import energy_derivatives, hoop_modulus
from stonepass.materials.protocol import Material
from stonepass.materials.relaxed_energy import KEPT, RelaxedEnergy, relaxed
from stonepass.model.accuracy import LEVELS
from stonepass.model.case_states import push_through
from stonepass.model.energy_balance import advance_force, opened_radius, strained_force
from stonepass.model.far_field import urine_pressure
from stonepass.model.states.loaded import _critical, _set_up, _Setup
from stonepass.model.states.loaded_state import Critical, NoPush, PushedState
from stonepass.model.states.uncached import UNCACHED
from stonepass.strain import INNER_WALL, CauchyGreen

DIRECT = asking(model="direct")
FAST = LEVELS["fast"].resolution
COARSE = LEVELS["fast"].companion


def case(material="latex", eta=1.5, xi=1.2, mu=0.0, load=None, aspect=1.0, **method):
    return sp.Case(
        sp.Stone(size_ratio=xi, friction=mu, aspect=aspect),
        sp.Ureter(wall_ratio=eta, material=material),
        load or sp.Load(),
        **asking(model="direct", **method),
    )


def test_what_an_advance_gains_by_hand():
    """Integrated over p step by step; and for a stiff tube I = P ξ⁻², its lumen unchanged."""
    question = case("ureter", 1.3, 1.2, load=sp.Load("4 kPa", "hydrostatic"))
    pressures = np.linspace(0.0, 8e3, 4001)[1:] - 1.0
    radii = np.array([opened_radius(question, float(p)) for p in pressures[::200]])
    stepped = float((radii**2).mean() * 8e3 / 1.2**2)
    assert advance_force(question, 8e3) == pytest.approx(stepped, rel=1e-2)
    assert advance_force(case(xi=1.2), 1e-3) == pytest.approx(1e-3 / 1.44, rel=1e-6)
    assert advance_force(case(), 1e6) is None  # latex does not bear that


@pytest.mark.parametrize(
    ("question", "kilopascal"),
    [
        (case(), 24.0),
        (case("ureter", 1.3, 1.2), 7.0),
        (case("ureter", 3.4, 1.1), 9.0),
        (case(load=sp.Load("10 kPa", "dead")), 24.0),
        (case(load=sp.Load("10 kPa", "hydrostatic")), 24.0),
        (case(load=sp.Load(prestretch=1.1)), 24.0),
        (case(aspect=0.5), 24.0),
        (case(aspect=2.0), 24.0),
        (case("ureter", 1.3, 1.2, aspect=1.4), 7.0),
    ],
    ids=[
        "latex",
        "thin ureter",
        "thick ureter",
        "dead",
        "hydrostatic",
        "pre-stretch",
        "flat stone",
        "long stone",
        "long stone, ureter",
    ],
)
def test_without_friction_the_force_is_what_the_urine_gains(question, kilopascal):
    """N(P) = I(P), exact where the axial stretch is the same on both sides (model: section 7).

    Advancing the stone exchanges inflated for uninflated tube. No closure and no reference code;
    the far field knows nothing of contact. A tether keeps the stretch.
    """
    pushed = push_through(question, f"{kilopascal} kPa", FAST, tether=0.1)
    assert isinstance(pushed, PushedState)
    assert pushed.net_force == pytest.approx(advance_force(question, kilopascal * 1e3), rel=5e-5)
    assert pushed.upstream_stretch == pytest.approx(question.load.prestretch, abs=3e-3)
    assert pushed.solver.axial_balance < 5e-4


@pytest.mark.parametrize("wetted", [False, True])
@pytest.mark.parametrize(
    ("material", "eta", "xi", "kilopascal"), [("latex", 1.5, 1.2, 24.0), ("ureter", 1.3, 1.2, 7.0)]
)
def test_with_friction_the_force_is_the_gain_less_what_friction_takes(
    material, eta, xi, kilopascal, wetted
):
    """N = I − D, D = ∫ μ λ λ_s dA with the loaded contact pressure."""
    question = case(material, eta, xi, 0.4, wetted=wetted)
    pushed = push_through(question, f"{kilopascal} kPa", FAST, tether=0.1)
    gained = advance_force(question, kilopascal * 1e3)
    assert pushed.friction_work > 0.3 * gained
    expected = gained - pushed.friction_work
    assert pushed.net_force == pytest.approx(expected, abs=1e-4 * gained)


def test_far_upstream_the_tube_is_that_of_the_far_field():
    question = case()
    pushed = push_through(question, "24 kPa", FAST, tether=0.1)
    at = float(urine_pressure(np.array(pushed.upstream_radius), 1.5, question.ureter.material.law,
                              question.load))  # fmt: skip
    assert at == pytest.approx(24e3, rel=2e-3)


def test_unloaded_and_without_friction_it_is_the_seated_state():
    question = case("ureter", 1.3, 1.2)
    pushed = push_through(question, "0 kPa", FAST)
    seated = sp.seat(replace(question, model=sp.SeatedBalance(seating="frictionless")), FAST)
    assert pushed.contact_angle == pytest.approx(seated.contact_angle, abs=2e-5)
    assert pushed.downstream_angle == pytest.approx(np.pi - seated.contact_angle, abs=2e-5)
    theta = np.radians([70.0, 80.0, 90.0, 100.0, 110.0])
    expected = seated.pressure_at(theta)
    np.testing.assert_allclose(pushed.pressure_at(theta), expected, rtol=2e-4)
    assert abs(pushed.net_force) < 1e-9 * seated.equator_contact_pressure


@pytest.fixture(scope="module")
def answer():
    return sp.solve(case(mu=0.475))


def test_at_the_critical_pressure_no_force_is_left_and_around_it_the_sign_changes(answer):
    assert answer.outcome is Outcome.MOVES
    assert abs(answer.contact.net_force) < 1e-6 * answer.pressure
    below, above = (
        push_through(answer.case, f"{answer.pressure * share} Pa", FAST) for share in (0.9, 1.1)
    )
    assert below.net_force < 0.0 < above.net_force


def test_axial_forces_balance_though_no_equation_says_so(answer):
    """The wall's stress at both ends knows nothing of the contact that N is summed from."""
    assert answer.contact.solver.axial_balance < 1e-4
    pushed = push_through(case("ureter", 1.3, 1.2, 0.5), "9 kPa", FAST)
    assert pushed.solver.axial_balance < 1e-4


def test_contact_is_pressed_and_urine_stands_before_it(answer):
    pushed = answer.contact
    upstream = pushed.theta < pushed.seal_angle
    assert pushed.contact_pressure[upstream].min() >= pushed.urine_pressure * (1.0 - 1e-6)
    assert pushed.contact_pressure[0] == pytest.approx(pushed.urine_pressure, rel=1e-6)
    assert pushed.contact_pressure[-1] == pytest.approx(
        0.0, abs=1e-6 * pushed.peak_contact_pressure
    )
    assert pushed.pressure_at(np.array(0.1)) == pytest.approx(pushed.urine_pressure)
    assert pushed.pressure_at(np.array(3.0)) == 0.0
    assert answer.detail.leak_pressure > answer.pressure
    assert pushed.contact_angle == answer.critical_angle


def test_without_friction_every_stone_moves_at_once():
    found = sp.solve(case(accuracy="fast"))
    assert found.outcome is Outcome.MOVES
    assert found.pressure == 0.0
    assert found.contact.urine_pressure == pytest.approx(0.0, abs=1e-6)
    assert found.detail.leak_pressure == pytest.approx(65.5e3, rel=0.02)


def test_pressure_scales_with_stiffness_and_never_with_size(answer):
    stiff = Material("stiff", type(CATALOGUE["latex"].law)(2 * 146500.0), "", "", "", (1.0, 1.5))
    twice = sp.solve(case(stiff, mu=0.475), FAST)
    once = sp.solve(case(mu=0.475), FAST)
    assert twice.pressure == pytest.approx(2.0 * once.pressure, rel=1e-9)
    sized = sp.critical_pressure(
        sp.Stone("6 mm", 0.475), sp.Ureter("5 mm", "7.5 mm", "latex"), **DIRECT
    )
    assert sized.pressure == pytest.approx(answer.pressure, rel=1e-9)


def test_urine_between_stone_and_wall_takes_friction_off(answer):
    wetted = sp.solve(case(mu=0.475, wetted=True), FAST)
    # At most the whole of P is taken off, over that part of the contact which lies before the seal.
    assert 0.8 * answer.pressure < wetted.pressure < 0.97 * answer.pressure


def test_the_claimed_error_covers_a_finer_solve(answer):
    fine = sp.solve(case(mu=0.475), LEVELS["reference"].resolution)
    assert abs(fine.pressure - answer.pressure) <= answer.error.critical_pressure
    assert answer.error.critical_pressure < 1e-3 * answer.pressure
    assert abs(fine.critical_angle - answer.critical_angle) <= answer.error.contact_angle
    equator = fine.contact.equator_contact_pressure - answer.contact.equator_contact_pressure
    assert abs(equator) <= answer.error.equator_contact_pressure


@pytest.mark.parametrize(
    ("offset", "prestretch"), [(-4.0, 1.0), (0.0, 1.0), (4.0, 1.0), (0.0, 1.1)]
)
def test_held_ends_strain_both_sides_and_the_force_is_exact_with_that(offset, prestretch):
    """N = [(ω − ε S)⁺ − (ω − ε S)⁻]/λ_z for any strain ε of the sides (`strained_force`)."""
    question, pressure = case(load=sp.Load(prestretch=prestretch)), 24e3
    pushed = push_through(question, f"{pressure} Pa", FAST, offset=offset)
    strained = strained_force(
        question, pressure, pushed.upstream_stretch, pushed.downstream_stretch
    )
    assert pushed.upstream_stretch < prestretch < pushed.downstream_stretch
    assert abs(pushed.net_force / advance_force(question, pressure) - 1.0) > 1e-3
    assert pushed.net_force == pytest.approx(strained, rel=3e-4)


def test_a_stone_that_is_not_stuck_is_refused_and_answered_loose():
    with pytest.raises(sp.BadInput, match="a smaller stone is loose"):
        push_through(case(xi=0.9), "5 kPa")
    assert sp.solve(case(xi=0.9)).outcome is Outcome.LOOSE
    with pytest.raises(sp.BadInput, match="urine pressure is -1 kPa"):
        push_through(case(), "-1 kPa")


def test_where_no_state_is_found_the_reason_is_said():
    lost = push_through(case(mu=2.0, half_length=4.0), "2 kPa", COARSE)
    assert isinstance(lost, NoPush)
    assert lost.reason


@pytest.mark.parametrize(("accuracy", "said"), [("standard", True), ("fast", False)])
def test_a_state_on_a_coarser_mesh_alone_is_told(accuracy, said):
    """The finer mesh has no state; the reason says that a coarser one has one."""
    asked = case()
    found = UNCACHED.push(asked, sp.Numerics("fast"), (COARSE,), wetted=False, leak=False)
    states = Mock(push=Mock(return_value=[*found, NoPush("no convergence", 1, 0.0)]))
    answer = sp.PushThrough().solve(asked, sp.Numerics(accuracy), states)
    assert answer.outcome is Outcome.NO_SOLUTION
    assert answer.reason.startswith("no convergence")
    assert ("the accuracy 'fast' may have an answer" in answer.reason) is said


# The wall that microbuckles.

URETER = CATALOGUE["ureter"].law


def test_the_kink_is_where_the_axial_slope_has_fallen_to_the_part_that_is_kept():
    wall = RelaxedEnergy(URETER)
    C_tt = np.array([0.8, 1.0, 1.3, 1.7])
    kink = wall.threshold(C_tt, np)
    one, zero = np.ones_like(C_tt), np.zeros_like(C_tt)
    slope, _ = energy_derivatives(
        URETER, CauchyGreen(one, C_tt, kink, zero, zero, zero), INNER_WALL
    )
    np.testing.assert_allclose(slope[:, 2], KEPT * URETER.G / 2.0, rtol=1e-9)


def test_beyond_the_kink_energy_goes_on_along_its_tangent_and_before_it_nothing_changes():
    wall, C_tt = RelaxedEnergy(URETER), np.array([1.3])
    kink = wall.threshold(C_tt, np)

    def energy(law, C_zz):
        return law.energy(CauchyGreen(np.ones(1), C_tt, np.array([C_zz])), INNER_WALL, np)[0]

    assert energy(wall, 1.0) == energy(URETER, 1.0)
    at, below = energy(wall, kink[0]), energy(wall, kink[0] - 0.1)
    assert at == pytest.approx(energy(URETER, kink[0]), rel=1e-12)
    assert at - below == pytest.approx(0.1 * KEPT * URETER.G / 2.0, rel=1e-9)
    assert below < energy(URETER, kink[0] - 0.1)  # fibres alone would be compressed further


def test_fine_kinks_in_the_mean_undeformed_fibres_reach_the_relaxed_energy():
    """With nothing kept: a layer of shears ±ε e_r ⊗ e_z, mean deformation kept, C_zz + ε² C_rr."""
    wall, C_zz = RelaxedEnergy(URETER, kept=1e-12), 0.8
    one = np.ones(1)
    layered = [
        URETER.energy(
            CauchyGreen(one, 1.2 * one, np.array([C_zz + e * e]), np.array([e])), INNER_WALL, np
        )[0]
        for e in np.linspace(0.0, 1.0, 2001)
    ]
    # U depends on C_rz not at all, so both halves of the layer have the same energy.
    relaxed_energy = wall.energy(CauchyGreen(one, 1.2 * one, C_zz * one), INNER_WALL, np)[0]
    assert relaxed_energy == pytest.approx(min(layered), rel=1e-6)
    assert relaxed_energy < layered[0]


def test_only_a_fung_wall_is_relaxed_and_at_rest_it_is_itself():
    latex = CATALOGUE["latex"].law
    assert relaxed(latex) is latex
    assert hoop_modulus(relaxed(URETER)) == pytest.approx(hoop_modulus(URETER), rel=1e-12)


def test_what_is_kept_of_the_ground_matrix_hardly_changes_the_answer(monkeypatch):
    """Mesh and kept part both matter by less than 0.2 %, in a wall that has lost its ellipticity."""
    question, found = case("ureter", 1.3, 1.2, 0.5), []
    for kept, resolution in ((0.1, COARSE), (0.2, COARSE), (0.2, Resolution())):
        monkeypatch.setattr(
            "stonepass.model.states.loaded.relaxed", lambda law, kept=kept: relaxed(law, kept)
        )
        found.append(sp.solve(question, resolution))
    pressures = np.array([answer.pressure for answer in found])
    assert np.ptp(pressures) < 2e-3 * pressures.mean()
    assert found[-1].contact.stability.margin < 0.0
    assert any("buckle on a fine scale at R" in str(each) for each in found[-1].warnings)


def leaking(monkeypatch, force, last):
    """Stand for a tube whose seal gives way while the stone is still held: N stays negative."""

    def state(pressure, excess):
        line = np.array([[pressure, pressure * (1.0 + excess), 0.0]])
        zero, at = np.zeros_like(line), Configuration(np.zeros(1), (-0.5, 0.5), pressure, 0.5)
        return SlidingState(at, force, zero, zero, zero, line, 1, 0.0, 0.0, 0.0)

    def at_seal(workspace, start, excess, guess, friction):
        if excess < last:
            return Failure("lost", 1)
        return state(10.0 - 0.5 * excess**2, excess)  # leaks at P = 10

    solves = {
        "solve_critical": lambda *_: Failure("no root", 3),
        "solve_at_pressure": lambda workspace, start, pressure, friction: state(pressure, 2.0),
        "solve_at_seal": at_seal,
        "_state": lambda case, setup, found, started: Mock(
            PushedState, urine_pressure=found.configuration.pressure
        ),
    }
    for name, function in solves.items():
        monkeypatch.setattr(f"stonepass.model.states.loaded.{name}", function)


@pytest.mark.parametrize(
    ("force", "last", "leaks"), [(-1.0, 0.01, True), (1.0, 0.01, False), (-1.0, 0.5, False)]
)
def test_urine_passes_first_only_where_the_seal_was_followed_to_its_end(
    monkeypatch, force, last, leaks
):
    """No wall we know does; so the decision is tested on a made-up one."""
    question = case("ureter", 1.3, 1.2)
    setup = replace(set_up(question), modulus=100.0, guess=5.0, opening=8.0)
    leaking(monkeypatch, force, last)
    found = _critical(question, setup, None, 0.0, leak=True)
    assert isinstance(found, Critical) is leaks
    if leaks:
        assert found.leaks
        assert found.leak_pressure == pytest.approx(1000.0, rel=1e-2)
        assert found.state.urine_pressure < 10.0  # the last state before the leak
    else:
        assert found.reason.startswith("no root")


def set_up(question):
    (found,) = _set_up(question, question.numerics, [COARSE], wetted=question.model.wetted)
    assert isinstance(found, _Setup)
    return found


def test_a_failed_solve_leaves_no_trace():
    """Asked for more than the tube bears, the next solve gives the same numbers, to the last bit."""
    question = case("ureter", 1.3, 1.2, wetted=True, half_length=4.0)
    failed, fresh = (set_up(question) for _ in range(2))
    first = solve_at_pressure(fresh.workspace, fresh.seated, 0.01, 0.4)
    before = solve_at_pressure(failed.workspace, failed.seated, 0.01, 0.4)
    lost = solve_at_pressure(failed.workspace, before.configuration, 1.0, 0.4)
    assert isinstance(lost, Failure)  # 336 kPa: no such tube
    again = solve_at_pressure(failed.workspace, before.configuration, 0.02, 0.4)
    expected = solve_at_pressure(fresh.workspace, first.configuration, 0.02, 0.4)
    assert isinstance(again, SlidingState)
    assert again.force == expected.force
    np.testing.assert_array_equal(again.contact_pressure, expected.contact_pressure)
    np.testing.assert_array_equal(again.configuration.unknowns, expected.configuration.unknowns)


def test_a_state_is_read_whatever_was_solved_after_it():
    setup = set_up(case("ureter", 1.3, 1.2, half_length=4.0))
    state = solve_at_pressure(setup.workspace, setup.seated, 0.01, 0.4)
    at_once = loaded_wall(setup.workspace, state)
    solve_at_pressure(setup.workspace, state.configuration, 0.02, 0.4)
    later = loaded_wall(setup.workspace, state)
    np.testing.assert_array_equal(at_once.field.stress_tt, later.field.stress_tt)
    assert at_once.far_field == later.far_field
    assert at_once.axial_balance == later.axial_balance


def test_only_a_wall_that_microbuckles_is_said_to():
    """Latex has no fibres; a bare Fung wall that is stable does not microbuckle."""
    assert not sp.solve(case(mu=0.475), COARSE).contact.microbuckled
    bare = push_through(case("ureter", 1.3, 1.1), "1 kPa", COARSE)
    assert not bare.microbuckled
    assert not any("buckle on a fine scale" in str(text) for text in bare.warnings())


@pytest.mark.parametrize(("xi", "eta", "mu", "kilopascal"), [(1.231, 1.777, 0.673, 26.68)])
def test_a_wall_in_which_many_fibres_begin_to_buckle_has_a_state(xi, eta, mu, kilopascal):
    """Newton's method alternates between the two sides of the onset if its tangent has a kink."""
    answer = sp.solve(case("ureter", eta, xi, mu), FAST)
    assert answer.outcome is Outcome.MOVES
    assert answer.pressure / 1e3 == pytest.approx(kilopascal, rel=1e-3)
    assert "loaded_imbalance" not in [each.code for each in answer.warnings]
