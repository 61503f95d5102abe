"""What the benchmark measures with, and how its page comes out; no timing is asserted."""

import sys
from pathlib import Path

import pytest

FOLDER = Path(__file__).parents[1] / "benchmarks"


@pytest.fixture
def benchmarks(monkeypatch):
    monkeypatch.syspath_prepend(str(FOLDER))


def test_a_target_is_met_or_missed(benchmarks):
    from measure import Row

    assert Row("s", "w", 1.0, "s").met is None
    assert Row("s", "w", 1.0, "s", 2.0).met is True
    assert Row("s", "w", 3.0, "s", 2.0).met is False
    assert Row("s", "w", 3.0, "×", 2.0, at_least=True).met is True
    assert Row("s", "w", 1.0, "×", 2.0, at_least=True).met is False


def test_a_command_is_charged_with_its_own_processor_time_alone(benchmarks):
    from measure import spend

    busy = "import time\nwhile time.process_time() < 0.3: pass"
    before = spend([sys.executable, "-c", busy])
    idle = spend([sys.executable, "-c", "import time; time.sleep(0.3); print('done')"])
    assert idle.output == "done\n"
    assert idle.code == 0
    assert idle.cpu < before.cpu
    assert idle.wall >= 0.3
    # Python alone, however large this process is.
    assert 3.0 < idle.memory < 40.0


def test_ratios_take_the_cheapest_of_ours_that_is_nowhere_worse(benchmarks):
    from peers import Solved, ratios

    exact = Solved("stonepass, reference", 9.0, (70.0, 100.0, 50.0))
    found = [
        Solved("stonepass, fast", 1.0, (70.0, 103.0, 50.0)),  # 3 % off in σ
        Solved("stonepass, standard", 2.0, (70.0, 101.0, 50.0)),
        Solved("CalculiX, CAX8", 100.0, (71.0, 102.0, 51.0)),
    ]
    fast, standard = ratios("pressed", found, exact)
    assert (fast.value, fast.target) == (100.0, None)
    assert (standard.value, standard.target, standard.met) == (50.0, 30.0, True)
    # Where none is as good, the target is missed, and that is said.
    *_, none = ratios("pressed", [found[0], found[2]], exact)
    assert none.met is False


def test_the_page_has_every_number(benchmarks):
    from measure import Row
    from page import page

    rows = [
        Row("peers", "pressed | CAX8 | fast | no *", 123.0, "×", 100.0, at_least=True),
        Row("memory", "largest", 345.0, "MB", 300.0),
    ]
    beside = {
        "seating": "pressed",
        "who": "CalculiX, CAX8",
        "cpu_s": 31.5,
        "contact_angle_error_deg": 0.4,
        "equator_pressure_error": 0.005,
        "critical_pressure_error": 0.001,
    }
    duel = {
        "case": "a tube",
        "seating": "pressed",
        "settings": "CAX8R, 3 rows",
        "decks_run": 8,
        "decks_near_enough": 5,
        "cpu_s": 6.25,
        "contact_angle_error_deg": 0.25,
        "equator_pressure_error": 0.0125,
        "critical_pressure_error": 0.0075,
        "ours_cpu_s": {"stonepass, fast, state alone": 0.45, "stonepass, standard": 2.08},
        "ratios": {"stonepass, fast, state alone": 14.0, "stonepass, standard": 3.0},
    }
    found = {
        "date": "2026-01-01",
        "code": "abc",
        "machine": {"cores": "2"},
        "resumed": 3,
        "beside": [beside],
        "settings": {"element": ["CAX8R"], "rows": [3, 4]},
        "duels": [duel],
        "scaling": [{"what": "w", "dofs": [10, 20], "cpu_s": [1.0, 2.0], "exponent": 1.0}],
        "rows": [row.record() for row in rows],
        "phases": {"case": {"residual": "12%"}},
    }
    text = page(
        found, {"peers": "Peers", "duels": "At its best", "scaling": "Growth", "memory": "Memory"}
    )
    for words in ("processor times of 3 decks", "123 ×", "met", "**missed**", "31.50", "0.500%", "| residual | 12% |", "abc",
                  "rows through the wall (3, 4)", "5 of 8", "0.25°", "1.25%",
                  "| pressed | CAX8 | fast \\* | no | 123 × | ≥ 100 × | met |",
                  "| 0.45 s, 14 × | – | – | 2.08 s, 3 × |",
                  "| pressed | no | 14 × | a tube; `fast` | 14 × | a tube; `fast` |"):  # fmt: skip
        assert words in text


def test_an_interrupted_benchmark_goes_on_with_the_same_decks(tmp_path, monkeypatch):
    import measure

    runs = []

    def spend(command, folder):
        runs.append(command)
        return measure.Spent(1.5, 2.0, 10.0, "", 0)

    monkeypatch.setattr(measure, "spend", spend)
    first = measure.Decks(tmp_path).run("job", "** made on Monday\n*NODE\n")
    assert runs == [["ccx", "job"]]
    again = measure.Decks(tmp_path, resume=True)
    assert again.run("job", "** made on Tuesday\n*NODE\n") == first
    assert (again.resumed, len(runs)) == (1, 1)
    again.run("job", "*ELEMENT\n", 60.0)  # another deck of this name
    measure.Decks(tmp_path).run("job", "*ELEMENT\n")  # not asked to resume
    assert runs[1:] == [["timeout", "60", "ccx", "job"], ["ccx", "job"]]
