"""The error that answers claim: it covers the true one, falls with the level, and is passed on."""

from dataclasses import replace

import pytest
from options import asking

import stonepass as sp
from stonepass.fe.axisymmetric.problem import Failure, Resolution
from stonepass.model.accuracy import LEVELS
from stonepass.model.states import seated
from stonepass.studies.solution_cache import SolutionCache

LATEX = sp.Ureter(wall_ratio=1.5, material="latex")
FRICTIONLESS = asking(seating="frictionless")


def claimed(case, accuracy):
    """The answer at a level, and its errors of α₀, σ(π/2) and P_ucr."""
    answer = sp.solve(replace(case, numerics=sp.Numerics(accuracy)))
    error = answer.error
    return answer, (error.contact_angle, error.equator_contact_pressure, error.critical_pressure)


def numbers(answer):
    state = answer.contact
    return state.contact_angle, state.equator_contact_pressure, answer.pressure


@pytest.mark.parametrize(
    "case",
    [
        sp.Case(sp.Stone(size_ratio=1.2), LATEX, **FRICTIONLESS),
        pytest.param(
            sp.Case(sp.Stone(size_ratio=1.1), sp.Ureter(wall_ratio=1.3)), marks=pytest.mark.slow
        ),
    ],
    ids=["frictionless", "pressed"],
)
def test_claims_cover_the_finest_level_and_fall_towards_it(case):
    fine, least = claimed(case, "reference")
    limit, larger = numbers(fine), least
    for level in ("standard", "fast"):
        answer, errors = claimed(case, level)
        for value, error, truth in zip(numbers(answer), errors, limit, strict=True):
            assert abs(value - truth) <= error
        assert errors[2] > larger[2] > 0.0
        larger = errors
    assert least[2] < 2e-3 * fine.pressure


def test_a_mesh_of_ones_own_is_solved_alone():
    answer = sp.solve(sp.Case(sp.Stone(size_ratio=1.2), LATEX, **FRICTIONLESS), Resolution())
    assert answer.error is None
    assert answer.contact.coarse is None
    assert "the discretisation error is not estimated" in str(answer.warnings[-1])


def test_an_answer_whose_second_solve_fails_says_so(monkeypatch):
    usual = seated._solve

    def without_companion(*arguments):
        return [Failure("made up", 7), *usual(*arguments)[1:]]

    monkeypatch.setattr(seated, "_solve", without_companion)
    answer = sp.solve(sp.Case(sp.Stone(size_ratio=1.2), LATEX, **FRICTIONLESS))
    assert answer.outcome is sp.Outcome.MOVES
    assert answer.error is None
    assert "the discretisation error is not estimated" in str(answer.warnings[-1])
    assert answer.newton_steps > 7


def test_without_a_balance_the_contact_still_has_its_error():
    stone = sp.Stone(size_ratio=1.2, friction=1.5)
    answer = sp.solve(sp.Case(stone, LATEX, **FRICTIONLESS))
    assert answer.outcome is sp.Outcome.BEYOND_CLOSURE
    assert answer.error.contact_angle > 0.0
    assert answer.error.critical_pressure is None


def test_an_outcome_within_the_solver_error_says_so(tmp_path):
    """Near the end of the closure the coarser solve may find a balance where this one does not."""
    case = sp.Case(sp.Stone(size_ratio=1.2), LATEX, **FRICTIONLESS)
    known = SolutionCache(tmp_path)  # the seated state is the same whatever the friction

    def outcomes(friction):
        stone = sp.Stone(size_ratio=1.2, friction=friction)
        here = sp.solve(replace(case, stone=stone), states=known)
        companion = LEVELS["standard"].companion
        coarser = sp.solve(replace(case, stone=stone), companion, states=known)
        return here, here.outcome is not coarser.outcome

    low, high = 0.5, 1.5  # moves, and does not: half the interval until only one solve moves
    for _ in range(40):
        friction = (low + high) / 2.0
        answer, undecided = outcomes(friction)
        if undecided:
            break
        low, high = (friction, high) if answer.outcome is sp.Outcome.MOVES else (low, friction)
    assert undecided
    assert answer.warnings[-1].code == "closure_undecided"
    assert "the discretisation error is too large to decide" in str(answer.warnings[-1])
    assert "closure_undecided" not in [each.code for each in sp.solve(case).warnings]


def test_the_error_of_a_size_is_that_of_its_pressure_over_the_slope():
    found = sp.critical_size(LATEX, "30 kPa", **FRICTIONLESS)
    case = found.at_size.case
    up, down = (
        sp.solve(case.with_size_ratio(found.size_ratio + h), Resolution()).pressure
        for h in (1e-3, -1e-3)
    )
    expected = found.at_size.error.critical_pressure / ((up - down) / 2e-3)
    assert found.size_ratio_error == pytest.approx(expected + 1e-6, rel=0.2)


def test_an_unknown_level_is_refused():
    with pytest.raises(
        sp.BadInput, match="accuracy is best, but must be one of fast, standard, ref"
    ):
        asking(accuracy="best")


def test_every_level_has_a_coarser_companion():
    for level in LEVELS.values():
        mesh, coarser = level.resolution, level.companion
        assert coarser.increments < mesh.increments
        assert coarser.closed < mesh.closed
        assert coarser.edge > mesh.edge


def test_a_refined_resolution():
    fine = Resolution(order=4, closed=10, edge=0.02, growth=1.69, increments=8).refined(2.0)
    assert (fine.order, fine.closed, fine.edge, fine.increments) == (4, 20, 0.01, 16)
    assert fine.growth == pytest.approx(1.3)
    assert fine.path_columns == 20
