"""Requests that follow from the server's own description: none of them is an error of the program."""

import sys
from pathlib import Path

import pytest
from web_server import ServerLimits, server

FOLDER = Path(__file__).parents[1] / "benchmarks"
REQUESTS = 1500


@pytest.mark.slow
def test_no_request_that_follows_from_the_description_is_an_error_of_the_program(monkeypatch):
    monkeypatch.syspath_prepend(str(FOLDER))
    from api_fuzz import fuzz

    limits = ServerLimits(per_minute=10**6, job_seconds=5.0, waiting=4)
    with server(workers=1, limits=limits) as serving:
        found = fuzz(f"http://127.0.0.1:{serving.port}", REQUESTS)
    faults = {label: number for label, number in found.items() if label[1] >= 500}
    assert not faults
    assert sum(found.values()) > REQUESTS // 2
    statuses = {status for _, status in found}
    assert {200, 202, 400, 404, 410, 415, 422} <= statuses
    assert "schemathesis" in sys.modules
