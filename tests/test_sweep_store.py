"""The store of a sweep loses nothing: kills, a full disk, folders that are not its own."""

import errno
import os
import random
import signal
import sqlite3
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pyarrow.dataset
import pytest
from shown import check_shown
from test_sweeps import BEAM, GRID, rows

import stonepass as sp
from stonepass.studies.sweeps import ledger as ledgers
from stonepass.studies.sweeps import run as runs
from stonepass.studies.sweeps import shards
from stonepass.studies.sweeps.ledger import LEDGER, locked, read_ledger

PATIENCE = 60.0  # s on a busy machine
LARGE = {
    "ureter": {"wall_ratio": 1.3, "material": "latex"},
    "method": {
        "model": "beam",
        "circumferential_modulus": "0.4 MPa",
        "longitudinal_modulus": "0.02 MPa",
    },
    "vary": {
        "stone.size_ratio": {"low": 0.95, "high": 1.3},
        "stone.friction": {"low": 0.05, "high": 0.6},
    },
    "samples": {"count": 128, "seed": 3},
}
# A study that lasts longer than all kills together, on a fast machine too.
LARGER = LARGE | {"samples": {"count": 512, "seed": 3}}
RUN = """
import json, sys
import stonepass as sp
if __name__ == "__main__":
    study, folder, workers, block = json.loads(sys.argv[1])
    sp.sweep(study, folder, workers=workers, block_cases=block, resume=True, progress=False)
    print("done")
"""


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """The large study without an interruption."""
    return sp.sweep(LARGE, tmp_path_factory.mktemp("whole") / "s", block_cases=8)


@pytest.fixture(scope="module")
def larger_whole(tmp_path_factory):
    """The larger study without an interruption."""
    return sp.sweep(LARGER, tmp_path_factory.mktemp("larger") / "s", block_cases=8)


@pytest.fixture
def started(tmp_path):
    """Start a sweep in a process group of its own; what is left of it is killed in the end."""
    import json

    script = tmp_path / "run.py"
    script.write_text(RUN)
    begun = []

    def start(folder, workers=1, block=8, study=LARGE):
        given = json.dumps([study, str(folder), workers, block])
        process = subprocess.Popen(
            [sys.executable, str(script), given], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
            text=True, start_new_session=True,
        )  # fmt: skip
        begun.append(process)
        return process

    yield start
    for process in begun:
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGKILL)
        process.communicate()


class Forked:
    """A sweep in a copy of this process, which begins at once."""

    def __init__(self, folder):
        self.pid = os.fork()
        self.status = None
        if self.pid == 0:
            os.setsid()
            sp.sweep(LARGER, folder, resume=True, block_cases=8, progress=False)
            os._exit(0)

    def poll(self):
        if self.status is None:
            pid, status = os.waitpid(self.pid, os.WNOHANG)
            self.status = status if pid else None
        return self.status

    def wait(self):
        while self.poll() is None:
            time.sleep(0.005)


def finished(folder):
    """(start, digest) of the finished blocks; every file that the ledger names is read whole."""
    if not (folder / LEDGER).exists():
        return set()
    found = sp.read_results(folder)
    table = found.table()
    assert table.num_rows == len(found)
    for entry in found.ledger.entries:
        assert shards.digest_of((folder / entry.shard).read_bytes()) == entry.digest
    return {(entry.start, entry.digest) for entry in found.ledger.entries}


def kill_at_random(start, folder, kills, seed):
    """Kill a sweep at random moments; return how many of the kills came while it wrote blocks."""
    moments, hit, before = random.Random(seed), 0, set()
    for _ in range(kills):
        process = start(folder)
        seen, end = len(before), time.monotonic() + PATIENCE
        while process.poll() is None and time.monotonic() < end:
            if (folder / LEDGER).exists() and len(read_ledger(folder).entries) > seen:
                break
            time.sleep(0.01)
        time.sleep(moments.uniform(0.0, 0.1))
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
        after = finished(folder)
        assert before <= after, "a finished block was lost"
        hit += before < after
        before = after
    return hit


def assert_equal_bit_for_bit(folder, whole):
    found = sp.read_results(folder)
    assert found.table().equals(whole.table())
    assert found.ledger.entries
    assert [(e.shard, e.digest) for e in found.ledger.entries] == [
        (e.shard, e.digest) for e in whole.ledger.entries
    ]
    files = sorted(str(p.relative_to(folder)) for p in (folder / "shards").rglob("*.*"))
    assert files == [e.shard for e in found.ledger.entries], "a file was left over"


@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system copies no processes")
def test_three_kills_lose_nothing(tmp_path, larger_whole):
    folder = tmp_path / "s"
    assert kill_at_random(Forked, folder, 3, seed=1) == 3
    assert 0 < len(sp.read_results(folder)) < 512
    sp.sweep(LARGER, folder, resume=True, block_cases=8)
    assert_equal_bit_for_bit(folder, larger_whole)


@pytest.mark.slow
def test_twenty_kills_lose_nothing(started, tmp_path, larger_whole):
    folder = tmp_path / "s"
    assert kill_at_random(lambda f: started(f, block=1, study=LARGER), folder, 24, seed=2) >= 20
    sp.sweep(LARGER, folder, resume=True)
    assert sp.read_results(folder).table().equals(larger_whole.table())
    assert len(list((folder / "shards").rglob("*.*"))) == len(read_ledger(folder).entries)


@pytest.mark.slow
def test_kills_of_single_workers_lose_nothing(started, tmp_path, larger_whole):
    """One process of the pool is killed now and then; the command goes on by itself."""
    folder = tmp_path / "s"
    process = started(folder, workers=2, block=8, study=LARGER)
    for seen in (1, 6, 12):
        workers = []  # there are none for a moment after a kill
        while len(finished(folder)) < seen or not workers:
            assert process.poll() is None, "the study ended before the last kill"
            time.sleep(0.02)
            workers = workers_of(process)
        os.kill(workers[0], signal.SIGKILL)
    out, err = process.communicate(timeout=4 * PATIENCE)
    assert (out, err) == ("done\n", "")
    assert sp.read_results(folder).table().equals(larger_whole.table())
    assert "WORKER_LOST" not in sp.read_results(folder).counts["beam"]


def workers_of(process):
    """Return the numbers of the processes of a pool; none for a process that has just ended."""
    found = []
    for child in Path(f"/proc/{process.pid}/task/{process.pid}/children").read_text().split():
        try:
            command = Path(f"/proc/{child}/cmdline").read_bytes()
        except OSError:
            continue
        if b"spawn_main" in command:
            found.append(int(child))
    return found


# --- what a stop may leave behind


def test_a_shard_that_the_ledger_does_not_name_is_removed(tmp_path, whole):
    """A process ended after it had renamed a shard, and before it entered the block."""
    folder = tmp_path / "s"
    plan = sp.read_sweep(LARGE)
    stopped_after(folder, plan, 3)
    stray = folder / "shards" / "000000" / "000000000024-000000000050.parquet"
    stray.write_bytes(b"half a shard")
    stray.with_name(stray.name + ".new").write_bytes(b"less")
    assert len(sp.read_results(folder)) == 24
    sp.sweep(LARGE, folder, resume=True, block_cases=8)
    assert_equal_bit_for_bit(folder, whole)


def stopped_after(folder, plan, blocks):
    """Run a sweep that Ctrl-C stops after some blocks."""
    left = iter(range(blocks + 1))

    def tell(standing):
        if next(left) == blocks:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        runs.run_sweep(plan, folder, tell=tell, block_cases=8)


@pytest.mark.parametrize("damage", [Path.unlink, lambda path: path.write_bytes(b"x")])
def test_a_damaged_shard_is_told_and_solved_again(tmp_path, whole, damage):
    folder = tmp_path / "s"
    stopped_after(folder, sp.read_sweep(LARGE), 4)
    damage(folder / read_ledger(folder).entries[2].shard)
    with pytest.raises(sp.StonepassError, match="missing or damaged"):
        sp.read_results(folder).table()
    sp.sweep(LARGE, folder, resume=True, block_cases=8)
    assert_equal_bit_for_bit(folder, whole)


READS = (
    lambda results, _: results.table(),
    lambda results, _: list(results.batches()),
    lambda results, _: results.to_xarray(),
    lambda results, folder: results.save(folder / "t.csv"),
)


def test_a_changed_byte_is_told(tmp_path, whole):
    """Anywhere in a shard: in a page, in its header, or in a name of a column."""
    folder = tmp_path / "s"
    stopped_after(folder, sp.read_sweep(LARGE), 3)
    shard = folder / read_ledger(folder).entries[1].shard
    content = shard.read_bytes()
    for place in np.random.default_rng(4).integers(0, len(content), 40):
        changed = bytearray(content)
        changed[place] ^= 0x55
        shard.write_bytes(changed)
        for read in READS:
            with pytest.raises(sp.StonepassError, match=r"missing or damaged .*have changed"):
                read(sp.read_results(folder), tmp_path)
        assert not list(tmp_path.glob("*t.csv*"))
    sp.sweep(LARGE, folder, resume=True, block_cases=8)
    assert_equal_bit_for_bit(folder, whole)


# --- folders and disks


def contents(folder):
    return {p: p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()}


def refusal(*arguments, **keywords):
    with pytest.raises(sp.StonepassError) as refused:
        sp.sweep(*arguments, **keywords)
    return str(refused.value)


def test_a_folder_with_other_contents_is_refused_and_left_alone(tmp_path):
    folder = tmp_path / "s"
    sp.sweep(GRID, folder)
    before = contents(folder)
    assert "give resume=True" in refusal(GRID, folder)
    other = GRID | {"vary": {"stone.size_ratio": [1.1]}}
    assert "another one; choose another folder" in refusal(other, folder, resume=True)
    assert contents(folder) == before
    mine = tmp_path / "mine"
    mine.mkdir()
    (mine / "thesis.txt").write_text("years of work")
    assert "an empty folder" in refusal(GRID, mine)
    assert "an empty folder" in refusal(GRID, mine, resume=True)
    assert [p.name for p in mine.iterdir()] == ["thesis.txt"]
    again = sp.sweep(GRID, folder, resume=True)
    assert contents(folder) == before
    assert len(again) == 6


def test_a_folder_of_another_format_or_solver_is_refused(tmp_path, monkeypatch):
    folder = tmp_path / "s"
    sp.sweep(GRID, folder)
    monkeypatch.setattr(runs, "this_solver", lambda: "another")
    assert "the numbers of two versions are not mixed" in refusal(GRID, folder, resume=True)
    monkeypatch.undo()
    connection = sqlite3.connect(folder / LEDGER)
    connection.execute("UPDATE study SET format = 7, version = '9.1'")
    connection.commit()
    connection.close()
    before = contents(folder)
    for call in (lambda: sp.read_results(folder), lambda: sp.sweep(GRID, folder, resume=True)):
        with pytest.raises(sp.BadInput, match=r"it has format 7 and was written by stonepass 9\.1"):
            call()
    assert contents(folder) == before


@pytest.mark.parametrize("content", [b"", b"no database at all", b"SQLite format 3\0" + bytes(900)])
def test_a_ledger_that_is_none_is_refused(tmp_path, content):
    (tmp_path / LEDGER).write_bytes(content)
    for call in (lambda: sp.read_results(tmp_path), lambda: sp.sweep(GRID, tmp_path, resume=True)):
        with pytest.raises(sp.BadInput, match="a ledger that can be read"):
            call()
    assert (tmp_path / LEDGER).read_bytes() == content
    with pytest.raises(sp.BadInput, match=r"which has a file ledger\.sqlite"):
        sp.read_results(tmp_path / "none")


def test_a_folder_that_cannot_be_written_is_refused(tmp_path):
    (tmp_path / "file").write_text("")
    assert "but must be writable" in refusal(GRID, tmp_path / "file" / "s")
    if Path("/proc").is_dir():  # where nobody can write, not even root
        assert "but must be writable" in refusal(GRID, "/proc/stonepass-sweep")


def test_a_second_process_is_refused(tmp_path):
    folder = tmp_path / "s"
    folder.mkdir()
    with locked(folder):
        assert "another process is writing" in refusal(GRID, folder)
    assert len(sp.sweep(GRID, folder)) == 6


class FullDisk:
    """The third shard finds no room."""

    def __init__(self):
        self.calls = 0

    def __call__(self, handle):
        self.calls += 1
        if self.calls > 4:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))


def test_a_full_disk_keeps_what_is_finished(tmp_path, monkeypatch, whole):
    folder = tmp_path / "s"
    monkeypatch.setattr(shards.os, "fsync", FullDisk())
    told = refusal(LARGE, folder, block_cases=8)
    assert "No space left on device" in told
    assert "resume=True" in told
    monkeypatch.undo()
    kept = finished(folder)
    assert 0 < len(kept) < 16
    assert list(folder.rglob("*.new")) == []
    sp.sweep(LARGE, folder, resume=True, block_cases=8)
    assert kept < finished(folder)
    assert_equal_bit_for_bit(folder, whole)


def test_a_full_disk_for_the_ledger_keeps_what_is_finished(tmp_path, monkeypatch, whole):
    folder = tmp_path / "s"
    add, calls = runs.add, []

    def full(connection, block):
        calls.append(block)
        if len(calls) == 3:
            raise sqlite3.OperationalError("database or disk is full")
        add(connection, block)

    monkeypatch.setattr(runs, "add", full)
    assert "database or disk is full" in refusal(LARGE, folder, block_cases=8)
    monkeypatch.undo()
    assert len(finished(folder)) == 2
    sp.sweep(LARGE, folder, resume=True, block_cases=8)
    assert_equal_bit_for_bit(folder, whole)


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32" or os.geteuid() != 0, reason="root mounts a small disk")
def test_a_small_disk_that_is_full(tmp_path, whole):
    disk = tmp_path / "disk"
    disk.mkdir()
    mounted = subprocess.run(
        ["mount", "-t", "tmpfs", "-o", "size=160k", "none", str(disk)],
        capture_output=True,
        check=False,
    )
    if mounted.returncode:
        pytest.skip("this system mounts no file system")
    try:
        told = refusal(LARGE, disk / "s", block_cases=8)
        assert "could not be written" in told
        kept = finished(disk / "s")
        assert 0 < len(kept) < 16
        subprocess.run(["mount", "-o", "remount,size=8m", str(disk)], check=True)
        sp.sweep(LARGE, disk / "s", resume=True, block_cases=8)
        assert_equal_bit_for_bit(disk / "s", whole)
        subprocess.run(["mount", "-o", "remount,ro", str(disk)], check=True)
        assert "but must be writable" in refusal(LARGE, disk / "s", resume=True)
        assert sp.read_results(disk / "s").table().equals(whole.table())
    finally:
        subprocess.run(["umount", str(disk)], check=True)


# --- reading


def test_results_are_read_lazily_and_by_columns(whole):
    assert len(whole) == 128
    table = whole.table(["index", "critical_pressure_kPa"])
    assert table.column_names == ["index", "critical_pressure_kPa"]
    moving = whole.table(["index"], pyarrow.dataset.field("outcome") == "MOVES")
    assert 0 < moving.num_rows == whole.counts["beam"]["MOVES"] < 128
    assert sum(batch.num_rows for batch in whole.batches(["index"])) == 128
    with pytest.raises(sp.BadInput, match="did you mean 'critical_pressure_kPa'"):
        whole.table(["critical_pressure"])
    frame = whole.to_frame()
    assert frame.shape == (128, len(whole.columns))
    assert str(frame.dtypes["size_ratio"]) == "float64"
    assert frame["index"].tolist() == list(range(128))
    assert rows(whole)[0]["critical_pressure_error_kPa"] is None


def test_a_grid_becomes_labelled_arrays(tmp_path):
    study = GRID | {
        "method": {},
        "models": {"thin": {"model": "beam"} | BEAM, "other": {"model": "beam"} | BEAM},
    }
    found = sp.sweep(study, tmp_path / "s")
    data = found.to_xarray()
    assert dict(data.sizes) == {"size_ratio": 3, "friction": 2, "model": 2}
    frame = found.to_frame()
    for _, row in frame.iterrows():
        cell = data.sel(size_ratio=row.size_ratio, friction=row.friction, model=row.model)
        assert float(cell.critical_pressure_kPa) == row.critical_pressure_kPa
        assert str(cell.outcome.item()) == row.outcome
    assert data.critical_pressure_kPa.attrs == {"units": "kPa"}


def test_samples_are_a_dimension_and_their_inputs_its_coordinates(tmp_path, whole):
    data = whole.to_xarray(["critical_pressure_kPa"])
    frame = whole.to_frame()
    assert dict(data.sizes) == {"sample": 128}
    assert data.size_ratio.to_numpy().tolist() == frame.size_ratio.tolist()
    assert list(data.data_vars) == ["critical_pressure_kPa"]
    stopped_after(tmp_path / "s", sp.read_sweep(LARGE), 2)
    part = sp.read_results(tmp_path / "s").to_xarray(["critical_pressure_kPa", "outcome"])
    assert int(part.size_ratio.notnull().sum()) == 16
    assert part.outcome.to_numpy()[16:].tolist() == [""] * 112


def test_results_are_written_to_files(tmp_path, whole):
    import pandas as pd
    import xarray as xr

    for ending in ("csv", "parquet", "nc"):
        whole.save(tmp_path / f"r.{ending}")
    frame = whole.to_frame()
    read = pd.read_csv(tmp_path / "r.csv")
    assert read.critical_pressure_kPa.equals(frame.critical_pressure_kPa)
    assert pd.read_parquet(tmp_path / "r.parquet").equals(frame)
    with xr.open_dataset(tmp_path / "r.nc", engine="h5netcdf") as data:
        assert data.critical_pressure_kPa.to_numpy()[5] == frame.critical_pressure_kPa[5]
        assert data.outcome.to_numpy()[5] == frame.outcome[5]
    assert sorted(p.name for p in tmp_path.iterdir()) == ["r.csv", "r.nc", "r.parquet"]
    with pytest.raises(sp.BadInput, match=r"ending in \.csv, \.parquet, \.nc"):
        whole.save(tmp_path / "r.txt")
    with pytest.raises(sp.BadInput, match="in a folder that can be written"):
        whole.save(tmp_path / "none" / "r.csv")


def test_the_journal_needs_no_shared_memory(tmp_path):
    """Network file systems have none; the write-ahead log of SQLite would need it."""
    sp.sweep(GRID, tmp_path / "s")
    with ledgers.opened(tmp_path / "s") as connection:
        assert connection.execute("PRAGMA journal_mode").fetchone() == ("delete",)
        assert connection.execute("PRAGMA synchronous").fetchone() == (3,)


# --- showing


def test_results_are_shown(whole, tmp_path):
    check_shown(whole, "index", "fingerprint", "size_ratio", "outcome", "critical_pressure_kPa")
    record = whole.to_dict()
    counts = whole.counts["beam"]
    assert record["models"][0]["outcomes"] == counts
    assert (record["cases"], record["finished"]) == (128, 128)
    quantiles = record["models"][0]["critical_pressure_quantiles_kPa"]
    pressures = whole.to_frame().critical_pressure_kPa.dropna()
    assert quantiles["median"] == pytest.approx(pressures.median(), rel=1e-12)
    assert (quantiles["smallest"], quantiles["largest"]) == (pressures.min(), pressures.max())
    assert sum(record["warning_counts"].values()) == sum(
        len(each["warnings"].split()) for each in rows(whole)
    )
    assert f"MOVES     {counts['MOVES']}" in str(whole) or f"{counts['MOVES']} (" in str(whole)
    for ending in ("png", "svg", "json"):
        whole.save(tmp_path / f"r.{ending}")
        assert (tmp_path / f"r.{ending}").stat().st_size > 500


def test_a_figure_of_several_models_and_of_names(tmp_path):
    study = {
        "stone": {"size_ratio": 1.1},
        "vary": {"ureter.material": ["latex", "ureter"], "ureter.wall_ratio": [1.3, 1.6],
                 "stone.friction": [0.1, 0.2]},
        "models": dict.fromkeys(("one", "two"), BEAM),
    }  # fmt: skip
    found = sp.sweep(study, tmp_path / "s")
    figure = found.figure()
    texts = [text.get_text() for axes in figure.axes for text in axes.get_xticklabels()]
    assert {"latex", "ureter"} <= set(texts)
    legend = figure.axes[3].get_legend()
    assert [each.get_text() for each in legend.get_texts()] == [
        "one", "two", "without a critical pressure"]  # fmt: skip
    assert "16 of 16 cases" in str(found)


def test_a_figure_without_a_critical_pressure_is_refused(tmp_path):
    thick = GRID | {"ureter": {"wall_ratio": 1.8, "material": "latex"}}
    found = sp.sweep(thick, tmp_path / "s")
    assert found.counts == {"beam": {"BAD_INPUT": 6}}
    with pytest.raises(sp.BadInput, match="where there is a critical pressure"):
        found.figure()
    assert "BAD_INPUT" in str(found)
    assert found.to_dict()["models"][0]["critical_pressure_quantiles_kPa"] is None
