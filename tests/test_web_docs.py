"""The commands of the page about the API run, and its tables are complete."""

import re
import runpy
import shutil
import subprocess
from pathlib import Path

import pytest
from web_server import client, server

from stonepass.web.answers import TITLES
from stonepass.web.jobs.worker import MODULES

ROOT = Path(__file__).parents[1]
PAGE = (ROOT / "docs" / "api.md").read_text(encoding="utf-8")
EXPECTED = [
    '"sentence":"The stone starts to move once the urine pressure above it reaches',
    '"status":"done"',
    '"status":"done"',  # of the job that is deleted
    '"neo-hookean"',
    "",
    '"field":"stone.diameter"',
]


@pytest.mark.skipif(shutil.which("curl") is None, reason="curl is not installed")
def test_the_curl_commands_of_the_documentation_run(tmp_path):
    blocks = re.findall(r"```sh\n(.*?)```", PAGE, re.DOTALL)
    assert len(blocks) == len(EXPECTED)
    shutil.copytree(ROOT / "examples", tmp_path / "examples")
    with server(tmp_path / "solved", workers=1) as serving:
        script = "\necho '=== next'\n".join(["set -eu", *blocks])
        script = script.replace("127.0.0.1:8765", f"127.0.0.1:{serving.port}")
        done = subprocess.run(
            ["bash", "-c", script], capture_output=True, text=True, cwd=tmp_path, timeout=120,
            check=True,
        )  # fmt: skip
    _, *answers = done.stdout.split("=== next\n")
    for answer, expected in zip(answers, EXPECTED, strict=True):
        assert expected in answer
    assert "Research use only" in (tmp_path / "report.html").read_text(encoding="utf-8")


def test_the_page_lists_every_address_kind_and_status():
    with client() as asking:
        described = asking.get("/api/v1/openapi.json").json()["paths"]
    listed = set(re.findall(r"^\| `(\w+) (/\S+)` \|", PAGE, re.MULTILINE))
    known = {(method.upper(), path) for path, methods in described.items() for method in methods}
    renamed = {(method, path.replace("{identity}", "{id}")) for method, path in known}
    assert listed == renamed
    assert set(re.findall(r"^\| `(\w+)` \| `(?:case|patient|upload)", PAGE, re.MULTILINE)) == set(
        MODULES
    )
    statuses = PAGE.split("## Problems")[1]
    for status in TITLES.keys() - {405, 500}:
        assert str(status) in statuses


def test_the_words_of_the_page_are_those_of_the_glossary():
    written = runpy.run_path(str(ROOT / "docs" / "write_reference.py"))["glossary_words"]()
    kept = ROOT / "src" / "stonepass" / "web" / "glossary.json"
    assert kept.read_text(encoding="utf-8") == written, "write it again: docs/write_reference.py"
