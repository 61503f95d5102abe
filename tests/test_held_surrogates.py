"""Surrogates of the direct model: functions of the pressure, their balance, exact results."""

import json

import numpy as np
import pytest
from scipy.stats import qmc

import stonepass as sp
from stonepass.cli import run
from stonepass.errors import Outcome
from stonepass.model.energy_balance import advance_force, opened_radius
from stonepass.studies.conditions import Conditions, case_at, lumen_ratios
from stonepass.studies.surrogates.box import Box, opening_pressure
from stonepass.studies.surrogates.build import build_surrogate
from stonepass.studies.surrogates.check import check_surrogate
from stonepass.studies.surrogates.held_functions import HIGHEST, HeldFunctions
from stonepass.studies.surrogates.held_stone import HeldStone
from stonepass.studies.surrogates.learnt import half_width
from stonepass.studies.surrogates.polynomial import SparsePolynomial
from stonepass.studies.surrogates.solved import MOVES, NO_SOLUTION
from stonepass.studies.surrogates.store import load_surrogate, save_surrogate


def case_of(material="latex", load="0 kPa"):
    return sp.Case(
        sp.Stone(size_ratio=1.2, friction=0.3),
        sp.Ureter(wall_ratio=1.4, material=material),
        sp.Load(load),
        model=sp.PushThrough(),
        numerics=sp.Numerics("fast"),
    )


def setting(case, size, wall, friction, factor=0.0):
    given = [np.array(each, dtype=float) for each in (size, wall, friction)]
    asked = Conditions(*given, np.full(len(size), factor))
    lumen = lumen_ratios(case, asked.wall_ratio, asked.load_factor)
    return Box().setting(case, asked, lumen, 0.9)


def test_coefficients_in_the_pressure_are_those_of_the_correction():
    """base + p × correction, whether p is set last or first, with and without a load."""
    rng = np.random.default_rng(1)
    base = SparsePolynomial(np.array([[0, 0, 0, 0], [1, 0, 0, 1], [0, 2, 0, 0]]),
                            rng.normal(0.0, 0.1, (3, 4)))  # fmt: skip
    terms = [[0, 0, 0, 0], [1, 0, 2, 0], [1, 0, 0, 2], [0, 1, 1, 1], [2, 1, 3, 0]]
    correction = SparsePolynomial(np.array(terms), rng.normal(size=(5, 3)))
    functions = HeldFunctions(base, correction)
    u = qmc.Sobol(3, seed=2).random(8)
    p = HIGHEST * u[:, 2]
    cosines = np.cos(np.arange(4) * np.arccos(2 * u[:, 2:] - 1))
    for factor, learnt in ((0.0, functions), (0.0, functions.without_load()), (0.7, functions)):
        case = case_of(load="3 kPa")
        at = setting(case, 1.0 + 0.6 * u[:, 0], 1.2 + u[:, 1], np.full(8, 0.3), factor)
        assert np.all(at.unit[:, 3] > 0.0) == (factor > 0.0)
        coefficients = learnt(at).reshape(8, 3, -1)
        without = base(at.unit)
        points = np.stack(
            [half_width(at, without), at.unit[:, 1], p / HIGHEST, at.unit[:, 3]], axis=1
        )
        expected = without[:, 1:] + p[:, None] * correction(points)
        changes = np.einsum("nfk,nk->nf", coefficients[:, :, 1:], cosines)
        assert np.allclose(coefficients[:, :, 0] + p[:, None] * changes, expected, atol=1e-12)


def test_the_balance_is_solved_or_has_a_bound():
    """For ln h = a + b p the balance is p = μ exp(a + b p), whatever the wall is."""
    case, friction = case_of(), np.array([0.0, 1e-3, 0.1, 0.4, 0.6, 1.0])
    at = setting(case, [1.2] * 6, [1.4] * 6, friction)
    a, b = 0.8, -0.5
    # The series b + 0 T₁; the other two functions are constant.
    row = [a, b, 0.0, 0.7, 0.0, 0.0, 1.0, 0.0, 0.0]
    found = HeldStone().solve(case, at, np.array([row] * 6))
    opening = opening_pressure(case, at)
    p = found.pressure / opening
    ended = friction * np.exp(a + b * HIGHEST) > HIGHEST
    assert ended.tolist() == [False] * 5 + [True]
    balanced = friction * np.exp(a + b * p)
    assert p[~ended] == pytest.approx(balanced[~ended], rel=1e-9, abs=1e-15)
    assert np.isnan(p[ended]).all()
    assert found.outcome.tolist() == [MOVES] * 5 + [NO_SOLUTION]
    assert found.lower_bound[ended] == pytest.approx(HIGHEST * opening[ended])
    assert found.quantities["leak_pressure"][2] == pytest.approx(np.e * opening[2])


@pytest.mark.parametrize(
    ("material", "load"), [("latex", "0 kPa"), ("ureter", "0 kPa"), ("latex", "6 kPa")]
)
def test_exact_values_give_the_answer_of_the_model(shared_solutions, material, load):
    """Radius and dissipation follow from P_ucr as in the energy balance of the model."""
    case = case_of(material, load)
    answer = sp.critical_pressure(case)
    at = setting(case, [1.2], [1.4], [0.3], 1.0)
    physics = HeldStone()
    p, *values = physics.learnt(case, at, [answer])[0]
    row = np.array([[each for value in values for each in (value, 0.0)]])
    found = physics.solve(case, at, row)
    assert found.pressure[0] == pytest.approx(answer.pressure, rel=1e-9)
    assert p == pytest.approx(answer.pressure / opening_pressure(case, at)[0])
    numbers = {name: float(each[0]) for name, each in found.quantities.items()}
    assert numbers["contact_angle"] == pytest.approx(answer.contact.contact_angle, abs=1e-9)
    assert numbers["leak_pressure"] == pytest.approx(answer.detail.leak_pressure, rel=1e-9)
    assert numbers["opened_radius"] == pytest.approx(opened_radius(case, answer.pressure), rel=1e-6)
    assert numbers["friction_work"] == pytest.approx(advance_force(case, answer.pressure), rel=1e-6)
    assert numbers["friction_work"] == pytest.approx(answer.contact.friction_work, rel=5e-3)


@pytest.fixture(scope="module")
def shipped():
    return load_surrogate("latex", "direct")


def test_a_shipped_surrogate_agrees_with_a_solved_case(shipped, shared_solutions):
    answer = sp.critical_pressure(case_of())
    found = shipped.evaluate(size_ratio=1.2, wall_ratio=1.4, friction=0.3)
    assert found.outcomes == [Outcome.MOVES]
    assert found.pressure[0] == pytest.approx(answer.pressure, rel=5e-3)
    assert abs(found.pressure[0] - answer.pressure) <= found.error[0]
    angle = float(found.quantities["contact_angle"][0])
    assert angle == pytest.approx(answer.contact.contact_angle, abs=0.01)
    leak = float(found.quantities["leak_pressure"][0])
    assert leak == pytest.approx(answer.detail.leak_pressure, rel=0.02)


def test_special_conditions_have_their_outcome(shipped):
    found = shipped.evaluate(
        size_ratio=[0.9, 1.2, 1.5, 1.7, 1.2],
        wall_ratio=1.4,
        friction=[0.3, 0.0, 1.0, 0.3, 0.3],
        confining_pressure=[0, 0, 0, 0, 11e3],
    )
    names = [each.name for each in found.outcomes]
    assert names == ["LOOSE", "MOVES", "NO_SOLUTION", "NO_SOLUTION", "NO_SOLUTION"]
    assert found.pressure[:2].tolist() == [0.0, 0.0]
    assert found.lower_bound[2] > 0.0
    assert found.lower_bound[[0, 1, 3, 4]].tolist() == [0.0] * 4
    assert found.censored.tolist() == [False, False, True, False, False]
    assert found.outside.tolist() == [False, False, True, True, True]


def test_pressures_scale_with_the_stiffness_and_lengths_do_not(shipped):
    at = {"size_ratio": [1.1, 1.3], "wall_ratio": 1.5, "friction": 0.2}
    soft, stiff = shipped.evaluate(**at), shipped.evaluate(**at, stiffness=2.0)
    for name, values in soft.quantities.items():
        factor = 2.0 if name in ("leak_pressure", "friction_work") else 1.0
        assert np.allclose(stiff.quantities[name], factor * values), name


def test_files_and_rows_hold_everything(shipped, tmp_path, capsys):
    save_surrogate(shipped, tmp_path / "own.json")
    assert load_surrogate(tmp_path / "own.json") == shipped
    command = ["surrogate", "evaluate", "latex", "--model", "direct", "--xi", "1.2", "--eta", "1.4"]
    assert run([*command, "--friction", "0.3", "--json"]) == 0
    (row,) = json.loads(capsys.readouterr().out)
    assert row["leak_pressure_kPa"] > row["critical_pressure_kPa"] > 0.0
    assert 1.0 < row["opened_radius"] < 1.2
    frame = shipped.evaluate(size_ratio=1.2, wall_ratio=1.4, friction=0.3).to_frame()
    assert {"leak_pressure_Pa", "friction_work_Pa", "opened_radius"} <= set(frame.columns)


@pytest.mark.slow
@pytest.mark.longest
@pytest.mark.parametrize(("load", "effort"), [("0 kPa", 0.15), ("4 kPa", 0.08)])
def test_a_surrogate_of_your_own_is_built_and_checked(load, effort):
    box = Box(size_ratio=1.3, wall_ratio=(1.4, 2.0), friction=(0.1, 0.6))
    built = build_surrogate(case_of(load=load), box, sp.JobSolver(), effort)
    found = check_surrogate(built, sp.JobSolver(), 24)
    assert found.cases == found.same_outcome == 24
    assert found.largest < 0.01
    at = Conditions(np.array([1.2]), np.array([1.6]), np.array([0.4]), np.array([0.5]))
    answer = sp.critical_pressure(case_at(built.case, at, 0))
    assert built.solve(at).pressure[0] == pytest.approx(answer.pressure, rel=0.005)
