"""Output that cannot be written: the answer is printed all the same, and no file is half written."""

import errno
import json
import os
import resource
import subprocess
import sys
from pathlib import Path

import pytest

from stonepass.cli import run
from stonepass.errors import BadInput
from stonepass.io.text_file import check_writable, write_file

LATEX = ["--xi", "1.2", "--eta", "1.5", "--material", "latex", "--seating", "frictionless",
         "--accuracy", "fast", "--json"]  # fmt: skip
FULL = Path("/dev/full")  # a device of Linux that is always full


@pytest.fixture
def full_disk(monkeypatch):
    """The disk is full after the first ten bytes of each file."""
    write = Path.write_bytes

    def full(path, content):
        write(path, content[:10])
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(Path, "write_bytes", full)


def test_a_file_is_replaced_as_a_whole(tmp_path):
    path = tmp_path / "a.csv"
    write_file(path, "first")
    path.chmod(0o640)
    write_file(path, "second")
    assert path.read_text() == "second"
    assert path.stat().st_mode & 0o777 == 0o640
    assert list(tmp_path.iterdir()) == [path]


def test_a_link_stays_a_link(tmp_path):
    (tmp_path / "link.csv").symlink_to(tmp_path / "a.csv")
    write_file(tmp_path / "link.csv", "text")
    assert (tmp_path / "link.csv").is_symlink()
    assert (tmp_path / "a.csv").read_text() == "text"


def test_a_full_disk_leaves_the_old_file(tmp_path, full_disk):
    path = tmp_path / "a.csv"
    path.touch()
    old = path.stat().st_ino
    with pytest.raises(BadInput, match=r"a\.csv, but must be writable \(No space left"):
        write_file(path, "a long text that does not fit")
    assert path.stat().st_ino == old
    assert path.read_bytes() == b""
    assert list(tmp_path.iterdir()) == [path]


@pytest.mark.parametrize("option", ["--profile", "--figure", "--save"])
def test_the_answer_is_printed_before_files_are_written(
    shared_solutions, tmp_path, capsys, full_disk, option
):
    path = tmp_path / {"--profile": "p.csv", "--figure": "f.svg", "--save": "c.toml"}[option]
    code = run(["pressure", *LATEX, option, str(path)])
    out, err = capsys.readouterr()
    assert code == 2
    assert json.loads(out)["outcome"] == "MOVES"
    assert err.splitlines()[-1].endswith("but must be writable (No space left on device).")
    assert list(tmp_path.iterdir()) == []


def test_a_cache_that_cannot_be_written_costs_one_warning(tmp_path, capsys):
    in_the_way = tmp_path / "file"
    in_the_way.touch()
    arguments = ["curve", "--eta", "1.5", "--material", "latex", "--seating", "frictionless",
                 "--accuracy", "fast", "--xi", "1.1:1.2:0.1", "--json"]  # fmt: skip
    assert run([*arguments, "--workers", "1", "--cache", str(in_the_way)]) == 0
    out, err = capsys.readouterr()
    assert [each["outcome"] for each in json.loads(out)] == ["MOVES", "MOVES"]
    (warned,) = [line for line in err.splitlines() if line.startswith("warning")]
    assert "file' could not be written" in warned
    assert warned.endswith("; --cache DIR chooses another folder, --no-cache works without one")


def test_names_that_cannot_be_written_are_refused_before_the_work(tmp_path):
    (tmp_path / "folder.csv").mkdir()
    for path in (tmp_path / "folder.csv", tmp_path / "none" / "a.csv"):
        with pytest.raises(BadInput, match="in a folder that can be written to"):
            check_writable(path, (".csv",))
    with pytest.raises(BadInput, match="a name ending in"):
        check_writable(tmp_path / "a.txt", (".csv",))


@pytest.mark.skipif(not FULL.exists(), reason="needs a device of Linux")
@pytest.mark.parametrize("arguments", [["material", "list"], ["material", "laws"], ["--help"]])
def test_a_full_device_is_said(arguments):
    with FULL.open("w") as full:
        done = subprocess.run(
            [sys.executable, "-m", "stonepass", *arguments], stdout=full, stderr=-1, check=False
        )
    assert done.returncode == 2
    said = "stonepass: the output could not be written: No space left on device.\n"
    assert done.stderr.decode() == said


def test_too_little_memory_is_said(shared_solutions, capsys, monkeypatch):
    def hungry(case, states):
        raise MemoryError

    monkeypatch.setattr("stonepass.model.critical.solve", hungry)
    assert run(["pressure", *LATEX]) == 2
    assert "there is not enough memory" in capsys.readouterr().err


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="other systems count memory in another way")
def test_a_limit_of_memory_ends_in_a_sentence():
    """From too little for the libraries to too little for the elements."""
    for megabytes in (300, 600, 800, 1000, 1200):
        limit = (megabytes * 1_000_000,) * 2
        done = subprocess.run(
            [sys.executable, "-m", "stonepass", "pressure", *LATEX],
            capture_output=True, text=True, check=False,
            preexec_fn=lambda limit=limit: resource.setrlimit(resource.RLIMIT_AS, limit),
        )  # fmt: skip
        assert done.returncode in (0, 1, 2), done.stderr  # 1 where OpenBLAS ends the process
        assert "fault" not in done.stderr
        assert "memory" in done.stderr.lower() or done.returncode == 0
