"""Ctrl-C, TERM and a killed parent: a parallel command ends, and leaves neither process nor file."""

import math
import os
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

from stonepass.studies import executor as executors
from stonepass.studies.sweeps.workers import PoolWorkers

PROCESSES = Path("/proc")
pytestmark = pytest.mark.skipif(not PROCESSES.is_dir(), reason="processes are listed by Linux")
PATIENCE = 60.0  # s on a busy machine; how fast it is is no matter of a test
WORK = """
import sys, time
from pathlib import Path
from stonepass.studies.executor import process_pool, stream

def work(item):
    Path(sys.argv[1], f"began-{item}").touch()
    while True:
        sum(range(1000))

if __name__ == "__main__":
    with process_pool(2) as pool:
        list(stream(pool, work, range(4)))
"""
CURVE = "from stonepass.cli import main; main()"


def group(leader):
    """The processes of a process group that still run."""
    found = []
    for each in PROCESSES.glob("[0-9]*"):
        try:
            state, _, pgrp = (each / "stat").read_text().rpartition(")")[2].split()[:3]
        except (OSError, ValueError):  # it ended meanwhile
            continue
        if int(pgrp) == leader and state != "Z":
            found.append(int(each.name))
    return found


def wait_until(holds):
    end = time.monotonic() + PATIENCE
    while not holds():
        assert time.monotonic() < end
        time.sleep(0.05)


@pytest.fixture
def started(tmp_path):
    """Start a command in a process group of its own; what is left of it is killed in the end."""
    begun = []

    def start(code, *arguments):
        pipe = subprocess.PIPE
        command = [sys.executable, "-c", code, *arguments]
        if code == WORK:  # new processes import what they run from a file
            script = tmp_path / "work.py"
            script.write_text(WORK)
            command = [sys.executable, str(script), *arguments]
        process = subprocess.Popen(
            command, stdout=pipe, stderr=pipe, text=True, start_new_session=True,
            # A process that a shell has put in the background ignores Ctrl-C, and so would this.
            preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
        )  # fmt: skip
        begun.append(process)
        return process

    yield start
    for process in begun:
        for left in group(process.pid):
            os.kill(left, signal.SIGKILL)
        process.communicate()


@pytest.mark.parametrize(("sent", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_one_signal_stops_a_parallel_command(started, tmp_path, sent, code):
    cache = tmp_path / "cache"
    process = started(
        CURVE, "curve", "--eta", "1.5", "--xi", "1.05:1.35:0.002", "--material", "latex",
        "--workers", "2", "--cache", str(cache),
    )  # fmt: skip
    wait_until(lambda: any(cache.rglob("*")))  # the work has begun
    os.killpg(process.pid, sent)  # as a terminal does
    _, said = process.communicate(timeout=PATIENCE)
    assert process.returncode == code
    assert said.endswith("stonepass: stopped.\n")
    assert "Traceback" not in said
    wait_until(lambda: not group(process.pid))
    assert list(cache.rglob("*.new")) == []


@pytest.mark.parametrize("sent", [signal.SIGINT, signal.SIGTERM, signal.SIGKILL])
def test_workers_end_with_their_parent(started, tmp_path, sent):
    process = started(WORK, str(tmp_path))
    wait_until(lambda: len(list(tmp_path.glob("began-*"))) == 2)
    assert len(group(process.pid)) >= 3
    process.send_signal(sent)
    process.communicate(timeout=PATIENCE)
    assert process.returncode != 0
    wait_until(lambda: not group(process.pid))


def test_a_killed_worker_is_told_in_one_sentence(started, tmp_path):
    process = started(WORK, str(tmp_path))
    wait_until(lambda: len(list(tmp_path.glob("began-*"))) == 2)
    for each in group(process.pid):
        if b"spawn_main" in (PROCESSES / str(each) / "cmdline").read_bytes():
            os.kill(each, signal.SIGKILL)
            break
    _, said = process.communicate(timeout=PATIENCE)
    assert "StonepassError: a worker process was killed" in said.splitlines()[-1]
    wait_until(lambda: not group(process.pid))


def test_a_worker_that_is_killed_while_another_one_starts_leaves_no_pool_that_waits(monkeypatch):
    """The pool is broken then, and the process that was just starting is not told to end."""
    begun, plain = [], executors._Worker.start

    def start(process):
        plain(process)
        begun.append(process)
        if len(begun) == 2:
            os.kill(begun[0].pid, signal.SIGKILL)
            time.sleep(0.5)  # the pool finds out before it knows the second process

    monkeypatch.setattr(executors._Worker, "start", start)
    with PoolWorkers(2).open() as workers:
        lost = [workers.executor.submit(time.sleep, 60.0) for _ in range(2)]
        assert all(each.exception(PATIENCE) for each in lost)
        renewing = threading.Thread(target=workers.renew, daemon=True)
        renewing.start()
        renewing.join(PATIENCE)
        waiting = renewing.is_alive()
        begun[1].kill()  # so that a failing test ends
        assert not waiting
        assert workers.executor.submit(math.sqrt, 4.0).result(PATIENCE) == 2.0
