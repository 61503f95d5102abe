"""The commands `sweep` and `results`: exit codes, what they say, how they stop and go on."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

import stonepass as sp
from stonepass.cli import run
from stonepass.cli.case_progress import counting_cases, standing_line
from stonepass.studies.sweeps import advice, case_rows
from stonepass.studies.sweeps import run as runs
from stonepass.studies.sweeps.ledger import read_ledger
from stonepass.studies.sweeps.run import Standing

STUDY = """
[ureter]
wall_ratio = 1.3
material = "latex"
[method]
model = "beam"
secant_stretch = 1.2
[vary]
stone.size_ratio = [1.05, 1.1, 1.2]
stone.friction = [0.1, 0.3]
"""


@pytest.fixture
def cli(capsys, tmp_path, monkeypatch):
    """Run the command line in this process, in a folder with a study: (exit code, stdout, stderr)."""
    monkeypatch.chdir(tmp_path)
    Path("study.toml").write_text(STUDY)

    def call(*arguments):
        code = run([*arguments, *(["--workers", "1"] if arguments[0] == "sweep" else [])])
        return code, *capsys.readouterr()

    return call


def test_a_sweep_and_its_results(cli):
    code, out, err = cli("sweep", "study.toml", "--out", "s", "--accuracy", "fast")
    assert (code, "6 of 6 cases" in out, "MOVES" in out) == (0, True, True)
    assert "'stonepass results s' shows these results again" in err
    again = cli("results", "s")
    assert (again[0], again[1]) == (0, out)
    files = ("r.csv", "r.parquet", "r.nc", "r.png")
    options = dict(zip(("--csv", "--parquet", "--netcdf", "--figure"), files, strict=True))
    code, out, err = cli(
        "results", "s", "--json", *(part for pair in options.items() for part in pair)
    )
    assert code == 0
    assert json.loads(out)["models"][0]["outcomes"] == {"MOVES": 6}
    assert err.splitlines() == [f"wrote {name}" for name in files]
    assert len(Path("r.csv").read_text().splitlines()) == 7
    assert all(Path(name).stat().st_size > 200 for name in files)


def test_the_folder_is_resumed_only_if_that_is_asked_for(cli):
    assert cli("sweep", "study.toml", "--out", "s")[0] == 0
    code, out, err = cli("sweep", "study.toml", "--out", "s")
    assert (code, out) == (2, "")
    assert err == (
        "stonepass: --out is s, but must be a folder without results; give --resume to go on with "
        "the study in it.\n"
    )
    assert cli("sweep", "study.toml", "--out", "s", "--resume")[0] == 0


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("sweep", "none.toml", "--out", "s"), "none.toml, but must be a file that exists"),
        (("sweep", "study.toml", "--out", "study.toml/s"), "--out is study.toml/s"),
        (("sweep", "study.toml", "--out", "s", "--accuracy", "best"), "--accuracy is best"),
        (("sweep", "study.toml", "--out", "s", "--scheduler", "tcp://h:1"), "--workers cannot be"),
        (("results", "none"), "ledger.sqlite"),
        (("results", "s", "--csv", "r.xlsx"), "a name ending in .csv"),
    ],
)
def test_a_refusal_is_one_sentence(cli, arguments, words):
    code, out, err = cli(*arguments)
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert words in err


def test_cases_without_an_answer_and_errors_of_the_program_have_exit_codes(cli, monkeypatch):
    text = STUDY.replace("wall_ratio = 1.3\n", "").replace(
        "[vary]", "[vary]\nureter.wall_ratio = [1.3, 1.9]"
    )
    Path("thick.toml").write_text(text)
    code, out, _ = cli("sweep", "thick.toml", "--out", "thick")
    assert (code, "BAD_INPUT" in out) == (1, True)
    solve, calls = case_rows.PressureJob.run, []

    def failing(job, folder):
        calls.append(job)
        if len(calls) == 2:
            raise RuntimeError("out of luck")
        return solve(job, folder)

    monkeypatch.setattr(case_rows.PressureJob, "run", failing)
    code, out, err = cli("sweep", "study.toml", "--out", "s")
    assert (code, "PROGRAM_ERROR" in out, "Traceback" in err) == (3, True, False)
    assert sp.read_results("s").table()["reason"][1].as_py() == "RuntimeError: out of luck"


def test_ctrl_c_says_how_to_go_on(cli, monkeypatch):
    add, calls = runs.add, []

    def stopped(connection, block):
        calls.append(block)
        if len(calls) == 2:
            raise KeyboardInterrupt
        add(connection, block)

    monkeypatch.setattr(runs, "add", stopped)
    code, out, err = cli("sweep", "study.toml", "--out", "s")
    done = len(sp.read_results("s"))
    assert 0 < done < 6
    assert (code, out) == (130, "")
    assert err.splitlines() == [
        f"{done} of 6 cases are finished and kept in 's'; the same command with --resume goes on",
        "stonepass: stopped.",
    ]
    monkeypatch.undo()


def test_a_sweep_of_many_days_is_refused_unless_it_is_accepted(cli, monkeypatch):
    text = STUDY.replace("[0.1, 0.3]", "{from = 0.1, to = 0.3, count = 1000}")
    Path("long.toml").write_text(text)
    monkeypatch.setattr(advice, "case_seconds", lambda *a: [500.0])
    code, out, err = cli("sweep", "long.toml", "--out", "s")
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert "3 000 cases × 5e+02 s a case / 1 worker = 17 days, and 3 days are accepted" in err
    assert "--max-days 21" in err
    seen = []
    monkeypatch.setattr(runs, "solved_blocks", lambda *a: seen.append(a) or [])
    cli("sweep", "long.toml", "--out", "s", "--max-days", "21")
    assert len(seen) == 1


def test_progress_has_rate_failures_and_time_left(capsys, monkeypatch):
    now = Standing(300, 1000, 12, 2)
    assert standing_line(now, 200, 50.0) == (
        "300 of 1000 cases, 12 without an answer, 2 of them errors of the program, 4 a second, "
        "3 min left"
    )
    assert standing_line(Standing(0, 9), 0, 1.0) == "0 of 9 cases"
    clock = iter(range(0, 10_000, 4))
    monkeypatch.setattr("stonepass.cli.case_progress.time.monotonic", lambda: next(clock))
    with counting_cases() as tell:
        for done in range(9):
            tell(Standing(done, 9))
    lines = capsys.readouterr().err.splitlines()
    assert 1 < len(lines) < 9
    assert all("of 9 cases, " in each and "left" in each for each in lines)
    monkeypatch.setattr("sys.stderr.isatty", lambda: True)
    with counting_cases() as tell:
        tell(Standing(2, 9))
    assert "2 of 9 cases" in capsys.readouterr().err


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="signals of a terminal")
@pytest.mark.parametrize(("sent", "code"), [(signal.SIGINT, 130), (signal.SIGTERM, 143)])
def test_one_signal_stops_a_parallel_sweep_and_it_goes_on(tmp_path, sent, code):
    study, folder = tmp_path / "study.toml", tmp_path / "s"
    study.write_text(STUDY.replace("[0.1, 0.3]", "{from = 0.1, to = 0.3, count = 1500}"))
    command = [sys.executable, "-m", "stonepass", "sweep", str(study), "--out", str(folder)]
    process = subprocess.Popen(
        [*command, "--workers", "2"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
        start_new_session=True, preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )  # fmt: skip
    while not (folder / "ledger.sqlite").exists() or not read_ledger(folder).entries:
        assert process.poll() is None
        time.sleep(0.05)
    os.killpg(process.pid, sent)
    _, said = process.communicate(timeout=60.0)
    assert process.returncode == code
    assert "with --resume goes on\nstonepass: stopped.\n" in said
    assert "Traceback" not in said
    before = len(sp.read_results(folder))
    assert 0 < before < 4500
    assert subprocess.run([*command, "--resume"], capture_output=True, check=False).returncode == 0
    found = sp.read_results(folder)
    assert found.table()["index"].to_pylist() == list(range(4500))
