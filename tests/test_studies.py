"""The contract of studies and executors; an additional study as a worked example."""

import pickle
import subprocess
import sys
import threading
import warnings
from concurrent.futures import Executor, Future, ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path

import pytest
from options import asking
from test_store import assert_same

import stonepass as sp
from stonepass.paper.headline import Headline
from stonepass.studies import executor as executors
from stonepass.studies.curve import Curve
from stonepass.studies.executor import InProcessExecutor, process_pool, stream
from stonepass.studies.jobs import Job, PressureJob, Results, iterate_jobs, run_jobs
from stonepass.studies.registry import STUDIES
from stonepass.studies.study import Study, run_studies, run_study

LOOSE = sp.Case(sp.Stone(size_ratio=0.9), sp.Ureter(wall_ratio=1.5, material="latex"))
BEAM = sp.Case(
    sp.Stone(size_ratio=1.2),
    sp.Ureter(wall_ratio=1.3),
    **asking(model="beam", secant_stretch=1.2),
)


class _Unsendable(UserWarning):
    """A warning that holds what cannot be pickled."""

    def __init__(self):
        super().__init__("beware")
        self.held = lambda: None


def _warning(item):
    warnings.warn(_Unsendable(), stacklevel=1)
    return item


def test_warnings_of_another_process_come_home():
    with process_pool(2) as pool, pytest.warns(UserWarning, match="beware"):
        assert sorted(stream(pool, _warning, [1, 2])) == [(0, 1), (1, 2)]


@dataclass(frozen=True)
class HighestPressure:
    """An additional study: the friction that needs the highest pressure, with the beam model."""

    frictions: tuple[float, ...]

    def jobs(self):
        return [PressureJob(BEAM.with_friction(mu)) for mu in self.frictions]

    def reduce(self, results):
        answers = [results[job] for job in self.jobs()]
        return max((each.pressure, each.case.stone.friction) for each in answers)


@dataclass(frozen=True)
class Square:
    """A job without physics."""

    number: int

    def run(self, cache_folder):
        return self.number**2


@dataclass(frozen=True)
class Refused:
    def run(self, cache_folder):
        return sp.Stone(size_ratio=40.0)


class Backwards(Executor):
    """Runs the last of the waiting calls first, in threads that start a little later."""

    def __init__(self):
        self.calls, self.most = [], 0

    def submit(self, fn, /, *args, **kwargs):
        future = Future()
        self.calls.append((future, fn, args, kwargs))
        self.most = max(self.most, len(self.calls))
        threading.Timer(0.01, self.run).start()
        return future

    def run(self):
        while True:
            try:
                future, fn, args, kwargs = self.calls.pop()
            except IndexError:
                return
            if future.set_running_or_notify_cancel():
                future.set_result(fn(*args, **kwargs))


def test_a_study_of_ones_own():
    study = HighestPressure((0.1, 0.3, 0.2))
    assert isinstance(study, Study)
    pressure, friction = run_study(study)
    assert friction == 0.3
    assert pressure == sp.solve(BEAM.with_friction(0.3)).pressure
    both = run_studies([study, HighestPressure((0.2, 0.1))])
    assert both == [(pressure, friction), run_study(HighestPressure((0.2,)))]


@pytest.mark.parametrize("name", STUDIES)
def test_every_study_keeps_the_contract(name, tmp_path):
    """Jobs are values that travel; the outcome is the same anywhere, remembered or not."""
    study = STUDIES[name](LOOSE)
    assert isinstance(study, Study)
    jobs = list(study.jobs())
    assert jobs
    assert jobs == list(study.jobs())
    for job in jobs:
        assert isinstance(job, Job)
        again = pickle.loads(pickle.dumps(job))
        assert again == job
        assert hash(again) == hash(job)
    outcome = run_study(study)
    with ThreadPoolExecutor(2) as pool:
        assert_same(run_study(study, pool), outcome)
    assert_same(run_study(study, Backwards(), tmp_path), outcome)


def test_the_headline_names_its_jobs():
    jobs = Headline().jobs()
    assert len(set(jobs)) == 30  # two sizes, 2 × 11 on curves, 2 × 3 under load
    assert jobs == Headline().jobs()


def test_results_are_the_same_by_every_executor():
    jobs = [Square(k) for k in range(1000)]
    expected = {job: job.number**2 for job in jobs}
    assert run_jobs(jobs).by_job == expected
    for pool in (InProcessExecutor(), ThreadPoolExecutor(3), Backwards()):
        assert list(run_jobs(jobs, pool).by_job.items()) == list(expected.items())


def test_results_are_the_same_by_processes():
    study = Curve(LOOSE, (0.9, 0.5, 0.7))
    with process_pool(2) as pool:
        assert run_study(study, pool) == run_study(study)


def test_results_arrive_as_they_are_ready_and_few_blocks_are_under_way():
    pool = Backwards()
    seen = [index for index, _ in stream(pool, abs, list(range(1000)))]
    assert sorted(seen) == list(range(1000))
    assert pool.most <= executors.IN_FLIGHT
    ran = []
    results = stream(InProcessExecutor(), ran.append, [1, 2, 3])
    assert next(results) == (0, None)
    assert ran == [1]
    results.close()
    assert list(iterate_jobs([Square(2), Square(3)])) == [(Square(2), 4), (Square(3), 9)]


def test_a_long_batch_returns_early_and_nothing_is_lost(monkeypatch):
    """Sixteen items are sent at a time, but each one takes the whole time of a batch."""
    monkeypatch.setattr(executors, "BATCH_SECONDS", 0.0)
    monkeypatch.setattr(executors, "_batch_size", lambda count, seconds: 16)
    assert dict(stream(InProcessExecutor(), abs, list(range(100)))) == {k: k for k in range(100)}


def test_the_progress_is_told_after_each_job():
    told = []
    run_jobs([Square(1), Square(1), Square(2)], progress=lambda *n: told.append(n))
    assert told == [(1, 2), (2, 2)]


def test_an_error_reaches_the_caller():
    for pool in (None, ThreadPoolExecutor(2)):
        with pytest.raises(sp.BadInput, match=r"0\.1 to 3"):
            run_jobs([Refused(), *map(Square, range(10))], pool)


def test_results_of_some_jobs():
    found = Results({Square(1): 1, Square(2): 4})
    assert found[Square(2)] == 4
    assert found.of([Square(1)]).by_job == {Square(1): 1}


def test_a_scheduler_needs_no_heavy_library():
    """In a fresh interpreter: jobs are made, sent and read without the finite elements."""
    absent = ("ngsolve", "netgen", "matplotlib", "pandas")
    statement = (
        "import sys, stonepass.studies.jobs, stonepass.studies.study, stonepass.studies.curve, "
        "stonepass.studies.case_solver, stonepass.studies.solution_cache; "
        f"print([name for name in {absent} if name in sys.modules])"
    )
    path = str(Path(sp.__file__).parents[1])
    shown = subprocess.run(
        [sys.executable, "-c", statement], capture_output=True, text=True, check=True,
        env={"PYTHONPATH": path},
    )  # fmt: skip
    assert shown.stdout.strip() == "[]"
