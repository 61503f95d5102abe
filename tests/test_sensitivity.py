"""Sensitivity to uncertain inputs: exact indices, missing answers, tornado, text, study files."""

import csv
import dataclasses
import doctest
import io
import json
import re
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

import stonepass as sp
from stonepass.cli import run
from stonepass.errors import BadInput, Outcome
from stonepass.studies.sampling import sobol_points
from stonepass.studies.sensitivity.conclusions import conclusions
from stonepass.studies.sensitivity.estimate import Gap, Response
from stonepass.studies.sensitivity.evaluator import BAD_INPUT, OUTCOMES, evaluations, outcome_name
from stonepass.studies.sensitivity.interpolated_cases import InterpolatedCases
from stonepass.studies.sensitivity.morris import morris_design, morris_sensitivities
from stonepass.studies.sensitivity.responses import ANSWERED, responses
from stonepass.studies.sensitivity.sensitivity import sensitivity
from stonepass.studies.sensitivity.sobol import saltelli_design, sobol_sensitivities
from stonepass.studies.sensitivity.solved_cases import CaseEvaluator
from stonepass.studies.sensitivity.study import SensitivityStudy
from stonepass.studies.sensitivity.study_file import read_sensitivity
from stonepass.studies.sensitivity.surrogate_cases import SurrogateCases
from stonepass.studies.sensitivity.swept_cases import swept_cases
from stonepass.studies.sensitivity.uncertain_case import uncertain_case
from stonepass.studies.uncertain_quantity import UncertainQuantity

ROOT = Path(__file__).parents[1]
ANY = Response("any", "the response", "kPa")
# Ishigami and Homma 1990, a = 7, b = 0.1: first-order, total and second-order indices follow from
# the variances V₁ = (1 + bπ⁴/5)²/2, V₂ = a²/8, V₁₃ = b²π⁸ 8/225.
A, B = 7.0, 0.1
V1, V2, V13 = (1 + B * np.pi**4 / 5) ** 2 / 2, A**2 / 8, 8 * B**2 * np.pi**8 / 225
V = V1 + V2 + V13
ISHIGAMI = {
    "first": {"x1": V1 / V, "x2": V2 / V, "x3": 0.0},
    "total": {"x1": (V1 + V13) / V, "x2": V2 / V, "x3": V13 / V},
    "second": {("x1", "x2"): 0.0, ("x1", "x3"): V13 / V, ("x2", "x3"): 0.0},
}
UNIFORM = UncertainQuantity(0.0, None, -np.pi, np.pi)


def ishigami(x1, x2, x3):
    return np.sin(x1) + A * np.sin(x2) ** 2 + B * x3**4 * np.sin(x1)


def sobol_of(function, quantities, samples=1024, seed=1):
    design = saltelli_design(quantities, samples, seed)
    values = np.ma.MaskedArray(function(*design.values()))
    return sobol_sensitivities(quantities, ANY, values, seed)


def estimates(found):
    """All estimates by (order, key)."""
    first = {("first", each.key): each.first for each in found.inputs}
    total = {("total", each.key): each.total for each in found.inputs}
    return first | total | {("second", each.keys): each.second for each in found.interactions}


def missed(found, known):
    """The known indices outside their confidence intervals."""
    exact = {(order, key): value for order, each in known.items() for key, value in each.items()}
    shown = estimates(found)
    assert exact.keys() == shown.keys()
    return [at for at, value in exact.items() if not shown[at].low <= value <= shown[at].high]


# --- exact indices


def test_ishigami_has_its_known_indices():
    quantities = dict.fromkeys(("x1", "x2", "x3"), UNIFORM)
    found = sobol_of(ishigami, quantities)
    assert missed(found, ISHIGAMI) == []
    assert [each.key for each in found.inputs] == ["x1", "x2", "x3"]
    assert found.interactions[0].keys == ("x1", "x3")
    assert max(each.half_width for each in estimates(found).values()) < 0.2


def test_wrong_indices_would_be_found():
    quantities = dict.fromkeys(("x1", "x2", "x3"), UNIFORM)
    found = sobol_of(ishigami, quantities)
    first, total = ISHIGAMI["first"], ISHIGAMI["total"]
    swapped = ISHIGAMI | {"first": total, "total": first}
    assert ("first", "x3") in missed(found, swapped)
    assert ("total", "x3") in missed(found, swapped)
    second = {("x1", "x2"): V13 / V, ("x1", "x3"): 0.0, ("x2", "x3"): 0.0}
    assert len(missed(found, ISHIGAMI | {"second": second})) == 2


def test_a_linear_model_has_the_variances_of_its_terms():
    quantities = {
        "a": UncertainQuantity(0.0, 1.0, -10.0, 10.0),
        "b": UncertainQuantity(0.0, 2.0, -20.0, 20.0),
        "c": UncertainQuantity(5.0, 0.5, 0.0, 10.0),
    }
    found = sobol_of(lambda a, b, c: 3.0 * a + b - 2.0 * c, quantities, samples=2048)
    parts = {"a": 9.0 / 14.0, "b": 4.0 / 14.0, "c": 1.0 / 14.0}
    none = dict.fromkeys([("a", "b"), ("a", "c"), ("b", "c")], 0.0)
    assert missed(found, {"first": parts, "total": parts, "second": none}) == []
    assert missed(found, {"first": dict(zip("abc", parts.values(), strict=True)) | {"a": 0.5},
                          "total": parts, "second": none}) == [("first", "a")]  # fmt: skip


def test_nineteen_of_twenty_intervals_cover_the_known_index():
    """At least 85 % of 120 intervals, which 95 % intervals do with near certainty."""
    quantities = {
        "a": UncertainQuantity(0.0, 1.0, -9.0, 9.0),
        "b": UncertainQuantity(0.0, 1.0, -9.0, 9.0),
    }
    known = {"a": 0.5, "b": 0.5}
    lost = 0
    for seed in range(30):
        found = sobol_of(lambda a, b: a + b, quantities, samples=128, seed=seed)
        assert len(found.inputs) == 2
        lost += len(missed(found, {"first": known, "total": known, "second": {("a", "b"): 0.0}}))
    assert lost <= 0.15 * 30 * 5


def test_elementary_effects_of_a_linear_model_are_its_slopes():
    quantities = {
        "a": UncertainQuantity(0.5, None, 0.0, 1.0),
        "b": UncertainQuantity(5.0, None, 0.0, 10.0),
    }
    design = morris_design(quantities, 10, 3)
    values = np.ma.MaskedArray(7.0 * design["a"] - 0.2 * design["b"])
    found = morris_sensitivities(quantities, ANY, values, 3)
    effects = {each.key: each for each in found.inputs}
    # Each input moves over 90 % of its range between the two quantiles.
    assert effects["a"].mean == pytest.approx(0.9 * 7.0)
    assert effects["b"].mean == pytest.approx(-0.9 * 2.0)
    assert effects["b"].mean_absolute.value == pytest.approx(1.8)
    assert max(each.spread for each in effects.values()) < 1e-9
    assert [each.key for each in found.inputs] == ["a", "b"]


# --- missing answers


def test_groups_with_a_missing_member_are_dropped_and_counted():
    quantities = dict.fromkeys(("x1", "x2", "x3"), UNIFORM)
    design = saltelli_design(quantities, 64, 1)
    values = np.ma.MaskedArray(ishigami(*design.values()))
    complete = sobol_sensitivities(quantities, ANY, values.copy(), 1)
    values[8 * 5 + 3] = np.ma.masked
    values[8 * 40 : 8 * 42] = np.ma.masked
    found = sobol_sensitivities(quantities, ANY, values, 1)
    assert (found.groups, found.dropped, found.gap) == (64, 3, None)
    assert found.inputs != complete.inputs
    kept = np.ones(64, dtype=bool)
    kept[[5, 40, 41]] = False
    alone = sobol_sensitivities(quantities, ANY, values.reshape(64, 8)[kept].ravel(), 1)
    assert found.inputs == alone.inputs


def test_too_few_complete_groups_have_no_indices():
    quantities = dict.fromkeys(("x1", "x2"), UNIFORM)
    values = np.ma.MaskedArray(np.arange(6.0 * 64), np.arange(6 * 64) < 6 * 40)
    found = sobol_sensitivities(quantities, ANY, values, 1)
    assert (found.inputs, found.gap, found.dropped) == ((), Gap.INCOMPLETE, 40)
    trajectories = np.ma.MaskedArray(np.arange(30.0), np.arange(30) < 24)
    assert morris_sensitivities(quantities, ANY, trajectories, 1).gap is Gap.INCOMPLETE


def test_a_constant_or_rare_response_has_no_indices():
    quantities = dict.fromkeys(("x1", "x2"), UNIFORM)
    values = np.ma.MaskedArray(np.ones(6 * 64))
    assert sobol_sensitivities(quantities, ANY, values, 1).gap is Gap.CONSTANT
    values[0] = 0.0
    rare = dataclasses.replace(ANY, yes_or_no=True)
    assert sobol_sensitivities(quantities, rare, values, 1).gap is Gap.RARE
    values[: 6 * 32 : 6] = 0.0
    assert sobol_sensitivities(quantities, rare, values, 1).gap is None


def test_every_outcome_has_its_place_in_the_responses():
    found = evaluations(
        [Outcome.MOVES, Outcome.LOOSE, Outcome.BEYOND_CLOSURE, Outcome.LEAKS, Outcome.NO_SOLUTION, None,
         Outcome.BEYOND_CLOSURE],
        [4e3, 0.0, None, None, None, None, None],
        [None, None, 9e3, 3e3, None, None, 5e3],
        "impossible",
    )  # fmt: skip
    assert found.outcome[5] == BAD_INPUT
    assert OUTCOMES[found.outcome[3]] is Outcome.LEAKS
    by_name = {each.name: values for each, values in responses(found, 6e3)}
    none = None
    assert by_name["pressure"].tolist() == [4.0, 0.0, none, none, none, none, none]
    # Known values and bounds, sorted: 0, 3, 4, 5, 9 kPa.
    assert by_name["rank"].tolist() == pytest.approx([0.4, 0.0, 0.8, 0.2, none, none, 0.6])
    # A leak below the limit means that the stone does not move; a bound below it leaves this open.
    assert by_name["moves"].tolist() == [1.0, 1.0, 0.0, 0.0, none, none, none]
    assert by_name["answered"].tolist() == [1.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0]
    assert "moves" not in {each.name for each, _ in responses(found, None)}


# --- a real model: the beam, which takes a millisecond

BEAM = sp.ElasticFoundation("0.4 MPa", "0.02 MPa")
CASE = sp.Case(sp.Stone("3.8 mm"), sp.Ureter("3.5 mm", "4.5 mm"), model=BEAM)
UNCERTAIN = {
    "stone.friction": "0.1 to 0.5",
    "stone.diameter": "3.8 mm ± 0.05 mm",
    "method.circumferential_modulus": "0.4 MPa ± 1 %",
}


@pytest.fixture(scope="module")
def beam():
    study = SensitivityStudy(uncertain_case(CASE, UNCERTAIN), limit="4 kPa", samples=32)
    return sensitivity(study, progress=False)


def test_the_beam_is_ranked_and_its_text_says_so(beam):
    assert beam.outcomes == (("MOVES", 1.0),)
    assert beam.evaluated == 32 * 8
    assert beam.main.inputs[0].key == "stone.friction"
    text = " ".join(conclusions(beam))
    assert "The friction matters most for the critical pressure: it takes part in " in text
    assert "The circumferential modulus does not matter for the critical pressure" in text
    assert "The critical pressure is known in all of them." in text
    assert "NaN" not in text
    assert "nan" not in text.split()


def test_the_tornado_is_the_model_itself(beam):
    bars = {bar.key: bar for bar in beam.pressures.bars}
    median = sp.Case(sp.Stone("3.8 mm", 0.3), sp.Ureter("3.5 mm", "4.5 mm"), model=BEAM)
    assert beam.pressures.centre.value == pytest.approx(sp.solve(median).pressure_kPa)
    low = median.with_friction(0.12)
    assert bars["stone.friction"].low.value == pytest.approx(sp.solve(low).pressure_kPa)
    assert bars["stone.friction"].low.input == pytest.approx(0.12)
    assert beam.sizes.unit == "mm"
    assert beam.sizes.centre.value == pytest.approx(sp.critical_size(median, "4 kPa").diameter_mm)
    of_size = {bar.key: bar for bar in beam.sizes.bars}
    assert of_size.keys() == {"stone.friction", "method.circumferential_modulus"}
    found = sp.critical_size(low, "4 kPa").diameter_mm
    assert of_size["stone.friction"].low.value == pytest.approx(found)
    spans = [bar.span for bar in beam.pressures.bars]
    assert spans == sorted(spans, reverse=True)


def test_the_critical_size_follows_an_uncertain_inner_diameter():
    uncertain = {"ureter.inner_diameter": "3.4 mm to 3.6 mm", "stone.diameter": "3.7 mm to 3.9 mm"}
    study = SensitivityStudy(uncertain_case(CASE, uncertain), limit="4 kPa", samples=32)
    found = sensitivity(study, progress=False)
    end = found.sizes.bars[0].high
    assert end.input == pytest.approx(3.59e-3)
    wide = sp.Case(sp.Stone("3.8 mm"), sp.Ureter("3.59 mm", "4.5 mm"), model=BEAM)
    assert end.value == pytest.approx(sp.critical_size(wide, "4 kPa").diameter_mm)
    assert [bar.key for bar in found.sizes.bars] == ["ureter.inner_diameter"]


def test_refused_cases_are_counted_with_their_reason():
    """The beam refuses walls thicker than η = 1.5, and some samples have one."""
    uncertain = {"ureter.outer_diameter": "5 mm to 5.3 mm", "stone.friction": "0.1 to 0.5"}
    study = SensitivityStudy(uncertain_case(CASE, uncertain), samples=64)
    found = sensitivity(study, progress=False)
    outcomes = dict(found.outcomes)
    # 5.25 mm is the largest outer diameter.
    assert outcomes["BAD_INPUT"] == pytest.approx(1.0 / 6.0, abs=0.02)
    told = {each.code: dict(each.values) for each in found.warnings}
    assert "at most 1.5" in told["cases_refused"]["reason"]
    assert told["groups_dropped"]["dropped"] == found.responses[0].dropped > 10
    answered = found.response("answered")
    assert answered.inputs[0].key == "ureter.outer_diameter"
    assert answered.inputs[0].total.low <= 1.0 <= answered.inputs[0].total.high
    assert answered.inputs[1].total.value == 0.0
    text = " ".join(conclusions(found))
    assert "the order of the inputs is that of its rank" in text
    assert "The outer diameter matters most for the outcome that a critical pressure exists" in text


def test_the_same_seed_gives_the_same_result(beam):
    again = sensitivity(beam.study, progress=False)
    assert again == beam
    quantities = beam.study.uncertain.quantities
    one, other = (saltelli_design(quantities, 32, seed)["stone.friction"] for seed in (1, 2))
    assert not np.any(one == other)


def test_any_function_can_be_evaluated():
    """Ishigami's function in the place of a model, through the whole study."""

    class Function:
        source = "a function"

        def __call__(self, inputs):
            unit = [(values - q.low) / (q.high - q.low) for values, q in
                    zip(inputs.values(), study.uncertain.quantities.values(), strict=True)]  # fmt: skip
            values = 1e3 * ishigami(*(np.pi * (2.0 * each - 1.0) for each in unit))
            return evaluations([Outcome.MOVES] * len(values), values.tolist(), [None] * len(values))

        def critical_sizes(self, inputs, limit):
            raise AssertionError("no limit was given")

    uncertain = {
        "stone.friction": "0 to 2",
        "stone.size_ratio": "1 to 1.2",
        "load.prestretch": "0.9 to 1.1",
    }
    case = sp.Case(sp.Stone(size_ratio=1.1), sp.Ureter(wall_ratio=1.3))
    study = SensitivityStudy(uncertain_case(case, uncertain), method="sobol", samples=1024)
    found = sensitivity(study, Function())
    names = dict(zip(uncertain, ("x1", "x2", "x3"), strict=True))
    main = found.main
    for each in main.inputs:
        known = ISHIGAMI["total"][names[each.key]]
        assert each.total.low <= known <= each.total.high
    assert found.pressures.centre.value == pytest.approx(0.0, abs=1e-12)
    text = " ".join(conclusions(found))
    assert "The largest interaction is that of the friction and the prestretch" in text
    assert found.sizes is None


@pytest.mark.slow
def test_elementary_effects_with_finite_elements(tmp_path):
    """Every case is solved; a second run reads the states from the cache."""
    case = sp.Case(
        sp.Stone(size_ratio=1.1), sp.Ureter(wall_ratio=1.3), model=sp.SeatedBalance(seating="frictionless"),
        numerics=sp.Numerics("fast"),
    )  # fmt: skip
    uncertain = {"stone.friction": "0.1 to 0.5", "ureter.material.G": "12 kPa ± 1 kPa"}
    study = SensitivityStudy(uncertain_case(case, uncertain), samples=4)
    assert study.method == "morris"
    found = sensitivity(study, cache_folder=tmp_path, progress=False)
    assert found.evaluated == 12
    assert found.main.inputs[0].key == "stone.friction"
    assert found.source == "finite elements of the model 'paper'"
    again = sensitivity(study, cache_folder=tmp_path, progress=False)
    assert again == found
    low = found.pressures.bars[0].low
    answer = sp.solve(case.with_friction(0.12), case.numerics.resolution)
    assert low.value == pytest.approx(answer.pressure_kPa)


# --- surrogates


class Linear:
    """A surrogate whose critical pressure is μ (ξ − 1) (η − 1) MPa, up to its edges."""

    case = sp.Case(sp.Stone(size_ratio=1.1), sp.Ureter(wall_ratio=1.3))
    OUTCOMES = (Outcome.LOOSE, Outcome.MOVES, Outcome.NO_SOLUTION, Outcome.BEYOND_CLOSURE)

    def evaluate(self, *, size_ratio, wall_ratio, friction, confining_pressure):
        over = np.maximum(size_ratio - 1.0, 0.0)
        pressure = 1e6 * friction * over * (wall_ratio - 1.0) + confining_pressure
        outside, beyond = size_ratio > 1.6, (friction > 1.0) & (over > 0.0)
        missing = outside | beyond
        codes = np.select([outside, beyond, over == 0.0], [2, 3, 0], 1)
        masked = np.ma.masked_array(pressure, missing)
        bound = np.where(beyond & ~outside, 5e3, 0.0)
        return SimpleNamespace(
            OUTCOMES=self.OUTCOMES, outcome=codes, pressure=masked, lower_bound=bound,
            error=np.ma.masked_array(0.001 * pressure, missing), outside=outside,
        )  # fmt: skip


def surrogate_study(uncertain, **settings):
    case = sp.Case(sp.Stone("3.85 mm", 0.3), sp.Ureter("3.5 mm", "4.55 mm"))
    study = SensitivityStudy(uncertain_case(case, uncertain), "sobol", "9 kPa", **settings)
    return study, SurrogateCases(study.uncertain, Linear(), "line")


def test_a_surrogate_answers_a_study():
    uncertain = {"stone.friction": "0.1 to 0.5", "stone.diameter": "3.7 mm to 4 mm",
                 "ureter.inner_diameter": "3.5 mm ± 0.01 mm"}  # fmt: skip
    study, surrogate = surrogate_study(uncertain, samples=256)
    found = sensitivity(study, surrogate)
    assert found.source == "surrogate 'line' of the model 'paper'"
    assert found.pressures.centre.value == pytest.approx(9.0, rel=1e-6)
    bars = {bar.key: bar for bar in found.sizes.bars}
    # ξ_cr − 1 = limit/(μ (η − 1)), in mm of the inner diameter; 1 MPa · 0.3 · 0.3 at the medians.
    assert found.sizes.centre.value == pytest.approx(3.85, abs=1e-6)
    assert bars["stone.friction"].low.value == pytest.approx(3.5 * (1.0 + 0.009 / 0.12 / 0.3))
    narrow = bars["ureter.inner_diameter"].low
    inner = 1e3 * narrow.input
    size = inner * (1.0 + 0.009 / 0.3 / (4.55 / inner - 1.0))
    assert narrow.value == pytest.approx(size, rel=1e-6)
    assert found.error == pytest.approx(0.0, abs=60.0)
    assert found.error > 10.0
    assert "whose stated error is at most" in " ".join(conclusions(found))


def test_what_a_surrogate_cannot_answer_has_a_name():
    uncertain = {"stone.friction": "0.1 to 1.3", "stone.diameter": "3.6 mm to 6 mm"}
    study, surrogate = surrogate_study(uncertain, samples=64)
    found = sensitivity(study, surrogate)
    outcomes = dict(found.outcomes)
    assert outcomes["OUTSIDE"] == pytest.approx(0.4 / 2.4, abs=0.02)
    assert outcomes["BEYOND_CLOSURE"] == pytest.approx(0.25 * 2.0 / 2.4, abs=0.02)
    assert found.sizes.bars[0].high.lower_bound == pytest.approx(3.5, rel=1e-6)
    told = {each.code: dict(each.values) for each in found.warnings}
    assert told["cases_outside"]["fraction"] == outcomes["OUTSIDE"]
    assert told["bounds_in_rank"]["fraction"] == outcomes["BEYOND_CLOSURE"]
    high = found.sizes.bars[0].high
    assert (high.outcome, high.value) == ("BEYOND_CLOSURE", None)


def test_outside_the_range_of_a_surrogate_nothing_is_said_to_not_exist():
    """Every case in the box of this surrogate has a critical pressure."""
    uncertain = {"stone.friction": "0.1 to 0.9", "stone.diameter": "3.6 mm to 6.4 mm"}
    study, surrogate = surrogate_study(uncertain, samples=64)
    found = sensitivity(study, surrogate)
    assert set(dict(found.outcomes)) == {"MOVES", "OUTSIDE"}
    (answered,) = (each for each in found.responses if each.response is ANSWERED)
    assert not answered.inputs
    assert answered.gap is Gap.CONSTANT
    text = " ".join(conclusions(found))
    assert "There is no critical pressure" not in text
    assert "a critical pressure exists" not in text
    high = next(bar for bar in found.pressures.bars if bar.key == "stone.diameter").high
    assert (high.outcome, high.value) == ("OUTSIDE", None)
    assert "The critical pressure is not known where the stone diameter is 6.26 mm and all" in text


def test_a_size_beyond_the_surrogate_has_a_lower_bound():
    study, surrogate = surrogate_study({"stone.friction": "0.01 to 0.1"})
    ends = sensitivity(study, surrogate).sizes.bars[0]
    assert (ends.low.outcome, ends.low.value) == ("BEYOND_RANGE", None)
    assert ends.low.lower_bound == pytest.approx(1.6 * 3.5, rel=1e-6)
    assert ends.high.value == pytest.approx(3.5 * (1.0 + 0.009 / 0.0955 / 0.3), rel=1e-6)


def test_a_study_file_may_name_a_surrogate(tmp_path, monkeypatch, capsys):
    asked = []
    monkeypatch.setattr(
        "stonepass.studies.sensitivity.sensitivity.load_surrogate",
        lambda name, model: asked.append((name, model)) or Linear(),
    )
    text = """
        [ureter]
        wall_ratio = 1.3
        [uncertain]
        stone.friction = "0.1 to 0.5"
        stone.size_ratio = "1.05 to 1.2"
        [sensitivity]
        samples = 64
    """
    path = study_file(tmp_path, text)
    assert read_sensitivity(path).method == "morris"
    assert run(["sensitivity", str(path), "--surrogate", "ureter", "--json"]) == 0
    record = json.loads(capsys.readouterr().out)
    assert asked == [("ureter", "paper")]
    assert record["method"] == "sobol"
    assert record["source"] == "surrogate 'ureter' of the model 'paper'"
    assert record["evaluated"] == 64 * 6
    path = study_file(tmp_path, text + 'surrogate = "mine.json"')
    assert read_sensitivity(path).surrogate == str(tmp_path / "mine.json")


def test_an_unknown_surrogate_is_refused(tmp_path, capsys):
    path = study_file(
        tmp_path, "[ureter]\nwall_ratio = 1.3\n[uncertain]\nstone.size_ratio = '1 to 1.2'"
    )
    assert run(["sensitivity", str(path), "--surrogate", "rubber"]) == 2
    assert "--surrogate is 'rubber' with the model 'paper'" in capsys.readouterr().err


def test_a_surrogate_of_another_case_is_refused():
    with pytest.raises(BadInput, match=r"uncertain input is load\.prestretch"):
        surrogate_study({"load.prestretch": "1 to 1.1"})
    latex = sp.Case(sp.Stone(size_ratio=1.1), sp.Ureter(wall_ratio=1.3, material="latex"))
    uncertain = uncertain_case(latex, {"stone.friction": "0.1 to 0.5"})
    with pytest.raises(BadInput, match="law of the wall"):
        SurrogateCases(uncertain, Linear())
    direct = dataclasses.replace(Linear.case, model=sp.PushThrough())
    with pytest.raises(BadInput, match="that of the surrogate"):
        SurrogateCases(uncertain_case(direct, {"stone.friction": "0.1 to 0.5"}), Linear())


# --- solved cases


def interpolated(uncertain, count=256):
    """Beam cases at points of a Sobol sequence over all ranges, as a sweep has them."""
    case = uncertain_case(CASE, uncertain)
    unit = sobol_points(len(uncertain), int(np.log2(count)), 3)
    points = {key: low + (high - low) * unit[:, k] for k, (key, low, high) in enumerate(
        (each.key, each.quantity.low, each.quantity.high) for each in case.inputs)}  # fmt: skip
    return InterpolatedCases(case, points, CaseEvaluator(case)(points), "sweep 'study'")


def test_solved_cases_answer_a_study():
    uncertain = {"stone.friction": "0.1 to 0.5", "stone.diameter": "3.6 mm to 3.8 mm"}
    swept = interpolated(uncertain)
    study = SensitivityStudy(swept.uncertain, limit="2 kPa", samples=64)
    found, solved = sensitivity(study, swept), sensitivity(study, progress=False)
    assert found.source == "interpolation of the sweep 'study'"
    assert found.error < 40.0  # of up to 4 kPa
    exact = solved.pressures.centre.value
    assert abs(found.pressures.centre.value - exact) * 1e3 < found.error + 1e-6
    assert found.sizes.centre.value == pytest.approx(solved.sizes.centre.value, abs=2e-3)
    inside = dict(found.outcomes)
    assert inside["MOVES"] > 0.9
    for mine, its in zip(found.response("rank").inputs, solved.main.inputs, strict=True):
        assert mine.key == its.key
        assert mine.total.overlaps(its.total)
    # A solved case keeps its own pressure.
    first = {key: values[:5] for key, values in swept.points.items()}
    assert swept(first).value.tolist() == pytest.approx(swept.solved.value[:5].tolist())


def test_cases_without_an_answer_keep_their_outcome():
    uncertain = {"stone.friction": "0.1 to 0.5", "ureter.outer_diameter": "5 mm to 5.4 mm"}
    swept = interpolated(uncertain, count=128)
    inputs = {"stone.friction": np.array([0.3, 0.3, 0.6]),
              "ureter.outer_diameter": np.array([5.1e-3, 5.38e-3, 5.1e-3])}  # fmt: skip
    found = swept(inputs)
    assert [outcome_name(code) for code in found.outcome.tolist()] == [
        "MOVES",
        "BAD_INPUT",
        "OUTSIDE",
    ]
    assert found.value.mask.tolist() == [False, True, True]
    with pytest.raises(BadInput, match="pressure limit"):
        swept.critical_sizes(inputs, 2e3)


def test_other_inputs_than_those_of_the_solved_cases_are_refused():
    swept = interpolated({"stone.friction": "0.1 to 0.5", "stone.diameter": "3.6 mm to 3.8 mm"}, 64)
    less = uncertain_case(CASE, {"stone.friction": "0.1 to 0.5"})
    with pytest.raises(
        BadInput, match=r"uncertain inputs is stone\.friction, but must be those of"
    ):
        dataclasses.replace(swept, uncertain=less)
    same = {**swept.points, "stone.friction": np.full(64, 0.3)}
    with pytest.raises(BadInput, match="constant in the sweep"):
        dataclasses.replace(swept, points=same)
    none = evaluations([Outcome.NO_SOLUTION] * 64, [None] * 64, [None] * 64)
    with pytest.raises(BadInput, match="number of critical pressures"):
        dataclasses.replace(swept, solved=none)


SWEEP = {
    "ureter": {"inner_diameter": "3.5 mm", "wall_thickness": "0.5 mm"},
    "method": {"model": "beam", "longitudinal_modulus": "20 kPa"},
    "vary": {
        "stone.diameter": {"low": "3.6 mm", "high": "3.9 mm"},
        "stone.friction": {"low": 0.1, "high": 0.5},
        "method.circumferential_modulus": {"low": "0.3 MPa", "high": "0.5 MPa"},
    },
    "samples": {"count": 128},
}
ITS_STUDY = """
[ureter]
inner_diameter = "3.5 mm"
wall_thickness = "0.5 mm"
[method]
model = "beam"
longitudinal_modulus = "20 kPa"
[uncertain]
stone.diameter = "3.6 mm to 3.9 mm"
stone.friction = "0.1 to 0.5"
method.circumferential_modulus = "0.3 MPa to 0.5 MPa"
[sensitivity]
samples = 64
sweep = "swept"
"""


def test_the_results_of_a_sweep_answer_a_study(tmp_path, capsys):
    sp.sweep(SWEEP, tmp_path / "swept", workers=1, progress=False)
    path = study_file(tmp_path, ITS_STUDY)
    assert run(["sensitivity", str(path), "--json"]) == 0
    record = json.loads(capsys.readouterr().out)
    assert (record["source"], record["evaluated"]) == ("interpolation of the sweep 'swept'", 512)
    median = sp.Case(sp.Stone("3.75 mm", 0.3), sp.Ureter("3.5 mm", "4.5 mm"), model=BEAM)
    exact = sp.solve(median).pressure_kPa
    assert record["tornado_pressure"]["centre"]["value"] == pytest.approx(exact, rel=0.02)
    assert 0.0 < record["largest_error_kPa"] < 0.2 * exact
    # The same sweep does not answer a study of another wall.
    other = study_file(tmp_path, ITS_STUDY.replace("20 kPa", "30 kPa"))
    assert run(["sensitivity", str(other)]) == 2
    assert "fixed inputs of the study" in capsys.readouterr().err
    assert run(["sensitivity", str(path), "--sweep", str(tmp_path / "none")]) == 2
    assert "--sweep is" in capsys.readouterr().err
    missing = study_file(tmp_path, ITS_STUDY.replace('"swept"', '"none"'))
    assert run(["sensitivity", str(missing)]) == 2
    assert "'sensitivity.sweep' is" in capsys.readouterr().err


def test_inputs_that_change_nothing_are_not_ranked(tmp_path, capsys):
    """All stones are loose, so that every critical pressure is 0."""
    study = ITS_STUDY.replace('sweep = "swept"\n', "").replace("3.6 mm to 3.9 mm", "2 mm to 3 mm")
    assert run(["sensitivity", str(study_file(tmp_path, study)), "--json"]) in (0, 1)
    told = " ".join(json.loads(capsys.readouterr().out)["conclusions"])
    assert "None of the inputs changes the critical pressure alone." in told
    assert "more than any other" not in told
    assert "the least" not in told


def test_a_sweep_of_several_models_answers_for_the_one_with_the_same_options(tmp_path):
    """The model of a sweep is found by its options, whatever its label."""
    fixed = {key: SWEEP[key] for key in ("ureter",)}
    both = fixed | {
        "models": {
            "stiff": {"model": "beam", "circumferential_modulus": "0.4 MPa",
                      "longitudinal_modulus": "40 kPa"},
            "soft": {"model": "beam", "circumferential_modulus": "0.4 MPa",
                     "longitudinal_modulus": "20 kPa"},
        },
        "vary": {"stone.friction": [0.1, 0.2, 0.3, 0.4, 0.5],
                 "stone.diameter": ["3.4 mm", "3.7 mm", "3.8 mm", "3.9 mm"]},
    }  # fmt: skip
    sp.sweep(both, tmp_path / "both", workers=1, progress=False)
    results = sp.read_results(tmp_path / "both")
    ranges = {"stone.friction": "0.1 to 0.5", "stone.diameter": "3.7 mm to 3.9 mm"}
    for modulus in ("20 kPa", "40 kPa"):
        model = dataclasses.replace(BEAM, longitudinal_modulus=modulus)
        case = sp.Case(sp.Stone("3.75 mm", 0.3), sp.Ureter("3.5 mm", "4.5 mm"), model=model)
        found = swept_cases(uncertain_case(case, ranges), results)
        assert len(found.solved.outcome) == 20
        at = {"stone.friction": np.array([0.3]), "stone.diameter": np.array([3.8e-3])}
        exact = sp.solve(dataclasses.replace(case, stone=sp.Stone("3.8 mm", 0.3))).pressure
        assert found(at).value[0] == pytest.approx(exact, rel=0.01)
    other = sp.Case(sp.Stone("3.75 mm", 0.3), sp.Ureter("3.5 mm", "4.5 mm"), model=sp.PushThrough())
    with pytest.raises(BadInput, match="fixed inputs of the study"):
        swept_cases(uncertain_case(other, ranges), results)


def test_a_sweep_over_names_does_not_answer_a_study(tmp_path):
    named = SWEEP | {"vary": SWEEP["vary"] | {"method.accuracy": ["fast", "standard"]}}
    sp.sweep(named | {"samples": {"count": 2}}, tmp_path / "named", workers=1, progress=False)
    with pytest.raises(BadInput, match=r"method\.accuracy.*a real number"):
        swept_cases(uncertain_case(CASE, {"stone.friction": "0.1 to 0.5"}),
                    sp.read_results(tmp_path / "named"))  # fmt: skip


# --- the study file and its errors

STUDY = """
[ureter]
inner_diameter = "3.5 mm"
wall_thickness = "0.5 mm"

[method]
model = "beam"
longitudinal_modulus = "20 kPa"

[uncertain]
stone.friction = "0.05 to 0.5"
"stone.diameter" = "3.8 mm ± 0.1 mm"
method.circumferential_modulus = "0.4 MPa ± 20 %"

[sensitivity]
limit = "4 kPa"
samples = 64
"""


def study_file(tmp_path, text=STUDY):
    path = tmp_path / "study.toml"
    path.write_text(text, encoding="utf-8")
    return path


def test_a_study_file_is_read(tmp_path):
    study = read_sensitivity(study_file(tmp_path))
    assert study.uncertain.keys == (
        "stone.friction",
        "stone.diameter",
        "method.circumferential_modulus",
    )
    assert (study.method, study.samples, study.seed, study.limit) == ("sobol", 64, 1, 4000.0)
    assert study.cases == 64 * 8
    shown = [each.describe() for each in study.uncertain.inputs]
    assert shown == ["0.05 to 0.5", "3.8 ± 0.1 mm", "400 ± 80 kPa"]
    case = study.uncertain.median_case
    assert (case.wall_ratio, case.stone.friction) == (pytest.approx(4.5 / 3.5), 0.275)
    changed = read_sensitivity(
        study_file(tmp_path), method="morris", samples=6, limit="5 kPa", seed=None
    )
    assert (changed.method, changed.samples, changed.limit, changed.seed) == (
        "morris",
        6,
        5000.0,
        1,
    )


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        (
            "stone.friction",
            "stone.frction",
            "uncertain input is stone.frction, but must be one of ",
        ),
        ('"0.05 to 0.5"', "0.3", "'stone.friction' is 0.3, but must be text in quotes"),
        (
            '"0.05 to 0.5"',
            '"0.5 to 0.05"',
            "'stone.friction' is 0.5 to 0.05, but must be a rising range",
        ),
        ("3.8 mm ± 0.1 mm", "3.8 ± 0.1", "must be a length with its unit"),
        ('"4 kPa"', '"4"', "limit is 4, but must be a pressure with its unit"),
        (
            "samples = 64",
            "samples = 60",
            "samples is 60, but must be a number of base samples, a power of two",
        ),
        ("samples = 64", "sample = 64", "key of [sensitivity] is sample, but must be one of"),
        ("samples = 64", 'method = "fast"', "method is fast, but must be one of sobol, morris"),
        (
            "[uncertain]",
            "[stone]\nfriction = 0.3\n[uncertain]",
            "'stone.friction' is fixed and uncertain",
        ),
        ("[uncertain]", "[uncertan]", "key is uncertan, but must be one of"),
        ('inner_diameter = "3.5 mm"', "", "inner diameter"),
        ("[uncertain]", '[uncertain]\n"stone.size_ratio" = "1 to 1.2"', "give one of the two"),
        (
            "[uncertain]",
            '[uncertain]\n"ureter.material.H" = "1 ± 0.1"',
            "must be one of C, a1111, a2222",
        ),
        (
            "[uncertain]",
            '[uncertain]\nload.confinement = "dead to hydrostatic"',
            "uncertain input is load.confinement",
        ),
        ("samples = 64", "seed = -1", "seed is -1, but must be a whole number from 0"),
    ],
)
def test_a_refused_study_file_says_what_is_wrong(tmp_path, old, new, message):
    path = study_file(tmp_path, STUDY.replace(old, new, 1))
    with pytest.raises(BadInput) as problem:
        read_sensitivity(path)
    assert message in str(problem.value)
    assert "study.toml" in str(problem.value)


def test_an_exact_quantity_is_fixed(tmp_path):
    text = STUDY.replace("0.4 MPa ± 20 %", "0.3 MPa ± 0 MPa")
    study = read_sensitivity(study_file(tmp_path, text))
    assert study.uncertain.keys == ("stone.friction", "stone.diameter")
    assert study.uncertain.median_case.model.circumferential_modulus == 3e5
    only = {"stone.friction": "0.3 ± 0"}
    with pytest.raises(BadInput, match="number of uncertain inputs is 0"):
        uncertain_case(CASE, only)


def test_constants_of_the_law_are_varied_in_their_units():
    wall = sp.Case(sp.Stone(size_ratio=1.1), sp.Ureter(wall_ratio=1.3, material="ureter"))
    uncertain = uncertain_case(
        wall, {"ureter.material.G": "12 kPa ± 2 kPa", "ureter.material.a1111": "2 to 3"}
    )
    case = uncertain.case({"ureter.material.G": 11e3, "ureter.material.a1111": 2.5})
    law = case.ureter.material.law
    assert (law.G, law.a1111, law.C) == (11e3, 2.5, wall.ureter.material.law.C)
    assert uncertain["ureter.material.G"].describe() == "12 ± 2 kPa"
    hgo = sp.HolzapfelGasserOgden(3e3, 2e3, 1.0, 0.7, 0.1)
    tube = dataclasses.replace(wall.ureter.material, law=hgo)
    angle = uncertain_case(
        sp.Case(wall.stone, sp.Ureter(wall_ratio=1.3, material=tube)),
        {"ureter.material.angle": "40 deg ± 5 deg"},
    )
    assert angle.inputs[0].quantity.value == pytest.approx(np.radians(40.0))


def test_an_unstable_law_is_a_refused_case():
    """Samples in which the law is unstable are outcomes, and end nothing."""
    case = sp.Case(
        sp.Stone(size_ratio=1.1), sp.Ureter(wall_ratio=1.3), numerics=sp.Numerics("fast")
    )
    uncertain = uncertain_case(case, {"ureter.material.a1122": "-30 to 30"})
    found = CaseEvaluator(uncertain)({"ureter.material.a1122": np.array([30.0])})
    assert found.outcome.tolist() == [BAD_INPUT]
    assert found.reason
    assert found.value.mask.all()


def test_salib_is_named_if_it_is_missing(monkeypatch):
    monkeypatch.setattr("stonepass.io.optional_imports.import_module", _missing)
    with pytest.raises(BadInput, match=r"pip install 'stonepass\[studies\]'"):
        saltelli_design({"x": UNIFORM}, 32, 1)


def _missing(name):
    raise ImportError(name)


# --- the doors


EXAMPLE = ROOT / "examples" / "uncertain_stone.toml"


def test_the_page_of_sensitivity_is_true():
    page = (ROOT / "docs" / "howto" / "sensitivity.md").read_text(encoding="utf-8")
    blocks = re.findall(r"^```{doctest}$(.*?)^```$", page, flags=re.MULTILINE | re.DOTALL)
    assert len(blocks) >= 5
    examples = doctest.DocTestParser().get_doctest("\n".join(blocks), {}, "page", None, 0)
    assert doctest.DocTestRunner().run(examples).failed == 0


def test_the_command_writes_table_and_picture(tmp_path, capsys):
    table, picture = tmp_path / "s.csv", tmp_path / "s.svg"
    options = ["--samples", "32", "--workers", "1", "--csv", str(table), "--figure", str(picture)]
    assert run(["sensitivity", str(EXAMPLE), *options]) == 0
    shown = capsys.readouterr()
    assert "matter most for the critical pressure" in " ".join(shown.out.split())
    assert f"wrote {table}" in shown.err
    rows = list(csv.DictReader(io.StringIO(table.read_text(encoding="utf-8"))))
    assert [row["key"] for row in rows][:2] == ["stone.diameter", "stone.friction"]
    assert float(rows[1]["pressure_total_low"]) < float(rows[1]["pressure_total"])
    assert rows[0]["critical_size_at_quantile_5_mm"] == ""
    assert float(rows[1]["critical_size_at_quantile_5_mm"]) > 4.0
    assert picture.read_text(encoding="utf-8").startswith("<?xml")


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (["--samples", "60"], "--samples is 60, but must be a number of base samples"),
        (["--limit", "6"], "--limit is 6, but must be a pressure with its unit"),
        (["--method", "fast"], "--method is fast, but must be one of sobol, morris"),
        (["--seed", "-3"], "--seed is -3, but must be a whole number"),
        (["--csv", "table.txt"], "table.txt"),
    ],
)
def test_a_refused_option_is_named(options, message, capsys):
    assert run(["sensitivity", str(EXAMPLE), *options]) == 2
    shown = capsys.readouterr()
    assert message in shown.err
    assert shown.out == ""


def test_the_result_is_shown_in_every_way(beam):
    record = beam.to_dict()
    assert sp.SensitivityRecord.model_validate(record).to_dict() == record
    text = json.dumps(record, allow_nan=False)
    assert json.loads(text) == record
    assert "Sensitivity of the critical pressure" in str(beam)
    assert beam._repr_html_().count("<table>") == 3
    assert len(beam.to_frame()) == 3
    panels = beam.figure().axes
    titles = [axes.get_title(loc="left") for axes in panels]
    assert titles == [
        "Sensitivity of the critical pressure",
        "Critical pressure, one input at a time",
        "Critical size at 4 kPa, one input at a time",
    ]
    bars = [[each.get_width() for each in axes.patches] for axes in panels[1:]]
    assert [len(each) for each in bars] == [6, 4]
    centre = beam.pressures.centre.value
    expected = [end.value - centre for bar in beam.pressures.bars for end in (bar.low, bar.high)]
    assert bars[0] == pytest.approx(expected)


def test_missing_ends_of_a_tornado_are_shown_with_their_outcome():
    """A wall that the beam refuses, and a closure that ends, have a word in the place of a bar."""
    uncertain = {"ureter.outer_diameter": "5 mm to 5.4 mm", "stone.friction": "0.1 to 2"}
    study = SensitivityStudy(uncertain_case(CASE, uncertain), samples=32)
    found = sensitivity(study, progress=False)
    first = found.pressures.bars[0]
    assert (first.key, first.high.outcome, first.span) == (
        "ureter.outer_diameter",
        "BAD_INPUT",
        None,
    )
    told = " ".join(conclusions(found))
    assert "There is no critical pressure where the outer diameter is 5.38 mm" in told
    drawn = [text.get_text() for axes in found.figure().axes for text in axes.texts]
    assert "5.38 mm: BAD_INPUT" in drawn
    assert found.to_dict()["tornado_pressure"]["bars"][0]["high"]["value"] is None
    assert "BAD_INPUT" in str(found)
