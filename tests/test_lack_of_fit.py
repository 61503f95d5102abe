"""Lack of fit: every mistake of a test is told by name, and data that obey the law raise no alarm."""

from dataclasses import replace

import numpy as np
import pytest

from stonepass.bench.branches import branches
from stonepass.bench.lack_of_fit import lack_of_fit
from stonepass.bench.law_fit import fit_law
from stonepass.bench.test_data import Inflation, Tension
from stonepass.materials.mooney_rivlin import MooneyRivlin
from stonepass.materials.neo_hookean import NeoHookean
from stonepass.model.far_field import inflation

RUBBER = NeoHookean(146.5e3)
NOISE = 0.01  # of the largest stress
STRETCH = np.linspace(1.02, 1.5, 20)
LOOP = np.concatenate([np.linspace(1.02, 1.5, 12), np.linspace(1.46, 1.02, 11)])


def shape(stretch):
    return 2.0 * (stretch - stretch**-2)


def strips(stretch, stress, seed=0, noise=NOISE):
    generator = np.random.default_rng(seed)
    noisy = stress + noise * np.abs(stress).max() * generator.normal(size=len(stretch))
    return Tension(stretch, noisy, ("axial",) * len(stretch), tuple(range(2, 2 + len(stretch))))


def cautions(data):
    """Of a neo-Hookean fit, whose constant and sensitivity are those of a straight line."""
    x = shape(data.stretch)
    C10 = float(x @ data.stress / (x @ x))
    spread = np.full(len(x), np.abs(data.stress).max())
    off = (C10 * x - data.stress) / spread
    return lack_of_fit(data, NeoHookean(C10), off, (C10 * x / spread)[:, None], spread)


@pytest.mark.parametrize("stretch", [STRETCH, STRETCH[::4], LOOP, np.tile(STRETCH[::2], 2)])
def test_data_that_obey_the_law_raise_no_alarm(stretch):
    """2 % of series are meant to; of 50, five or more would come by chance 3 times in 1000."""
    stress = RUBBER.C10 * shape(stretch)
    assert sum(bool(cautions(strips(stretch, stress, seed))) for seed in range(50)) <= 4


def toe(stretch):
    return np.maximum(shape(np.maximum(stretch / 1.05, 1.0)), 0.0)


def loop(share):
    return shape(LOOP) * np.where(np.arange(len(LOOP)) < 12, 1.0, 1.0 - share)


def cycles():
    return np.concatenate([shape(STRETCH[::2]) * factor for factor in (1.0, 0.93, 0.93)])


@pytest.mark.parametrize(
    ("stretch", "stress", "code", "value", "true", "within"),
    [
        (STRETCH, shape(STRETCH) + 0.08, "zero_offset", "offset_kPa", 0.08 * 146.5, 7.0),
        (1.02 * STRETCH, shape(STRETCH), "rest_size", "part", -0.02, 0.012),
        (STRETCH / 1.05, shape(STRETCH), "rest_size", "part", 0.05, 0.025),
        (STRETCH, toe(STRETCH), "slack", "stretch", 1.05, 0.021),
        (LOOP, loop(0.1), "hysteresis", "share", 0.1, 0.04),
        (np.tile(STRETCH[::2], 3), cycles(), "runs_differ", "share", 0.07, 0.03),
    ],
)
def test_mistakes_are_told_by_name(stretch, stress, code, value, true, within):
    """Each in at least nine of ten series, with its size."""
    found = []
    for seed in range(10):
        told = cautions(strips(stretch, RUBBER.C10 * stress, seed))
        found += [dict(each.values)[value] for each in told if each.code == code]
    assert len(found) >= 9
    assert np.median(found) == pytest.approx(true, abs=within)


def test_an_outlier_is_told_by_its_row_and_not_as_another_mistake():
    data = strips(STRETCH, RUBBER.C10 * shape(STRETCH))
    stress = data.stress.copy()
    stress[7] += 10.0 * NOISE * stress.max()
    (told,) = cautions(replace(data, stress=stress))
    assert told.code == "outlier"
    assert dict(told.values)["row"] == "row 9"
    assert dict(told.values)["off_kPa"] == pytest.approx(10.0 * NOISE * 310.0, rel=0.35)


def test_another_law_is_told_as_a_misfit():
    """Mooney–Rivlin strips with the neo-Hookean law: the shape is wrong, no mistake explains it."""
    law = MooneyRivlin(5e4, 1e5)
    blank = Tension(STRETCH, STRETCH, ("axial",) * len(STRETCH))
    told = [cautions(strips(STRETCH, blank.predicted(law), seed)) for seed in range(10)]
    named = [{each.code for each in some} & {"lack_of_fit", "slack"} for some in told]
    assert sum(bool(each) for each in named) == 10
    assert sum("lack_of_fit" in each for each in named) >= 6


def test_errors_that_go_on_from_point_to_point_are_told():
    """First-order autoregression with correlation 0.8 of 60 points."""
    stretch, told = np.linspace(1.02, 1.5, 60), 0
    for seed in range(10):
        z = np.random.default_rng(seed).normal(size=60)
        for k in range(1, 60):
            z[k] = 0.8 * z[k - 1] + 0.6 * z[k]
        stress = RUBBER.C10 * shape(stretch)
        data = strips(stretch, stress + NOISE * stress.max() * z, noise=0.0)
        told += bool(cautions(data))
    assert told >= 9


def test_what_a_caution_says_stands_before_the_numbers_and_marks_the_intervals():
    data = strips(LOOP, RUBBER.C10 * loop(0.1))
    found = fit_law(data, "neo-hookean")
    assert found.warnings[0].code == "hysteresis"
    assert found.approximate
    assert not fit_law(strips(STRETCH, RUBBER.C10 * shape(STRETCH)), "neo-hookean").approximate


def test_an_axial_stretch_of_a_tube_that_was_not_told():
    ratio = np.linspace(1.03, 1.4, 15)
    pressure = inflation(ratio, 1.3, RUBBER, 1.15)
    noisy = pressure + NOISE * pressure.max() * np.random.default_rng(2).normal(size=15)
    found = fit_law(Inflation(ratio, noisy, 1.3, np.ones(15)), "neo-hookean")
    told = {each.code: dict(each.values) for each in found.warnings}
    assert told["axial_rest_length"]["part"] == pytest.approx(0.15, abs=0.08)


def test_impossible_amounts_are_not_offered():
    """Pressures at 1.3 to 1.7 times the diameter, as if from outer diameters: no size is −146 %."""
    ratio = np.array([1.32, 1.389, 1.457, 1.523, 1.591, 1.66, 1.729, 1.714])
    pressure = 1e3 * np.array([5.6, 15, 24, 31, 38, 44, 50, 56])
    found = fit_law(Inflation(ratio, pressure, 1.3, np.ones(8)), "neo-hookean")
    assert found.warnings
    for each in found.warnings:
        values = dict(each.values)
        assert 5e-5 <= abs(values.get("part", 0.1)) <= 0.3
        assert abs(values.get("offset_kPa", 0.0)) <= 56.0


def test_residuals_that_are_rounding_are_not_looked_at():
    stress = RUBBER.C10 * shape(STRETCH)
    assert cautions(strips(STRETCH, np.round(stress, -1), noise=0.0)) == []


def test_branches_by_hand():
    """Up, down and up again; then two strips, one after the other."""
    up, down = [1.0, 1.1, 1.2, 1.3], [1.2, 1.1, 1.0]
    found = branches(strips(np.array([*up, *down, 1.1, 1.2, 1.3]), np.ones(10)))
    assert list(found.loading) == [1] * 4 + [-1] * 3 + [1] * 3
    assert list(found.run) == [0] * 7 + [1] * 3
    found = branches(strips(np.array(up + up), np.ones(8)))
    assert list(found.loading) == [1] * 8
    assert list(found.run) == [0] * 4 + [1] * 4


def test_one_outlier_is_no_offset_and_no_wrong_size_at_rest():
    """A single point makes the residuals appear to grow with the stress."""
    stretch = np.linspace(1.0, 1.5, 11)
    for seed in range(8):
        noise = np.random.default_rng(seed).normal(0.0, 0.5e3, 11)
        stress = 2.0 * 150e3 * (stretch - stretch**-2) + noise
        stress[7] *= 1.3
        found = fit_law(Tension(stretch, stress, ("axial",) * 11), "neo-hookean")
        assert "outlier" in {each.code for each in found.warnings}
        assert not {each.code for each in found.warnings} & {"zero_offset", "rest_size"}


def test_a_strip_that_carries_half_of_its_load_is_not_slack():
    stretch = np.array([1.0, 1.1, 1.2, 1.0, 1.1, 1.2])
    stress = 1e3 * np.array([0.0, 20.0, 42.0, 0.0, 20.4, 41.5])
    found = fit_law(Tension(stretch, stress, ("axial",) * 6), "neo-hookean")
    assert "slack" not in {each.code for each in found.warnings}
