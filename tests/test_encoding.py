"""Output under a code page: every command prints, and nothing is lost but the look of symbols."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

import stonepass
from stonepass.cli.encoding import spell

SOURCE = Path(stonepass.__file__).parent
BEAM = "pressure --xi 1.2 --eta 1.3 --model beam --E1 0.465MPa --E2 0.02MPa"


def printed(arguments, encoding):
    """(Exit code, stdout) of a process whose output is redirected."""
    done = subprocess.run(
        [sys.executable, "-m", "stonepass", *arguments.split()],
        capture_output=True, check=False, env=os.environ | {"PYTHONIOENCODING": encoding},
    )  # fmt: skip
    return done.returncode, done.stdout.decode(encoding)


@pytest.mark.parametrize("encoding", ["ascii", "cp1252"])
def test_a_table_is_spelled_out(encoding):
    code, out = printed(BEAM, encoding)
    assert code == 0
    assert "xi = 1.2, eta = 1.3" in out
    assert "12.49" in out
    assert "?" not in out


def test_json_is_the_same_data_in_every_encoding():
    documents = [json.loads(printed(f"{BEAM} --json", each)[1]) for each in ("ascii", "utf-8")]
    assert documents[0] == documents[1]


def test_every_symbol_that_may_be_printed_has_a_spelling():
    folders = [SOURCE / name for name in ("cli", "report", "records", "model", "inputs", "paper")]
    files = [path for folder in folders for path in folder.rglob("*.py")] + list(
        SOURCE.glob("*.py")
    )
    found = {c for path in files for c in path.read_text(encoding="utf-8") if ord(c) > 127}
    assert len(found) > 50
    assert {c for c in found if spell(c) == "?" or not spell(c).isascii()} == set()


def test_spellings():
    assert [spell(c) for c in "ξΘ₂─│×é"] == ["xi", "Theta", "2", "-", "|", "x", "e"]
