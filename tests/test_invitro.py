"""In-vitro series: comparison, the friction that fits, and what a series can tell."""

import json
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest
from options import asking
from shown import check_shown

from stonepass.bench.agreement import disagreement
from stonepass.bench.comparison import SeriesSetting, compare, point_curves, size_curves
from stonepass.bench.invitro import fit_friction
from stonepass.bench.least_squares import profile_level
from stonepass.cli import run
from stonepass.errors import BadInput, Outcome
from stonepass.inputs.measured_pressures import Point
from stonepass.materials.catalogue import material
from stonepass.materials.neo_hookean import NeoHookean
from stonepass.materials.protocol import Material
from stonepass.model.answer import Answer
from stonepass.records.invitro import InVitroRecord, invitro_record
from stonepass.report.invitro_figure import invitro_figure
from stonepass.studies.case_solver import JobSolver
from stonepass.units import Pressure

EXAMPLES = Path(__file__).parents[1] / "examples"
QUICK = SeriesSetting(material("latex"), **asking(seating="frictionless", accuracy="fast"))
DRY = [(1.5, 1.1, 0.0), (1.5, 1.25, 0.0), (2.0, 1.1, 0.0), (2.0, 1.3, 0.0)]
WET = [(1.5, 1.15, 5e3), (2.0, 1.2, 5e3)]


def series(pressures, tubes, sd=None):
    return [
        Point(xi, eta, Pressure(confining), Pressure(p), None if sd is None else Pressure(sd))
        for p, (eta, xi, confining) in zip(pressures, tubes, strict=True)
    ]


@dataclass(frozen=True)
class MadeUp:
    """A solver of a formula in place of the finite elements: P = s E (ξ − 1) μ/(0.5 + μ) + P_out."""

    modulus: float = 2e5

    def answers(self, cases, *, error=True):
        return [self._answer(case) for case in cases]

    def _answer(self, case):
        asked = case.model, case.numerics
        mu, over = case.stone.friction, case.size_ratio - 1.0
        if over <= 0.0:
            return Answer(case, *asked, Outcome.LOOSE, pressure=0.0)
        saturating = mu / (0.5 * case.wall_ratio / 1.5 + mu)
        pressure = self.modulus * over * saturating + float(case.load.confining_pressure)
        return Answer(case, *asked, Outcome.MOVES, pressure=pressure)


def made_up(tubes, friction, stiffness=1.0, noise=0.0, seed=0):
    points = series([1.0] * len(tubes), tubes)
    solver = MadeUp(2e5 * stiffness)
    exact = compare(points, friction, QUICK, solver).predicted
    generator = np.random.default_rng(seed)
    return series(exact * (1.0 + noise * generator.normal(size=len(tubes))), tubes)


def test_statistics_by_hand():
    """Model 20, 40 kPa beside 18, 44: bias −1, RMSE √((4 + 16)/2), R² 1 − 20/338."""
    points = series([18e3, 44e3], [(1.5, 1.1, 0.0), (1.5, 1.2, 0.0)])
    comparison = compare(points, 0.5, QUICK, MadeUp(4e5))
    np.testing.assert_allclose(comparison.predicted, [20e3, 40e3])
    assert comparison.bias == pytest.approx(-1e3)
    assert comparison.rmse == pytest.approx(1e3 * np.sqrt(10.0))
    assert comparison.r_squared == pytest.approx(1.0 - 20.0 / 338.0)


def test_a_point_without_an_answer_is_counted_not_averaged():
    points = series([18e3, 44e3], [(1.5, 1.1, 0.0), (1.5, 1.2, 0.0)])
    found = compare(points, 0.5, QUICK, MadeUp(4e5))
    lost = replace(found.answers[1], outcome=Outcome.BEYOND_CLOSURE, pressure=None)
    found = replace(found, answers=(found.answers[0], lost))
    assert (found.compared, found.bias) == (1, pytest.approx(2e3))
    assert found.not_compared == {"BEYOND_CLOSURE": 1}
    assert found.r_squared is None


def test_friction_and_stiffness_come_back_from_a_formula():
    points = made_up([*DRY, *WET], 0.35, stiffness=1.3)
    found = fit_friction(points, QUICK, solver=MadeUp())
    check_shown(found, "size_ratio", "measured_kPa", "critical_pressure_kPa")
    assert found.joint.friction.value == pytest.approx(0.35, rel=1e-3)
    assert found.joint.stiffness.value == pytest.approx(1.3, rel=1e-3)
    assert found.friction.value > 0.4


@pytest.mark.slow  # the same fit with a formula in place of the elements is in the fast tests
def test_friction_and_stiffness_come_back_through_the_finite_elements(tmp_path):
    """A wall of 1.3 times the modulus, dry and under water, against the material's own stiffness."""
    stiff = Material("stiff", NeoHookean(1.3 * 0.1465e6), "", "", "", (1.0, 1.5))
    tubes, solver = [*DRY[:3], WET[0]], JobSolver(cache_folder=tmp_path)
    blank = series([1.0] * len(tubes), tubes)
    measured = compare(blank, 0.35, replace(QUICK, material=stiff), solver).predicted
    found = fit_friction(series(measured, tubes), QUICK, solver=solver)
    assert found.joint is not None
    assert found.joint.friction.value == pytest.approx(0.35, rel=4e-3)
    assert found.joint.stiffness.value == pytest.approx(1.3, rel=4e-3)
    assert found.joint.correlation < -0.8
    assert found.friction.value > 0.4  # alone, friction has to make up for the stiffness
    record = invitro_record(found, "a.csv")
    assert record.joint.stiffness.value == found.joint.stiffness.value
    exact = compare(blank, 0.35, QUICK, solver).predicted
    own = fit_friction(series(exact, tubes), QUICK, solver=solver)
    assert own.friction.value == pytest.approx(0.35, rel=1e-3)
    assert own.fitted.rmse < 2e-3 * float(np.mean(own.fitted.measured))


@pytest.mark.slow
def test_friction_intervals_cover_as_often_as_they_say():
    tubes = [*DRY, *DRY, *WET]
    covered = 0
    for seed in range(20):
        found = fit_friction(made_up(tubes, 0.3, noise=0.05, seed=seed), QUICK, solver=MadeUp())
        covered += found.friction.low <= 0.3 <= found.friction.high
    assert 17 <= covered <= 20  # of 19 expected


def test_one_size_alone_cannot_tell_stiffness_from_friction():
    """Each friction has a stiffness that fits as well: the interval is open, and that is said."""
    tubes = [(1.5, 1.2, 0.0)] * 5
    found = fit_friction(made_up(tubes, 0.3, noise=0.05), QUICK, solver=MadeUp())
    assert found.friction.low < 0.3 < found.friction.high
    joint = found.joint
    assert joint is not None
    assert None in (joint.friction.low, joint.friction.high)
    for friction in (0.2, 0.4, 0.8):  # P ∝ s μ/(0.5 + μ) is the same
        same = (0.3 / 0.8) * (0.5 + friction) / friction
        assert joint.misfit(np.array(friction), np.array(same)) < joint.level
    assert any("if stiffness is fitted too" in str(sentence) for sentence in found.warnings)


def test_weights_and_what_is_refused():
    points = made_up(DRY, 0.3)
    spoilt = [replace(points[0], pressure=Pressure(3.0 * points[0].pressure)), *points[1:]]
    weighted = [replace(p, sd=Pressure(1e5 if k == 0 else 1e2)) for k, p in enumerate(spoilt)]
    found = fit_friction(weighted, QUICK, solver=MadeUp())
    assert found.weighted
    assert found.friction.value == pytest.approx(0.3, rel=1e-2)
    assert abs(fit_friction(spoilt, QUICK, solver=MadeUp()).friction.value - 0.3) > 0.02
    with pytest.raises(BadInput, match=r"sd_kPa is 0\.0, but must be above 0"):
        fit_friction([replace(p, sd=Pressure(0.0)) for p in points], QUICK, solver=MadeUp())
    with pytest.raises(
        BadInput, match="points for which the model predicts a critical pressure is 1, but must be"
    ):
        fit_friction(points[:1], QUICK, solver=MadeUp())


def test_loose_stones_say_nothing_of_friction():
    """With them the estimate, its interval and the joint fit are the same."""
    points = made_up([*DRY, *WET], 0.3, noise=0.05)
    loose = series([1.0, 2.0, 3.0], [(1.5, 0.9, 0.0), (1.5, 0.8, 0.0), (2.0, 0.95, 0.0)])
    alone = fit_friction(points, QUICK, solver=MadeUp())
    found = fit_friction([*points, *loose], QUICK, solver=MadeUp())
    assert found.joint.friction == alone.joint.friction
    assert found.friction.low == pytest.approx(alone.friction.low, rel=1e-6)
    assert found.fitted.not_compared == {"LOOSE": 3}
    assert found.fitted.r_squared == pytest.approx(alone.fitted.r_squared)
    assert any("3 of 9 stones are no larger than the lumen" in str(told) for told in found.warnings)


def test_joint_intervals_are_profiles():
    """Each end is where the misfit, the other parameter at its best, reaches its level."""
    found = fit_friction(made_up([*DRY, *DRY, *WET], 0.3, noise=0.03), QUICK, solver=MadeUp())
    joint, grid = found.joint, np.geomspace(1.0 / 3.0, 3.0, 20_001)
    level = profile_level(10 - 2)
    ends = [end for end in (joint.friction.low, joint.friction.high) if end is not None]
    assert ends
    for end in ends:
        assert np.min(joint.misfit(np.array(end), grid)) == pytest.approx(level, rel=1e-3)


def test_no_friction_meets_a_series_far_above_the_wall():
    points = made_up(DRY, 1.0, stiffness=20.0)
    found = fit_friction(points, QUICK, solver=MadeUp())
    assert any(
        "no friction coefficient makes the model agree" in str(sentence)
        for sentence in found.warnings
    )
    assert found.friction.high is None


def test_the_record_is_whole():
    record = invitro_record(
        fit_friction(made_up(DRY, 0.3, noise=0.02), QUICK, solver=MadeUp()), "a.csv"
    )
    assert record.joint is not None
    assert InVitroRecord.model_validate(json.loads(json.dumps(record.to_dict()))) == record


def test_command(tmp_path, capsys):
    out, figure = tmp_path / "points.csv", tmp_path / "series.svg"
    data = tmp_path / "series.csv"
    lines = (EXAMPLES / "latex_series.csv").read_text(encoding="utf-8").splitlines()
    data.write_text("\n".join(lines[:5]), encoding="utf-8")
    arguments = ["invitro", str(data), "--material", "latex", "--seating", "frictionless",
                 "--cache", str(tmp_path), "--workers", "1", "--friction", "0.475"]  # fmt: skip
    code = run([*arguments, "--json", "--out", str(out), "--figure", str(figure)])
    record = json.loads(capsys.readouterr().out)
    assert code == 0
    assert record["friction"] == 0.475
    assert record["compared"] == len(record["points"]) == 4
    low, high = (record["fitted_friction"][name] for name in ("low", "high"))
    assert low < record["fitted_friction"]["value"] < high
    assert record["r_squared"] > 0.95
    assert len(out.read_text().splitlines()) == 5
    assert "<svg" in figure.read_text()
    assert run([*arguments, "--material", "latexx"]) == 2
    assert "did you mean 'latex'" in capsys.readouterr().err


def test_figure_shows_every_point_and_curve():
    points = made_up([*DRY, *WET], 0.3, noise=0.02)
    found = fit_friction(points, QUICK, solver=MadeUp())
    curves = size_curves(found.comparison, QUICK, MadeUp())
    assert [(c.wall_ratio, c.confining_pressure) for c in curves] == [(1.5, 0.0), (2.0, 0.0)]
    series_axes, region = invitro_figure(found, curves).axes[:2]
    marks = sum(len(c.lines[0].get_xdata()) for c in series_axes.containers)
    assert marks == len(points)
    assert region.get_xlabel() == "friction μ"


def test_the_figure_of_a_result_shows_the_model_at_the_measured_sizes():
    points = made_up([*DRY, *WET], 0.3, noise=0.02)
    found = fit_friction(points, QUICK, solver=MadeUp())
    curves = point_curves(found.comparison)
    answers = {a.case: a.pressure for a in found.comparison.answers}
    assert sum(len(curve.size_ratio) for curve in curves) >= 4
    for curve in curves:
        assert np.all(np.diff(curve.size_ratio) > 0.0)
        assert set(curve.pressure) <= set(answers.values())
    drawn = [line.get_xydata() for line in found.figure().axes[0].lines]
    for curve in curves:
        expected = np.column_stack([curve.size_ratio, curve.pressure / 1e3])
        assert any(np.array_equal(line, expected) for line in drawn)


def with_sd(points, share):
    return [replace(each, sd=Pressure(share * each.pressure)) for each in points]


def test_a_wall_that_the_series_excludes_is_told_first():
    """A wall of 1.5 times the stiffness: friction alone makes up for it, the joint fit does not."""
    found = fit_friction(
        with_sd(made_up([*DRY, *WET], 0.3, stiffness=1.5, noise=0.02), 0.02), QUICK, solver=MadeUp()
    )
    codes = [each.code for each in found.warnings]
    assert codes[0] == "stiffness_excluded"
    told = dict(found.warnings[0].values)
    assert told["stiffness"] == pytest.approx(1.5, rel=0.15)
    assert told["jointly"] == pytest.approx(0.3, rel=0.25)
    assert told["friction"] == found.friction.value
    own = fit_friction(
        with_sd(made_up([*DRY, *WET], 0.3, noise=0.02), 0.02), QUICK, solver=MadeUp()
    )
    assert own.objections == ()


def test_residuals_of_six_standard_deviations_by_hand():
    """Model 20, 40 kPa beside 18, 44 with 0.5 kPa each: 4 and 8 deviations, χ² 80 of 2."""
    points = series([18e3, 44e3], [(1.5, 1.1, 0.0), (1.5, 1.2, 0.0)], sd=500.0)
    comparison = compare(points, 0.5, QUICK, MadeUp(4e5))
    (told,) = disagreement(comparison, 0)
    assert dict(told.values) == pytest.approx(
        {"typical": 40.0**0.5, "largest": 8.0, "friction": 0.5}
    )
    wide = series([18e3, 44e3], [(1.5, 1.1, 0.0), (1.5, 1.2, 0.0)], sd=3e3)
    assert disagreement(compare(wide, 0.5, QUICK, MadeUp(4e5)), 0) == []


def test_repeated_points_tell_the_error_of_a_series():
    """Means are missed by 2 and 4 kPa, repeats scatter by 0.1: F = (20 · 2/2)/(0.02 · 2/2)."""
    tubes = [(1.5, 1.1, 0.0), (1.5, 1.2, 0.0)] * 2
    near = compare(series([17.9e3, 43.9e3, 18.1e3, 44.1e3], tubes), 0.5, QUICK, MadeUp(4e5))
    (told,) = disagreement(near, 0)
    assert told.code == "beyond_repeats"
    assert dict(told.values)["off_kPa"] == pytest.approx(10.0**0.5)
    assert dict(told.values)["scatter_kPa"] == pytest.approx(0.02**0.5)
    far = compare(series([15e3, 38e3, 21e3, 47e3], tubes), 0.5, QUICK, MadeUp(4e5))
    assert disagreement(far, 0) == []


def test_false_alarms_of_a_series_are_rare():
    """1 % of χ²; the joint interval of 95 % excludes the true stiffness in 5 %."""
    told = {"beyond_sd": 0, "stiffness_excluded": 0}
    for seed in range(12):
        points = with_sd(made_up([*DRY, *WET], 0.3, noise=0.03, seed=seed), 0.03)
        for each in fit_friction(points, QUICK, solver=MadeUp()).objections:
            told[each.code] += 1
    assert told["beyond_sd"] <= 1
    assert told["stiffness_excluded"] <= 3


def test_the_command_says_first_what_does_not_hold(tmp_path, capsys):
    data = tmp_path / "series.csv"
    lines = (EXAMPLES / "latex_series.csv").read_text(encoding="utf-8").splitlines()[:5]
    stiffer = [lines[0]]
    for line in lines[1:]:
        xi, eta, out, pressure, sd = line.split(",")
        stiffer.append(f"{xi},{eta},{out},{2.0 * float(pressure)},{sd}")
    data.write_text("\n".join(stiffer), encoding="utf-8")
    arguments = ["invitro", str(data), "--material", "latex", "--seating", "frictionless",
                 "--workers", "1", "--friction", "0.475"]  # fmt: skip
    run(arguments)
    shown = capsys.readouterr().out
    assert shown.startswith("The fit cannot be used: series and model disagree: with friction")
    run([*arguments, "--json"])
    record = json.loads(capsys.readouterr().out)
    assert record["holds"] is False
    assert record["warnings"][0]["code"] == "beyond_sd"
