"""A sweep on a Dask cluster on this machine: its scheduler and workers are started as documented."""

import os
import signal
import socket
import subprocess
import sys
import time
from contextlib import suppress
from pathlib import Path

import pytest
from toy_laws import hazardous

import stonepass as sp
from stonepass.cli import run
from stonepass.studies.sweeps.cluster import cluster
from stonepass.studies.sweeps.ledger import LEDGER, read_ledger

Client = pytest.importorskip("distributed").Client
pytestmark = [
    pytest.mark.slow,
    # Dask leaves its loop and sockets to be closed when the process ends.
    pytest.mark.filterwarnings("ignore::ResourceWarning"),
    pytest.mark.filterwarnings("ignore::pytest.PytestUnraisableExceptionWarning"),
]
PATIENCE = 90.0  # s on a busy machine
TESTS = Path(__file__).parent
STUDY = """
[ureter]
wall_ratio = 1.3
material = "latex"
[method]
model = "beam"
secant_stretch = 1.2
[vary]
stone.size_ratio = {low = 1.05, high = 1.3}
stone.friction = {from = 0.1, to = 0.5, count = 8}
[samples]
count = 128
seed = 5
"""


@pytest.fixture
def dask(tmp_path):
    """(address of a scheduler, function that starts a worker); all end with the test."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    begun, address = [], f"tcp://127.0.0.1:{port}"
    path = os.pathsep.join([str(Path(sp.__file__).parents[1]), str(TESTS)])
    environment = os.environ | {
        "PYTHONPATH": path,
        "DASK_DISTRIBUTED__SCHEDULER__ALLOWED_FAILURES": "1",
    }

    def start(*arguments):
        log = (tmp_path / f"dask-{len(begun)}.log").open("w")
        process = subprocess.Popen(
            [sys.executable, "-m", "dask", *arguments], env=environment, cwd=tmp_path, stdout=log,
            stderr=subprocess.STDOUT, start_new_session=True,
        )  # fmt: skip
        log.close()
        begun.append(process)
        return process

    start("scheduler", "--host", "127.0.0.1", "--port", str(port), "--no-dashboard")

    def worker(*more):
        return start("worker", address, "--nthreads", "1", "--no-dashboard", *more)

    yield address, worker
    for process in begun:
        with suppress(ProcessLookupError):  # a test has killed it
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()


def wait_until(holds):
    end = time.monotonic() + PATIENCE
    while not holds():
        assert time.monotonic() < end
        time.sleep(0.05)


def workers_at(address, count):
    def there():
        try:
            with cluster(address) as executor:
                return executor.count == count
        except sp.BadInput:
            return False

    wait_until(there)


def test_a_killed_worker_loses_nothing_and_nothing_is_solved_twice(
    dask, tmp_path, monkeypatch, capsys
):
    """The command is run by this process, which kills a worker after the fourth block."""
    address, worker = dask
    first, _ = worker("--no-nanny"), worker("--no-nanny")
    workers_at(address, 2)
    (tmp_path / "study.toml").write_text(STUDY)
    monkeypatch.chdir(tmp_path)
    from stonepass.studies.sweeps import run as runs

    add, stored = runs.add, []

    def add_and_kill(connection, block):
        add(connection, block)
        stored.append((block.start, block.stop))
        if len(stored) == 4:
            os.killpg(first.pid, signal.SIGKILL)

    monkeypatch.setattr(runs, "add", add_and_kill)
    code = run(["sweep", "study.toml", "--out", "s", "--scheduler", address])
    out, err = capsys.readouterr()
    assert (code, "Traceback" in err) == (0, False), err
    assert "1024 of 1024 cases" in out
    assert first.poll() is not None
    indices = [k for start, stop in stored for k in range(start, stop)]
    assert sorted(indices) == list(range(1024))
    found = sp.read_results("s")
    assert found.counts == {"beam": {"MOVES": 1024}}
    assert found.table().equals(sp.sweep("study.toml", "here", workers=2).table())


def test_a_case_that_ends_its_worker_is_a_row(dask, tmp_path):
    """A nanny starts each worker again."""
    address, worker = dask
    worker(), worker()
    workers_at(address, 2)
    study = {
        "ureter": {"wall_ratio": 1.3, "material": hazardous(tmp_path / "deaths")},
        "method": {"model": "beam", "secant_stretch": 1.2},
        "vary": {"ureter.material.hazard": [0.0, 2.0, 0.0], "stone.size_ratio": [1.1, 1.2]},
    }
    with Client(address, set_as_default=False) as client:
        found = sp.sweep(study, tmp_path / "s", executor=client.get_executor())
    outcomes = [each["outcome"] for each in found.table().to_pylist()]
    assert outcomes == ["MOVES"] * 2 + ["WORKER_LOST"] * 2 + ["MOVES"] * 2


def test_a_lost_scheduler_keeps_what_is_finished(dask, tmp_path):
    address, worker = dask
    worker("--no-nanny")
    workers_at(address, 1)
    (tmp_path / "study.toml").write_text(STUDY)
    folder = tmp_path / "s"
    code = "import sys; from stonepass.cli import main; main(sys.argv[1:])"
    process = subprocess.Popen(
        [sys.executable, "-c", code, "sweep", str(tmp_path / "study.toml"), "--out", str(folder),
         "--scheduler", address],
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
    )  # fmt: skip
    wait_until(lambda: (folder / LEDGER).exists() and len(read_ledger(folder).entries) > 1)
    scheduler = [
        int(p.name) for p in Path("/proc").glob("[0-9]*")
        if b"scheduler" in (p / "cmdline").read_bytes() and address.split(":")[-1].encode() in (p / "cmdline").read_bytes()
        and b"stonepass" not in (p / "cmdline").read_bytes()
    ]  # fmt: skip
    os.kill(scheduler[0], signal.SIGKILL)
    _, err = process.communicate(timeout=PATIENCE)
    assert process.returncode == 2, err
    assert "the connection to the workers was lost" in err
    assert "Traceback" not in err
    before = len(sp.read_results(folder))
    found = sp.sweep(tmp_path / "study.toml", folder, resume=True)
    assert len(found) == 1024 > before > 0


@pytest.mark.parametrize(
    "address", ["foo", "tcp://127.0.0.1", "nohost.invalid:8786", "127.0.0.1:x"]
)
def test_what_is_no_address_is_refused_at_once_and_without_a_traceback(tmp_path, address):
    """Dask would wait for it, and then fail once more when its client is collected."""
    (tmp_path / "study.toml").write_text(STUDY, encoding="utf-8")
    done = subprocess.run(
        [sys.executable, "-m", "stonepass", "sweep", "study.toml", "--out", "s", "--scheduler", address],
        cwd=tmp_path, capture_output=True, text=True, check=False, timeout=PATIENCE,
    )  # fmt: skip
    assert done.returncode == 2
    (told,) = done.stderr.strip().splitlines()
    assert told.startswith(f"stonepass: --scheduler is {address}, but must be the address")


def test_a_scheduler_that_does_not_answer_is_told(tmp_path, capsys):
    (tmp_path / "study.toml").write_text(STUDY)
    arguments = ["sweep", str(tmp_path / "study.toml"), "--out", str(tmp_path / "s")]
    from stonepass.studies.sweeps import cluster as clusters

    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(clusters, "PATIENCE", 0.5)
        assert run([*arguments, "--scheduler", "tcp://127.0.0.1:9"]) == 2
        assert run([*arguments, "--scheduler", "nonsense"]) == 2
    err = capsys.readouterr().err
    assert err.count("start it with 'dask scheduler'") == 2
    assert "Traceback" not in err
